// See mesh_layout.hpp.
#include <simdbezier/mesh_layout.hpp>

#include <limits>
#include <new>

#include "src/mesh/layout/cells.hpp"
#include "src/mesh/layout/layout_builder.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Vertices are counted in 64 bits and have to fit 32, without the largest number.
constexpr std::uint64_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

constexpr std::size_t kManySides = 8;

void count_segments(const TopologyData& topology, MeshData& mesh) {
  EdgeRates rates;
  std::vector<std::uint32_t> scratch;
  mesh.segments.resize(topology.edges());
  bool has_unions = false;
  for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
    const auto sides = topology.sides_of(edge);
    if (sides.size() <= 2) {
      mesh.segments[edge] = segments_of(mesh.rate(sides.front()), mesh.rate(sides.back()));
    } else {
      mesh.rates_of(edge, rates);
      if (sides.size() > kManySides) {
        mesh.crowded_edges.push_back({edge, rates});
      }
      mesh.segments[edge] = union_segments(rates, scratch);
    }
    mesh.most_segments = std::max(mesh.most_segments, mesh.segments[edge]);
    const std::uint32_t most = mesh.segments[edge];
    has_unions |= most != mesh.rate(sides.front()) || most != mesh.rate(sides.back());
  }
  mesh.has_unions = has_unions;
}

/// The triangles of a patch: two a cell, one more for every vertex that its sides have besides its
/// own ones, and one less for every cell at a side that is a point. Where that is less than
/// none, all points of the patch are one vertex, and it has no triangle.
std::uint64_t triangles_of(const TopologyData& topology, const MeshData& mesh, std::size_t patch) {
  std::int64_t triangles = 2 * std::int64_t{mesh.nu[patch]} * mesh.nv[patch];
  for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
    const Side& own = topology.sides[side];
    triangles += own.collapsed() ? 0 : std::int64_t{mesh.segments[own.edge()]};
    triangles -= mesh.rate(side);
  }
  return static_cast<std::uint64_t>(std::max<std::int64_t>(triangles, 0));
}

/// Counts what the cells of a patch become.
struct TriangleCounter {
  std::uint64_t triangles = 0;

  void triangle(std::uint32_t, std::uint32_t, std::uint32_t) { ++triangles; }
  void cell(const CellCorners&, bool) { triangles += 2; }
  void cells(const CellCorners&, const VertexSteps&, std::uint32_t count, bool) {
    triangles += 2 * std::uint64_t{count};
  }
};

/// Patches that touch themselves may have cells with one vertex twice, so that they have fewer
/// triangles than triangles_of() says. Of all patches that may be such, they are counted.
void count_entangled(const TopologyData& topology, MeshData& mesh) {
  PatchBoundary boundary(mesh);
  std::uint64_t counted = 0; // without correction
  for (std::size_t patch = 0; patch < topology.patches(); ++patch) {
    std::uint64_t triangles = mesh.triangles[patch + 1] - counted;
    counted = mesh.triangles[patch + 1];
    if ((topology.flags[patch] & kEntangled) != 0) {
      TriangleCounter counter;
      boundary.move_to(patch);
      CellCutter(mesh, boundary, patch).cut(counter);
      triangles = counter.triangles;
    }
    mesh.triangles[patch + 1] = mesh.triangles[patch] + triangles;
  }
}

std::size_t boundary_samples(const TopologyData& topology, const MeshData& mesh,
                             std::size_t patch) {
  std::size_t samples = 0;
  for (std::size_t k = kPatchCorners * patch; k < kPatchCorners * (patch + 1); ++k) {
    if (topology.corners[k] == k) {
      topology.for_joined(k, [&](auto) { ++samples; });
    }
  }
  for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
    if (topology.owns_edge(side)) {
      const std::uint32_t edge = topology.sides[side].edge();
      samples += topology.sides_of(edge).size() * (mesh.segments[edge] - 1);
    }
  }
  return samples;
}

/// The vertices of an edge's points, from `vertices` on; returns the next free one.
std::uint64_t number_edge(std::uint32_t edge, std::uint64_t vertices, MeshData& mesh) {
  const auto sides = mesh.topology.data()->sides_of(edge);
  const std::uint32_t points = mesh.segments[edge] - 1;
  mesh.edge_first[edge] = static_cast<std::uint32_t>(vertices);
  if (!mesh.is_split(sides[0])) {
    return vertices + points;
  }
  for (std::uint32_t k = 0; k < points; ++k) {
    std::uint32_t groups = 0;
    for (const std::uint32_t side : sides) {
      std::uint32_t& vertex = mesh.side_vertices[mesh.side_first[side] + k];
      groups = std::max(groups, vertex + 1);
      vertex += static_cast<std::uint32_t>(vertices);
    }
    vertices += groups;
  }
  return vertices;
}

} // namespace

Status number_vertices(std::span<const std::uint32_t> corner_groups, MeshData& mesh) {
  const TopologyData& topology = *mesh.topology.data();
  mesh.corners.resize(topology.corners.size());
  mesh.edge_first.resize(topology.edges());
  mesh.inner.resize(topology.patches());
  mesh.triangles.resize(topology.patches() + 1);
  std::uint64_t vertices = 0;
  for (std::size_t patch = 0; patch < topology.patches(); ++patch) {
    for (std::size_t k = kPatchCorners * patch; k < kPatchCorners * (patch + 1); ++k) {
      if (topology.corners[k] == k) {
        topology.for_joined(k, [&](std::size_t corner) {
          const std::uint32_t lowest = corner_groups[corner];
          mesh.corners[corner] =
              lowest == corner ? static_cast<std::uint32_t>(vertices++) : mesh.corners[lowest];
        });
      }
    }
    for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
      if (topology.owns_edge(side)) {
        vertices = number_edge(topology.sides[side].edge(), vertices, mesh);
      }
    }
    mesh.inner[patch] = static_cast<std::uint32_t>(vertices);
    vertices += mesh.inner_points(patch);
    mesh.triangles[patch + 1] = mesh.triangles[patch] + triangles_of(topology, mesh, patch);
    if (vertices > kMostVertices) {
      return Status::size_overflow;
    }
  }
  mesh.vertices = static_cast<std::uint32_t>(vertices);
  if (std::any_of(topology.flags.begin(), topology.flags.end(),
                  [](std::uint8_t flags) { return (flags & kEntangled) != 0; })) {
    count_entangled(topology, mesh);
  }
  return Status::ok;
}

void measure_boundaries(MeshData& mesh) {
  const TopologyData& topology = *mesh.topology.data();
  mesh.most_boundary_vertices = 0;
  for (std::size_t patch = 0; patch < mesh.patches(); ++patch) {
    mesh.most_boundary_vertices = std::max<std::size_t>(
        mesh.most_boundary_vertices, mesh.inner[patch] - mesh.first_vertex(patch));
    mesh.most_boundary_samples =
        std::max(mesh.most_boundary_samples, boundary_samples(topology, mesh, patch));
  }
  for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
    mesh.most_sides = std::max(mesh.most_sides, topology.sides_of(edge).size());
  }
}

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
  return number_vertices(data.corners, mesh);
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
    detail::measure_boundaries(*mesh);
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

std::size_t MeshLayout::first_vertex(std::size_t patch) const noexcept {
  return data_ == nullptr ? 0 : data_->first_vertex(std::min(patch, data_->patches()));
}

} // namespace simdbezier
