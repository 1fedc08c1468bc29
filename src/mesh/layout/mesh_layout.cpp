#include <simdbezier/mesh_layout.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

#include "src/mesh/layout/cells.hpp"
#include "src/mesh/layout/edge_union.hpp"
#include "src/mesh/layout/layout_builder.hpp"
#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/layout/vertex_numbers.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Vertices are counted in 64 bits and have to fit 32, without the largest number.
constexpr std::uint64_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

/// Counts the segments of all edges. Those of more sides than two are few, as a rule, and have
/// lists of rates: one thread counts them, after all others.
class SegmentCounts {
public:
  SegmentCounts(const TopologyData& topology, MeshData& mesh, int threads)
      : topology_(topology), mesh_(mesh), shares_(topology.edges(), kNanoseconds, threads),
        found_(shares_.count()) {}

  void run() {
    mesh_.segments.resize(topology_.edges());
    shares_.run([this](std::size_t share) { count(share); });
    Share all;
    for (const Share& share : found_) {
      all.most = std::max(all.most, share.most);
      all.unions |= share.unions;
      all.sides = std::max(all.sides, share.sides);
    }
    if (all.sides > 2) {
      count_crowds(all);
    }
    mesh_.most_sides = all.sides;
    mesh_.most_segments = all.most;
    mesh_.has_unions = all.unions;
  }

private:
  static constexpr std::size_t kNanoseconds = 8; ///< an edge
  static constexpr std::size_t kManySides = 8;

  struct Share {
    std::uint32_t most = 0; ///< segments
    bool unions = false;    ///< whether an edge has points that one of its sides has not
    std::size_t sides = 1;  ///< of the edge that has the most
  };

  void count(std::size_t share) {
    Share found;
    for (std::size_t edge = shares_.begin(share); edge < shares_.end(share); ++edge) {
      const auto sides = topology_.sides_of(edge);
      found.sides = std::max(found.sides, sides.size());
      if (sides.size() <= 2) {
        put(edge, segments_of(mesh_.rate(sides.front()), mesh_.rate(sides.back())), found);
      }
    }
    found_[share] = found;
  }
  void count_crowds(Share& found) {
    EdgeRates rates;
    std::vector<std::uint32_t> scratch;
    for (std::size_t edge = 0; edge < topology_.edges(); ++edge) {
      const std::size_t sides = topology_.sides_of(edge).size();
      if (sides > 2) {
        mesh_.rates_of(edge, rates);
        if (sides > kManySides) {
          mesh_.crowded_edges.push_back({edge, rates});
        }
        put(edge, union_segments(rates, scratch), found);
      }
    }
  }
  void put(std::size_t edge, std::uint32_t segments, Share& found) {
    const auto sides = topology_.sides_of(edge);
    mesh_.segments[edge] = segments;
    found.most = std::max(found.most, segments);
    found.unions |= segments != mesh_.rate(sides.front()) || segments != mesh_.rate(sides.back());
  }

  const TopologyData& topology_;
  MeshData& mesh_;
  Shares shares_;
  std::vector<Share> found_;
};

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
