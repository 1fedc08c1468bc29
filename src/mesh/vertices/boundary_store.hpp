// Makes the vertices on boundaries of the samples there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "src/mesh/vertices/boundary_parameters.hpp"
#include "src/mesh/vertices/boundary_samples.hpp"
#include "src/mesh/vertices/merged_normals.hpp"
#include "src/mesh/vertices/vertex_target.hpp"

namespace simdbezier::detail {

/// The patch, of those at a vertex, that gives its position: the lowest of all, or, where the
/// vertex is split, the lowest of those that have this very one.
enum class ValuesOf : std::uint8_t { owner, own_patch };

/// One thread's boundary vertices on their way to memory.
template <typename T>
class BoundaryStore {
public:
  [[nodiscard]] static std::size_t bytes(const MeshData& mesh) noexcept {
    return whole_lines(mesh.most_boundary_samples * sizeof(Member)) +
           whole_lines(2 * mesh.most_sides * sizeof(std::uint32_t));
  }
  BoundaryStore(const MeshData& mesh, ValuesOf values, unsigned char* memory) noexcept
      : mesh_(mesh), merged_(mesh.normals()), topology_(*mesh.topology.data()), values_(values),
        members_(reinterpret_cast<Member*>(memory)),
        scratch_(reinterpret_cast<std::uint32_t*>(
            memory + whole_lines(mesh.most_boundary_samples * sizeof(Member)))) {}

  /// Forms the vertices of an entry from planes of all samples.
  void store(const BoundaryEntry& entry, const Planes<T>& positions, const Planes<T>& normals,
             const VertexTarget<T>& to) noexcept {
    list_members(entry);
    if (is_split(mesh_, entry)) {
      store_split(entry, positions, normals, to);
    } else {
      store_whole(entry, positions, normals, to);
    }
    if (to.parameters.wanted()) {
      store_parameters(entry, to);
    }
  }

private:
  /// One patch at an edge or in a corner.
  struct Member {
    std::uint32_t place; ///< a side, or 4 * patch + corner
    bool turned;
    bool apart;
    // Of the point in question, where vertices are split:
    std::uint32_t vertex;
    std::uint32_t merged; ///< the vertex in the layout where normals are merged
  };

  void list_members(const BoundaryEntry& entry) noexcept {
    const auto describe = [&](std::uint32_t place, ApartFlag flag) {
      const std::uint32_t patch = place / 4;
      return Member{place, topology_.is_turned(patch), topology_.is_apart(place, flag), 0, 0};
    };
    std::size_t m = 0;
    if (entry.corner) {
      std::uint32_t corner = entry.place;
      for (; m < entry.members; ++m, corner = topology_.next_corner[corner]) {
        members_[m] = describe(corner, kApartCorner);
      }
    } else {
      const auto sides = topology_.sides_of(entry.place);
      for (; m < entry.members; ++m) {
        members_[m] = describe(sides[m], kApartSide);
      }
    }
  }
  [[nodiscard]] bool is_split(const MeshData& mesh, const BoundaryEntry& entry) const noexcept {
    if (!entry.corner) {
      return mesh.is_split(topology_.sides_of(entry.place)[0]);
    }
    if (mesh.side_first.empty()) {
      return false;
    }
    std::uint32_t corner = entry.place;
    do {
      corner = topology_.next_corner[corner];
    } while (mesh.corners[corner] == mesh.corners[entry.place] && corner != entry.place);
    return corner != entry.place;
  }
  [[nodiscard]] std::uint32_t first_vertex(const BoundaryEntry& entry) const noexcept {
    return entry.corner ? mesh_.corners[entry.place] : mesh_.edge_first[entry.place];
  }

  static void put(const Planes<T>& from, std::size_t at, std::size_t points, const Planes<T>& to,
                  std::size_t step, std::size_t place) noexcept {
    for (std::size_t c = 0; c < 3 && to.component[c] != nullptr; ++c) {
      PointBlock<T>::store(PointBlock<T>::load(from.component[c] + at), points,
                           to.component[c] + place * step, step);
    }
  }
  void store_whole(const BoundaryEntry& entry, const Planes<T>& positions, const Planes<T>& normals,
                   const VertexTarget<T>& to) const noexcept {
    const std::size_t place = first_vertex(entry) - to.first;
    for (std::size_t k = 0; k < entry.points; k += PointBlock<T>::kPoints) {
      const std::size_t points = entry.points - k;
      put(positions, entry.first + k, points, to.position, to.step, place + k);
      if (!to.normal.wanted()) {
        continue;
      }
      NormalSums<T> sums(normals, entry.first + k, members_[0].turned);
      for (std::size_t m = 1; m < entry.members; ++m) {
        if (!members_[m].apart) {
          sums.add(normals, entry.first + m * entry.points + k, members_[m].turned);
        }
      }
      sums.finish(points, to.normal, place + k, to.step);
    }
  }

  void store_split(const BoundaryEntry& entry, const Planes<T>& positions, const Planes<T>& normals,
                   const VertexTarget<T>& to) noexcept {
    for (std::uint32_t k = 0; k < entry.points; ++k) {
      std::optional<NormalSums<T>> sums; // of the last one; several share it
      std::uint32_t merged = 0;
      for_vertices(entry, k, [&](std::size_t m, std::uint32_t vertex) {
        const std::size_t place = vertex - to.first;
        const std::size_t from = values_ == ValuesOf::owner ? 0 : m;
        put(positions, entry.first + from * entry.points + k, 1, to.position, to.step, place);
        if (to.normal.wanted()) {
          if (!sums || merged != members_[m].merged) {
            merged = members_[m].merged;
            sums = sums_of(merged, entry, k, normals);
          }
          sums->finish(1, to.normal, place, to.step);
        }
      });
    }
  }
  /// Of those at point k that share a merged vertex.
  [[nodiscard]] NormalSums<T> sums_of(std::uint32_t merged, const BoundaryEntry& entry,
                                      std::uint32_t k, const Planes<T>& normals) const noexcept {
    const bool whole = !is_split(merged_, entry); // else those apart have their own
    std::size_t m = 0;
    while (members_[m].merged != merged) {
      ++m;
    }
    const auto sample = [&](std::size_t n) { return entry.first + n * entry.points + k; };
    NormalSums<T> sums(normals, sample(m), members_[m].turned);
    while (++m < entry.members) {
      if (members_[m].merged == merged && !(whole && members_[m].apart)) {
        sums.add(normals, sample(m), members_[m].turned);
      }
    }
    return sums;
  }

  /// Calls visit(first member, vertex) for the different vertices of a point.
  template <typename Visit>
  void for_vertices(const BoundaryEntry& entry, std::uint32_t k, const Visit& visit) noexcept {
    for (std::size_t m = 0; m < entry.members; ++m) {
      Member& member = members_[m];
      const auto vertex_in = [&](const MeshData& mesh) {
        return entry.corner ? mesh.corners[member.place] : mesh.edge_vertex(member.place, k + 1);
      };
      member.vertex = vertex_in(mesh_);
      member.merged = vertex_in(merged_);
    }
    for (std::size_t m = 0; m < entry.members; ++m) {
      const std::uint32_t vertex = members_[m].vertex;
      const auto has = [&](const Member& earlier) { return earlier.vertex == vertex; };
      if (std::none_of(members_, members_ + m, has)) {
        visit(m, vertex);
      }
    }
  }

  void store_parameters(const BoundaryEntry& entry, const VertexTarget<T>& to) noexcept {
    const auto put_point = [&](std::uint32_t k, std::uint32_t numerator,
                               std::uint32_t denominator) {
      for_vertices(entry, k - 1, [&](std::size_t m, std::uint32_t vertex) {
        const std::uint32_t place = members_[m].place;
        const std::size_t at = vertex - to.parameters_first;
        if (entry.corner) {
          put_corner_parameters(topology_, place, at, to.parameters);
        } else {
          put_side_parameters(topology_, place, numerator, denominator, at, to.parameters);
        }
      });
    };
    if (entry.corner) {
      put_point(1, 0, 1);
    } else {
      for_edge_points(mesh_, entry.place, scratch_, put_point);
    }
  }

  const MeshData& mesh_;
  const MeshData& merged_; ///< whose vertices have a normal each
  const TopologyData& topology_;
  ValuesOf values_;
  Member* members_;
  std::uint32_t* scratch_;
};

} // namespace simdbezier::detail
