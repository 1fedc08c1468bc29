// See src/calls/grid_plan.hpp.
#include "src/calls/grid_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace simdbezier::detail {
namespace {

template <typename T>
void fill_parameters(const T* given, std::size_t count, Parameters parameters, T* out) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] =
        given == nullptr ? uniform_parameter<T>(i, count - 1) : half_centred(given[i], parameters);
  }
  // Lanes behind the last column or row repeat it, so that they need nothing that it does not need.
  std::fill_n(out + count, kMaxLanes, out[count - 1]);
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
  if (!fits_inline(nu_, nv_)) {
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
  fill_parameters(grid.u, nu_, grid.parameters, x);
  const bool square = grid.u == nullptr && grid.v == nullptr && nu_ == nv_;
  if (!square) {
    fill_parameters(grid.v, nv_, grid.parameters, y);
  }
  x_ = x;
  y_ = square ? x : y;
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
  for (std::size_t j = first; j < last; ++j) {
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
template float half_centred(float, Parameters) noexcept;
template double half_centred(double, Parameters) noexcept;

} // namespace simdbezier::detail
