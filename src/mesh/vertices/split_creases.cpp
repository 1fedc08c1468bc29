// See evaluate_mesh.hpp: which vertices are split into several.
#include <new>

#include <simdbezier/evaluate_mesh.hpp>

#include "src/calls/call.hpp"
#include "src/choice/measured_call.hpp"
#include "src/mesh/layout/layout_builder.hpp"
#include "src/mesh/radians.hpp"
#include "src/mesh/vertices/crease_groups.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Units are patches: each thread looks at the corners and edges that its patches own.
template <typename T>
class CreaseWork {
public:
  CreaseWork(const MeshData& mesh, const PatchKernels<T>& kernels, double angle,
             CreaseGroups& groups, std::uint32_t* sample_of_corner) noexcept
      : mesh_(mesh), kernels_(kernels), angle_(angle), groups_(groups),
        sample_of_corner_(sample_of_corner) {}

  [[nodiscard]] std::size_t units() const noexcept { return mesh_.patches(); }
  [[nodiscard]] std::size_t duration() const noexcept { return duration_of(units(), 500); }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return BoundarySamples<T>::bytes(mesh_);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    BoundarySamples<T> samples(mesh_, kernels_, 0, true, true, scratch);
    const CreaseFinder<T> finder(mesh_, angle_, groups_);
    const TopologyData& topology = *mesh_.topology.data();
    for (std::size_t patch = begin; patch < end; ++patch) {
      samples.grids().count_patch();
      topology.for_owned_corners(patch, [&](std::uint32_t corner) {
        finder.group(samples.joined(corner), sample_of_corner_);
      });
      topology.for_owned_edges(patch, [&](std::uint32_t edge) {
        if (mesh_.segments[edge] > 1) {
          finder.group(samples.edge(edge), sample_of_corner_);
        }
      });
    }
    return samples.runner().executed();
  }

private:
  const MeshData& mesh_;
  const PatchKernels<T>& kernels_;
  double angle_;
  CreaseGroups& groups_;
  std::uint32_t* sample_of_corner_;
};

/// Fills groups that are not all apart.
template <typename T>
Status find_groups(const PatchSet<T>& set, const MeshData& whole, double angle,
                   const Request<T>& request, const Options& options, CreaseGroups& groups) {
  std::vector<std::uint32_t> sample_of_corner(groups.corners.size());
  const OutputSelection normals = {Output::normal};
  const PatchKernels<T> kernels(*set.storage(), request, normals, options);
  const CreaseWork<T> work(whole, kernels, angle, groups, sample_of_corner.data());
  return run_work(AnyWork(work), options);
}

/// A layout whose vertices are those of the groups. merged: see MeshData.
Status number_groups(CreaseGroups& groups, const MeshData& whole, const MeshLayout& merged,
                     MeshLayout& split) {
  groups.close(*whole.topology.data(), whole);
  auto mesh = std::make_shared<MeshData>(whole);
  mesh->merged = merged;
  mesh->side_first = std::move(groups.side_first);
  mesh->side_vertices = std::move(groups.side_groups);
  const Status numbered = number_vertices(groups.corners, *mesh);
  if (numbered) {
    split = MeshLayout(std::move(mesh));
  }
  return numbered;
}

template <typename T>
Status split_vertices(const PatchSet<T>& set, const MeshLayout& layout, double angle,
                      const Request<T>& request, const Options& options, MeshLayout& split) {
  const MeshData& whole = layout.data()->normals();
  CreaseGroups groups(whole);
  if (angle == 0) {
    groups.part(*whole.topology.data(), whole);
  } else if (const Status found = find_groups(set, whole, angle, request, options, groups);
             !found) {
    return found;
  }
  MeshLayout creased;
  Status status = number_groups(groups, whole, {}, creased);
  if (status && &whole != layout.data()) { // the layout was split by parameters as well
    status = split_parameters(creased, creased);
  }
  split = status ? creased : split;
  return status;
}

} // namespace
} // namespace detail

Status split_parameters(const MeshLayout& layout, MeshLayout& split) noexcept try {
  if (layout.data() == nullptr || layout.data()->merged.data() != nullptr) {
    split = layout;
    return Status::ok;
  }
  detail::CreaseGroups groups(*layout.data());
  groups.part(*layout.data()->topology.data(), *layout.data());
  return detail::number_groups(groups, *layout.data(), layout, split);
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

template <typename T>
Status split_creases(const PatchSet<T>& set, const MeshLayout& layout, double degrees,
                     MeshLayout& split, const Options& options) noexcept try {
  const detail::DefaultFpEnvironment environment;
  if (!(degrees >= 0)) {
    return Status::bad_tolerance;
  }
  if (set.size() != (layout.data() == nullptr ? 0 : layout.data()->patches())) {
    return Status::unequal_lengths;
  }
  detail::Request<T> request;
  if (const Status status = request.resolve(set, {}, 0, options); !status) {
    return status;
  }
  if (set.empty()) {
    split = layout;
    return Status::ok;
  }
  if (!request.components.space()) {
    return Status::bad_components;
  }
  return detail::split_vertices(set, layout, detail::radians(degrees), request, options, split);
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

SIMDBEZIER_EXPORT_BOTH_TYPES(split_creases);

} // namespace simdbezier
