// Compiled once per instruction set (cmake/isa.cmake): fills this instruction set's tables.
// Only the tables leave this object; they are constants, so nothing runs at load time. shapes.cpp,
// curves.cpp and nets.cpp are compiled the same way.
#include "kernels/grid/grid_kernel.hpp"
#include "kernels/pack/bicubic_pack_kernel.hpp"
#include "kernels/scattered/scattered_kernel.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T, detail::Scheme kScheme>
constexpr void fill_scheme(detail::KernelTable<T>& table) {
  table.grid[detail::kPosition][kScheme] = grid_kernel<T, detail::kPosition, kScheme>;
  table.grid[detail::kPositionNormal][kScheme] = grid_kernel<T, detail::kPositionNormal, kScheme>;
  table.grid[detail::kPositionDerivatives][kScheme] =
      grid_kernel<T, detail::kPositionDerivatives, kScheme>;
  // Rarer outputs ask the task whether edges are watertight; see kUsual.
  constexpr detail::Scheme kGeneral = detail::scheme(true, detail::has_origins(kScheme));
  table.grid[detail::kAnyOutputs][kScheme] = grid_kernel<T, detail::kAnyOutputs, kGeneral>;
  table.grid[detail::kSecondDerivatives][kScheme] =
      grid_kernel<T, detail::kSecondDerivatives, detail::kWatertight>; // which have no origins
}

// Of the other objects of this instruction set.
extern const detail::ShapeTable<float> shape_table_f32;
extern const detail::ShapeTable<double> shape_table_f64;
extern const detail::CurveTable<float> curve_table_f32;
extern const detail::CurveTable<double> curve_table_f64;
extern const detail::NetTable<float> net_table_f32;
extern const detail::NetTable<double> net_table_f64;

template <typename T>
constexpr detail::KernelTable<T> make_table() {
  detail::KernelTable<T> table{};
  table.isa = Isa::SIMDBEZIER_ISA;
  table.lanes = kLanes<vec<T>>;
  table.puts_records = kPutsRecords<vec<T>>;
  table.highest_index = highest_index;
  table.drain = drain_all<T>;
  table.fence = streaming_fence;
  table.pack_f32 = pack_kernel<T, float>;
  table.pack_f64 = pack_kernel<T, double>;
  fill_scheme<T, detail::kOpen>(table);
  fill_scheme<T, detail::kOpenOrigin>(table);
  fill_scheme<T, detail::kWatertight>(table);
  fill_scheme<T, detail::kWatertightOrigin>(table);
  table.scattered[false] = scattered_kernel<T, false>;
  table.scattered[true] = scattered_kernel<T, true>;
  return table;
}

constexpr detail::KernelTable<float> make_table_f32() {
  detail::KernelTable<float> table = make_table<float>();
  table.shapes = &shape_table_f32;
  table.curves = &curve_table_f32;
  table.nets = &net_table_f32;
  return table;
}

constexpr detail::KernelTable<double> make_table_f64() {
  detail::KernelTable<double> table = make_table<double>();
  table.shapes = &shape_table_f64;
  table.curves = &curve_table_f64;
  table.nets = &net_table_f64;
  return table;
}

extern const detail::KernelTable<float> table_f32;
extern const detail::KernelTable<double> table_f64;
constinit const detail::KernelTable<float> table_f32 = make_table_f32();
constinit const detail::KernelTable<double> table_f64 = make_table_f64();

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
