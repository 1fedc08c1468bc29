// What nothing in the modules calls. The linker takes the first definition of a table, and of an
// instance of a template: in front of the library's own, these leave their code out.
#include "src/mesh/rates/pixels.hpp"
#include "src/runtime/both_types.hpp"
#include "src/tables/curve_table.hpp"
#include "src/tables/derivative_task.hpp"
#include "src/tables/mean_task.hpp"

namespace simdbezier::isa_simd128 {

// Curves.
extern const detail::CurveTable<float> curve_table_f32;
extern const detail::CurveTable<double> curve_table_f64;
constinit const detail::CurveTable<float> curve_table_f32{};
constinit const detail::CurveTable<double> curve_table_f64{};

// Derivatives of any order.
template <typename T>
void derivative_kernel(detail::DerivativeTask<T>& /*task*/) {
  __builtin_trap();
}
template void derivative_kernel(detail::DerivativeTask<float>&);
template void derivative_kernel(detail::DerivativeTask<double>&);

// Sets in another type than their control points.
template <typename T, typename S>
detail::PackDoubt pack_kernel(const detail::PackTask<T, S>& /*task*/, std::size_t /*begin*/,
                              std::size_t /*end*/) {
  __builtin_trap();
}
template <typename T, typename S>
detail::PackDoubt shape_pack_kernel(const detail::PackTask<T, S>& /*task*/, std::size_t /*begin*/,
                                    std::size_t /*end*/) {
  __builtin_trap();
}
template detail::PackDoubt pack_kernel(const detail::PackTask<float, double>&, std::size_t,
                                       std::size_t);
template detail::PackDoubt pack_kernel(const detail::PackTask<double, float>&, std::size_t,
                                       std::size_t);
template detail::PackDoubt shape_pack_kernel(const detail::PackTask<float, double>&, std::size_t,
                                             std::size_t);
template detail::PackDoubt shape_pack_kernel(const detail::PackTask<double, float>&, std::size_t,
                                             std::size_t);

#if !SIMDBEZIER_WEB_FILES
// Splines, which files have.
void mean_lines(const detail::MeanTask& task);
void mean_points(const detail::PointMeansTask& task);
void mean_lines(const detail::MeanTask& /*task*/) { __builtin_trap(); }
void mean_points(const detail::PointMeansTask& /*task*/) { __builtin_trap(); }
#endif

} // namespace simdbezier::isa_simd128

namespace simdbezier::detail {

// Tolerances in pixels.
template <typename S>
Status view_tolerances(std::span<const ControlNets<S>> /*nets*/, const Topology& /*topology*/,
                       const Camera& /*camera*/, double /*pixels*/, std::span<double> /*out*/,
                       const RunOptions& /*options*/) noexcept {
  __builtin_trap();
}
SIMDBEZIER_OF_BOTH_TYPES(view_tolerances);

} // namespace simdbezier::detail
