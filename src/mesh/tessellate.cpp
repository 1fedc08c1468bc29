// See mesh.hpp.
#include <simdbezier/mesh.hpp>

#include <algorithm>
#include <limits>

#include <simdbezier/mesh_primitives.hpp>

#include "src/mesh/mesh_planner.hpp"
#include "src/runtime/attempt.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

template <typename T>
Status evaluate_vertices(const MeshPlan<T>& plan, const MeshOptions& options, Mesh<T>& mesh) {
  const std::size_t vertices = plan.layout.size().vertices;
  MeshOutputs<T> out;
  mesh.positions.resize(vertices);
  out.position = Vectors<T>::xyz(mesh.positions);
  if (options.normals) {
    mesh.normals.resize(vertices);
    out.normal = Vectors<T>::xyz(mesh.normals);
  }
  if (options.parameters) {
    mesh.parameters.resize(vertices);
    mesh.patches.resize(vertices);
    T* const first = vertices == 0 ? nullptr : mesh.parameters.front().data();
    out.parameters = Vectors<T>::pairs(std::span<T>(first, 2 * vertices));
    out.patch = mesh.patches;
  }
  Options how;
  how.threads = options.threads;
  how.isa = options.isa;
  if (vertices == 0) {
    return Status::ok;
  }
  const Status status = evaluate_mesh(plan.set, plan.layout, out, how);
  for (std::size_t k = 0; k < mesh.patches.size() && !plan.pieces.empty(); ++k) {
    const PatchPiece& piece = plan.pieces[mesh.patches[k]];
    const double u = static_cast<double>(mesh.parameters[k][0]);
    const double v = static_cast<double>(mesh.parameters[k][1]);
    mesh.parameters[k] = {static_cast<T>(piece.u0 + (piece.u1 - piece.u0) * u),
                          static_cast<T>(piece.v0 + (piece.v1 - piece.v0) * v)};
  }
  if (!plan.patches.empty()) {
    for (std::uint32_t& patch : mesh.patches) {
      patch = plan.patches[patch];
    }
  }
  return status;
}

template <typename T>
Status write_faces(const MeshPlan<T>& plan, const MeshOptions& options, Mesh<T>& mesh) {
  const MeshSize size = plan.layout.size();
  const auto write = [&]<typename Index>(std::vector<std::array<Index, 3>>& triangles) {
    triangles.resize(size.triangles);
    Index* const first = triangles.empty() ? nullptr : triangles.front().data();
    return write_triangles<Index>(plan.layout, std::span<Index>(first, 3 * size.triangles),
                                  {.threads = options.threads, .isa = options.isa});
  };
  const bool few = size.vertices <= std::numeric_limits<std::uint16_t>::max();
  return options.short_indices && few ? write(mesh.short_triangles) : write(mesh.triangles);
}

template <typename T>
Status fill_mesh(const MeshPlan<T>& plan, const MeshOptions& options, std::size_t given,
                 Mesh<T>& mesh) {
  if (const Status status = evaluate_vertices(plan, options, mesh); !status) {
    return status;
  }
  mesh.deviation = plan.deviation;
  mesh.counts = plan.counts;
  mesh.splits = plan.splits;
  mesh.deviations.resize(given);
  for (std::size_t patch = 0; patch < plan.deviations.size(); ++patch) {
    double& deviation = mesh.deviations[plan.patches.empty() ? patch : plan.patches[patch]];
    deviation = std::max(deviation, plan.deviations[patch]);
  }
  return write_faces(plan, options, mesh);
}

} // namespace
} // namespace detail

template <typename T, typename S>
MeshPlan<T> plan_mesh(std::span<const ControlNets<S>> nets, const MeshOptions& options) noexcept {
  const detail::DefaultFpEnvironment environment;
  return detail::attempt(&MeshPlan<T>::fault_patch, [&](MeshPlan<T>& plan) {
    return detail::MeshPlanner<T, S>(nets, options, plan).run();
  });
}

template <typename T, typename S>
Mesh<T> tessellate(std::span<const ControlNets<S>> nets, const MeshOptions& options) noexcept {
  const detail::DefaultFpEnvironment environment; // comparisons would lose tiny deviations
  return detail::attempt(&Mesh<T>::fault_patch, [&](Mesh<T>& mesh) {
    const MeshPlan<T> plan = plan_mesh<T>(nets, options);
    mesh.fault_patch = plan.fault_patch;
    return plan ? detail::fill_mesh(plan, options, detail::patches_of(nets), mesh) : plan.status;
  });
}

#define SIMDBEZIER_INSTANTIATE(T, S)                                                               \
  template SIMDBEZIER_API MeshPlan<T> plan_mesh<T, S>(std::span<const ControlNets<S>>,             \
                                                      const MeshOptions&) noexcept;                \
  template SIMDBEZIER_API Mesh<T> tessellate<T, S>(std::span<const ControlNets<S>>,                \
                                                   const MeshOptions&) noexcept;
SIMDBEZIER_INSTANTIATE(float, float)
SIMDBEZIER_INSTANTIATE(float, double)
SIMDBEZIER_INSTANTIATE(double, float)
SIMDBEZIER_INSTANTIATE(double, double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
