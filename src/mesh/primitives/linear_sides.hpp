// The sides of usual patches, whose vertices have numbers that follow each other. Rates are from 2
// to 63.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "src/mesh/layout/edge_union.hpp"
#include "src/mesh/layout/mesh_data.hpp"

namespace simdbezier::detail {

/// One thread's tables for small rates.
class UnionCounts {
public:
  static constexpr std::uint32_t kMost = 63;

  /// For i = 0 .. rate - 1: the segments from i / rate to (i + 1) / rate on an edge of both rates,
  /// which are from 1 to kMost.
  __attribute__((always_inline)) const std::uint8_t* of(std::uint32_t rate, std::uint32_t other) {
    const std::uint8_t* const pairs = known_[rate].get();
    return pairs != nullptr && pairs[other * rate] != 0 ? pairs + other * rate : add(rate, other);
  }

private:
  __attribute__((noinline)) const std::uint8_t* add(std::uint32_t rate, std::uint32_t other) {
    std::unique_ptr<std::uint8_t[]>& pairs = known_[rate];
    if (pairs == nullptr) {
      pairs = std::make_unique<std::uint8_t[]>((kMost + 1) * rate);
    }
    std::uint8_t* const counts = pairs.get() + other * rate;
    walk_segments(rate, other, [&](std::uint32_t i, std::uint32_t n) {
      counts[i] = static_cast<std::uint8_t>(n);
    });
    return counts;
  }

  /// The counts with each other rate, one after the other, 0 where they are not yet known.
  std::array<std::unique_ptr<std::uint8_t[]>, kMost + 1> known_;
};

/// A side whose inner vertices have numbers one after the other.
struct LinearSide {
  std::uint32_t zero = 0; ///< the number that point 0 would have if it were not a corner
  std::uint32_t step = 0; ///< 1 or -1
  std::uint32_t segments = 0;
  std::uint32_t end[2] = {0, 0};        ///< the corners
  const std::uint8_t* counts = nullptr; ///< segments from each of the patch's points to the next

  /// The vertex of a point that is no corner.
  [[nodiscard]] std::uint32_t at(std::uint32_t place) const noexcept { return zero + place * step; }
};

/// The sides of one patch after the other.
class LinearSides {
public:
  explicit LinearSides(const MeshData& mesh) : mesh_(mesh), topology_(*mesh.topology.data()) {}

  /// False where the patch is not a usual one.
  bool move_to(std::size_t patch) {
    const std::uint32_t nu = mesh_.nu[patch];
    const std::uint32_t nv = mesh_.nv[patch];
    return nu > 1 && nv > 1 && nu <= UnionCounts::kMost && nv <= UnionCounts::kMost &&
           read<0>(patch, nu) && read<1>(patch, nu) && read<2>(patch, nv) && read<3>(patch, nv) &&
           !is_folded(patch);
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
  /// Reads side k. It is compiled for each, so that the compiler knows where things are.
  template <std::size_t k>
  __attribute__((always_inline)) bool read(std::size_t patch, std::uint32_t rate) {
    const std::size_t number = kPatchEdges * patch + k;
    const Side side = topology_.sides[number];
    if (side.collapsed() || mesh_.is_split(number)) {
      return false;
    }
    const std::uint32_t edge = side.edge();
    const auto all = topology_.sides_of(edge);
    const std::uint32_t other = all.size() == 1 ? rate : mesh_.rate(all[all[0] == number ? 1 : 0]);
    if (all.size() > 2 || other > UnionCounts::kMost) {
      return false;
    }
    LinearSide& to = sides_[k];
    to.segments = mesh_.segments[edge];
    const std::uint32_t backwards = side.reversed() ? ~0U : 0; // no branch: it is anyone's guess
    to.step = backwards | 1;
    to.zero = mesh_.edge_first[edge] + (to.segments & backwards) - 1;
    to.end[0] = mesh_.corners[kPatchCorners * patch + kSideCorners[k][0]];
    to.end[1] = mesh_.corners[kPatchCorners * patch + kSideCorners[k][1]];
    to.counts = counts_.of(rate, other);
    return true;
  }

  const MeshData& mesh_;
  const TopologyData& topology_;
  LinearSide sides_[kPatchEdges];
  UnionCounts counts_;
};

} // namespace simdbezier::detail
