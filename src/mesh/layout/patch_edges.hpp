// The edges of the mesh that patches may have, whichever way their cells are cut.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "src/mesh/layout/cells.hpp"
#include "src/mesh/layout/mesh_data.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier::detail {

/// An edge that a mesh may have: where it is, and the two vertices that it joins. Two edges in
/// different places must not join the same two.
struct MeshEdge {
  std::uint64_t vertices;
  std::uint64_t place; ///< a segment of an edge, or two points of one patch
  std::uint32_t patch;

  friend auto operator<=>(const MeshEdge&, const MeshEdge&) = default;
};

/// The only triangle of a patch. All of its edges may be segments of the patch's sides, so that
/// they do not tell it from that of another patch with the same ones.
struct OnlyTriangle {
  std::array<std::uint32_t, 3> vertices; ///< ascending
  std::uint32_t patch;

  friend auto operator<=>(const OnlyTriangle&, const OnlyTriangle&) = default;
};

/// All diagonals from (0,0) to (1,1), or from (1,0) to (0,1).
inline constexpr std::uint16_t kCuts[] = {0, 0x1ff};

/// The edges of one patch after the other.
class PatchEdges {
public:
  PatchEdges(MeshData& mesh, PatchBoundary& boundary) : mesh_(mesh), boundary_(boundary) {}

  /// Appends the patch's triangle if it has a single one.
  void append(std::uint32_t patch, std::vector<OnlyTriangle>& triangles) {
    if (mesh_.triangles[patch + 1] - mesh_.triangles[patch] != 1) {
      return;
    }
    boundary_.move_to(patch);
    mesh_.diagonals[patch] = kCuts[0];
    cut(patch, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      triangles.push_back({{a, b, c}, patch});
      sort_range(triangles.back().vertices.begin(), triangles.back().vertices.end());
    });
  }
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
    for (const std::uint16_t diagonals : kCuts) {
      mesh_.diagonals[patch] = diagonals;
      add_points(patch);
    }
    mesh_.inner[patch] = inner;
    sort_range(points_.begin(), points_.end());
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
    sort_range(inside_.begin(), inside_.end());
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
    cut(patch, [this](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      points_.push_back(pair_of(a, b));
      points_.push_back(pair_of(b, c));
      points_.push_back(pair_of(c, a));
    });
  }
  /// visit(a, b, c) for all triangles of a patch.
  template <typename Visit>
  void cut(std::uint32_t patch, const Visit& visit) {
    TriangleVisitor<Visit> sink{visit};
    CellCutter(mesh_, boundary_, patch).cut(sink);
  }
  template <typename Visit>
  struct TriangleVisitor {
    const Visit& visit;

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { visit(a, b, c); }
    void cell(const CellCorners& c, bool falling) {
      put_halves(c, falling, [&](auto... vertices) { triangle(vertices...); });
    }
  };

  MeshData& mesh_;
  PatchBoundary& boundary_;
  std::vector<std::uint32_t> vertices_; ///< of the patch's points
  std::vector<std::uint64_t> points_;   ///< two of a patch, joined
  std::vector<MeshEdge> inside_;        ///< edges to inner points
};

} // namespace simdbezier::detail
