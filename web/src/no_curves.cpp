// The module has no calls on curves. In front of the library's own tables, these leave their
// kernels out of it.
#include "src/tables/curve_table.hpp"

namespace simdbezier::isa_simd128 {

extern const detail::CurveTable<float> curve_table_f32;
extern const detail::CurveTable<double> curve_table_f64;
constinit const detail::CurveTable<float> curve_table_f32{};
constinit const detail::CurveTable<double> curve_table_f64{};

} // namespace simdbezier::isa_simd128
