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
  const auto known = read(given, kOptions);
  MeshOptions options;
  set_limits(options.rates, known);
  options.relative_tolerance = limit_of(known.relative_tolerance);
  options.pixels = limit_of(known.pixels);
  require(known.pixels == 0 || known.camera != nullptr, SIMDBEZIER_NULL_INPUT, kOptions / "camera");
  options.camera = camera_of(known.camera, kOptions / "camera");
  options.nu = known.nu;
  options.nv = known.nv;
  options.topology.point_size = known.point_size;
  options.topology.snap = known.snap;
  options.split_edges = known.split_edges != 0;
  options.crease_degrees = known.unshared != 0 ? 0 : limit_of(known.crease_degrees);
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
  return !options.rates.tolerances.empty()             ? "tolerances"
         : std::isfinite(options.rates.tolerance)      ? "tolerance"
         : std::isfinite(options.relative_tolerance)   ? "relative_tolerance"
         : std::isfinite(options.pixels)               ? "pixels or camera"
         : std::isfinite(options.rates.longest_edge)   ? "longest_edge"
         : std::isfinite(options.rates.normal_degrees) ? "normal_degrees"
                                                       : "tolerance";
}

/// points: what of these is at fault where no option is.
Path blamed_in_tessellation(Status status, const MeshOptions& options, const Path& points) {
  const bool few = options.nu < 2 || options.nv < 2;
  return blamed(
      status,
      {{{Status::bad_tolerance}, kOptions / blamed_measure(options)},
       {{Status::bad_grid}, kOptions / (few ? "nu or nv" : "nu and nv beside a tolerance")},
       {{Status::bad_rates}, kOptions / (options.nu != 0 ? "nu or nv" : "tolerances")},
       {{Status::snap_too_large}, kOptions / "snap"},
       {{Status::not_orientable}, kOptions / "orient"}},
      points);
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

/// A mesh or a plan of one, which call(views, options, report of splines) makes of nets or splines.
template <typename Struct, typename Handle, typename Call>
simdbezier_status make(const char* function, const Struct* models, std::size_t length,
                       simdbezier_scalar scalar, const simdbezier_mesh_options* options,
                       Handle** handle, const char* name, Call call) noexcept {
  return answer(function, [&] {
    constexpr bool kSplines = std::is_same_v<Struct, simdbezier_spline_surface>;
    constexpr const char* kModels = kSplines ? "surfaces" : "nets";
    require_place(handle, {name});
    const MeshOptions how = mesh_options_of(options);
    with_array(models, length, kModels, [&](const auto& views) {
      with_scalar(scalar, {"scalar"}, [&]<typename T>() {
        Report own;
        auto made = [&] {
          if constexpr (kSplines) {
            return call.template operator()<T>(views, how, &own);
          } else {
            return call.template operator()<T>(views, how);
          }
        }();
        require_spline(own, {kModels, own.item}, kSurfaceNames);
        require_item(made.report, [&](Status status) {
          const Path model = element_with_patch(kModels, views, made.report.item);
          return blamed_in_tessellation(status, how, blamed_nets(status, model));
        });
        give(handle, std::move(made));
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

// tessellate() and plan_mesh() of nets and of splines.
#define SIMDBEZIER_MAKE(name, models, model_type, made, made_type, call)                           \
  simdbezier_status simdbezier_##name(                                                             \
      const simdbezier_##model_type* models, size_t length, simdbezier_scalar scalar,              \
      const simdbezier_mesh_options* options, simdbezier_##made_type** made) {                     \
    return make(__func__, models, length, scalar, options, made, #made, call);                     \
  }
SIMDBEZIER_MAKE(tessellate, nets, nets, mesh, mesh, kTessellate)
SIMDBEZIER_MAKE(plan_mesh, nets, nets, plan, mesh_plan, kPlanMesh)
SIMDBEZIER_MAKE(spline_tessellate, surfaces, spline_surface, mesh, mesh, kTessellate)
SIMDBEZIER_MAKE(spline_plan_mesh, surfaces, spline_surface, plan, mesh_plan, kPlanMesh)

void simdbezier_mesh_free(simdbezier_mesh* mesh) { delete mesh; }

simdbezier_status simdbezier_mesh_look(const simdbezier_mesh* mesh,
                                       simdbezier_mesh_arrays* arrays) {
  return look(__func__, mesh, {"mesh"}, arrays, {"arrays"},
              [](const auto& of) { return arrays_of(of); });
}

simdbezier_status simdbezier_mesh_count(const simdbezier_mesh* mesh,
                                        simdbezier_topology_counts* counts) {
  return look(__func__, mesh, {"mesh"}, counts, {"counts"},
              [](const auto& of) { return counts_of(of.counts); });
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
  return look(__func__, plan, {"plan"}, counts, {"counts"},
              [](const auto& of) { return counts_of(of.counts); });
}
