// Compiled once per instruction set: kernels for patches of any shape, in floats.
#include "kernels/shape/shape_kernel.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

extern const detail::ShapeTable<float> shape_table_f32;
constinit const detail::ShapeTable<float> shape_table_f32 = make_shape_table<float>();

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
