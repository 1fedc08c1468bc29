// See sample_bounds.hpp.
#include "tests/properties/accuracy/judge/sample_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simdbezier::tests {
namespace {

/// The polynomial net of w (b - origin) for a rational net.
[[nodiscard]] Net homogeneous_points(const Net& net, const Vector3& origin) {
  Net points = control_polygon(net);
  for (std::size_t k = 0; k < points.points.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      points.points[k][c] = net.weights[k] * (points.points[k][c] - origin[c]);
    }
  }
  return points;
}

[[nodiscard]] Net weight_net(const Net& net) {
  Net weights = control_polygon(net);
  for (std::size_t k = 0; k < weights.points.size(); ++k) {
    weights.points[k].fill(net.weights[k]);
  }
  return weights;
}

[[nodiscard]] Vector3 larger(const Vector3& a, const Vector3& b) {
  return {std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
}
[[nodiscard]] NetScales larger(const NetScales& a, const NetScales& b) {
  return {larger(a.position, b.position), larger(a.du, b.du),   larger(a.dv, b.dv),
          larger(a.duu, b.duu),           larger(a.duv, b.duv), larger(a.dvv, b.dvv)};
}

[[nodiscard]] Vector3 times(double factor, Vector3 a) {
  for (double& value : a) {
    value *= factor;
  }
  return a;
}

/// Errors of the polynomial values with these scales.
[[nodiscard]] SampleErrors scaled_errors(double unit, const ShapeBounds& bounds,
                                         const NetScales& scales) {
  return {times(unit * bounds.position, scales.position),
          times(unit * bounds.du, scales.du),
          times(unit * bounds.dv, scales.dv),
          times(unit * bounds.duu, scales.duu),
          times(unit * bounds.duv, scales.duv),
          times(unit * bounds.dvv, scales.dvv)};
}

/// One term of the quotient rule: factor * a * w', with the errors of a and w'.
struct Term {
  double factor;
  double a;
  double a_error;
  double w;
  double w_error;
};

} // namespace

NetScales scales_of(const Net& net) {
  return {{largest_coordinate(net, 0), largest_coordinate(net, 1), largest_coordinate(net, 2)},
          largest_hodographs(net, {1, 0}),
          largest_hodographs(net, {0, 1}),
          largest_hodographs(net, {2, 0}),
          largest_hodographs(net, {1, 1}),
          largest_hodographs(net, {0, 2})};
}

NetBounds::NetBounds(const Net& net, const BoundRule& rule)
    : rule_(rule), is_rational_(net.is_rational()),
      bounds_(is_rational_ ? general_bounds(net.degree_u, net.degree_v, rule.fma)
                           : shape_bounds(net.degree_u, net.degree_v, rule.fma)) {
  const Net polygon = control_polygon(net);
  if (!is_rational_) {
    homogeneous_ = scales_of(polygon);
    return;
  }
  weights_ = scales_of(weight_net(net));
  if (!rule.local_origin) {
    homogeneous_ = scales_of(homogeneous_points(net, {}));
    return;
  }
  // The origin lies in the hull; everything is linear in it, so its ends are the worst.
  Vector3 low = polygon.points.front();
  Vector3 high = low;
  for (const Vector3& point : polygon.points) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], point[c]);
      high[c] = std::max(high[c], point[c]);
    }
  }
  homogeneous_ =
      larger(scales_of(homogeneous_points(net, low)), scales_of(homogeneous_points(net, high)));
  extent_ = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

SampleErrors NetBounds::at(const OracleSample& sample, const WeightSample& weight) const {
  if (is_rational_) {
    return rational(sample, weight);
  }
  ShapeBounds bounds = bounds_;
  if (rule_.local_origin) {
    bounds.position = 2 * bounds.position + 1;
  }
  return scaled_errors(rule_.unit_roundoff, bounds, homogeneous_);
}

SampleErrors NetBounds::rational(const OracleSample& sample, const WeightSample& weight) const {
  const double u = rule_.unit_roundoff;
  const SampleErrors h = scaled_errors(u, bounds_, homogeneous_);
  const SampleErrors w = scaled_errors(u, bounds_, weights_);
  const double least = weight.w - w.position[0]; // what the computed weight is at least
  if (!(least > 0)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const Vector3 none{kInfinity, kInfinity, kInfinity};
    return {none, none, none, none, none, none};
  }
  /// The error of (value's numerator - sum of terms) / w.
  const auto quotient = [&](double value, double own_error, std::initializer_list<Term> terms) {
    double error = own_error;
    double size = std::abs(value) * weight.w;
    for (const Term& t : terms) {
      error += t.factor *
               (std::abs(t.a) * t.w_error + std::abs(t.w) * t.a_error + t.a_error * t.w_error);
      size += t.factor * std::abs(t.a * t.w);
    }
    const double roundings = static_cast<double>(terms.size() + (terms.size() > 0 ? 1 : 0));
    error += roundings * u * size;
    return (error + std::abs(value) * w.position[0]) / least + 2 * u * std::abs(value);
  };
  SampleErrors e;
  for (std::size_t c = 0; c < 3; ++c) {
    const double p = sample.position[c].to_double();
    const double q = rule_.local_origin ? extent_[c] : p;
    const double du = sample.du[c].to_double();
    const double dv = sample.dv[c].to_double();
    const double q_error = quotient(q, h.position[c], {});
    e.position[c] = q_error + (rule_.local_origin ? u * (std::abs(p) + q_error) : 0);
    const auto by_q = [&](double w_value, double w_error) {
      return Term{1, q, q_error, w_value, w_error};
    };
    e.du[c] = quotient(du, h.du[c], {by_q(weight.u, w.du[0])});
    e.dv[c] = quotient(dv, h.dv[c], {by_q(weight.v, w.dv[0])});
    e.duu[c] = quotient(sample.duu[c].to_double(), h.duu[c],
                        {{2, du, e.du[c], weight.u, w.du[0]}, by_q(weight.uu, w.duu[0])});
    e.duv[c] = quotient(sample.duv[c].to_double(), h.duv[c],
                        {{1, du, e.du[c], weight.v, w.dv[0]},
                         {1, dv, e.dv[c], weight.u, w.du[0]},
                         by_q(weight.uv, w.duv[0])});
    e.dvv[c] = quotient(sample.dvv[c].to_double(), h.dvv[c],
                        {{2, dv, e.dv[c], weight.v, w.dv[0]}, by_q(weight.vv, w.dvv[0])});
  }
  return e;
}

} // namespace simdbezier::tests
