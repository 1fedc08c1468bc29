// Compiled once per instruction set: kernels for patches of any shape.
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

extern const detail::ShapeTable<float> shape_table_f32;
extern const detail::ShapeTable<double> shape_table_f64;
constinit const detail::ShapeTable<float> shape_table_f32 = make_shape_table<float>();
constinit const detail::ShapeTable<double> shape_table_f64 = make_shape_table<double>();

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
