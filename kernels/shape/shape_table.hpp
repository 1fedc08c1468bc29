// The table of what any shape of patch needs, of floats or of doubles. Each has an object of its
// own, since together they take the compiler twice the memory.
#pragma once

#include "kernels/derivative/derivative_kernel.hpp"
#include "kernels/pack/shape_pack_kernel.hpp"
#include "kernels/shape/shape_kernel.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T>
constexpr detail::ShapeTable<T> make_shape_table() {
  detail::ShapeTable<T> table{};
  table.grid = shape_grid_kernel<T>;
  table.scattered = shape_scattered_kernel<T>;
  table.derivatives = derivative_kernel<T>;
  table.pack_f32 = shape_pack_kernel<T, float>;
  table.pack_f64 = shape_pack_kernel<T, double>;
  return table;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
