// The reference: tensor-product Bézier patches of any degree in double-double arithmetic.
//
// Bernstein weights times control points; derivatives from exact differences of control points.
// All weights are positive inside the patch, so each sum is componentwise accurate: the error is
// below 2^-96 sum |b| B_i B_j for degrees up to 15, which exact_rational.hpp checks on every run.
// Rational patches: the same sums in homogeneous coordinates, then the quotient rule.
// Shares nothing with the library, whose scheme is a centred power basis.
#pragma once

#include <array>
#include <vector>

#include "tests/support/nets/net.hpp"
#include "tests/support/oracle/oracle_arithmetic.hpp"

namespace simdbezier::tests {

using Vector3dd = std::array<DoubleDouble, 3>;

/// A parameter together with its complement, so that 1-t is never rounded.
struct OracleParameter {
  DoubleDouble t;
  DoubleDouble complement;

  /// t = (1+x)/2, exact for double x.
  static OracleParameter centred(DoubleDouble x) {
    return {scale_by_power_of_two(DoubleDouble(1.0) + x, -1),
            scale_by_power_of_two(DoubleDouble(1.0) - x, -1)};
  }
  static OracleParameter unit(double t) { return {t, two_sum(1.0, -t)}; }
};

struct OracleSample {
  Vector3dd position;
  Vector3dd du;
  Vector3dd dv;
  Vector3dd duu;
  Vector3dd duv;
  Vector3dd dvv;
};

struct OracleNormal {
  Vector3 direction{};      ///< unit length; zero where the cross product is zero
  double kappa = 0;         ///< (Hu|dv| + Hv|du|) / |du x dv|: how much it magnifies errors
  double relative_size = 0; ///< |du x dv| / (|Hu| |Hv|)
};

[[nodiscard]] std::vector<DoubleDouble> bernstein_weights(int degree, OracleParameter at);

/// The order of differentiation in each direction.
struct Derivative {
  int u = 0;
  int v = 0;
};

/// Channels of a net in homogeneous coordinates: x, y, z (times the weight) and the weight.
inline constexpr std::size_t kWeightChannel = 3;

[[nodiscard]] inline DoubleDouble channel_value(const Net& net, int j, int i, std::size_t c) {
  if (c == kWeightChannel) {
    return net.weight(j, i);
  }
  return net.is_rational() && !net.homogeneous ? two_product(net.weight(j, i), net.at(j, i)[c])
                                               : DoubleDouble(net.at(j, i)[c]);
}

/// The control values of one channel's hodograph of that order, rows in v: differences of control
/// values times falling factorials of the degrees. Single differences are exact, further ones up to
/// 2^-106.
[[nodiscard]] std::vector<DoubleDouble> hodograph(const Net& net, std::size_t c, Derivative order);

/// The largest of them: what errors of that derivative are relative to.
[[nodiscard]] double largest_hodograph(const Net& net, std::size_t component, Derivative order);
/// Returns the largest values for the three components of a polynomial net.
[[nodiscard]] inline Vector3 largest_hodographs(const Net& net, Derivative order) {
  return {largest_hodograph(net, 0, order), largest_hodograph(net, 1, order),
          largest_hodograph(net, 2, order)};
}

/// One derivative of all channels; the weight's is 0 where the net has none.
[[nodiscard]] std::array<DoubleDouble, 4> channel_derivatives(const Net& net, OracleParameter u,
                                                              OracleParameter v, Derivative order);

/// One derivative of a polynomial net, or of a rational one in homogeneous coordinates.
[[nodiscard]] inline Vector3dd oracle_derivative(const Net& net, OracleParameter u,
                                                 OracleParameter v, Derivative order) {
  const auto all = channel_derivatives(net, u, v, order);
  return {all[0], all[1], all[2]};
}

/// All of one sample. Rational patches by the quotient rule: h = w S, differentiated and solved for
/// the highest derivative of S.
[[nodiscard]] OracleSample oracle_sample(const Net& net, OracleParameter u, OracleParameter v);

[[nodiscard]] inline OracleSample oracle_sample(const Net& net, double x, double y) {
  return oracle_sample(net, OracleParameter::centred(x), OracleParameter::centred(y));
}

[[nodiscard]] inline DoubleDouble dot(const Vector3dd& a, const Vector3dd& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[nodiscard]] inline DoubleDouble length(const Vector3dd& a) { return sqrt(dot(a, a)); }

[[nodiscard]] inline Vector3dd cross(const Vector3dd& a, const Vector3dd& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[nodiscard]] inline Vector3dd scaled(Vector3dd a, int exponent) {
  for (DoubleDouble& value : a) {
    value = scale_by_power_of_two(value, exponent);
  }
  return a;
}

/// Largest hodograph control vector over all three components.
[[nodiscard]] inline Vector3 largest_hodographs_u(const Net& net) {
  return {largest_hodograph_u(net, 0), largest_hodograph_u(net, 1), largest_hodograph_u(net, 2)};
}
[[nodiscard]] inline Vector3 largest_hodographs_v(const Net& net) {
  return {largest_hodograph_v(net, 0), largest_hodograph_v(net, 1), largest_hodograph_v(net, 2)};
}
[[nodiscard]] inline double largest_of(const Vector3& a) { return std::max({a[0], a[1], a[2]}); }

/// The unit normal from exact tangents. Tangents are brought near 1 by powers of two first, so
/// that nets scaled by 2^-60 and 2^60 neither underflow nor overflow.
[[nodiscard]] inline OracleNormal oracle_normal(const Net& net, const OracleSample& sample) {
  const Net polygon = control_polygon(net);
  const double size_u = largest_of(largest_hodographs_u(polygon));
  const double size_v = largest_of(largest_hodographs_v(polygon));
  if (size_u == 0 || size_v == 0) {
    return {};
  }
  const int exponent_u = std::ilogb(size_u);
  const int exponent_v = std::ilogb(size_v);
  const Vector3dd du = scaled(sample.du, -exponent_u);
  const Vector3dd dv = scaled(sample.dv, -exponent_v);
  const Vector3dd normal = cross(du, dv);
  const DoubleDouble size = length(normal);
  if (size.hi == 0) {
    return {};
  }
  OracleNormal result;
  for (std::size_t c = 0; c < 3; ++c) {
    result.direction[c] = (normal[c] / size).to_double();
  }
  const double hodograph_u = std::ldexp(size_u, -exponent_u);
  const double hodograph_v = std::ldexp(size_v, -exponent_v);
  result.kappa = (hodograph_u * length(dv).hi + hodograph_v * length(du).hi) / size.hi;
  result.relative_size = size.hi / (hodograph_u * hodograph_v);
  return result;
}

/// The limit of the normal along the straight way to the patch's centre, for samples where the
/// cross product itself vanishes: evaluated 2^-26 of the way in, so within 1e-6 degree of the
/// limit on the families here, while |du x dv| >= 2^-78 S^2 keeps 28 bits in double-double.
[[nodiscard]] inline OracleNormal oracle_limit_normal(const Net& net, double x, double y) {
  constexpr double kPull = 0x1p-26;
  const auto pulled = [](double t) { return two_sum(t, -kPull * t); };
  const OracleSample sample =
      oracle_sample(net, OracleParameter::centred(pulled(x)), OracleParameter::centred(pulled(y)));
  return oracle_normal(net, sample);
}

} // namespace simdbezier::tests
