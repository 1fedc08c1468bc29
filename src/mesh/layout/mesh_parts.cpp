// Numbers of vertices in the mesh of a whole model, and of single ones; see mesh_layout.hpp.
#include <simdbezier/mesh_layout.hpp>

#include "src/calls/call.hpp"
#include "src/mesh/layout/layout_builder.hpp"
#include "src/mesh/layout/mesh_data.hpp"

namespace simdbezier {
namespace detail {

bool has_range(const MeshData* mesh, SetRange& patches) noexcept {
  const SetRange given = patches;
  return resolve_range(given, mesh == nullptr ? 0 : mesh->patches(), patches.first, patches.count);
}

namespace {

/// Calls visit(the member of PatchVertices, where its vertices begin) for what a patch owns, in the
/// order of its numbers. Layouts with several vertices in one place number these consecutively.
template <typename Vertices, typename Visit>
void for_owned_vertices(const MeshData& mesh, std::size_t patch, Vertices& vertices,
                        const Visit& visit) {
  const TopologyData& topology = *mesh.topology.data();
  topology.for_owned_corners(patch, [&](std::uint32_t corner) {
    visit(vertices.corners[corner % kPatchCorners], mesh.corners[corner]);
  });
  topology.for_owned_edges(patch, [&](std::uint32_t edge) { // its first side is the owner's
    visit(vertices.edges[topology.sides_of(edge)[0] % kPatchEdges], mesh.edge_first[edge]);
  });
}

} // namespace
} // namespace detail

Status owned_vertices(const MeshLayout& part, SetRange own, std::uint64_t first_vertex,
                      std::span<PatchVertices> out) noexcept {
  const detail::MeshData* const mesh = part.data();
  if (!detail::has_range(mesh, own)) {
    return Status::bad_patch_range;
  }
  if (out.size() < own.count) {
    return Status::output_too_small;
  }
  for (std::size_t p = 0; p < own.count; ++p) {
    const std::uint32_t first = mesh->first_vertex(own.first);
    out[p] = {};
    detail::for_owned_vertices(*mesh, own.first + p, out[p],
                               [&](std::uint64_t& number, std::uint32_t vertex) {
                                 number = first_vertex + (vertex - first);
                               });
  }
  return Status::ok;
}

Status number_part(const MeshLayout& part, SetRange own, std::uint64_t first_vertex,
                   std::span<const PatchVertices> ghosts,
                   std::span<std::uint64_t> numbers) noexcept {
  const detail::MeshData* const mesh = part.data();
  if (!detail::has_range(mesh, own)) {
    return Status::bad_patch_range;
  }
  if (ghosts.size() != own.first) {
    return Status::unequal_lengths;
  }
  const std::size_t before = mesh == nullptr ? 0 : part.first_vertex(own.first);
  const std::size_t all = mesh == nullptr ? 0 : part.first_vertex(own.first + own.count);
  if (numbers.size() < all) {
    return Status::output_too_small;
  }
  for (std::size_t p = 0; p < own.first; ++p) {
    std::uint64_t number = detail::MeshData::kWhole; // of the vertices that begin at `next`
    std::size_t next = mesh->first_vertex(p);
    const auto fill_to = [&](std::size_t end) {
      for (; next < end; ++next) {
        numbers[next] = number == kUnknownVertex ? kUnknownVertex : number++;
      }
    };
    detail::for_owned_vertices(*mesh, p, ghosts[p], [&](std::uint64_t told, std::uint32_t vertex) {
      fill_to(vertex);
      number = told;
    });
    fill_to(mesh->inner[p]);
    number = kUnknownVertex;
    fill_to(mesh->first_vertex(p + 1));
  }
  for (std::size_t vertex = before; vertex < all; ++vertex) {
    numbers[vertex] = first_vertex + (vertex - before);
  }
  return Status::ok;
}

std::uint32_t MeshLayout::corner(std::size_t patch, std::size_t corner) const noexcept {
  const bool exists = data_ != nullptr && patch < data_->patches() && corner < 4;
  return exists ? data_->corners[detail::kPatchCorners * patch + corner] : kNoLayoutVertex;
}

std::uint32_t MeshLayout::segments(std::size_t patch, PatchEdge edge) const noexcept {
  const std::size_t side = kPatchEdges * patch + static_cast<std::size_t>(edge);
  if (data_ == nullptr || patch >= data_->patches() || side / kPatchEdges != patch) {
    return 0;
  }
  const detail::Side& own = data_->topology.data()->sides[side];
  return own.collapsed() ? 0 : data_->segments[own.edge()];
}

std::uint32_t MeshLayout::along(std::size_t patch, PatchEdge edge, std::uint32_t k) const noexcept {
  const std::uint32_t all = segments(patch, edge);
  if (data_ == nullptr || patch >= data_->patches() || k > all) {
    return kNoLayoutVertex;
  }
  const std::size_t side = kPatchEdges * patch + static_cast<std::size_t>(edge);
  if (k == 0 || k == all) {
    return data_->corners[detail::corner_at(side, k == 0 ? 0 : 1)];
  }
  return data_->edge_vertex(side, data_->topology.data()->sides[side].reversed() ? all - k : k);
}

std::uint32_t MeshLayout::inner(std::size_t patch, std::uint32_t i,
                                std::uint32_t j) const noexcept {
  const bool exists = data_ != nullptr && patch < data_->patches() && i > 0 && j > 0 &&
                      i < data_->nu[patch] && j < data_->nv[patch];
  return exists ? data_->inner[patch] + (j - 1) * (data_->nu[patch] - 1) + (i - 1)
                : kNoLayoutVertex;
}

} // namespace simdbezier
