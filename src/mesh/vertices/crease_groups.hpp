// Decides which patches share a vertex where their normals, or their parameters, differ.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "src/mesh/net_points.hpp"
#include "src/mesh/radians.hpp"
#include "src/mesh/vertices/boundary_samples.hpp"

namespace simdbezier::detail {

/// What threads fill, each the entries of its own patches.
struct CreaseGroups {
  std::vector<std::uint32_t> corners; ///< see number_vertices()
  std::vector<std::size_t> side_first;
  std::vector<std::uint32_t> side_groups; ///< at [side_first[side] + k - 1], from 0 on

  explicit CreaseGroups(const MeshData& mesh) : corners(mesh.topology.data()->corners.size()) {
    const TopologyData& topology = *mesh.topology.data();
    side_first.assign(topology.sides.size(), MeshData::kWhole);
    std::size_t values = 0;
    for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
      const auto sides = topology.sides_of(edge);
      for (const std::uint32_t side : sides) {
        side_first[side] = sides.size() > 1 && mesh.segments[edge] > 1 ? values : MeshData::kWhole;
        values += sides.size() > 1 ? mesh.segments[edge] - 1 : 0;
      }
    }
    side_groups.resize(values);
  }
  /// Gives every patch vertices of its own. The ends of a side that is a point stay one.
  void part(const TopologyData& topology, const MeshData& mesh) {
    std::iota(corners.begin(), corners.end(), 0U);
    for (std::size_t side = 0; side < topology.sides.size(); ++side) {
      if (topology.sides[side].collapsed()) {
        const auto [low, high] =
            std::minmax({corners[corner_at(side, 0)], corners[corner_at(side, 1)]});
        auto* const own = &corners[side / kPatchEdges * kPatchCorners];
        std::replace(own, own + kPatchCorners, high, low);
      }
    }
    for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
      std::uint32_t group = 0;
      for (const std::uint32_t side : topology.sides_of(edge)) {
        if (side_first[side] != MeshData::kWhole) {
          std::fill_n(&side_groups[side_first[side]], mesh.segments[edge] - 1, group++);
        }
      }
    }
  }
  /// Marks edges on which all sides share all vertices as whole.
  void close(const TopologyData& topology, const MeshData& mesh) {
    for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
      bool whole = true;
      for (const std::uint32_t side : topology.sides_of(edge)) {
        if (side_first[side] != MeshData::kWhole) {
          const std::uint32_t* const groups = &side_groups[side_first[side]];
          whole = whole && std::all_of(groups, groups + mesh.segments[edge] - 1,
                                       [](std::uint32_t group) { return group == 0; });
        }
      }
      for (const std::uint32_t side : topology.sides_of(edge)) {
        side_first[side] = whole ? MeshData::kWhole : side_first[side];
      }
    }
  }
};

/// One thread's decisions.
template <typename T>
class CreaseFinder {
public:
  CreaseFinder(const MeshData& mesh, double angle, CreaseGroups& groups) noexcept
      : topology_(*mesh.topology.data()), always_(angle >= radians(180)), cosine_(std::cos(angle)),
        sine_(std::sin(angle)), groups_(groups) {}

  /// Gives groups to the patches at a corner, or at each point of an edge. sample_of_corner:
  /// scratch for one value a corner that is joined with others.
  void group(const BoundaryEntry<T>& entry, std::uint32_t* sample_of_corner) const noexcept {
    if (entry.corner) {
      group_corner(entry, sample_of_corner);
    } else if (entry.members > 1) {
      for (std::uint32_t k = 0; k < entry.points; ++k) {
        group_point(entry, k);
      }
    }
  }

private:
  static Point3 normal(const VertexSample<T>& sample) noexcept {
    Point3 n;
    for (std::size_t c = 0; c < 3; ++c) {
      n.x[c] = static_cast<double>(sample.normal[c]);
    }
    return n;
  }
  /// Whether two samples' normals may be merged.
  [[nodiscard]] bool join(const VertexSample<T>& a, const VertexSample<T>& b,
                          bool against) const noexcept {
    if (always_) {
      return true;
    }
    const Point3 x = normal(a);
    const Point3 y = normal(b);
    const Point3 z = cross(x, y);
    const double along = against ? -dot(x, y) : dot(x, y);
    // The sine of the angle between the normals, less the crease's angle: of small angles a cosine
    // would show the rounding of the normals' lengths instead.
    return dot(x, x) == 0 || dot(y, y) == 0 || std::sqrt(dot(z, z)) * cosine_ < along * sine_;
  }
  /// join() of normals at two sides of one edge.
  [[nodiscard]] bool sides_join(std::uint32_t a, const VertexSample<T>& sample_a, std::uint32_t b,
                                const VertexSample<T>& sample_b) const noexcept {
    const bool two = topology_.sides_of(topology_.sides[a].edge()).size() == 2;
    return !(two && topology_.disagree(a, b)) &&
           join(sample_a, sample_b,
                topology_.is_turned(a / kPatchEdges) != topology_.is_turned(b / kPatchEdges));
  }

  void group_point(const BoundaryEntry<T>& entry, std::uint32_t k) const noexcept {
    const auto sides = topology_.sides_of(entry.place);
    const auto sample = [&](std::size_t m) -> const VertexSample<T>& {
      return entry.samples[m * entry.points + k];
    };
    const auto group_of = [&](std::size_t m) -> std::uint32_t& {
      return groups_.side_groups[groups_.side_first[sides[m]] + k];
    };
    std::uint32_t count = 0;
    for (std::size_t m = 0; m < sides.size(); ++m) {
      std::uint32_t group = 0;
      for (; group < count; ++group) {
        bool fits = true;
        for (std::size_t n = 0; n < m && fits; ++n) {
          fits = group_of(n) != group || sides_join(sides[n], sample(n), sides[m], sample(m));
        }
        if (fits) {
          break;
        }
      }
      group_of(m) = group;
      count = std::max(count, group + 1);
    }
  }

  /// Neighbours across edges whose normals may be merged, and their neighbours, share a vertex.
  void group_corner(const BoundaryEntry<T>& entry, std::uint32_t* sample_of_corner) const noexcept {
    std::vector<std::uint32_t>& lowest = groups_.corners;
    std::uint32_t sample = 0;
    topology_.for_joined(entry.place, [&](std::size_t corner) {
      lowest[corner] = static_cast<std::uint32_t>(corner);
      sample_of_corner[corner] = sample++;
    });
    const auto find = [&](std::uint32_t corner) {
      while (lowest[corner] != corner) {
        corner = lowest[corner];
      }
      return corner;
    };
    topology_.for_joined(entry.place, [&](std::size_t corner) {
      topology_.for_neighbours(corner, [&](std::size_t side, std::size_t other, std::uint32_t to) {
        if (topology_.sides[side].collapsed() ||
            sides_join(static_cast<std::uint32_t>(side), entry.samples[sample_of_corner[corner]],
                       static_cast<std::uint32_t>(other), entry.samples[sample_of_corner[to]])) {
          const std::uint32_t a = find(static_cast<std::uint32_t>(corner));
          const std::uint32_t b = find(to);
          lowest[std::max(a, b)] = std::min(a, b);
        }
      });
    });
    topology_.for_joined(entry.place, [&](std::size_t corner) {
      lowest[corner] = find(static_cast<std::uint32_t>(corner));
    });
  }

  const TopologyData& topology_;
  bool always_;
  double cosine_;
  double sine_;
  CreaseGroups& groups_;
};

} // namespace simdbezier::detail
