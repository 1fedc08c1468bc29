#include <simdbezier/flatten.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "src/mesh/bounds/bound_parts.hpp"
#include "src/mesh/bounds/vector_patch.hpp"
#include "src/mesh/rates/curve_cells.hpp"
#include "src/pack/curve_input.hpp"
#include "src/runtime/attempt.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Roundings of a bound's own.
constexpr double kRoundedUp = 1 + 1e-12;

/// One curve's control points around the middle of their box, weighted where it is rational, in
/// double.
class CurveBound {
public:
  /// The first value that is at fault: ok | non_finite_input | bad_weight.
  template <typename S>
  Status read(const ControlCurves<S>& curves, std::size_t curve) {
    points_ = static_cast<std::size_t>(curves.degree) + 1;
    components_ = static_cast<std::size_t>(curves.components);
    rational_ = curves.weights != Weights::none;
    divided_ = curves.weights == Weights::homogeneous;
    const S* const from = curves.points + static_cast<std::ptrdiff_t>(curve) * curves.curve_stride;
    for (std::size_t i = 0; i < points_; ++i) {
      const S* const at = from + static_cast<std::ptrdiff_t>(i) * curves.point_stride;
      const auto value = [&](std::size_t c) {
        return static_cast<double>(at[static_cast<std::ptrdiff_t>(c) * curves.component_stride]);
      };
      weight_[i] = rational_ ? value(components_) : 1;
      if (!std::isfinite(weight_[i]) || !(weight_[i] > 0)) {
        return Status::bad_weight;
      }
      const double divisor = divided_ ? weight_[i] : 1;
      for (std::size_t c = 0; c < components_; ++c) {
        point_[i][c] = value(c) / divisor;
        if (!std::isfinite(point_[i][c])) {
          return Status::non_finite_input;
        }
      }
    }
    scale();
    centre();
    return Status::ok;
  }

  /// Whether weights are so far apart that second() may ask for far too many points.
  [[nodiscard]] bool is_spread() const {
    const auto [least, most] = std::minmax_element(weight_, weight_ + points_);
    return *most > kLeastSpread * *least && *most < kMostSpread * *least;
  }
  /// Fewer segments than `usual`, for which t becomes the bound; or `usual`.
  [[nodiscard]] std::uint32_t fewer_segments(std::uint32_t usual, double& t) const {
    CurveNet net;
    net.resize(points_ - 1, components_);
    for (std::size_t i = 0; i < points_; ++i) {
      for (std::size_t c = 0; c < components_; ++c) {
        net.point(i)[c] = weighted(i, c);
      }
      net.point(i)[components_] = weight_[i];
    }
    double bound = t * scale_.inverse() / (kRoundedUp * kRoundedUp);
    const std::uint32_t n =
        CurveCells(std::move(net), kPointSetDoubt * (radius_ + size_)).choose(usual, bound);
    t = n < usual ? bound * kRoundedUp * scale_ + std::numeric_limits<double>::denorm_min() : t;
    return n;
  }

  /// A bound on |C''|, or on what takes its place for rational curves.
  [[nodiscard]] double second() const {
    double most = 0;
    for (std::size_t i = 0; i + 2 < points_; ++i) {
      double square = 0;
      for (std::size_t c = 0; c < components_; ++c) {
        const double d =
            (weighted(i + 2, c) - weighted(i + 1, c)) - (weighted(i + 1, c) - weighted(i, c));
        square += d * d;
      }
      const double w = (weight_[i + 2] - weight_[i + 1]) - (weight_[i + 1] - weight_[i]);
      most = larger_bound(most, std::sqrt(square) + radius_ * std::fabs(w));
    }
    // Values around the middle err by a few u of the box, and divided ones by u of their own size;
    // a second difference has four of them.
    const double heaviest = *std::max_element(weight_, weight_ + points_);
    const double lightest = *std::min_element(weight_, weight_ + points_);
    const double doubt = 32 * 0x1p-53 * (radius_ + size_) * heaviest;
    const auto n = static_cast<double>(points_ - 1);
    if (points_ < 3) {
      return 0;
    }
    const double all = n * (n - 1) * (most + doubt) / lightest * (1 + 1e-12);
    return larger_bound(0, all) * scale_ + std::numeric_limits<double>::denorm_min();
  }

private:
  [[nodiscard]] double weighted(std::size_t i, std::size_t c) const {
    return weight_[i] * point_[i][c];
  }
  /// Divides by the powers of two that bring the largest value and the largest weight between 1 and
  /// 2, so that squares neither overflow nor vanish.
  void scale() {
    double largest = 0;
    for (std::size_t i = 0; i < points_; ++i) {
      for (std::size_t c = 0; c < components_; ++c) {
        largest = std::max(largest, std::fabs(point_[i][c]));
      }
    }
    scale_ = largest > 0 ? power_of_two_below(largest) : PowerOfTwo();
    const PowerOfTwo down = scale_.inverse();
    const PowerOfTwo weight_down =
        power_of_two_below(*std::max_element(weight_, weight_ + points_)).inverse();
    for (std::size_t i = 0; i < points_; ++i) {
      weight_[i] = weight_[i] * weight_down;
      for (std::size_t c = 0; c < components_; ++c) {
        point_[i][c] = point_[i][c] * down;
      }
    }
  }
  void centre() {
    double square = 0;
    size_ = 0;
    for (std::size_t c = 0; c < components_; ++c) {
      double low = point_[0][c];
      double high = low;
      for (std::size_t i = 1; i < points_; ++i) {
        low = std::min(low, point_[i][c]);
        high = std::max(high, point_[i][c]);
      }
      const double middle = low + (high - low) / 2;
      size_ = divided_ ? std::max({size_, std::fabs(low), std::fabs(high)}) : 0;
      for (std::size_t i = 0; i < points_; ++i) {
        point_[i][c] -= middle;
      }
      const double half = std::max(high - middle, middle - low); // the middle is rounded
      square += half * half;
    }
    radius_ = std::sqrt(square) * (1 + 1e-12);
  }

  std::size_t points_ = 0;
  std::size_t components_ = 0;
  bool rational_ = false;
  bool divided_ = false;
  PowerOfTwo scale_; ///< which points were divided by
  double point_[kMostDegree + 1][kMostComponents];
  double weight_[kMostDegree + 1];
  double radius_ = 0; ///< no point is farther from the middle of the box
  double size_ = 0;   ///< the largest value that a division has rounded
};

/// The bound for n segments; uniform parameters in single precision are uneven by rounding.
double bound_of(double second, double n) {
  const double step = step_slack(n) / n;
  return second * step * step / 8;
}

/// Points of a polyline; 0 where `most` are not enough.
std::uint32_t points_for(double second, double t, std::uint32_t most) {
  double n = std::max(1.0, std::ceil(std::sqrt(second / (8 * t))));
  while (n < most && !(bound_of(second, n) <= t)) {
    ++n;
  }
  return n < most ? static_cast<std::uint32_t>(n) + 1 : 0;
}

/// Takes fewer segments than `count` - 1, or than `most` if count is 0, if these hold.
Status take_fewer(const CurveBound& bound, std::uint32_t most, double t, std::uint32_t& count,
                  double& found) noexcept {
  try {
    const std::uint32_t usual = count == 0 ? most : count - 1;
    if (const std::uint32_t n = bound.fewer_segments(usual, t); n < usual) {
      count = n + 1;
      found = t;
    }
  } catch (const std::bad_alloc&) {
    return Status::out_of_memory;
  }
  return Status::ok;
}

/// Chooses one curve's points: ok | non_finite_input | bad_weight | bad_tolerance | out_of_memory.
template <typename S>
Status choose_points(const ControlCurves<S>& curves, const FlattenOptions& options,
                     std::size_t curve, std::span<std::uint32_t> points,
                     std::span<double> deviation) noexcept {
  CurveBound bound;
  if (const Status status = bound.read(curves, curve); !status) {
    return status;
  }
  const double own = options.tolerances.empty() ? options.tolerance : options.tolerances[curve];
  const double wanted = own >= options.tolerance ? options.tolerance : own; // nan is refused
  const double error = options.errors.empty() ? 0 : options.errors[curve];
  const double t = tolerance_less(wanted, error);
  const double second = bound.second();
  const bool possible = options.tolerance > 0 && t > 0 && error >= 0;
  const std::uint32_t most = std::min(options.most_points, kMostPolylinePoints);
  std::uint32_t count = possible ? points_for(second, t, most) : 0;
  double found = count == 0 ? t : bound_of(second, count - 1);
  if (possible && bound.is_spread()) {
    if (const Status status = take_fewer(bound, most, t, count, found); !status) {
      return status;
    }
  }
  if (count == 0) {
    return Status::bad_tolerance;
  }
  points[curve] = count;
  if (!deviation.empty()) {
    deviation[curve] = found + error;
  }
  return Status::ok;
}

Status check_lengths(std::size_t curves, const FlattenOptions& options, std::size_t points,
                     std::size_t deviation) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == curves; };
  const bool all = points == curves && fits(deviation) && fits(options.tolerances.size()) &&
                   fits(options.errors.size());
  return all ? Status::ok : Status::unequal_lengths;
}

template <typename T, typename S>
Status flatten_into(const ControlCurves<S>& curves, double tolerance, const RunOptions& options,
                    Polylines<T>& lines) {
  CurveSet<T> set;
  if (const Report packed = pack(curves, set, {.threads = options.threads, .isa = options.isa});
      !packed) {
    lines.report = packed;
    return packed.status;
  }
  if (curves.components > 3) {
    return Status::bad_components;
  }
  std::vector<double> errors(set.size());
  std::vector<double> deviation(set.size());
  std::vector<std::uint32_t> points(set.size());
  Status status = position_errors(set, std::span<double>(errors), options);
  FlattenOptions wanted;
  wanted.tolerance = tolerance;
  wanted.errors = errors;
  const Report report = choose_polylines(curves, wanted, points, deviation, options);
  if (!status || !report) {
    lines.report = report;
    return status ? report.status : status;
  }
  lines.first.push_back(0);
  for (const std::uint32_t n : points) {
    lines.first.push_back(lines.first.back() + n);
  }
  if (set.empty()) {
    return Status::ok;
  }
  lines.deviation = *std::max_element(deviation.begin(), deviation.end());
  lines.points.resize(lines.first.back());
  CurveOutputs<T> out;
  out.position = Vectors<T>::xyz(lines.points);
  out.position.z = curves.components < 3 ? nullptr : out.position.z;
  out.position.y = curves.components < 2 ? nullptr : out.position.y;
  return evaluate(set, CurveGrids{points}, out, {.threads = options.threads, .isa = options.isa});
}

} // namespace
} // namespace detail

template <typename S>
Report choose_polylines(const ControlCurves<S>& curves, const FlattenOptions& options,
                        std::span<std::uint32_t> points, std::span<double> deviation,
                        const RunOptions& run) noexcept {
  if (const Status status = detail::check_curves(curves); !status) {
    return {status};
  }
  if (const Status status =
          detail::check_lengths(curves.count, options, points.size(), deviation.size());
      !status) {
    return {status};
  }
  const auto choose = [&](std::size_t curve) {
    return detail::choose_points(curves, options, curve, points, deviation);
  };
  const std::size_t curve = detail::first_failure(
      curves.count, 150, run.threads, [&](std::size_t k) { return choose(k) == Status::ok; });
  if (curve < curves.count) {
    const detail::DefaultFpEnvironment environment;
    const Status again = choose(curve);
    return {again ? Status::out_of_memory : again, curve}; // nothing else passes by itself
  }
  return {};
}

template <typename T, typename S>
Polylines<T> flatten(const ControlCurves<S>& curves, double tolerance,
                     const RunOptions& options) noexcept {
  const detail::DefaultFpEnvironment environment;
  return detail::attempt<Polylines<T>>(
      [&](Polylines<T>& lines) { return detail::flatten_into(curves, tolerance, options, lines); });
}

#define SIMDBEZIER_INSTANTIATE(S)                                                                  \
  template SIMDBEZIER_API Report choose_polylines(const ControlCurves<S>&, const FlattenOptions&,  \
                                                  std::span<std::uint32_t>, std::span<double>,     \
                                                  const RunOptions&) noexcept;                     \
  template SIMDBEZIER_API Polylines<float> flatten(const ControlCurves<S>&, double,                \
                                                   const RunOptions&) noexcept;                    \
  template SIMDBEZIER_API Polylines<double> flatten(const ControlCurves<S>&, double,               \
                                                    const RunOptions&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
