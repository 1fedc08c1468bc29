// What stands behind the handles of simdbezier.h: C++ objects of one type or the other.
#pragma once

#include <memory>
#include <utility>
#include <variant>

#include <simdbezier/curves.hpp>
#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/topology.hpp>

#include "src/c_api/structs.hpp"

struct simdbezier_patch_set {
  std::variant<simdbezier::PatchSet<float>, simdbezier::PatchSet<double>> of;
};
struct simdbezier_curve_set {
  std::variant<simdbezier::CurveSet<float>, simdbezier::CurveSet<double>> of;
};
struct simdbezier_topology {
  simdbezier::Topology of;
};
struct simdbezier_mesh_layout {
  simdbezier::MeshLayout of;
};

namespace simdbezier::c_api {

/// body(set) with the C++ set behind a handle.
template <typename Handle, typename Body>
auto with_set(const Handle* handle, const Path& path, Body body) {
  require(handle != nullptr, SIMDBEZIER_NULL_INPUT, path);
  return std::visit(body, handle->of);
}

template <typename Handle>
const auto& object_of(const Handle* handle, const Path& path) {
  require(handle != nullptr, SIMDBEZIER_NULL_INPUT, path);
  return handle->of;
}

/// Hands an object to the caller.
template <typename Handle, typename Object>
void give(Handle** handle, Object&& object) {
  *handle = std::make_unique<Handle>(Handle{std::forward<Object>(object)}).release();
}

/// Where a handle goes.
template <typename Handle>
void require_place(Handle* const* handle, const Path& path) {
  require(handle != nullptr, SIMDBEZIER_NULL_OUTPUT, path);
}

} // namespace simdbezier::c_api
