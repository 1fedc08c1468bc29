// Compiled once per instruction set: kernels for curves.
#include "kernels/curve/curve_kernel.hpp"
#include "kernels/curve/curve_scattered_kernel.hpp"
#include "kernels/pack/curve_pack_kernel.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T>
constexpr detail::CurveTable<T> make_curve_table() {
  detail::CurveTable<T> table{};
  table.grid = curve_grid_kernel<T>;
  table.scattered = scattered_curve_kernel<T>;
  table.pack_f32 = curve_pack_kernel<T, float>;
  table.pack_f64 = curve_pack_kernel<T, double>;
  return table;
}

extern const detail::CurveTable<float> curve_table_f32;
extern const detail::CurveTable<double> curve_table_f64;
constinit const detail::CurveTable<float> curve_table_f32 = make_curve_table<float>();
constinit const detail::CurveTable<double> curve_table_f64 = make_curve_table<double>();

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
