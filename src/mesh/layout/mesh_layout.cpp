// See mesh_layout.hpp.
#include <simdbezier/mesh_layout.hpp>

#include <algorithm>
#include <limits>
#include <new>

#include "src/mesh/layout/cells.hpp"
#include "src/mesh/layout/layout_builder.hpp"
#include "src/mesh/layout/segment_counts.hpp"
#include "src/mesh/layout/vertex_numbers.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Vertices are counted in 64 bits and have to fit 32, without the largest number.
constexpr std::uint64_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

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

} // namespace

Status number_vertices(std::span<const std::uint32_t> corner_groups, MeshData& mesh, int threads) {
  const TopologyData& topology = *mesh.topology.data();
  const std::uint64_t vertices =
      VertexNumbers(corner_groups, mesh, mesh.side_first.empty() ? threads : 1).run();
  if (vertices > kMostVertices) {
    return Status::size_overflow;
  }
  mesh.vertices = static_cast<std::uint32_t>(vertices);
  if (std::any_of(topology.flags.begin(), topology.flags.end(),
                  [](std::uint8_t flags) { return (flags & kEntangled) != 0; })) {
    count_entangled(topology, mesh);
  }
  return Status::ok;
}

bool are_rates(const Topology& topology, std::span<const std::uint32_t> rates) noexcept {
  return rates.size() == topology.counts().patches &&
         std::all_of(rates.begin(), rates.end(),
                     [](std::uint32_t n) { return n >= 1 && n <= kMostSegments; });
}

Status build_layout(const Topology& topology, const PatchRates& rates, MeshData& mesh,
                    int threads) {
  const TopologyData& data = *topology.data();
  mesh.topology = topology;
  mesh.nu.assign(rates.cells_u.begin(), rates.cells_u.end());
  mesh.nv.assign(rates.cells_v.begin(), rates.cells_v.end());
  mesh.diagonals.assign(rates.diagonals.begin(), rates.diagonals.end());
  mesh.diagonals.resize(data.patches());
  const auto [least, most] = std::minmax_element(mesh.nu.begin(), mesh.nu.end());
  mesh.least_nu = *least;
  mesh.most_nu = *most;
  mesh.most_nv = *std::max_element(mesh.nv.begin(), mesh.nv.end());
  SegmentCounts(data, mesh, threads).run();
  return number_vertices(data.corners, mesh, threads);
}

} // namespace detail

Status lay_out_mesh(const Topology& topology, const PatchRates& rates, MeshLayout& layout,
                    const RunOptions& options) noexcept try {
  const std::size_t patches = topology.counts().patches;
  if (!detail::are_rates(topology, rates.cells_u) || !detail::are_rates(topology, rates.cells_v) ||
      !(rates.diagonals.empty() || rates.diagonals.size() == patches)) {
    return Status::bad_rates;
  }
  if (patches == 0) {
    layout = MeshLayout();
    return Status::ok;
  }
  auto mesh = std::make_shared<detail::MeshData>();
  const Status status = detail::build_layout(topology, rates, *mesh, options.threads);
  if (status == Status::ok) {
    layout = MeshLayout(std::move(mesh));
  }
  return status;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

MeshSize MeshLayout::size() const noexcept {
  return data_ == nullptr ? MeshSize{}
                          : MeshSize{std::size_t{data_->vertices},
                                     static_cast<std::size_t>(data_->triangles.back())};
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
