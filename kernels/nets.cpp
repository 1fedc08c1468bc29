// Compiled once per instruction set: kernels for operations on control nets.
#include "kernels/net_table.hpp"
#include "kernels/isa/arch.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

extern const detail::NetTable<float> net_table_f32;
extern const detail::NetTable<double> net_table_f64;
constinit const detail::NetTable<float> net_table_f32{};
constinit const detail::NetTable<double> net_table_f64{};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
