// Random splines of every kind, and their exact Bézier pieces by knot insertion in fractions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gmpxx.h>

#include <simdbezier/splines.hpp>

#include "tests/support/random.hpp"

namespace simdbezier::tests {

using Rational = mpq_class;

/// One direction of a spline.
struct AxisModel {
  int degree = 3;
  std::size_t points = 0;
  bool periodic = false;
  std::vector<double> knots; // empty: uniform
  Interval range = {};

  [[nodiscard]] std::size_t order() const { return static_cast<std::size_t>(degree) + 1; }
  /// The knots as splines without periods have them, for points that are repeated.
  [[nodiscard]] std::vector<Rational> exact_knots() const {
    std::vector<Rational> all;
    const auto n = static_cast<long>(points);
    const long last = n + degree + (periodic ? degree : 0);
    for (long k = 0; k <= last; ++k) {
      const long at = periodic ? k - degree : k;
      if (knots.empty()) {
        all.emplace_back(periodic ? at : at - degree);
      } else if (!periodic) {
        all.emplace_back(knots[static_cast<std::size_t>(at)]);
      } else {
        const long turns = (at >= 0 ? at : at - n + 1) / n;
        const Rational period = Rational(knots.back()) - Rational(knots.front());
        all.push_back(Rational(knots[static_cast<std::size_t>(at - turns * n)]) + turns * period);
      }
    }
    return all;
  }
};

/// The kinds of knots, which tables of cases name.
enum class KnotKind : std::uint8_t {
  uniform,  ///< none are given
  clamped,  ///< simple ones inside
  open,     ///< ends are no multiple knots
  multiple, ///< inner ones occur up to degree times, clamped or not
  broken,   ///< inner ones occur up to degree + 1 times
  distant,  ///< spans whose lengths differ by factors of up to 2^40
  periodic,
  periodic_uniform
};
inline constexpr KnotKind kKnotKinds[] = {
    KnotKind::uniform, KnotKind::clamped, KnotKind::open,     KnotKind::multiple,
    KnotKind::broken,  KnotKind::distant, KnotKind::periodic, KnotKind::periodic_uniform};

inline std::string name_of(KnotKind kind) {
  const char* const names[] = {"uniform", "clamped", "open",     "multiple",
                               "broken",  "distant", "periodic", "periodic_uniform"};
  return names[static_cast<std::size_t>(kind)];
}

/// A random direction of a kind; `cut` restricts it to a part of its domain.
inline AxisModel random_axis(Random& random, KnotKind kind, int degree, bool cut) {
  AxisModel axis;
  axis.degree = degree;
  const std::size_t more = random.below(7);
  axis.periodic = kind == KnotKind::periodic || kind == KnotKind::periodic_uniform;
  axis.points = (axis.periodic ? axis.order() - 1 : axis.order()) + more;
  const std::size_t knots = axis.points + (axis.periodic ? 1 : axis.order());
  if (kind != KnotKind::uniform && kind != KnotKind::periodic_uniform) {
    const bool clamps =
        kind == KnotKind::clamped ||
        ((kind == KnotKind::multiple || kind == KnotKind::broken || kind == KnotKind::distant) &&
         random.below(2) == 0);
    const std::size_t most = kind == KnotKind::broken     ? axis.order()
                             : kind == KnotKind::multiple ? axis.order() - 1
                                                          : 1;
    double knot = random.between(-4, 4);
    std::size_t left = 0;
    for (std::size_t k = 0; k < knots; ++k) {
      const bool at_end = clamps && (k < axis.order() || k >= axis.points);
      const bool new_end = clamps && (k == 0 || k == axis.points);
      if (at_end ? new_end : left == 0) {
        const double step = random.between(0.05, 1);
        knot += kind == KnotKind::distant ? std::ldexp(step, -static_cast<int>(random.below(41)))
                                          : step;
        left = at_end ? 0 : 1 + random.below(most);
      }
      left -= left > 0 && !at_end ? 1 : 0;
      axis.knots.push_back(knot);
    }
    // The domain must not be empty.
    const std::size_t begin = axis.periodic ? 0 : axis.order() - 1;
    if (!(axis.knots[begin] < axis.knots[axis.points])) {
      for (std::size_t k = axis.points; k < knots; ++k) {
        axis.knots[k] += 1;
      }
    }
  }
  if (cut) {
    const std::vector<Rational> all = axis.exact_knots();
    const double begin = all[axis.order() - 1].get_d();
    const double end = all[axis.points + (axis.periodic ? axis.order() - 1 : 0)].get_d();
    const double a = random.between(0, 0.6);
    axis.range = {begin + (end - begin) * a, begin + (end - begin) * random.between(a + 0.1, 1)};
  }
  return axis;
}

/// The pieces of one direction: de Boor points as they are after every end of a piece has been
/// inserted until it occurs `degree` times (W. Boehm, Inserting new knots into B-spline curves,
/// Computer-Aided Design 12, 1980).
inline std::vector<std::vector<Rational>> exact_pieces(const AxisModel& axis,
                                                       std::vector<Rational> points) {
  const auto p = static_cast<std::size_t>(axis.degree);
  std::vector<Rational> knots = axis.exact_knots();
  for (std::size_t k = 0; axis.periodic && k < p; ++k) {
    points.push_back(points[k]);
  }
  const Rational domain[2] = {knots[p], knots[points.size()]};
  Rational begin = domain[0];
  Rational end = domain[1];
  if (!axis.range.empty()) {
    begin = Rational(axis.range.begin);
    end = Rational(axis.range.end);
  }
  std::vector<Rational> breaks = {begin, end};
  for (const Rational& knot : knots) {
    if (begin < knot && knot < end) {
      breaks.push_back(knot);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  for (const Rational& x : breaks) {
    for (auto times = static_cast<std::size_t>(std::count(knots.begin(), knots.end(), x));
         times < p; ++times) {
      const auto after = std::upper_bound(knots.begin(), knots.end(), x);
      const auto k = static_cast<std::size_t>(after - knots.begin()) - 1;
      std::vector<Rational> more(points.size() + 1);
      for (std::size_t i = 0; i < more.size(); ++i) {
        if (i + p <= k) {
          more[i] = points[i];
        } else if (i > k || i >= points.size()) {
          more[i] = points[i - 1];
        } else {
          const Rational length = knots[i + p] - knots[i];
          const Rational share = length == 0 ? Rational(0) : Rational((x - knots[i]) / length);
          more[i] = share * points[i] + (1 - share) * points[i - 1];
        }
      }
      points = more;
      knots.insert(knots.begin() + (after - knots.begin()), x);
    }
  }
  std::vector<std::vector<Rational>> pieces;
  for (std::size_t b = 0; b + 1 < breaks.size(); ++b) {
    const auto after = std::upper_bound(knots.begin(), knots.end(), breaks[b]);
    const auto last = static_cast<std::size_t>(after - knots.begin()) - 1;
    pieces.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(last - p),
                        points.begin() + static_cast<std::ptrdiff_t>(last + 1));
  }
  return pieces;
}

/// A spline surface with its memory.
template <typename T>
struct SurfaceModel {
  AxisModel u;
  AxisModel v;
  int components = 3;
  Weights weights = Weights::none;
  std::vector<T> values; // row after row, points packed

  [[nodiscard]] std::size_t channels() const {
    return static_cast<std::size_t>(components) + (weights == Weights::none ? 0 : 1);
  }
  [[nodiscard]] T& at(std::size_t row, std::size_t column, std::size_t c) {
    return values[(row * u.points + column) * channels() + c];
  }
  [[nodiscard]] T at(std::size_t row, std::size_t column, std::size_t c) const {
    return values[(row * u.points + column) * channels() + c];
  }
  [[nodiscard]] SplineSurface<T> view() const {
    SplineSurface<T> surface;
    surface.points = values.data();
    surface.rows = v.points;
    surface.columns = u.points;
    surface.point_stride = static_cast<std::ptrdiff_t>(channels());
    surface.row_stride = surface.point_stride * static_cast<std::ptrdiff_t>(u.points);
    surface.components = components;
    surface.weights = weights;
    surface.periodic_u = u.periodic;
    surface.periodic_v = v.periodic;
    surface.degree_u = u.degree;
    surface.degree_v = v.degree;
    surface.knots_u = u.knots;
    surface.knots_v = v.knots;
    surface.u_range = u.range;
    surface.v_range = v.range;
    surface.memory = values;
    return surface;
  }
};

/// Random control values, which share a size of 2^-20 to 2^20; weights are from 1/4 to 4.
template <typename T>
SurfaceModel<T> random_surface(Random& random, const AxisModel& u, const AxisModel& v,
                               int components, Weights weights) {
  SurfaceModel<T> model{u, v, components, weights, {}};
  const double size = std::ldexp(1, random.integer(-20, 20));
  for (std::size_t k = 0; k < u.points * v.points; ++k) {
    const double weight = std::ldexp(random.between(1, 2), random.integer(-2, 1));
    for (int c = 0; c < components; ++c) {
      const double value = size * random.symmetric();
      model.values.push_back(
          static_cast<T>(weights == Weights::homogeneous ? value * weight : value));
    }
    if (weights != Weights::none) {
      model.values.push_back(static_cast<T>(weight));
    }
  }
  return model;
}

/// The nets that a surface becomes, with homogeneous weights where it has some.
template <typename T>
struct CutSurface {
  SpanCounts spans;
  MutableNets<T> nets;
  std::vector<T> values;
  std::vector<PatchInterval> intervals;
  Report report;

  explicit CutSurface(const SplineSurface<T>& surface, const Options& options = {})
      : spans(span_count(surface)) {
    nets = MutableNets<T>::packed(
        nullptr, spans.patches(), surface.degree_u, surface.degree_v, surface.components,
        surface.weights == Weights::none ? Weights::none : Weights::homogeneous);
    values.assign(spans.patches() * static_cast<std::size_t>(nets.patch_stride), T(-77));
    intervals.resize(spans.patches());
    nets.points = values.data();
    nets.memory = values;
    report = to_bezier(surface, nets, intervals, options);
  }
  CutSurface(CutSurface&&) = default; // `nets` goes on to point to the values

  [[nodiscard]] T at(std::size_t patch, std::size_t j, std::size_t i, std::size_t c) const {
    return values[patch * static_cast<std::size_t>(nets.patch_stride) +
                  j * static_cast<std::size_t>(nets.row_stride) +
                  i * static_cast<std::size_t>(nets.point_stride) + c];
  }
};

} // namespace simdbezier::tests
