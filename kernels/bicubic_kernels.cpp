// Compiled once per instruction set (cmake/isa.cmake): fills this instruction set's tables.
// Only the tables leave this object; they are constants, so nothing runs at load time. The other
// sources of this folder are compiled the same way.
#include "kernels/grid/grid_kernel.hpp"
#include "kernels/pack/bicubic_pack_kernel.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Stores the register at `to` as often as it is asked for, one behind the other, as in a plane's
/// rows: by that src/choice/line_costs.cpp finds out what stores across cache lines cost.
template <typename T>
SIMDBEZIER_KERNEL void store_registers(T* to, std::size_t registers) {
  const vec<T> value = load_vector<vec<T>>(to);
  for (std::size_t k = 0; k < registers; ++k) {
    store_vector(to + k * kLanes<vec<T>>, value);
  }
}

// The tables of this instruction set's other objects.
extern const detail::ShapeTable<float> shape_table_f32;
extern const detail::ShapeTable<double> shape_table_f64;
extern const detail::CurveTable<float> curve_table_f32;
extern const detail::CurveTable<double> curve_table_f64;
extern const detail::NetTable<float> net_table_f32;
extern const detail::NetTable<double> net_table_f64;
extern const detail::MeshTable<float> mesh_table_f32;
extern const detail::MeshTable<double> mesh_table_f64;

/// Returns the largest index, 0 where there is none. It is a kernel because only the wider
/// instruction sets have a maximum of unsigned integers.
inline std::uint32_t highest_index(const std::uint32_t* index, std::size_t count) {
  std::uint32_t highest = 0;
  for (std::size_t k = 0; k < count; ++k) {
    highest = highest > index[k] ? highest : index[k];
  }
  return highest;
}

template <typename T>
constexpr detail::KernelTable<T>
make_table(const detail::ShapeTable<T>& shapes, const detail::CurveTable<T>& curves,
           const detail::NetTable<T>& nets, const detail::MeshTable<T>& meshes) {
  detail::KernelTable<T> table{};
  table.shapes = &shapes;
  table.curves = &curves;
  table.nets = &nets;
  table.meshes = kCompact ? nullptr : &meshes;
  table.isa = Isa::SIMDBEZIER_ISA;
  table.lanes = kLanes<vec<T>>;
  table.compact = kCompact;
  table.highest_index = highest_index;
  table.drain = drain_all<T>;
  table.fence = streaming_fence;
  if constexpr (!kCompact) {
    table.puts_records = kPutsRecords<vec<T>>;
    table.store_registers = store_registers<T>;
    table.pack_f32 = pack_kernel<T, float>;
    table.pack_f64 = pack_kernel<T, double>;
    table.grid[detail::kPosition] = grid_kernel<T, detail::kPosition>;
    table.grid[detail::kPositionNormal] = grid_kernel<T, detail::kPositionNormal>;
    table.grid[detail::kPositionDerivatives] = grid_kernel<T, detail::kPositionDerivatives>;
    table.grid[detail::kAnyOutputs] = grid_kernel<T, detail::kAnyOutputs>;
    table.grid[detail::kSecondDerivatives] = grid_kernel<T, detail::kSecondDerivatives>;
  }
  return table;
}

extern const detail::KernelTable<float> table_f32;
extern const detail::KernelTable<double> table_f64;
constinit const detail::KernelTable<float> table_f32 =
    make_table(shape_table_f32, curve_table_f32, net_table_f32, mesh_table_f32);
constinit const detail::KernelTable<double> table_f64 =
    make_table(shape_table_f64, curve_table_f64, net_table_f64, mesh_table_f64);

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
