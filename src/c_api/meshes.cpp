// Vertices of meshes, and meshes in one call, of simdbezier.h.
#include <cmath>
#include <limits>

#include <simdbezier/evaluate_mesh.hpp>
#include <simdbezier/mesh.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kSet{"set"};
constexpr Path kLayout{"layout"};
constexpr Path kOut{"out"};

template <typename T>
MeshOutputs<T> outputs_of(const simdbezier_mesh_outputs* given) {
  const simdbezier_mesh_outputs known = read(given, kOut);
  MeshOutputs<T> out{vectors_of<T>(known.position, kOut / "position"),
                     vectors_of<T>(known.normal, kOut / "normal"),
                     vectors_of<T>(known.parameters, kOut / "parameters"),
                     {}};
  if (known.patch != nullptr || known.patch_length != 0) {
    out.patch = span_of(known.patch, known.patch_length, kOut / "patch");
  }
  return out;
}

/// unequal_lengths is about the number of patches in the set, not about the range asked for.
Path blamed_in_mesh(Status status) {
  switch (status.code()) {
  case Status::unequal_lengths:
  case Status::bad_components:
    return kSet;
  case Status::bad_patch_range:
    return {"first_patch or patch_count"};
  default:
    return blamed_in_call(status, kLayout);
  }
}

/// Zero stands for no limit.
double limit_of(double value) {
  return value == 0 ? std::numeric_limits<double>::infinity() : value;
}

MeshOptions mesh_options_of(const simdbezier_mesh_options* given) {
  const simdbezier_mesh_options known = read(given, kOptions);
  MeshOptions options;
  options.tolerance = limit_of(known.tolerance);
  options.relative_tolerance = limit_of(known.relative_tolerance);
  options.tolerances = span_of(known.tolerances, known.tolerances_length, kOptions / "tolerances");
  options.pixels = limit_of(known.pixels);
  require(known.pixels == 0 || known.camera != nullptr, SIMDBEZIER_NULL_INPUT, kOptions / "camera");
  options.camera = camera_of(known.camera, kOptions / "camera");
  options.longest_edge = limit_of(known.longest_edge);
  options.normal_angle = limit_of(known.normal_angle);
  options.nu = known.nu;
  options.nv = known.nv;
  options.point_size = known.point_size;
  options.snap = known.snap;
  options.crease_angle = known.unshared != 0 ? 0 : limit_of(known.crease_angle);
  options.orient = known.orient != 0;
  options.flip = known.flip != 0;
  options.drop_repeated = known.drop_repeated != 0;
  options.normals = known.no_normals == 0;
  options.parameters = known.parameters != 0;
  options.short_indices = known.short_indices != 0;
  options.local_origin = known.local_origin != 0;
  options.threads = known.threads;
  options.isa = isa_of(known.isa, kOptions / "isa");
  return options;
}

template <typename S>
Path blamed_in_tessellation(Status status, std::span<const ControlNets<S>> nets,
                            std::size_t patch) {
  switch (status.code()) {
  case Status::bad_tolerance:
    return kOptions / "tolerance";
  case Status::bad_grid:
    return kOptions / "nu or nv";
  case Status::bad_rates:
  case Status::not_orientable:
    return kOptions;
  default:
    return blamed_nets(status, nets_with_patch(nets, patch));
  }
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
  return known;
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_evaluate_mesh(const simdbezier_patch_set* set,
                                           const simdbezier_mesh_layout* layout,
                                           const simdbezier_mesh_outputs* out,
                                           const simdbezier_options* options, size_t first_patch,
                                           size_t patch_count) {
  return answer(__func__, [&] {
    const MeshLayout& numbers = object_of(layout, kLayout);
    with_set(set, kSet, [&]<typename T>(const PatchSet<T>& patches) {
      const MeshOutputs<T> to = outputs_of<T>(out);
      const CallOptions how(options);
      require_ok(evaluate_mesh(patches, numbers, to, *how, range_of(first_patch, patch_count)),
                 blamed_in_mesh);
    });
  });
}

simdbezier_status simdbezier_evaluate_mesh_attributes(const simdbezier_patch_set* set,
                                                      const simdbezier_mesh_layout* layout,
                                                      const simdbezier_vectors* out,
                                                      int32_t first_component,
                                                      const simdbezier_options* options,
                                                      size_t first_patch, size_t patch_count) {
  return answer(__func__, [&] {
    const MeshLayout& numbers = object_of(layout, kLayout);
    require(out != nullptr, SIMDBEZIER_NULL_OUTPUT, kOut);
    with_set(set, kSet, [&]<typename T>(const PatchSet<T>& patches) {
      const Vectors<T> to = vectors_of<T>(*out, kOut);
      const CallOptions how(options);
      require_ok(evaluate_mesh_attributes(patches, numbers, to, first_component, *how,
                                          range_of(first_patch, patch_count)),
                 [](Status status) {
                   return status == Status::bad_components ? Path{"first_component"}
                                                           : blamed_in_mesh(status);
                 });
    });
  });
}

simdbezier_status simdbezier_split_creases(const simdbezier_patch_set* set,
                                           const simdbezier_mesh_layout* layout, double angle,
                                           const simdbezier_options* options,
                                           simdbezier_mesh_layout** split) {
  return answer(__func__, [&] {
    require_place(split, {"split"});
    const MeshLayout& numbers = object_of(layout, kLayout);
    with_set(set, kSet, [&](const auto& patches) {
      const CallOptions how(options);
      MeshLayout made;
      require_ok(split_creases(patches, numbers, angle, made, *how), [](Status status) {
        return status == Status::bad_tolerance ? Path{"angle"} : blamed_in_mesh(status);
      });
      give(split, std::move(made));
    });
  });
}

simdbezier_status simdbezier_tessellate(const simdbezier_nets* nets, size_t length,
                                        simdbezier_scalar scalar,
                                        const simdbezier_mesh_options* options,
                                        simdbezier_mesh** mesh) {
  return answer(__func__, [&] {
    require_place(mesh, {"mesh"});
    const MeshOptions how = mesh_options_of(options);
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      with_scalar(scalar, {"scalar"}, [&]<typename T>() {
        Mesh<T> made = tessellate<T>(views, how);
        if (!made) {
          throw Fault{code_of(made.status),
                      blamed_in_tessellation(made.status, views, made.fault_patch),
                      made.fault_patch};
        }
        give(mesh, std::move(made));
      });
    });
  });
}

void simdbezier_mesh_free(simdbezier_mesh* mesh) { delete mesh; }

simdbezier_status simdbezier_mesh_look(const simdbezier_mesh* mesh,
                                       simdbezier_mesh_arrays* arrays) {
  return answer(__func__, [&] {
    require_writable(arrays, {"arrays"});
    with_set(mesh, {"mesh"}, [&](const auto& of) { write(arrays, arrays_of(of)); });
  });
}

simdbezier_status simdbezier_mesh_count(const simdbezier_mesh* mesh,
                                        simdbezier_topology_counts* counts) {
  return answer(__func__, [&] {
    require_writable(counts, {"counts"});
    with_set(mesh, {"mesh"}, [&](const auto& of) { write(counts, counts_of(of.counts)); });
  });
}
