// Compiled once per instruction set: kernels for patches of any shape, in doubles, and what second
// looks at normals begin with.
#include "kernels/poly/normal_start.hpp"
#include "kernels/shape/shape_kernel.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

void start_normals(const detail::NetShape& shape, const detail::GivenNet& net, double tolerance,
                   const double* x, const double* y, std::size_t count, double* normals,
                   std::size_t step, double* orders) {
  const auto start = shape.degree_u == 3 && shape.degree_v == 3 ? start_on<4> : start_on<0>;
  start(shape, net, tolerance, x, y, count, normals, step, orders);
}

extern const detail::ShapeTable<double> shape_table_f64;
constinit const detail::ShapeTable<double> shape_table_f64 = make_shape_table<double>();

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
