// Compiled once per instruction set (cmake/isa.cmake): fills this instruction set's tables.
// Only the tables leave this object; they are constants, so nothing runs at load time.
#include "kernels/grid_kernel.hpp"
#include "kernels/scattered_kernel.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T, detail::OutputSet kOutputs>
constexpr void fill_grid(detail::KernelTable<T>& table) {
  table.grid[kOutputs][false] = grid_kernel<T, kOutputs, false>;
  table.grid[kOutputs][true] = grid_kernel<T, kOutputs, true>;
}

template <typename T>
constexpr detail::KernelTable<T> make_table() {
  detail::KernelTable<T> table{Isa::SIMDBEZIER_ISA, kLanes<vec<T>>, {}, {}};
  fill_grid<T, detail::kPosition>(table);
  fill_grid<T, detail::kPositionNormal>(table);
  fill_grid<T, detail::kPositionDerivatives>(table);
  fill_grid<T, detail::kAnyOutputs>(table);
  table.scattered[false] = scattered_kernel<T, false>;
  table.scattered[true] = scattered_kernel<T, true>;
  return table;
}

extern const detail::KernelTable<float> table_f32;
extern const detail::KernelTable<double> table_f64;
constinit const detail::KernelTable<float> table_f32 = make_table<float>();
constinit const detail::KernelTable<double> table_f64 = make_table<double>();

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
