// The splines of a call: checked, with the factors that follow from their knots.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <simdbezier/splines.hpp>

#include "src/splines/spline_factors.hpp"

namespace simdbezier::detail {

/// A spline surface, or a curve as one of a single row, with what its knots say.
template <typename S>
struct PreparedSpline {
  SplineSurface<S> surface;
  std::shared_ptr<const SplineFactors> u;
  std::shared_ptr<const SplineFactors> v;
  std::size_t first_patch = 0; ///< of all patches of the call
  std::size_t first_row = 0;   ///< of all rows of spans of the call
  /// Whether neighbouring points are one somewhere, while their weights may differ: see
  /// restore_points().
  bool has_poles = false;

  [[nodiscard]] std::size_t channels() const noexcept {
    return static_cast<std::size_t>(surface.components) +
           (surface.weights == Weights::none ? 0 : 1);
  }
  [[nodiscard]] std::size_t patches() const noexcept { return u->spans() * v->spans(); }
  /// Values of a line, and with the room that kernels need behind it.
  [[nodiscard]] std::size_t line_values() const noexcept { return u->means().size() * channels(); }
  [[nodiscard]] std::size_t line_room() const noexcept { return line_values() + kMeanSlack; }
  [[nodiscard]] std::size_t row_values() const noexcept { return surface.columns * channels(); }
  [[nodiscard]] const S* point(std::size_t row, std::size_t column) const noexcept {
    return surface.points +
           static_cast<std::ptrdiff_t>(wrapped(row, surface.rows)) * surface.row_stride +
           static_cast<std::ptrdiff_t>(wrapped(column, surface.columns)) * surface.point_stride;
  }
};

/// The points as one net; its rows and columns are no degrees.
template <typename S>
ControlNets<S> one_net(const SplineSurface<S>& surface) noexcept {
  return {surface.points,
          1,
          static_cast<int>(surface.columns - 1),
          static_cast<int>(surface.rows - 1),
          0,
          surface.row_stride,
          surface.point_stride,
          surface.component_stride,
          surface.components,
          surface.weights,
          surface.memory};
}

/// All splines of a call, whose patches and rows of spans are numbered through.
template <typename S>
class SplineList {
public:
  /// Checks the splines and prepares them; the report names the first one at fault. May throw
  /// std::bad_alloc. to: the form of weights that results will have.
  [[nodiscard]] Report prepare(std::span<const SplineSurface<S>> surfaces,
                               Weights to = Weights::homogeneous);
  [[nodiscard]] Report prepare(const SplineCurve<S>& curve);

  [[nodiscard]] const std::vector<PreparedSpline<S>>& splines() const noexcept { return splines_; }
  [[nodiscard]] std::size_t patches() const noexcept { return patches_; }
  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  /// The spline that a row of spans, numbered through, is part of.
  [[nodiscard]] const PreparedSpline<S>& spline_of(std::size_t row) const noexcept;
  /// The first patch of such a row.
  [[nodiscard]] std::size_t patch_of(std::size_t row) const noexcept {
    const PreparedSpline<S>& spline = spline_of(row);
    return spline.first_patch + (row - spline.first_row) * spline.u->spans();
  }
  /// Writes the interval of each patch, where there is room: for none, or for all.
  void write_intervals(std::span<PatchInterval> intervals) const noexcept;
  /// What a thread needs besides.
  [[nodiscard]] std::size_t scratch_bytes() const noexcept;

private:
  /// directions: 2, or 1 of a curve, which has one row of points.
  [[nodiscard]] Report add(const SplineSurface<S>& surface, int directions, Weights to);

  std::vector<PreparedSpline<S>> splines_;
  std::size_t patches_ = 0;
  std::size_t rows_ = 0;
};

} // namespace simdbezier::detail
