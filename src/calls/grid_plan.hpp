// What all patches of a grid call have in common: parameters, and which rows are edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

#include <simdbezier/curves.hpp>
#include <simdbezier/patch_set.hpp>

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// The half-centred parameter, which is half of x_i = (2i - N) / N for N intervals, by one
/// correctly rounded division, so that x_i = -x_{N-i} exactly. Integer has a sign and room for 2N.
template <typename T, typename Integer = std::int64_t>
T uniform_parameter(std::size_t i, std::size_t intervals) noexcept {
  const T numerator = static_cast<T>(2 * static_cast<Integer>(i) - static_cast<Integer>(intervals));
  return numerator / static_cast<T>(static_cast<Integer>(intervals)) * T(0.5);
}

/// Half-centred parameters of a grid, in the form in which kernels read them. Small grids need no
/// allocation: for a few patches it would cost as much as the evaluation.
template <typename T>
class GridPlan {
public:
  /// Samples in a row or column: above this, indices and numerators would leave 63 bits, and
  /// runs 32.
  static constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - kMaxLanes;
  /// Whether a plan needs no memory besides its own.
  [[nodiscard]] static bool fits_inline(std::size_t nu, std::size_t nv) noexcept {
    return nu <= kInline && nv <= kInline;
  }

  /// ok | bad_grid | size_overflow
  [[nodiscard]] static Status check(const Grid<T>& grid) noexcept;
  /// Checks the grid and fills the plan, in the library's floating-point environment. Returns ok |
  /// bad_grid | size_overflow | out_of_memory (not if `memory` has room for the grid's
  /// memory_values()).
  [[nodiscard]] Status build(const Grid<T>& grid, T* memory = nullptr) noexcept;
  [[nodiscard]] static std::size_t memory_values(std::size_t nu, std::size_t nv) noexcept;
  /// Lets the plan be of given half-centred parameters, which stay where they are: nu of x, with
  /// kMaxLanes more readable behind them, and nv of y.
  void view(const T* x, std::size_t nu, const T* y, std::size_t nv) noexcept {
    ++generation_;
    nu_ = nu;
    nv_ = nv;
    between_edges_ = false;
    x_ = x;
    y_ = y;
  }

  [[nodiscard]] std::size_t nu() const noexcept { return nu_; }
  [[nodiscard]] std::size_t nv() const noexcept { return nv_; }
  [[nodiscard]] const T* x() const noexcept { return x_; }
  [[nodiscard]] const T* y() const noexcept { return y_; }
  /// Changes with every build().
  [[nodiscard]] std::uint32_t generation() const noexcept { return generation_; }

  /// Describes rows [first, last) by runs, of which there is room for last - first; returns how
  /// many there are.
  std::size_t fill_runs(std::size_t first, std::size_t last, RowRun<T>* runs) const noexcept;

private:
  static constexpr std::size_t kInline = 128;

  std::size_t nu_ = 0;
  std::size_t nv_ = 0;
  std::uint32_t generation_ = 0;
  bool between_edges_ = false; ///< known: the first row and the last are on edges, no other is
  const T* x_ = nullptr;
  const T* y_ = nullptr;
  std::unique_ptr<T[]> heap_;
  alignas(64) T inline_x_[kInline + kMaxLanes];
  alignas(64) T inline_y_[kInline + kMaxLanes];
};

/// Curves as surfaces of one row: what a plan needs of their parameters.
template <typename T>
Grid<T> as_grid(const CurveGrid<T>& grid) noexcept {
  static constexpr T kRow = 0;
  return {grid.n, 1, grid.t, &kRow, grid.parameters, {}};
}
template <typename T>
const Grid<T>& as_grid(const Grid<T>& grid) noexcept {
  return grid;
}

/// The half-centred X = u - 1/2 (exactly half of 2u - 1 rounded once); nan where u is not finite.
template <typename T>
T half_centred(T value, Parameters parameters) noexcept;

} // namespace simdbezier::detail
