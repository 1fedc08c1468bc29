// Grids in a spline's own parameters: by the spans that parameters lie in, and the work.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <span>
#include <vector>

#include "src/calls/call.hpp"
#include "src/calls/grid_plan.hpp"
#include "src/calls/piece_evaluator.hpp"
#include "src/splines/spline_knots.hpp"

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

/// Samples of a small grid: what fits into the first-level cache beside a patch.
inline constexpr std::size_t kMostColumns = 128;
inline constexpr std::size_t kMostRows = 16;
/// Samples of the rows that are computed before any of them leaves: these stay in the second-level
/// cache.
inline constexpr std::size_t kTogether = std::size_t{1} << 14;

/// How often derivatives are by U and by V.
struct Orders {
  int u;
  int v;
};
constexpr Orders orders_of(std::size_t vector) noexcept {
  constexpr Orders kOrders[] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {0, 0}};
  static_assert(std::size(kOrders) == kVectorOutputs, "every vector has its row, in their order");
  return kOrders[vector];
}

template <typename T>
T divisor_of(Orders orders, double length_u, double length_v) noexcept {
  return static_cast<T>(derivative_divisor(orders.u, orders.v, length_u, length_v));
}

/// Units are runs of V: a thread has all samples of some rows. Kernels put the small grids of
/// patches into memory of their own, from which whole rows are formed: rows of many patches are
/// what leaves the caches in whole lines.
template <typename T>
class SplineGridWork {
public:
  SplineGridWork(const SetStorage<T>& set, const Request<T>& request, const AxisRuns<T>& u,
                 const AxisRuns<T>& v, const OutputList<T>& out, const Options& options,
                 Way way) noexcept
      : kernels_(set, request, out, options), first_patch_(request.first),
        dimension_(request.components.dimension), u_(u), v_(v), out_(out), outputs_(out, way) {
    for (const SpanRun& run : v.runs) {
      most_rows_ = std::max(most_rows_, run.count);
    }
    std::size_t most_columns = 0;
    for (const SpanRun& run : u.runs) {
      most_columns = std::max(most_columns, run.count);
    }
    kernels_.expect_output(written_bytes(out, u.count * v.count), way);
    // Planes that begin at the same place of a page would contend for the same lines of a cache.
    constexpr std::size_t kApart = 5 * 64;
    plane_ = (whole_lines(most_columns * most_rows_ * sizeof(T)) + kApart) / sizeof(T);
    delivery_bytes_ = whole_lines(Delivery<T>::scratch_bytes(
        outputs_.staged_planes(), outputs_.streaming(), u.count * most_rows_));
  }

  [[nodiscard]] std::size_t units() const noexcept { return v_.runs.size(); }
  [[nodiscard]] std::size_t duration() const noexcept {
    return duration_of(u_.count * v_.count, 2);
  }
  [[nodiscard]] std::size_t grain() const noexcept { return 1; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return delivery_bytes_ + (3 * kVectorOutputs + kCurvatureKinds + 1) * plane_ * sizeof(T);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    PieceEvaluator<T> evaluator(kernels_, kMostRows, nullptr);
    Delivery<T> delivery(outputs_, *kernels_.table, u_.count * most_rows_, scratch);
    GridPlan<T> grid;
    T* const values = reinterpret_cast<T*>(scratch + delivery_bytes_);
    Planes<T> small[kVectorOutputs] = {};
    for (std::size_t g = 0; g < out_.vector_count; ++g) {
      for (std::size_t c = 0; c < dimension_ && out_.wants(g); ++c) {
        small[g].component[c] = values + (3 * g + c) * plane_;
      }
    }
    typename PieceEvaluator<T>::Target to(outputs_, small, 0);
    T* const others = values + 3 * kVectorOutputs * plane_;
    for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
      to.curvature[k] = to.curvature[k] == nullptr ? nullptr : others + k * plane_;
    }
    if (to.status != nullptr) {
      to.status = reinterpret_cast<SampleStatus*>(others + kCurvatureKinds * plane_);
    }
    to.record = 1;
    to.streaming = false;
    to.drain = delivery.queue();
    for (std::size_t unit = begin; unit < end; ++unit) {
      const SpanRun& v = v_.runs[unit];
      const Planes<T>* const rows = delivery.begin(v.first * u_.count);
      for (const SpanRun& u : u_.runs) {
        grid.view(u_.parameters.data() + u.at, u.count, v_.parameters.data() + v.at, v.count);
        const std::size_t patch = first_patch_ + v.span * u_.spans + u.span;
        evaluator.run(grid, {patch, 1, 0, v.count}, to, nullptr);
        put(u, v, to, rows);
      }
      delivery.end(v.count * u_.count);
    }
    delivery.finish();
    return evaluator.executed();
  }

private:
  /// Takes the samples of a small grid to rows of many patches.
  void put(const SpanRun& u, const SpanRun& v, const typename PieceEvaluator<T>::Target& from,
           const Planes<T>* rows) const noexcept {
    for (std::size_t g = 0; g < out_.vector_count; ++g) {
      if (out_.wants(g)) {
        const T divisor = divisor_of<T>(orders_of(g), u.length, v.length);
        for (std::size_t c = 0; c < dimension_; ++c) {
          put_plane(u, v, from.planes[g].component[c], rows[g].component[c], divisor);
        }
      }
    }
    const std::size_t sample = v.first * u_.count;
    for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
      if (from.curvature[k] != nullptr) {
        put_plane(u, v, from.curvature[k], out_.curvature_at(k, sample), T(1));
      }
    }
    if (from.status != nullptr) {
      SampleStatus* const status = out_.status_at(sample) + u.first;
      for (std::size_t row = 0; row < v.count; ++row) {
        std::copy_n(from.status + row * u.count, u.count, status + row * u_.count);
      }
    }
  }

  void put_plane(const SpanRun& u, const SpanRun& v, const T* from, T* to,
                 T divisor) const noexcept {
    to += u.first;
    for (std::size_t row = 0; row < v.count; ++row, from += u.count, to += u_.count) {
      if (divisor == T(1)) {
        copy_few(from, u.count, to);
      } else {
        for (std::size_t k = 0; k < u.count; ++k) {
          to[k] = from[k] / divisor;
        }
      }
    }
  }
  /// A copy in pieces of a line, without a call for each row of a patch.
  static void copy_few(const T* from, std::size_t count, T* to) noexcept {
    constexpr std::size_t kLine = 64 / sizeof(T);
    for (; count >= kLine; count -= kLine, from += kLine, to += kLine) {
      std::memcpy(to, from, 64);
    }
    for (std::size_t k = 0; k < count; ++k) {
      to[k] = from[k];
    }
  }

  PatchKernels<T> kernels_;
  std::size_t first_patch_;
  std::size_t dimension_;
  const AxisRuns<T>& u_;
  const AxisRuns<T>& v_;
  const OutputList<T>& out_;
  OutputPlan<T> outputs_;
  std::size_t most_rows_ = 0;
  std::size_t plane_ = 0; ///< values from one plane of a small grid to the next
  std::size_t delivery_bytes_ = 0;
};

} // namespace simdbezier::detail
