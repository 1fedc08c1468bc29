// Compiled once per instruction set: kernels for meshes.
#include "kernels/mesh/edge_kernel.hpp"
#include "kernels/mesh/format_kernel.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T>
constexpr detail::MeshTable<T> make_mesh_table() {
  detail::MeshTable<T> table{};
  if constexpr (!kCompact) {
    table.edges = edge_kernel<T>;
  }
  return table;
}

extern const detail::MeshTable<float> mesh_table_f32;
extern const detail::MeshTable<double> mesh_table_f64;
constinit const detail::MeshTable<float> mesh_table_f32 = make_mesh_table<float>();
constinit const detail::MeshTable<double> mesh_table_f64 = make_mesh_table<double>();
extern const detail::FormatTable<float> format_table_f32;
extern const detail::FormatTable<double> format_table_f64;
constinit const detail::FormatTable<float> format_table_f32 = {format_kernel<float>};
constinit const detail::FormatTable<double> format_table_f64 = {format_kernel<double>};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
