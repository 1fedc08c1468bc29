// Compiled once per instruction set: kernels for operations on control nets.
#include "kernels/nets/casteljau.hpp"
#include "kernels/nets/line_means.hpp"
#include "kernels/nets/net_boxes.hpp"
#include "kernels/nets/net_flatness.hpp"
#include "kernels/nets/net_maps.hpp"
#include "kernels/nets/net_measures.hpp"
#include "kernels/rates/group_bounds.hpp"
#include "kernels/rates/net_rates.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T>
constexpr detail::NetTable<T> make_net_table() {
  return {
      rate_kernel<T>, kBoundKernels, {mean_lines, mean_points}, {sum_kernel<T>, depth_kernel<T>}};
}

template <typename T>
constexpr detail::NetOperationTable<T> make_operations() {
  return {split_kernel<T>, segment_kernel<T>, map_kernel<T>, box_kernel<T>, flatness_kernel<T>};
}

extern const detail::NetTable<float> net_table_f32;
extern const detail::NetTable<double> net_table_f64;
constinit const detail::NetTable<float> net_table_f32 = make_net_table<float>();
constinit const detail::NetTable<double> net_table_f64 = make_net_table<double>();
extern const detail::NetOperationTable<float> net_operations_f32;
extern const detail::NetOperationTable<double> net_operations_f64;
constinit const detail::NetOperationTable<float> net_operations_f32 = make_operations<float>();
constinit const detail::NetOperationTable<double> net_operations_f64 = make_operations<double>();

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
