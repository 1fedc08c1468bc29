// Meshes in one call, and plans of them, of simdbezier.h.
#include <cmath>
#include <cstddef>

#include <simdbezier/mesh.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/spline_views.hpp"
#include "src/mesh/mesh_measures.hpp"

namespace simdbezier::c_api {
namespace {

// Pieces are handed out in place.
static_assert(sizeof(simdbezier_patch_piece) == sizeof(PatchPiece) &&
              offsetof(simdbezier_patch_piece, patch) == offsetof(PatchPiece, patch) &&
              offsetof(simdbezier_patch_piece, u0) == offsetof(PatchPiece, u0) &&
              offsetof(simdbezier_patch_piece, u1) == offsetof(PatchPiece, u1) &&
              offsetof(simdbezier_patch_piece, v0) == offsetof(PatchPiece, v0) &&
              offsetof(simdbezier_patch_piece, v1) == offsetof(PatchPiece, v1) &&
              offsetof(simdbezier_patch_piece, error) == offsetof(PatchPiece, error));

MeshOptions mesh_options_of(const simdbezier_mesh_options* given) {
  const simdbezier_mesh_options known = read(given, kOptions);
  MeshOptions options;
  options.rates.tolerance = limit_of(known.tolerance);
  options.relative_tolerance = limit_of(known.relative_tolerance);
  options.rates.tolerances =
      span_of(known.tolerances, known.tolerances_length, kOptions / "tolerances");
  options.pixels = limit_of(known.pixels);
  require(known.pixels == 0 || known.camera != nullptr, SIMDBEZIER_NULL_INPUT, kOptions / "camera");
  options.camera = camera_of(known.camera, kOptions / "camera");
  options.rates.longest_edge = limit_of(known.longest_edge);
  options.rates.normal_degrees = limit_of(known.normal_degrees);
  options.nu = known.nu;
  options.nv = known.nv;
  options.topology.point_size = known.point_size;
  options.topology.snap = known.snap;
  options.split_edges = known.split_edges != 0;
  options.crease_degrees = limit_of(known.crease_degrees);
  options.share_vertices = known.unshared == 0;
  options.topology.orient = known.orient != 0;
  options.topology.flip = known.flip != 0;
  options.drop_repeated = known.drop_repeated != 0;
  options.normals = known.no_normals == 0;
  options.parameters = known.parameters != 0;
  options.short_indices = known.short_indices != 0;
  options.local_origin = known.local_origin != 0;
  options.threads = known.threads;
  options.isa = isa_of(known.isa, kOptions / "isa");
  return options;
}

/// The member that bad_tolerance is about: one that has no meaning, or says how fine the mesh is to
/// be.
const char* blamed_measure(const MeshOptions& options) {
  if (const char* const meaningless = detail::meaningless_measure(options)) {
    return meaningless;
  }
  return !options.rates.tolerances.empty()           ? "tolerances"
         : std::isfinite(options.rates.tolerance)    ? "tolerance"
         : std::isfinite(options.relative_tolerance) ? "relative_tolerance"
         : std::isfinite(options.pixels)             ? "pixels or camera"
                                                     : "tolerance";
}

/// blamed_points(status): what of the points is at fault where no option is.
template <typename BlamedPoints>
Path blamed_in_tessellation(Status status, const MeshOptions& options, BlamedPoints blamed_points) {
  const bool few = options.nu < 2 || options.nv < 2;
  switch (status.code()) {
  case Status::bad_tolerance:
    return kOptions / blamed_measure(options);
  case Status::bad_grid:
    return kOptions / (few ? "nu or nv" : "nu and nv beside a tolerance");
  case Status::bad_rates:
    return kOptions / (options.nu != 0 ? "nu or nv" : "tolerances");
  case Status::snap_too_large:
    return kOptions / "snap";
  case Status::not_orientable:
    return kOptions / "orient";
  default:
    return blamed_points(status);
  }
}

template <typename Known>
void put_splits(Known& known, const SplitCounts& of) noexcept {
  known.splits = of.splits;
  known.unjoined = of.unjoined;
  known.largest_gap = of.largest_gap;
}

template <typename T>
simdbezier_mesh_arrays arrays_of(const Mesh<T>& mesh) noexcept {
  simdbezier_mesh_arrays known{};
  known.scalar = kScalar<T>;
  known.vertices = mesh.positions.size();
  known.triangles = mesh.triangles.size() + mesh.short_triangles.size();
  known.positions = first_of(mesh.positions);
  known.normals = first_of(mesh.normals);
  known.parameters = first_of(mesh.parameters);
  known.patches = first_of(mesh.patches);
  known.indices = first_of(mesh.triangles);
  known.short_indices = first_of(mesh.short_triangles);
  known.deviations = first_of(mesh.deviations);
  known.patches_given = mesh.deviations.size();
  known.deviation = mesh.deviation;
  put_splits(known, mesh.splits);
  return known;
}

simdbezier_mesh_plan_parts parts_of(const simdbezier_mesh_plan& plan) noexcept {
  simdbezier_mesh_plan_parts known{};
  known.set = &plan.set;
  known.topology = &plan.topology;
  known.layout = &plan.layout;
  std::visit(
      [&](const auto& of) {
        known.patch_count = of.cells_u.size();
        known.patches = first_of(of.patches);
        known.cells_u = first_of(of.cells_u);
        known.cells_v = first_of(of.cells_v);
        known.deviations = first_of(of.deviations);
        known.deviation = of.deviation;
        known.diagonal = of.diagonal;
        known.pieces = of.pieces.empty()
                           ? nullptr
                           : reinterpret_cast<const simdbezier_patch_piece*>(of.pieces.data());
        put_splits(known, of.splits);
      },
      plan.of);
  return known;
}

/// Gives a mesh or a plan of one, or refuses the call for what it was refused for.
template <typename Handle, typename Made, typename BlamedPoints>
void give_made(Made&& made, const MeshOptions& options, Handle** handle,
               BlamedPoints blamed_points) {
  if (!made) {
    throw Fault{code_of(made.report.status),
                blamed_in_tessellation(made.report.status, options, blamed_points),
                made.report.item};
  }
  give(handle, std::forward<Made>(made));
}

/// A mesh or a plan of one, which `call` makes.
template <typename Handle, typename Call>
simdbezier_status make(const char* function, const simdbezier_nets* nets, std::size_t length,
                       simdbezier_scalar scalar, const simdbezier_mesh_options* options,
                       Handle** handle, const char* name, Call call) noexcept {
  return answer(function, [&] {
    require_place(handle, {name});
    const MeshOptions how = mesh_options_of(options);
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      with_scalar(scalar, {"scalar"}, [&]<typename T>() {
        auto made = call.template operator()<T>(views, how);
        const std::size_t patch = made.report.item;
        give_made(std::move(made), how, handle, [&](Status status) {
          return blamed_nets(status, nets_with_patch(views, patch));
        });
      });
    });
  });
}

/// The same of splines.
template <typename Handle, typename Call>
simdbezier_status make(const char* function, const simdbezier_spline_surface* surfaces,
                       std::size_t length, simdbezier_scalar scalar,
                       const simdbezier_mesh_options* options, Handle** handle, const char* name,
                       Call call) noexcept {
  return answer(function, [&] {
    require_place(handle, {name});
    const MeshOptions how = mesh_options_of(options);
    with_surface_array(surfaces, length, [&]<typename S>(std::span<const SplineSurface<S>> views) {
      with_scalar(scalar, {"scalar"}, [&]<typename T>() {
        Report report;
        auto made = call.template operator()<T>(views, how, &report);
        require_spline(report, {"surfaces", report.item}, kSurfaceNames);
        const std::size_t patch = made.report.item;
        give_made(std::move(made), how, handle, [&](Status status) {
          std::size_t k = 0;
          std::size_t end = 0; // of the patches of surface k
          while (k + 1 < views.size() && patch >= (end += span_count(views[k]).patches())) {
            ++k;
          }
          return blamed_nets(status, {"surfaces", k});
        });
      });
    });
  });
}

// Overloads and templates cannot be handed over as they are.
const auto kTessellate = []<typename T>(const auto& views, const auto&... how) {
  return tessellate<T>(views, how...);
};
const auto kPlanMesh = []<typename T>(const auto& views, const auto&... how) {
  return plan_mesh<T>(views, how...);
};

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_tessellate(const simdbezier_nets* nets, size_t length,
                                        simdbezier_scalar scalar,
                                        const simdbezier_mesh_options* options,
                                        simdbezier_mesh** mesh) {
  return make(__func__, nets, length, scalar, options, mesh, "mesh", kTessellate);
}

void simdbezier_mesh_free(simdbezier_mesh* mesh) { delete mesh; }

simdbezier_status simdbezier_mesh_look(const simdbezier_mesh* mesh,
                                       simdbezier_mesh_arrays* arrays) {
  return answer(__func__, [&] {
    require_writable(arrays, {"arrays"});
    with_object(mesh, {"mesh"}, [&](const auto& of) { write(arrays, arrays_of(of)); });
  });
}

simdbezier_status simdbezier_mesh_count(const simdbezier_mesh* mesh,
                                        simdbezier_topology_counts* counts) {
  return answer(__func__, [&] {
    require_writable(counts, {"counts"});
    with_object(mesh, {"mesh"}, [&](const auto& of) { write(counts, counts_of(of.counts)); });
  });
}

simdbezier_status simdbezier_plan_mesh(const simdbezier_nets* nets, size_t length,
                                       simdbezier_scalar scalar,
                                       const simdbezier_mesh_options* options,
                                       simdbezier_mesh_plan** plan) {
  return make(__func__, nets, length, scalar, options, plan, "plan", kPlanMesh);
}

void simdbezier_mesh_plan_free(simdbezier_mesh_plan* plan) { delete plan; }

simdbezier_status simdbezier_mesh_plan_look(const simdbezier_mesh_plan* plan,
                                            simdbezier_mesh_plan_parts* parts) {
  return answer(__func__, [&] {
    require_writable(parts, {"parts"});
    require(plan != nullptr, SIMDBEZIER_NULL_INPUT, {"plan"});
    write(parts, parts_of(*plan));
  });
}

simdbezier_status simdbezier_mesh_plan_count(const simdbezier_mesh_plan* plan,
                                             simdbezier_topology_counts* counts) {
  return answer(__func__, [&] {
    require_writable(counts, {"counts"});
    with_object(plan, {"plan"}, [&](const auto& of) { write(counts, counts_of(of.counts)); });
  });
}

simdbezier_status simdbezier_spline_tessellate(const simdbezier_spline_surface* surfaces,
                                               size_t length, simdbezier_scalar scalar,
                                               const simdbezier_mesh_options* options,
                                               simdbezier_mesh** mesh) {
  return make(__func__, surfaces, length, scalar, options, mesh, "mesh", kTessellate);
}

simdbezier_status simdbezier_spline_plan_mesh(const simdbezier_spline_surface* surfaces,
                                              size_t length, simdbezier_scalar scalar,
                                              const simdbezier_mesh_options* options,
                                              simdbezier_mesh_plan** plan) {
  return make(__func__, surfaces, length, scalar, options, plan, "plan", kPlanMesh);
}
