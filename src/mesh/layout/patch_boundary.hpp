// The vertices on the four sides of a patch.
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <vector>

#include "src/mesh/layout/mesh_data.hpp"

namespace simdbezier::detail {

/// Vertices between two own points of a side, both among them, in the side's direction.
struct Chain {
  const std::uint32_t* first;
  std::uint32_t segments; ///< 0 on a side that is a point
};

/// The inner points of a row, if their numbers follow each other: point i has number
/// `zero` + i * step.
struct PointRow {
  std::uint32_t zero = 0;
  std::uint32_t step = 0; ///< 0: they do not
};

/// The vertices of one patch after the other, in memory of its own.
class PatchBoundary {
public:
  explicit PatchBoundary(const MeshData& mesh) : mesh_(mesh), topology_(*mesh.topology.data()) {
    for (Line& line : lines_) {
      line.chain.reserve(mesh.most_segments + 1);
      line.places.reserve(kMostSegments + 1);
    }
  }

  void move_to(std::size_t patch) {
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      fill(kPatchEdges * patch + k, lines_[k]);
    }
  }

  /// The points of a side that has only its own ones.
  [[nodiscard]] const PointRow& row(std::size_t side) const { return lines_[side].row; }
  /// The vertex of own point i of a side.
  [[nodiscard]] std::uint32_t vertex(std::size_t side, std::uint32_t i) const {
    const Line& line = lines_[side];
    return line.chain[line.places[i]];
  }
  /// The chain from own point i to the next one.
  [[nodiscard]] Chain between(std::size_t side, std::uint32_t i) const {
    const Line& line = lines_[side];
    return {&line.chain[line.places[i]], line.places[i + 1] - line.places[i]};
  }
  [[nodiscard]] std::uint32_t segments(std::size_t side, std::uint32_t i) const {
    const Line& line = lines_[side];
    return line.places[i + 1] - line.places[i];
  }
  /// All vertices of a side.
  [[nodiscard]] std::span<const std::uint32_t> chain(std::size_t side) const {
    return lines_[side].chain;
  }

  /// Replaces vertices by numbers of the patch's own, from 0 on: points of one number are one point
  /// of the patch, whatever other points the model joins it with. vertices: of these points.
  void number_locally(std::vector<std::uint32_t>& vertices) {
    vertices.clear();
    std::uint32_t corners[kPatchCorners];
    for (std::uint32_t k = 0; k < kPatchCorners; ++k) {
      corners[k] = k;
      vertices.push_back(0);
    }
    for (std::size_t k = 0; k < kPatchEdges; ++k) { // sides that are points have one corner
      if (lines_[k].chain.size() == 1) {
        const std::uint32_t other = corners[kSideCorners[k][1]];
        std::replace(corners, corners + kPatchCorners, other, corners[kSideCorners[k][0]]);
      }
    }
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      lines_[k].row = {};
      auto& chain = lines_[k].chain;
      const std::uint32_t ends[2] = {corners[kSideCorners[k][0]], corners[kSideCorners[k][1]]};
      vertices[ends[0]] = chain.front();
      vertices[ends[1]] = chain.back();
      for (std::size_t i = 0; i < chain.size(); ++i) {
        if (i == 0 || i + 1 == chain.size()) {
          chain[i] = ends[i == 0 ? 0 : 1];
        } else {
          vertices.push_back(chain[i]);
          chain[i] = static_cast<std::uint32_t>(vertices.size() - 1);
        }
      }
    }
  }
  /// Whether two numbers follow each other on a side.
  [[nodiscard]] bool is_segment(std::uint32_t a, std::uint32_t b) const {
    // Both ends of a side may be one corner, and corners have the lowest numbers: the larger number
    // stands once, or next to itself.
    const auto [lower, larger] = std::minmax(a, b);
    return std::any_of(
        lines_.begin(), lines_.end(), [&, lower = lower, larger = larger](auto& line) {
          const auto at = std::find(line.chain.begin(), line.chain.end(), larger);
          return at != line.chain.end() && ((at != line.chain.begin() && *(at - 1) == lower) ||
                                            (at + 1 != line.chain.end() && *(at + 1) == lower));
        });
  }

private:
  struct Line {
    std::vector<std::uint32_t> chain;  ///< all vertices
    std::vector<std::uint32_t> places; ///< of the own points in it
    PointRow row;
  };

  void fill(std::size_t side, Line& line) {
    const std::uint32_t rate = mesh_.rate(side);
    const std::size_t corners = side / kPatchEdges * kPatchCorners;
    const auto& ends = kSideCorners[side % kPatchEdges];
    const std::uint32_t begin = mesh_.corners[corners + ends[0]];
    line.places.resize(rate + 1);
    line.row = {};
    if (topology_.sides[side].collapsed()) {
      line.chain.assign(1, begin);
      std::fill(line.places.begin(), line.places.end(), 0U);
      return;
    }
    const Side own = topology_.sides[side];
    const std::uint32_t segments = mesh_.segments[own.edge()];
    line.chain.resize(segments + 1);
    line.chain.front() = begin;
    line.chain.back() = mesh_.corners[corners + ends[1]];
    if (mesh_.is_split(side)) {
      for (std::uint32_t k = 1; k < segments; ++k) {
        line.chain[k] = mesh_.edge_vertex(side, own.reversed() ? segments - k : k);
      }
    } else {
      const std::uint32_t step = own.reversed() ? ~0U : 1;
      const std::uint32_t zero =
          mesh_.edge_first[own.edge()] + (own.reversed() ? segments - 1 : ~0U);
      for (std::uint32_t k = 1; k < segments; ++k) {
        line.chain[k] = zero + k * step;
      }
      line.row = {zero, rate == segments ? step : 0};
    }
    if (segments == rate) { // all points of the edge are its own
      std::iota(line.places.begin(), line.places.end(), 0U);
      return;
    }
    mesh_.rates_of(own.edge(), rates_);
    union_places(rates_, rate, scratch_, line.places);
  }

  const MeshData& mesh_;
  const TopologyData& topology_;
  std::array<Line, kPatchEdges> lines_;
  EdgeRates rates_;
  std::vector<std::uint32_t> scratch_;
};

} // namespace simdbezier::detail
