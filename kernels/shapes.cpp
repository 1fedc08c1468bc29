// Compiled once per instruction set: kernels for patches of any shape.
#include "kernels/isa/arch.hpp"
#include "kernels/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

extern const detail::ShapeTable<float> shape_table_f32;
extern const detail::ShapeTable<double> shape_table_f64;
constinit const detail::ShapeTable<float> shape_table_f32{};
constinit const detail::ShapeTable<double> shape_table_f64{};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
