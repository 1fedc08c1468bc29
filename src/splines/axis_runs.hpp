// The parameters of a spline's grid by the spans that they lie in.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "src/calls/grid_plan.hpp"
#include "src/splines/span_finder.hpp"
#include "src/splines/spline_axes.hpp"

namespace simdbezier::detail {

/// Consecutive parameters of one direction that lie in one span.
struct SpanRun {
  std::size_t span;
  std::size_t first; ///< of the caller's parameters
  std::size_t count;
  std::size_t at; ///< where its half-centred parameters begin
  double length;
};

/// The parameters of one direction, by runs.
template <typename T>
struct AxisRuns {
  std::vector<SpanRun> runs;
  std::vector<T> parameters; ///< of each run, with kMaxLanes more that repeat the last one
  std::size_t spans = 0;
  std::size_t count = 0; ///< of all parameters

  /// `most`: parameters of one run.
  template <typename S>
  [[nodiscard]] Report build(const SplineSurface<S>& surface, int direction,
                             std::span<const double> given, std::size_t most) {
    if (given.data() == nullptr && !given.empty()) {
      return {Status::null_input, 0, 0, direction};
    }
    SplineKnots knots;
    const SplineAxis axis = axis_of(surface, direction);
    std::size_t knot = 0;
    if (const Status status = knots.build(axis, knot); !status) {
      return {status, 0, static_cast<std::ptrdiff_t>(knot), direction};
    }
    spans = knots.spans().size();
    count = given.size();
    SpanFinder finder(knots, axis);
    parameters.reserve(given.size() + (given.size() / most + 2) * kMaxLanes);
    for (std::size_t k = 0; k < given.size(); ++k) {
      if (const Status status = finder.find(given[k]); !status) {
        return {status, 0, static_cast<std::ptrdiff_t>(k), direction};
      }
      if (runs.empty() || runs.back().span != finder.span() || runs.back().count == most) {
        end_run();
        runs.push_back({finder.span(), k, 0, parameters.size(), finder.length()});
      }
      ++runs.back().count;
      parameters.push_back(half_centred(static_cast<T>(finder.centred()), Parameters::centred));
    }
    end_run();
    return {};
  }

private:
  void end_run() {
    if (!runs.empty()) {
      const T last = parameters.back(); // not a reference into what grows
      parameters.insert(parameters.end(), kMaxLanes, last);
    }
  }
};

} // namespace simdbezier::detail
