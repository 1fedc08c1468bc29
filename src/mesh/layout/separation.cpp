// Raises rates so small that edges of the mesh would coincide; see mesh_layout.hpp.
#include <algorithm>
#include <new>
#include <vector>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/layout/layout_builder.hpp"
#include "src/mesh/layout/patch_edges.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier {
namespace detail {
namespace {

class Separation {
public:
  Separation(const Topology& topology, std::span<std::uint32_t> nu, std::span<std::uint32_t> nv)
      : topology_(topology), data_(*topology.data()), nu_(nu), nv_(nv), given_(copy()) {}

  std::size_t run() {
    raise_torn_cells();
    raise_between_points();
    raise_loops();
    // More cells take vertices apart; what a few rounds do not separate, no round will.
    constexpr int kRounds = 6;
    for (int round = 0; round < kRounds && raise_coinciding(); ++round) {
    }
    std::size_t raised = 0;
    for (std::size_t patch = 0; patch < nu_.size(); ++patch) {
      raised += nu_[patch] != given_.nu[patch] || nv_[patch] != given_.nv[patch] ? 1 : 0;
    }
    return raised;
  }

private:
  struct Rates {
    std::vector<std::uint32_t> nu;
    std::vector<std::uint32_t> nv;
  };
  [[nodiscard]] Rates copy() const { return {{nu_.begin(), nu_.end()}, {nv_.begin(), nv_.end()}}; }
  void raise(std::size_t patch, bool in_u, std::uint32_t least) {
    std::uint32_t& n = (in_u ? nu_ : nv_)[patch];
    if (n < least && least <= kMostSegments) {
      n = least;
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

  /// Opposite sides that are points have a row of vertices between them. Where a third side is a
  /// point they are one and the same, and a single row would have two edges from each of its
  /// vertices to it; where all four are, there would be no triangles.
  void raise_between_points() {
    for (std::size_t patch = 0; patch < nu_.size(); ++patch) {
      const Side* const sides = &data_.sides[kPatchEdges * patch];
      const bool in_v = sides[0].collapsed() && sides[1].collapsed();
      const bool in_u = sides[2].collapsed() && sides[3].collapsed();
      const auto points = std::count_if(sides, sides + kPatchEdges,
                                        [](const Side& side) { return side.collapsed(); });
      if (in_v) {
        raise(patch, false, points > 2 ? 3 : 2);
      }
      if (in_u) {
        raise(patch, true, points > 2 ? 3 : 2);
      }
    }
  }

  /// Edges that end where they begin without being points: a single segment would have no length.
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

  /// What of patches in doubt may coincide.
  struct Doubts {
    std::vector<MeshEdge> edges; ///< with either diagonal: which it will be is not known yet
    std::vector<OnlyTriangle> triangles;
  };
  [[nodiscard]] Doubts find_doubts() const {
    Doubts doubts;
    bool any = false;
    for (std::size_t patch = 0; patch < nu_.size() && !any; ++patch) {
      any = in_doubt(patch);
    }
    MeshData mesh;
    if (!any || build_layout(topology_, {nu_, nv_, {}}, mesh) != Status::ok) {
      return doubts; // nothing, or too many vertices, which the layout will report
    }
    PatchBoundary boundary(mesh);
    PatchEdges own(mesh, boundary);
    for (std::uint32_t patch = 0; patch < nu_.size(); ++patch) {
      if (in_doubt(patch)) {
        own.append(patch, doubts.triangles);
        own.append(patch, doubts.edges);
      }
    }
    return doubts;
  }

  /// Whether two neighbouring sides are one edge, folded at their corner: the cell there has one
  /// vertex at two of its corners, however many cells there are.
  [[nodiscard]] bool has_equal_sides(std::size_t patch) const {
    const Side* const sides = &data_.sides[kPatchEdges * patch];
    for (std::size_t k = 0; k < kPatchCorners; ++k) {
      const std::size_t in_u = k / 2;
      const std::size_t in_v = k % 2;
      const Side& a = sides[in_u];
      const Side& b = sides[2 + in_v];
      if (!a.collapsed() && !b.collapsed() && a.edge() == b.edge() &&
          (in_v != (a.reversed() ? 1U : 0U)) == (in_u != (b.reversed() ? 1U : 0U))) {
        return true;
      }
    }
    return false;
  }

  /// Calls visit(those) for all that have the same vertices.
  template <typename Value, typename Visit>
  static void for_same_vertices(std::vector<Value>& all, const Visit& visit) {
    sort_range(all.begin(), all.end());
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      while (end < all.size() && all[end].vertices == all[begin].vertices) {
        ++end;
      }
      visit(std::span(all).subspan(begin, end - begin));
    }
  }

  /// Raises both rates of all patches with edges or triangles that coincide, where that helps;
  /// returns whether there were any.
  bool raise_coinciding() {
    doubtful_.clear();
    Doubts doubts = find_doubts();
    for_same_vertices(doubts.edges, [this](std::span<MeshEdge> same) { add_coinciding(same); });
    for_same_vertices(doubts.triangles,
                      [this](std::span<OnlyTriangle> same) { add_coinciding(same); });
    sort_range(doubtful_.begin(), doubtful_.end());
    doubtful_.erase(std::unique(doubtful_.begin(), doubtful_.end()), doubtful_.end());
    std::erase_if(doubtful_, [&](std::uint32_t patch) { return has_equal_sides(patch); });
    for (const std::uint32_t patch : doubtful_) {
      raise(patch, true, nu_[patch] + 1);
      raise(patch, false, nv_[patch] + 1);
    }
    return !doubtful_.empty();
  }

  /// Adds the edges that join the same two vertices. Edges of a patch and of its repetitions lie in
  /// one place, whatever their numbers, so among these only edges of one patch are compared.
  void add_coinciding(std::span<MeshEdge> same) {
    const auto model = [&](const MeshEdge& edge) { return data_.original_of(edge.patch); };
    const auto differs_from_first = [&](const auto& value) {
      return std::any_of(same.begin(), same.end(),
                         [&](const MeshEdge& edge) { return value(edge) != value(same.front()); });
    };
    const bool point = same.front().vertices >> 32 == (same.front().vertices & 0xffffffff);
    const bool places = differs_from_first([](const MeshEdge& edge) { return edge.place; });
    if (point || (places && differs_from_first(model))) {
      for (const MeshEdge& edge : same) {
        doubtful_.push_back(edge.patch);
      }
    } else if (places) {
      sort_range(same.begin(), same.end(), [](const MeshEdge& a, const MeshEdge& b) {
        return a.patch != b.patch ? a.patch < b.patch : a.place < b.place;
      });
      for (std::size_t k = 1; k < same.size(); ++k) {
        if (same[k].patch == same[k - 1].patch && same[k].place != same[k - 1].place) {
          doubtful_.push_back(same[k].patch);
        }
      }
    }
  }

  /// Adds the patches that consist of the same triangle, unless one repeats the other.
  void add_coinciding(std::span<const OnlyTriangle> same) {
    const auto model = [&](const OnlyTriangle& one) { return data_.original_of(one.patch); };
    if (std::any_of(same.begin(), same.end(),
                    [&](const OnlyTriangle& one) { return model(one) != model(same.front()); })) {
      for (const OnlyTriangle& one : same) {
        doubtful_.push_back(one.patch);
      }
    }
  }

  const Topology& topology_;
  const TopologyData& data_;
  std::span<std::uint32_t> nu_;
  std::span<std::uint32_t> nv_;
  Rates given_;
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
