// Compiled once per instruction set: kernels for curves.
#include "kernels/curve_table.hpp"
#include "kernels/isa/arch.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

extern const detail::CurveTable<float> curve_table_f32;
extern const detail::CurveTable<double> curve_table_f64;
constinit const detail::CurveTable<float> curve_table_f32{};
constinit const detail::CurveTable<double> curve_table_f64{};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
