// The sides of usual patches: rates from 2 to 63, and vertices whose numbers follow each other.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/primitives/union_places.hpp"

namespace simdbezier::detail {

/// A side whose inner vertices have numbers one after the other.
struct LinearSide {
  std::uint32_t zero = 0; ///< the number that point 0 would have if it were not a corner
  std::uint32_t step = 0; ///< 1 or -1
  std::uint32_t segments = 0;
  std::uint32_t end[2] = {0, 0};         ///< the corners
  const std::uint32_t* places = nullptr; ///< of the patch's own points

  [[nodiscard]] std::uint32_t at(std::uint32_t place) const noexcept { return zero + place * step; }
};

/// The sides of one patch after the other.
class LinearSides {
public:
  explicit LinearSides(const MeshData& mesh) : mesh_(mesh), topology_(*mesh.topology.data()) {}

  /// False where the patch is not a usual one.
  bool move_to(std::size_t patch) {
    const auto usual = [](std::uint32_t rate) { return rate >= 2 && rate <= UnionPlaces::kMost; };
    if (!usual(mesh_.nu[patch]) || !usual(mesh_.nv[patch])) {
      return false;
    }
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      if (!read(kPatchEdges * patch + k, sides_[k])) {
        return false;
      }
    }
    return !is_folded(patch);
  }
  [[nodiscard]] const LinearSide& operator[](std::size_t side) const { return sides_[side]; }

private:
  /// Whether two sides that meet are one edge: cells between them have vertices twice.
  [[nodiscard]] bool is_folded(std::size_t patch) const {
    const Side* const side = &topology_.sides[kPatchEdges * patch];
    const auto same = [&](std::size_t a, std::size_t b) {
      return side[a].edge() == side[b].edge();
    };
    return same(0, 2) || same(0, 3) || same(1, 2) || same(1, 3);
  }
  bool read(std::size_t number, LinearSide& to) {
    const Side side = topology_.sides[number];
    if (side.collapsed() || mesh_.is_split(number)) {
      return false;
    }
    const auto all = topology_.sides_of(side.edge());
    const std::uint32_t rate = mesh_.rate(number);
    const std::uint32_t other = all.size() == 1 ? rate : mesh_.rate(all[all[0] == number ? 1 : 0]);
    if (all.size() > 2 || other > UnionPlaces::kMost) {
      return false;
    }
    to.segments = mesh_.segments[side.edge()];
    to.step = side.reversed() ? ~0U : 1;
    to.zero = mesh_.edge_first[side.edge()] + (side.reversed() ? to.segments - 1 : ~0U);
    to.end[0] = mesh_.corners[corner_at(number, 0)];
    to.end[1] = mesh_.corners[corner_at(number, 1)];
    to.places = places_.of(rate, other);
    return true;
  }

  const MeshData& mesh_;
  const TopologyData& topology_;
  LinearSide sides_[kPatchEdges];
  UnionPlaces places_;
};

} // namespace simdbezier::detail
