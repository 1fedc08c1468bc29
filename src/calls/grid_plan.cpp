#include "src/calls/grid_plan.hpp"
#include "src/runtime/both_types.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>

namespace simdbezier::detail {
namespace {

/// Lanes behind the last column or row repeat it, so that they need nothing that it does not need.
template <typename T>
void repeat_last(std::size_t count, T* out) {
  std::fill_n(out + count, kMaxLanes, out[count - 1]);
}

template <typename T>
void fill_parameters(const T* given, std::size_t count, Parameters parameters, T* out) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] =
        given == nullptr ? uniform_parameter<T>(i, count - 1) : half_centred(given[i], parameters);
  }
  repeat_last(count, out);
}

/// Fills the uniform parameters of a grid that fits inline: compilers make vectors of 32-bit
/// numbers, not of 64-bit ones.
template <typename T>
void fill_few_parameters(std::size_t count, T* out) {
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    out[i] = uniform_parameter<T, std::int32_t>(i, count - 1);
  }
  repeat_last(count, out);
}

template <typename T>
RowKind kind_of(T y) {
  if (y == T(-0.5)) {
    return RowKind::edge_v0;
  }
  if (y == T(0.5)) {
    return RowKind::edge_v1;
  }
  return std::fabs(y) < T(0.5) ? RowKind::interior : RowKind::outside;
}

} // namespace

template <typename T>
T half_centred(T value, Parameters parameters) noexcept {
  if (!std::isfinite(value)) {
    return std::numeric_limits<T>::quiet_NaN();
  }
  return parameters == Parameters::unit ? value - T(0.5) : value * T(0.5);
}

template <typename T>
Status GridPlan<T>::check(const Grid<T>& grid) noexcept {
  if (grid.nu < (grid.u == nullptr ? 2U : 1U) || grid.nv < (grid.v == nullptr ? 2U : 1U)) {
    return Status::bad_grid;
  }
  return grid.nu > kMost || grid.nv > kMost ? Status::size_overflow : Status::ok;
}

template <typename T>
Status GridPlan<T>::build(const Grid<T>& grid, T* memory) noexcept {
  if (const Status status = check(grid); !status) {
    return status;
  }
  ++generation_;
  nu_ = grid.nu;
  nv_ = grid.nv;
  T* x = inline_x_;
  T* y = inline_y_;
  const bool few = fits_inline(nu_, nv_);
  if (!few) {
    if (memory == nullptr) {
      heap_.reset(new (std::nothrow) T[memory_values(nu_, nv_)]);
      memory = heap_.get();
    }
    if (memory == nullptr) {
      return Status::out_of_memory;
    }
    x = memory;
    y = x + nu_ + kMaxLanes;
  }
  const auto fill = [&](const T* given, std::size_t count, T* out) {
    if (few && given == nullptr) {
      fill_few_parameters(count, out);
    } else {
      fill_parameters(given, count, grid.parameters, out);
    }
  };
  fill(grid.u, nu_, x);
  const bool square = grid.u == nullptr && grid.v == nullptr && nu_ == nv_;
  if (!square) {
    fill(grid.v, nv_, y);
  }
  x_ = x;
  y_ = square ? x : y;
  between_edges_ = few && grid.v == nullptr; // parameters of many rows may be rounded to edges
  return Status::ok;
}

template <typename T>
std::size_t GridPlan<T>::memory_values(std::size_t nu, std::size_t nv) noexcept {
  return nu + nv + 2 * kMaxLanes;
}

template <typename T>
std::size_t GridPlan<T>::fill_runs(std::size_t first, std::size_t last,
                                   RowRun<T>* runs) const noexcept {
  std::size_t count = 0;
  std::size_t j = first;
  if (between_edges_ && j == 0) {
    runs[count++] = {y_, 1, RowKind::edge_v0};
    ++j;
  }
  if (const std::size_t inner = std::min(last, nv_ - 1); between_edges_ && j < inner) {
    runs[count++] = {y_ + j, static_cast<std::uint32_t>(inner - j), RowKind::interior};
    j = inner;
  }
  for (; j < last; ++j) {
    const RowKind kind = kind_of(y_[j]);
    if (count > 0 && runs[count - 1].kind == kind) {
      ++runs[count - 1].rows;
    } else {
      runs[count++] = {y_ + j, 1, kind};
    }
  }
  return count;
}

template class GridPlan<float>;
template class GridPlan<double>;
SIMDBEZIER_OF_BOTH_TYPES(half_centred);

} // namespace simdbezier::detail
