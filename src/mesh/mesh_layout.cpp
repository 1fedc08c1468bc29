// See mesh_layout.hpp.
#include <simdbezier/mesh_layout.hpp>

#include <limits>
#include <new>

#include "src/mesh/layout_builder.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Vertices are counted in 64 bits and have to fit 32, without the largest number.
constexpr std::uint64_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

void count_segments(const TopologyData& topology, MeshData& mesh) {
  EdgeRates rates;
  std::vector<std::uint32_t> scratch;
  mesh.segments.resize(topology.edges());
  for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
    mesh.rates_of(edge, rates);
    mesh.segments[edge] = union_segments(rates, scratch);
    mesh.most_segments = std::max(mesh.most_segments, mesh.segments[edge]);
  }
}

/// The triangles of a patch: two a cell, one more for every vertex that its sides have besides its
/// own ones, and one less for every cell at a side that is a point.
std::uint64_t triangles_of(const TopologyData& topology, const MeshData& mesh, std::size_t patch) {
  std::uint64_t triangles = 2 * std::uint64_t{mesh.nu[patch]} * mesh.nv[patch];
  for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
    const Side& own = topology.sides[side];
    triangles += own.collapsed() ? 0 : mesh.segments[own.edge()];
    triangles -= mesh.rate(side);
  }
  return triangles;
}

Status number_vertices(const TopologyData& topology, MeshData& mesh) {
  mesh.corners.resize(topology.corners.size());
  mesh.edge_first.resize(topology.edges());
  mesh.inner.resize(topology.patches());
  mesh.triangles.resize(topology.patches() + 1);
  std::uint64_t vertices = 0;
  for (std::size_t patch = 0; patch < topology.patches(); ++patch) {
    for (std::size_t k = kPatchCorners * patch; k < kPatchCorners * (patch + 1); ++k) {
      const std::uint32_t lowest = topology.corners[k];
      mesh.corners[k] = lowest == k ? static_cast<std::uint32_t>(vertices++) : mesh.corners[lowest];
    }
    for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
      const Side& own = topology.sides[side];
      if (!own.collapsed() && topology.sides_of(own.edge())[0] == side) {
        mesh.edge_first[own.edge()] = static_cast<std::uint32_t>(vertices);
        vertices += mesh.segments[own.edge()] - 1;
      }
    }
    mesh.inner[patch] = static_cast<std::uint32_t>(vertices);
    vertices += std::uint64_t{mesh.nu[patch] - 1} * (mesh.nv[patch] - 1);
    mesh.triangles[patch + 1] = mesh.triangles[patch] + triangles_of(topology, mesh, patch);
    if (vertices > kMostVertices) {
      return Status::size_overflow;
    }
  }
  mesh.vertices = static_cast<std::uint32_t>(vertices);
  return Status::ok;
}

} // namespace

bool are_rates(const Topology& topology, std::span<const std::uint32_t> rates) noexcept {
  return rates.size() == topology.counts().patches &&
         std::all_of(rates.begin(), rates.end(),
                     [](std::uint32_t n) { return n >= 1 && n <= kMostSegments; });
}

Status build_layout(const Topology& topology, const PatchRates& rates, MeshData& mesh) {
  const TopologyData& data = *topology.data();
  mesh.topology = topology;
  mesh.nu.assign(rates.nu.begin(), rates.nu.end());
  mesh.nv.assign(rates.nv.begin(), rates.nv.end());
  mesh.diagonals.assign(rates.diagonals.begin(), rates.diagonals.end());
  mesh.diagonals.resize(data.patches());
  count_segments(data, mesh);
  return number_vertices(data, mesh);
}

} // namespace detail

Status lay_out_mesh(const Topology& topology, const PatchRates& rates, MeshLayout& layout) noexcept
    try {
  const std::size_t patches = topology.counts().patches;
  if (!detail::are_rates(topology, rates.nu) || !detail::are_rates(topology, rates.nv) ||
      !(rates.diagonals.empty() || rates.diagonals.size() == patches)) {
    return Status::bad_rates;
  }
  if (patches == 0) {
    layout = MeshLayout();
    return Status::ok;
  }
  auto mesh = std::make_shared<detail::MeshData>();
  const Status status = detail::build_layout(topology, rates, *mesh);
  if (status == Status::ok) {
    layout = MeshLayout(std::move(mesh));
  }
  return status;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

MeshSize MeshLayout::size() const noexcept {
  return data_ == nullptr ? MeshSize{} : MeshSize{data_->vertices, data_->triangles.back()};
}

std::size_t MeshLayout::first_triangle(std::size_t patch) const noexcept {
  if (data_ == nullptr) {
    return 0;
  }
  return data_->triangles[std::min(patch, data_->triangles.size() - 1)];
}

} // namespace simdbezier
