// The absolute error that the published bounds allow at one sample of one net.
#pragma once

#include "tests/properties/accuracy/judge/shape_bounds.hpp"
#include "tests/support/oracle/oracle.hpp"
#include "tests/support/oracle/oracle_curvature.hpp"

namespace simdbezier::tests {

/// One value per derivative and component.
struct SampleErrors {
  Vector3 position{};
  Vector3 du{};
  Vector3 dv{};
  Vector3 duu{};
  Vector3 duv{};
  Vector3 dvv{};

  [[nodiscard]] DerivativeErrors derivatives() const { return {du, dv, duu, duv, dvv}; }
};

/// The weight function and its derivatives at a sample; 1 and 0 where there are no weights.
struct WeightSample {
  double w = 1;
  double u = 0;
  double v = 0;
  double uu = 0;
  double uv = 0;
  double vv = 0;
};

[[nodiscard]] inline WeightSample weight_sample(const Net& net, OracleParameter u,
                                                OracleParameter v) {
  if (!net.is_rational()) {
    return {};
  }
  const auto of = [&](Derivative order) {
    return channel_derivatives(net, u, v, order)[kWeightChannel].to_double();
  };
  return {of({0, 0}), of({1, 0}), of({0, 1}), of({2, 0}), of({1, 1}), of({0, 2})};
}

/// The largest control values of a net and its hodographs, component by component: what errors are
/// measured in.
struct NetScales {
  Vector3 position{};
  Vector3 du{};
  Vector3 dv{};
  Vector3 duu{};
  Vector3 duv{};
  Vector3 dvv{};
};

/// The scales of a polynomial net.
[[nodiscard]] NetScales scales_of(const Net& net);

/// How a net was packed and evaluated.
struct BoundRule {
  double unit_roundoff = 0;
  bool fma = true;
  bool local_origin = false;
};

/// The bounds that hold for all samples of one net.
///
/// Polynomial: K u max|b|; with local origins (2K + 1) u max|b|, since the origin lies in the hull
/// of the control points. Rational: the homogeneous surface h = w (b - O) and the weight w are
/// polynomial, with bounds E of their own; P - O = h / w, and so on by the quotient rule, each
/// operation rounding once (a division twice: it may be a reciprocal and a product).
class NetBounds {
public:
  NetBounds(const Net& net, const BoundRule& rule);
  [[nodiscard]] SampleErrors at(const OracleSample& sample, const WeightSample& weight) const;

private:
  [[nodiscard]] SampleErrors rational(const OracleSample& sample, const WeightSample& weight) const;

  BoundRule rule_;
  bool is_rational_;
  NetScales homogeneous_; ///< of h, or of the net where it is polynomial
  NetScales weights_;     ///< of w, in all three components
  Vector3 extent_{};      ///< bounds |P - O| where origins are local
  ShapeBounds bounds_;
};

} // namespace simdbezier::tests
