#include "kernels/fallback/surface_jet.hpp"

#include <algorithm>
#include <cmath>

namespace simdbezier::detail {

Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double squared_length(Vector a) { return a.x * a.x + a.y * a.y + a.z * a.z; }
double length(Vector a) { return std::sqrt(squared_length(a)); }
double max_norm(Vector a) {
  return std::max(std::fabs(a.x), std::max(std::fabs(a.y), std::fabs(a.z)));
}

namespace {

/// 2^-ilogb(size), for a positive finite size.
double inverse_power(double size) { return std::scalbn(1.0, -std::ilogb(size)); }

} // namespace

SurfaceFrame::SurfaceFrame(const NetShape& shape, const GivenNet& net)
    : degree_u_(static_cast<std::size_t>(shape.degree_u)),
      degree_v_(static_cast<std::size_t>(shape.degree_v)), rational_(shape.rational) {
  const std::size_t count = shape.points();
  const std::size_t channels = shape.channels();
  const auto point_of = [&](std::size_t k) {
    return Vector{net.coordinate(k, channels, 0), net.coordinate(k, channels, 1),
                  net.coordinate(k, channels, 2)};
  };
  double size = 0;
  double weight = 0;
  for (std::size_t k = 0; k < count; ++k) {
    size = std::max(size, max_norm(point_of(k)));
    weight = rational_ ? std::max(weight, net.value(k * channels + 3)) : 1;
  }
  if (size == 0) {
    return;
  }
  // Halved once more, so that differences cannot overflow.
  const int exponent = -std::ilogb(size) - 1;
  scale = std::scalbn(1.0, exponent);
  // The same values, but for sizes whose power of two no double holds.
  const bool one_factor = std::isnormal(scale);
  const auto scaled_point = [&](std::size_t k) {
    const Vector p = point_of(k);
    return one_factor ? scale * p
                      : Vector{std::scalbn(p.x, exponent), std::scalbn(p.y, exponent),
                               std::scalbn(p.z, exponent)};
  };
  const Vector origin = scaled_point(0);
  for (std::size_t k = 0; k < count; ++k) {
    points_[k] = scaled_point(k) - origin;
  }
  if (rational_) {
    const double weight_scale = inverse_power(weight);
    distance_ = size * scale;
    heaviest_ = weight * weight_scale;
    for (std::size_t k = 0; k < count; ++k) {
      weights_[k] = net.value(k * channels + 3) * weight_scale;
      extent_ = std::max(extent_, max_norm(points_[k]));
    }
  }
  measure();
}

/// A rational patch may move while its points do not, because their weights change; no further than
/// the patch extends.
void SurfaceFrame::measure_pair(std::size_t a, std::size_t b, double& size, double& step,
                                double& turn) const {
  const double distance = max_norm(points_[b] - points_[a]);
  size = std::max(size, distance);
  if (rational_) {
    const double larger = std::max(weights_[a], weights_[b]);
    const double difference = std::fabs(weights_[b] - weights_[a]);
    size = std::max(size, distance + difference / larger * 2 * extent_);
    step = std::max(step, larger * distance);
    turn = std::max(turn, difference);
  }
}

void SurfaceFrame::measure() {
  const std::size_t order_u = degree_u_ + 1;
  for (std::size_t j = 0; j <= degree_v_; ++j) {
    for (std::size_t i = 0; i < degree_u_; ++i) {
      measure_pair(j * order_u + i, j * order_u + i + 1, size_u, step_u_, turn_u_);
    }
  }
  for (std::size_t j = 0; j < degree_v_; ++j) {
    for (std::size_t i = 0; i <= degree_u_; ++i) {
      measure_pair(j * order_u + i, (j + 1) * order_u + i, size_v, step_v_, turn_v_);
    }
  }
  size_u *= static_cast<double>(degree_u_);
  size_v *= static_cast<double>(degree_v_);
  scale_u = size_u > 0 ? inverse_power(size_u) : 1;
  scale_v = size_v > 0 ? inverse_power(size_v) : 1;
}

SurfaceFrame::ErrorSizes SurfaceFrame::errors(double weight, double reach, double factor) const {
  if (!rational_) {
    return {size_u * scale_u, size_v * scale_v};
  }
  const double factor_u = factor * static_cast<double>(degree_u_) * scale_u / weight;
  const double factor_v = factor * static_cast<double>(degree_v_) * scale_v / weight;
  return {factor_u * (step_u_ + turn_u_ * reach), factor_v * (step_v_ + turn_v_ * reach)};
}

namespace {

/// Bernstein values of a degree and of the one below, and the first two derivatives.
/// (1-t, t) = (1/2-X, 1/2+X).
class Basis {
public:
  double value[kMostOrder];
  double lower[kMostOrder]; ///< of degree n - 1
  double first[kMostOrder];
  double second[kMostOrder];

  Basis(std::size_t degree, double half_centred) {
    const double s = 0.5 - half_centred;
    const double t = 0.5 + half_centred;
    double lowest[kMostOrder] = {}; // of degree n - 2
    fill(value, degree, s, t);
    fill(lower, degree - 1, s, t);
    if (degree > 1) {
      fill(lowest, degree - 2, s, t);
    }
    const auto n = static_cast<double>(degree);
    for (std::size_t i = 0; i <= degree; ++i) {
      const double q0 = i > 0 ? lower[i - 1] : 0;
      const double q1 = i < degree ? lower[i] : 0;
      const double l0 = i > 1 ? lowest[i - 2] : 0;
      const double l1 = i > 0 && i < degree ? lowest[i - 1] : 0;
      const double l2 = i + 1 < degree ? lowest[i] : 0;
      first[i] = n * (q0 - q1);
      second[i] = n * (n - 1) * (l0 - 2 * l1 + l2);
    }
  }

private:
  /// C(n,i) s^(n-i) t^i, factor by factor: relative errors of a few roundings, ends exact.
  static void fill(double* values, std::size_t degree, double s, double t) {
    double binomial = 1;
    for (std::size_t i = 0; i <= degree; ++i) {
      double product = binomial;
      for (std::size_t k = i; k < degree; ++k) {
        product *= s;
      }
      for (std::size_t k = 0; k < i; ++k) {
        product *= t;
      }
      values[i] = product;
      binomial = binomial * static_cast<double>(degree - i) / static_cast<double>(i + 1);
    }
  }
};

SurfaceJet polynomial_jet(const SurfaceFrame& frame, const Basis& bu, const Basis& bv) {
  const std::size_t m = frame.degree_u();
  const std::size_t n = frame.degree_v();
  SurfaceJet d;
  for (std::size_t j = 0; j <= n; ++j) {
    for (std::size_t i = 0; i < m; ++i) {
      const double w = static_cast<double>(m) * bv.value[j] * bu.lower[i];
      d.u = d.u + (w * frame.scale_u) * (frame.point(j, i + 1) - frame.point(j, i));
    }
    for (std::size_t i = 0; i <= m; ++i) {
      const Vector p = frame.point(j, i);
      d.uu = d.uu + (frame.scale_u * bu.second[i] * bv.value[j]) * p;
      d.uv = d.uv + (bu.first[i] * bv.first[j]) * p;
      d.vv = d.vv + (frame.scale_v * bu.value[i] * bv.second[j]) * p;
    }
  }
  for (std::size_t i = 0; i <= m; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double w = static_cast<double>(n) * bu.value[i] * bv.lower[j];
      d.v = d.v + (w * frame.scale_v) * (frame.point(j + 1, i) - frame.point(j, i));
    }
  }
  return d;
}

/// A numerator and its weight.
struct Weighted {
  Vector h{};
  double w = 0;

  void add(double factor, const Weighted& other) {
    h = h + factor * other.h;
    w += factor * other.w;
  }
  friend Weighted operator-(const Weighted& a, const Weighted& b) { return {a.h - b.h, a.w - b.w}; }
};

/// w S = h differentiated, around the control point that is nearest in parameters: where an edge
/// has collapsed, that is the pole, so numerators and tangent are exactly zero.
SurfaceJet rational_jet(const SurfaceFrame& frame, const Basis& bu, const Basis& bv, double x,
                        double y) {
  const std::size_t m = frame.degree_u();
  const std::size_t n = frame.degree_v();
  const auto nearest = [](double half_centred, std::size_t degree) {
    const double t = std::min(std::max(0.5 + half_centred, 0.0), 1.0);
    return static_cast<std::size_t>(t * static_cast<double>(degree) + 0.5);
  };
  const Vector origin = frame.point(nearest(y, n), nearest(x, m));
  const auto at = [&](std::size_t j, std::size_t i) {
    const double w = frame.weight(j, i);
    return Weighted{w * (frame.point(j, i) - origin), w};
  };
  Weighted value, u, v, uu, uv, vv;
  for (std::size_t j = 0; j <= n; ++j) {
    for (std::size_t i = 0; i <= m; ++i) {
      const Weighted p = at(j, i);
      value.add(bu.value[i] * bv.value[j], p);
      uu.add(bu.second[i] * bv.value[j], p);
      uv.add(bu.first[i] * bv.first[j], p);
      vv.add(bu.value[i] * bv.second[j], p);
      if (i < m) {
        u.add(static_cast<double>(m) * bu.lower[i] * bv.value[j], at(j, i + 1) - p);
      }
      if (j < n) {
        v.add(static_cast<double>(n) * bu.value[i] * bv.lower[j], at(j + 1, i) - p);
      }
    }
  }
  const double inverse = 1 / value.w;
  const Vector s = inverse * value.h;
  const Vector su = inverse * (u.h - u.w * s);
  const Vector sv = inverse * (v.h - v.w * s);
  SurfaceJet d;
  d.weight = value.w;
  d.u = frame.scale_u * su;
  d.v = frame.scale_v * sv;
  d.uu = (frame.scale_u * inverse) * (uu.h - 2 * u.w * su - uu.w * s);
  d.uv = inverse * (uv.h - v.w * su - u.w * sv - uv.w * s);
  d.vv = (frame.scale_v * inverse) * (vv.h - 2 * v.w * sv - vv.w * s);
  return d;
}

} // namespace

SurfaceJet surface_jet(const SurfaceFrame& frame, double x, double y) {
  const Basis bu(frame.degree_u(), x);
  const Basis bv(frame.degree_v(), y);
  return frame.rational() ? rational_jet(frame, bu, bv, x, y) : polynomial_jet(frame, bu, bv);
}

double surface_weight(const SurfaceFrame& frame, double x, double y) {
  if (!frame.rational()) {
    return 1;
  }
  const Basis bu(frame.degree_u(), x);
  const Basis bv(frame.degree_v(), y);
  double weight = 0;
  for (std::size_t j = 0; j <= frame.degree_v(); ++j) {
    for (std::size_t i = 0; i <= frame.degree_u(); ++i) {
      weight += bu.value[i] * bv.value[j] * frame.weight(j, i);
    }
  }
  return weight;
}

} // namespace simdbezier::detail
