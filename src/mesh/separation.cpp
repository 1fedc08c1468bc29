// Rates so small that edges of the mesh would coincide; see mesh_layout.hpp.
#include <algorithm>
#include <new>
#include <vector>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/layout_builder.hpp"
#include "src/mesh/primitive_sinks.hpp"
#include "src/mesh/topology_data.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// An edge that a mesh may have: where it is, and the two vertices that it joins. Two edges in
/// different places must not join the same two.
struct MeshEdge {
  std::uint64_t vertices;
  std::uint64_t place; ///< a segment of an edge, or two points of one patch
  std::uint32_t patch;

  friend auto operator<=>(const MeshEdge&, const MeshEdge&) = default;
};

std::uint64_t pair_of(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// The edges of one patch after the other.
class PatchEdges {
public:
  PatchEdges(MeshData& mesh, PatchBoundary& boundary) : mesh_(mesh), boundary_(boundary) {}

  void append(std::uint32_t patch, std::vector<MeshEdge>& edges) {
    boundary_.move_to(patch);
    add_segments(patch, edges);
    points_.clear();
    boundary_.number_locally(vertices_);
    const auto boundary_points = static_cast<std::uint32_t>(vertices_.size());
    const std::uint32_t inner = mesh_.inner[patch];
    mesh_.inner[patch] = boundary_points;
    for (std::uint32_t k = 0; k < (mesh_.nu[patch] - 1) * (mesh_.nv[patch] - 1); ++k) {
      vertices_.push_back(inner + k);
    }
    for (const std::uint16_t diagonals : {std::uint16_t{0}, kAllFalling}) {
      mesh_.diagonals[patch] = diagonals;
      add_points(patch);
    }
    mesh_.inner[patch] = inner;
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    for (const std::uint64_t ends : points_) {
      const auto a = static_cast<std::uint32_t>(ends >> 32);
      const auto b = static_cast<std::uint32_t>(ends);
      if (boundary_.is_segment(a, b)) {
        continue;
      }
      const bool inside = std::max(a, b) >= boundary_points;
      (inside ? inside_ : edges)
          .push_back({pair_of(vertices_[a], vertices_[b]), place_of(patch, ends), patch});
    }
    move_coinciding(edges);
  }

private:
  static constexpr std::uint16_t kAllFalling = 0x1ff;
  static constexpr std::uint64_t kInside = std::uint64_t{1} << 63;

  /// Points of patches in doubt are few: some thousands a patch at the most.
  static std::uint64_t place_of(std::uint32_t patch, std::uint64_t ends) {
    return kInside | std::uint64_t{patch} << 34 | (ends >> 32 & 0x1ffff) << 17 | (ends & 0x1ffff);
  }

  void add_segments(std::uint32_t patch, std::vector<MeshEdge>& edges) const {
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      const Side& side = mesh_.topology.data()->sides[kPatchEdges * patch + k];
      if (side.collapsed()) {
        continue;
      }
      const auto chain = boundary_.chain(k);
      for (std::size_t s = 0; s + 1 < chain.size(); ++s) {
        const std::size_t segment = side.reversed() ? chain.size() - 2 - s : s;
        edges.push_back(
            {pair_of(chain[s], chain[s + 1]), std::uint64_t{side.edge()} << 20 | segment, patch});
      }
    }
  }

  /// No other patch has edges to a patch's inner points, which are most of all edges, so only those
  /// that coincide with others of their own patch go on to be compared.
  void move_coinciding(std::vector<MeshEdge>& edges) {
    std::sort(inside_.begin(), inside_.end());
    for (std::size_t k = 0; k < inside_.size(); ++k) {
      const auto joins_same = [&](std::size_t other) {
        return other < inside_.size() && inside_[other].vertices == inside_[k].vertices;
      };
      if (joins_same(k + 1) || (k > 0 && joins_same(k - 1))) {
        edges.push_back(inside_[k]);
      }
    }
    inside_.clear();
  }

  /// The edges of all triangles, by points of the patch.
  void add_points(std::uint32_t patch) {
    triangles_.resize(3 * (mesh_.triangles[patch + 1] - mesh_.triangles[patch]) + 64);
    TriangleSink<std::uint32_t> sink(triangles_.data(), false);
    CellCutter(mesh_, boundary_, patch).cut(sink);
    for (const std::uint32_t* t = triangles_.data(); t != sink.end(); t += 3) {
      points_.push_back(pair_of(t[0], t[1]));
      points_.push_back(pair_of(t[1], t[2]));
      points_.push_back(pair_of(t[2], t[0]));
    }
  }

  MeshData& mesh_;
  PatchBoundary& boundary_;
  std::vector<std::uint32_t> vertices_; ///< of the patch's points
  std::vector<std::uint32_t> triangles_;
  std::vector<std::uint64_t> points_; ///< two of a patch, joined
  std::vector<MeshEdge> inside_;      ///< edges to inner points
};

class Separation {
public:
  Separation(const Topology& topology, std::span<std::uint32_t> nu, std::span<std::uint32_t> nv)
      : topology_(topology), data_(*topology.data()), nu_(nu), nv_(nv), raised_(nu.size()) {}

  std::size_t run() {
    raise_torn_cells();
    raise_between_points();
    raise_loops();
    // More cells take vertices apart; what is not apart then never will be, such as a patch whose
    // neighbouring sides are one edge.
    constexpr int kRounds = 6;
    for (int round = 0; round < kRounds && raise_coinciding(); ++round) {
    }
    return static_cast<std::size_t>(std::count(raised_.begin(), raised_.end(), true));
  }

private:
  void raise(std::size_t patch, bool in_u, std::uint32_t least) {
    std::uint32_t& n = (in_u ? nu_ : nv_)[patch];
    if (n < least && least <= kMostSegments) {
      n = least;
      raised_[patch] = true;
    }
  }

  /// Two corners in one cell that want its diagonal in both ways.
  void raise_torn_cells() {
    for (std::size_t patch = 0; patch < nu_.size(); ++patch) {
      const std::uint8_t flags = data_.flags[patch];
      for (std::size_t a = 0; a < kPatchCorners; ++a) {
        for (std::size_t b = a + 1; b < kPatchCorners; ++b) {
          const bool both = is_forced_through(flags, a) && is_forced_through(flags, b);
          const bool apart_u = (a & 1) != (b & 1);
          const bool apart_v = (a & 2) != (b & 2);
          if (both && falls(a) != falls(b) && (!apart_u || nu_[patch] == 1) &&
              (!apart_v || nv_[patch] == 1)) {
            raise(patch, apart_u, 2);
          }
        }
      }
    }
  }

  /// Opposite sides that are points have a row of vertices between them.
  void raise_between_points() {
    for (std::size_t patch = 0; patch < nu_.size(); ++patch) {
      const Side* const sides = &data_.sides[kPatchEdges * patch];
      if (sides[0].collapsed() && sides[1].collapsed()) {
        raise(patch, false, 2);
      }
      if (sides[2].collapsed() && sides[3].collapsed()) {
        raise(patch, true, 2);
      }
    }
  }

  /// Edges that end where they begin without being points: as one segment they would be no line.
  void raise_loops() {
    for (const std::uint32_t side : data_.loops) {
      raise(side / kPatchEdges, runs_in_u(side), 2);
    }
  }

  /// Whether edges of its mesh may coincide with others.
  [[nodiscard]] bool in_doubt(std::size_t patch) const {
    constexpr std::uint32_t kFewCells = 8;
    return (data_.flags[patch] & kEntangled) != 0 && std::min(nu_[patch], nv_[patch]) <= kFewCells;
  }

  /// All edges of patches in doubt, with either diagonal: which ones there will be is not known
  /// yet.
  [[nodiscard]] std::vector<MeshEdge> edges_in_doubt() const {
    std::vector<MeshEdge> edges;
    bool any = false;
    for (std::size_t patch = 0; patch < nu_.size() && !any; ++patch) {
      any = in_doubt(patch);
    }
    MeshData mesh;
    if (!any || build_layout(topology_, {nu_, nv_, {}}, mesh) != Status::ok) {
      return edges; // of nothing, or too many vertices, which is for the layout to say
    }
    PatchBoundary boundary(mesh);
    PatchEdges own(mesh, boundary);
    for (std::uint32_t patch = 0; patch < nu_.size(); ++patch) {
      if (in_doubt(patch)) {
        own.append(patch, edges);
      }
    }
    return edges;
  }

  /// Raises both rates of all patches with edges that coincide; whether there were any.
  bool raise_coinciding() {
    std::vector<MeshEdge> edges = edges_in_doubt();
    std::sort(edges.begin(), edges.end());
    bool any = false;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      bool coincide = edges[begin].vertices >> 32 == (edges[begin].vertices & 0xffffffff);
      for (end = begin; end < edges.size() && edges[end].vertices == edges[begin].vertices; ++end) {
        coincide = coincide || edges[end].place != edges[begin].place;
      }
      for (std::size_t k = begin; k < end && coincide; ++k) {
        doubtful_.push_back(edges[k].patch);
        any = true;
      }
    }
    std::sort(doubtful_.begin(), doubtful_.end());
    doubtful_.erase(std::unique(doubtful_.begin(), doubtful_.end()), doubtful_.end());
    for (const std::uint32_t patch : doubtful_) {
      raise(patch, true, nu_[patch] + 1);
      raise(patch, false, nv_[patch] + 1);
    }
    doubtful_.clear();
    return any;
  }

  const Topology& topology_;
  const TopologyData& data_;
  std::span<std::uint32_t> nu_;
  std::span<std::uint32_t> nv_;
  std::vector<bool> raised_;
  std::vector<std::uint32_t> doubtful_;
};

} // namespace
} // namespace detail

Status separate_vertices(const Topology& topology, std::span<std::uint32_t> nu,
                         std::span<std::uint32_t> nv, std::size_t& raised) noexcept try {
  if (!detail::are_rates(topology, nu) || !detail::are_rates(topology, nv)) {
    return Status::bad_rates;
  }
  raised = topology.data() == nullptr ? 0 : detail::Separation(topology, nu, nv).run();
  return Status::ok;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

} // namespace simdbezier
