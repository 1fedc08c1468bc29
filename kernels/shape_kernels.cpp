// Compiled once per instruction set: kernels for patches of any shape, and what second looks at
// normals begin with.
#include "kernels/derivative/derivative_kernel.hpp"
#include "kernels/pack/shape_pack_kernel.hpp"
#include "kernels/poly/normal_start.hpp"
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

void start_normals(const detail::NetShape& shape, const detail::GivenNet& net, double tolerance,
                   const double* x, const double* y, std::size_t count, double* normals,
                   std::size_t step, double* orders) {
  const auto start = shape.degree_u == 3 && shape.degree_v == 3 ? start_on<4> : start_on<0>;
  start(shape, net, tolerance, x, y, count, normals, step, orders);
}

extern const detail::ShapeTable<float> shape_table_f32;
extern const detail::ShapeTable<double> shape_table_f64;
constinit const detail::ShapeTable<float> shape_table_f32 = make_shape_table<float>();
constinit const detail::ShapeTable<double> shape_table_f64 = make_shape_table<double>();

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
