// Numbers the edges of a model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/topology/topology_data.hpp"
#include "src/nets/edge_rings.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/fresh_vector.hpp"

namespace simdbezier::detail {

/// Numbers edges in the order of their first sides, and tells every side which way it runs.
class EdgeNumbers {
public:
  /// shares: of the patches.
  EdgeNumbers(const EdgeRings& rings, const Shares& shares, TopologyData& topology)
      : rings_(rings), shares_(shares), topology_(topology), found_(shares.count()),
        marks_(rings.next.size() + kApart * shares.count()), firsts_(rings.next.size()) {
    topology.sides.resize(rings.next.size());
  }

  void run() {
    shares_.run([this](std::size_t share) { mark_firsts(share); });
    shares_.run([this](std::size_t share) { list_firsts(share); });
    Share all;
    for (Share& share : found_) {
      share.first_edge = all.edges;
      share.first_member = all.members;
      all.edges += share.edges;
      all.members += share.members;
      topology_.counts.collapsed_sides += share.collapsed;
    }
    topology_.first.resize(all.edges + 1);
    topology_.members.resize(rings_.next.size() - topology_.counts.collapsed_sides);
    shares_.run([this](std::size_t share) { write(share); });
    topology_.first[all.edges] = static_cast<std::uint32_t>(topology_.members.size());
    topology_.counts.edges = all.edges;
    for (const Share& share : found_) {
      topology_.counts.open_edges += share.open;
      topology_.counts.non_manifold_edges += share.non_manifold;
    }
  }

private:
  /// Bytes between those that several threads write.
  static constexpr std::size_t kApart = 64;

  /// What a share has of its own: edges whose first sides are in it.
  struct Share {
    std::size_t edges = 0;
    std::size_t members = 0; ///< sides of these edges; counted where there are more shares than one
    std::size_t first_edge = 0;
    std::size_t first_member = 0;
    std::size_t collapsed = 0;
    std::size_t open = 0;
    std::size_t non_manifold = 0;
  };

  [[nodiscard]] std::size_t first_side(std::size_t share) const {
    return kPatchEdges * shares_.begin(share);
  }
  [[nodiscard]] std::span<const std::uint32_t> firsts_of(std::size_t share) const {
    return std::span(firsts_).subspan(first_side(share), found_[share].edges);
  }

  /// Which sides are the last ones of their rings, which lead back to the first ones, follows no
  /// rule, so that branches would take longer than marks for nobody, behind all sides.
  void mark_firsts(std::size_t share) {
    const std::uint32_t* const next = rings_.next.data();
    const std::size_t nobody = rings_.next.size() + kApart * share;
    for (std::size_t side = first_side(share); side < first_side(share + 1); ++side) {
      marks_[next[side] <= side ? next[side] : nobody] = 1;
    }
  }
  void list_firsts(std::size_t share) {
    Share& found = found_[share];
    std::uint32_t* const firsts = firsts_.data() + first_side(share);
    std::size_t count = 0;
    for (std::size_t side = first_side(share); side < first_side(share + 1); ++side) {
      firsts[count] = static_cast<std::uint32_t>(side);
      count += marks_[side];
      if (rings_.is_point(side)) {
        topology_.sides[side] = Side::point();
        ++found.collapsed;
      }
    }
    found.edges = count;
    if (shares_.count() > 1) {
      for (const std::uint32_t first : firsts_of(share)) {
        for_ring(first, [&](auto) { ++found.members; });
      }
    }
  }
  void write(std::size_t share) {
    Share& found = found_[share];
    auto edge = static_cast<std::uint32_t>(found.first_edge);
    auto end = static_cast<std::uint32_t>(found.first_member);
    for (const std::uint32_t first : firsts_of(share)) {
      const std::uint32_t begin = end;
      topology_.first[edge] = begin;
      for_ring(first, [&](std::uint32_t side) {
        topology_.members[end++] = side;
        topology_.sides[side] = Side(edge, rings_.turned[side] != rings_.turned[first]);
      });
      found.open += end - begin == 1 ? 1 : 0;
      found.non_manifold += end - begin > 2 ? 1 : 0;
      ++edge;
    }
  }
  template <typename Visit>
  void for_ring(std::uint32_t first, const Visit& visit) const {
    std::uint32_t side = first;
    do {
      visit(side);
      side = rings_.next[side];
    } while (side != first);
  }

  const EdgeRings& rings_;
  const Shares& shares_;
  TopologyData& topology_;
  std::vector<Share> found_;
  std::vector<std::uint8_t> marks_;   ///< of each side: whether it is the first one of its ring
  FreshVector<std::uint32_t> firsts_; ///< those of a share from its first side's place on
};

} // namespace simdbezier::detail
