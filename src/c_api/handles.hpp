// What stands behind the handles of simdbezier.h: C++ objects of one type or the other.
#pragma once

#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include <simdbezier/curves.hpp>
#include <simdbezier/flatten.hpp>
#include <simdbezier/mesh.hpp>
#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/topology.hpp>

#include "src/c_api/structs.hpp"

struct simdbezier_patch_set {
  std::variant<simdbezier::PatchSet<float>, simdbezier::PatchSet<double>> of;
};
struct simdbezier_curve_set {
  std::variant<simdbezier::CurveSet<float>, simdbezier::CurveSet<double>> of;
};
struct simdbezier_polylines {
  std::variant<simdbezier::Polylines<float>, simdbezier::Polylines<double>> of;
};
struct simdbezier_topology {
  simdbezier::Topology of;
};
struct simdbezier_mesh_layout {
  simdbezier::MeshLayout of;
};
struct simdbezier_mesh_plan {
  /// The plan's parts as handles, which other calls take.
  template <typename T>
  explicit simdbezier_mesh_plan(simdbezier::MeshPlan<T>&& plan)
      : set{plan.set}, topology{plan.topology}, layout{plan.layout}, of(std::move(plan)) {}

  simdbezier_patch_set set;
  simdbezier_topology topology;
  simdbezier_mesh_layout layout;
  std::variant<simdbezier::MeshPlan<float>, simdbezier::MeshPlan<double>> of;
};
struct simdbezier_mesh {
  std::variant<simdbezier::Mesh<float>, simdbezier::Mesh<double>> of;
};

namespace simdbezier::c_api {

template <typename Handle>
const auto& object_of(const Handle* handle, const Path& path) {
  require(handle != nullptr, SIMDBEZIER_NULL_INPUT, path);
  return handle->of;
}

/// body(object) with the C++ object behind a handle, of one of two number types.
template <typename Handle, typename Body>
auto with_object(const Handle* handle, const Path& path, Body body) {
  return std::visit(body, object_of(handle, path));
}

/// Writes arrays or numbers of an object into the caller's struct: result_of(object).
template <typename Handle, typename Struct, typename ResultOf>
simdbezier_status look(const char* function, const Handle* handle, const Path& path, Struct* result,
                       const Path& result_path, ResultOf result_of) noexcept {
  return answer(function, [&] {
    require_writable(result, result_path);
    with_object(handle, path, [&](const auto& object) { write(result, result_of(object)); });
  });
}

/// Hands an object to the caller.
template <typename Handle, typename Object>
void give(Handle** handle, Object&& object) {
  *handle = std::make_unique<Handle>(Handle{std::forward<Object>(object)}).release();
}

/// The first number of a vector that a handle holds, or null where there is none.
template <typename V>
const auto* first_of(const std::vector<V>& values) {
  if constexpr (std::is_arithmetic_v<V>) {
    return values.empty() ? nullptr : values.data();
  } else {
    return values.empty() ? nullptr : values.front().data();
  }
}

inline simdbezier_topology_counts counts_of(const TopologyCounts& of) noexcept {
  simdbezier_topology_counts known{};
  known.patches = of.patches;
  known.edges = of.edges;
  known.open_edges = of.open_edges;
  known.non_manifold_edges = of.non_manifold_edges;
  known.collapsed_sides = of.collapsed_sides;
  known.corners = of.corners;
  known.repeated_patches = of.repeated_patches;
  known.turned_edges = of.turned_edges;
  known.snapped_sides = of.snapped_sides;
  known.orientable = of.orientable ? 1 : 0;
  return known;
}

inline Camera camera_of(const simdbezier_camera* given, const Path& path) {
  const auto known = read_options(given, path);
  Camera camera;
  std::copy_n(known.eye, 3, camera.eye.begin());
  if (known.direction[0] != 0 || known.direction[1] != 0 || known.direction[2] != 0) {
    std::copy_n(known.direction, 3, camera.direction.begin());
  }
  const auto set = [](double& member, double value) { member = value != 0 ? value : member; };
  set(camera.focal_length, known.focal_length);
  set(camera.width, known.width);
  set(camera.height, known.height);
  set(camera.nearest, known.nearest);
  camera.orthographic = known.orthographic != 0;
  camera.skip_outside = known.skip_outside != 0;
  camera.skip_back = known.skip_back != 0;
  return camera;
}

/// Refuses null where a handle is to go.
template <typename Handle>
void require_place(Handle* const* handle, const Path& path) {
  require(handle != nullptr, SIMDBEZIER_NULL_OUTPUT, path);
}

} // namespace simdbezier::c_api
