// The calls of bases.hpp: which nets a basis takes, and B-spline meshes as rows of nets.
#include <simdbezier/bases.hpp>

#include <cmath>
#include <cstdint>
#include <new>
#include <vector>

#include "src/nets/linear_maps.hpp"
#include "src/nets/net_call.hpp"
#include "src/nets/net_places.hpp"

namespace simdbezier {
namespace detail {
namespace {

bool is_power(Basis basis) noexcept {
  return basis == Basis::power || basis == Basis::centred_power;
}

/// ok | bad_degree | bad_weight, for nets that can be read.
template <typename T>
Status check_basis(Basis basis, const ControlNets<T>& nets, bool to_bezier) noexcept {
  if (!is_power(basis) && (nets.degree_u != 3 || nets.degree_v != 3)) {
    return Status::bad_degree;
  }
  const bool any_weights = basis == Basis::b_spline && to_bezier;
  const bool allowed = nets.weights == Weights::none || any_weights ||
                       (is_power(basis) && nets.weights == Weights::homogeneous);
  return allowed ? Status::ok : Status::bad_weight;
}

template <typename T>
NetReport change_basis(const ControlNets<T>& nets, const MutableNets<T>& out, Basis basis,
                       bool to_bezier, const Options& options) noexcept {
  const Status status = check_nets<T>(nets, {&out}, nets.degree_u, nets.degree_v);
  if (status != Status::ok) {
    return {status};
  }
  const Status fits = check_basis(basis, nets, to_bezier);
  if (fits != Status::ok) {
    return argument_fault(fits);
  }
  const auto map_of = to_bezier ? to_bezier_map : from_bezier_map;
  const LinearMap u = map_of(basis, nets.degree_u);
  const LinearMap v = map_of(basis, nets.degree_v);
  const MapTask<T> task{view_of(nets), view_of(out), &u, &v, support_of(u), support_of(v)};
  return compute_nets(nets, &NetTable<T>::map, task, 3 * shape_of(nets).control_values(), options,
                      is_power(basis));
}

template <typename T>
std::ptrdiff_t channels_of(const SplineMesh<T>& mesh) noexcept {
  return mesh.components + (mesh.weights == Weights::none ? 0 : 1);
}

/// A row of the mesh's patches: neighbours share three columns, so they are one column apart.
template <typename T>
ControlNets<T> row_of_patches(const SplineMesh<T>& mesh, std::size_t row) noexcept {
  return {mesh.points + static_cast<std::ptrdiff_t>(row) * mesh.row_stride,
          mesh.patches_u(),
          3,
          3,
          mesh.point_stride,
          mesh.row_stride,
          mesh.point_stride,
          mesh.component_stride,
          mesh.components,
          mesh.weights};
}

/// The mesh with its first columns and rows once more behind the last ones.
template <typename T>
SplineMesh<T> unrolled(const SplineMesh<T>& mesh, std::vector<T>& points) {
  SplineMesh<T> open = mesh;
  open.rows += mesh.periodic_v ? 3 : 0;
  open.columns += mesh.periodic_u ? 3 : 0;
  open.periodic_u = open.periodic_v = false;
  open.component_stride = 1;
  open.point_stride = channels_of(mesh);
  open.row_stride = open.point_stride * static_cast<std::ptrdiff_t>(open.columns);
  points.reserve(open.rows * static_cast<std::size_t>(open.row_stride));
  for (std::size_t row = 0; row < open.rows; ++row) {
    for (std::size_t column = 0; column < open.columns; ++column) {
      const T* const point = mesh.points +
                             static_cast<std::ptrdiff_t>(row % mesh.rows) * mesh.row_stride +
                             static_cast<std::ptrdiff_t>(column % mesh.columns) * mesh.point_stride;
      for (std::ptrdiff_t c = 0; c < open.point_stride; ++c) {
        points.push_back(point[c * mesh.component_stride]);
      }
    }
  }
  open.points = points.data();
  return open;
}

/// Faults of an open mesh. Patches are searched one by one only if some value is at fault.
template <typename T>
NetReport find_mesh_fault(const SplineMesh<T>& mesh) noexcept {
  bool sound = true;
  for (std::size_t row = 0; row < mesh.rows; ++row) {
    for (std::size_t column = 0; column < mesh.columns; ++column) {
      const T* const point = mesh.points + static_cast<std::ptrdiff_t>(row) * mesh.row_stride +
                             static_cast<std::ptrdiff_t>(column) * mesh.point_stride;
      for (std::ptrdiff_t c = 0; c < channels_of(mesh); ++c) {
        const T value = point[c * mesh.component_stride];
        sound = sound && std::isfinite(value) && (c < mesh.components || value > 0);
      }
    }
  }
  for (std::size_t row = 0; !sound && row < mesh.patches_v(); ++row) {
    NetReport report = find_fault(row_of_patches(mesh, row), 1);
    if (!report) {
      report.patch += row * mesh.patches_u();
      return report;
    }
  }
  return {};
}

template <typename T>
NetReport convert_mesh(const SplineMesh<T>& mesh, const MutableNets<T>& out,
                       const Options& options) noexcept {
  Isa isa = Isa::automatic;
  const Status runs = resolve_isa(options.isa, isa);
  if (runs != Status::ok) {
    return {runs};
  }
  const NetReport checked = find_mesh_fault(mesh);
  if (!checked) {
    return checked;
  }
  const LinearMap map = to_bezier_map(Basis::b_spline, 3);
  const Support support = support_of(map);
  const std::size_t columns = mesh.patches_u();
  const std::size_t groups = lane_groups(columns); // of one row
  const NetKernel<MapTask<T>> kernel = kernel_table<T>(isa).nets->map;
  const auto work = [&](int, std::size_t begin, std::size_t end, unsigned char* scratch) {
    Isa executed = isa;
    for (std::size_t unit = begin; unit < end; ++unit) {
      const std::size_t row = unit / groups;
      const std::size_t first = unit % groups * kMaxLanes;
      MutableNets<T> to = out;
      to.points += static_cast<std::ptrdiff_t>(row * columns) * out.patch_stride;
      const MapTask<T> task{
          view_of(row_of_patches(mesh, row)), view_of(to), &map, &map, support, support};
      const std::size_t last = first + kMaxLanes < columns ? first + kMaxLanes : columns;
      executed = kernel(task, first, last, scratch);
    }
    return executed;
  };
  const std::size_t values = 3 * 16 * static_cast<std::size_t>(channels_of(mesh));
  return {run_blocks(mesh.patches_v() * groups, duration_of(mesh.patches_v() * columns, 100),
                     options, values * kLineBytes, work)};
}

/// A mesh of sound components as one net; its rows and columns are no degrees.
template <typename T>
ControlNets<T> one_net(const SplineMesh<T>& mesh) noexcept {
  return {mesh.points,
          1,
          static_cast<int>(mesh.columns - 1),
          static_cast<int>(mesh.rows - 1),
          0,
          mesh.row_stride,
          mesh.point_stride,
          mesh.component_stride,
          mesh.components,
          mesh.weights};
}

template <typename T>
Status check_mesh(const SplineMesh<T>& mesh, const MutableNets<T>& out) noexcept {
  constexpr std::size_t kMost = std::size_t{1} << 31;
  const auto enough = [](std::size_t count, bool periodic) {
    return count >= (periodic ? 3U : 4U);
  };
  if (!enough(mesh.rows, mesh.periodic_v) || !enough(mesh.columns, mesh.periodic_u)) {
    return Status::bad_grid;
  }
  if (mesh.rows > kMost || mesh.columns > kMost) {
    return Status::size_overflow;
  }
  ControlNets<T> pieces = row_of_patches(mesh, 0);
  Status status = check_input(pieces);
  if (status != Status::ok) {
    return status;
  }
  pieces.count = mesh.patches_u() * mesh.patches_v();
  status = check_output(out, pieces, 3, 3);
  Lattice lattice;
  if (status == Status::ok && !lattice_of(one_net(mesh), lattice)) {
    return Status::size_overflow;
  }
  return status == Status::ok ? check_apart<T>(out, lattice.range) : status;
}

} // namespace
} // namespace detail

template <typename T>
NetReport to_bezier(Basis basis, const ControlNets<T>& nets,
                    const std::type_identity_t<MutableNets<T>>& out,
                    const Options& options) noexcept {
  return detail::change_basis<T>(nets, out, basis, true, options);
}

template <typename T>
NetReport from_bezier(Basis basis, const ControlNets<T>& nets,
                      const std::type_identity_t<MutableNets<T>>& out,
                      const Options& options) noexcept {
  return detail::change_basis<T>(nets, out, basis, false, options);
}

template <typename T>
NetReport spline_to_bezier(const SplineMesh<T>& mesh,
                           const std::type_identity_t<MutableNets<T>>& out,
                           const Options& options) noexcept try {
  const Status status = detail::check_mesh<T>(mesh, out);
  if (status != Status::ok) {
    return {status};
  }
  if (!mesh.periodic_u && !mesh.periodic_v) {
    return detail::convert_mesh<T>(mesh, out, options);
  }
  std::vector<T> points;
  const SplineMesh<T> open = detail::unrolled(mesh, points);
  return detail::convert_mesh<T>(open, out, options);
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API NetReport to_bezier(Basis, const ControlNets<T>&,                        \
                                              const std::type_identity_t<MutableNets<T>>&,         \
                                              const Options&) noexcept;                            \
  template SIMDBEZIER_API NetReport from_bezier(Basis, const ControlNets<T>&,                      \
                                                const std::type_identity_t<MutableNets<T>>&,       \
                                                const Options&) noexcept;                          \
  template SIMDBEZIER_API NetReport spline_to_bezier(                                              \
      const SplineMesh<T>&, const std::type_identity_t<MutableNets<T>>&, const Options&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
