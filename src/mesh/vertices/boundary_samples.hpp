// The samples that corners and edges of a mesh are made of: one for every vertex there, or, where
// normals are merged, one for every patch that has the vertex.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/vertices/boundary_rings.hpp"
#include "src/mesh/vertices/corner_cache.hpp"
#include "src/mesh/vertices/merged_normals.hpp"
#include "src/mesh/vertices/parameter_lines.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier::detail {

/// Some vertices that lie one after the other, and their samples: all points for the first side,
/// then all points for the next one. In a corner of patches there is one point, and `members`
/// counts the joined corners.
struct BoundaryEntry {
  std::uint32_t place; ///< an edge, or 4 * patch + corner
  bool corner;
  std::uint32_t first; ///< sample
  std::uint32_t points;
  std::uint32_t members;
};

/// The points of an edge between its ends, in its own direction: visit(k, numerator, denominator)
/// for k = 1, 2, … scratch: two values a side.
template <typename Visit>
void for_edge_points(const MeshData& mesh, std::uint32_t edge, std::uint32_t* scratch,
                     const Visit& visit) {
  const auto sides = mesh.topology.data()->sides_of(edge);
  std::uint32_t* const rates = scratch;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    rates[k] = mesh.rate(sides[k]);
  }
  sort_range(rates, rates + sides.size());
  const auto count = static_cast<std::size_t>(std::unique(rates, rates + sides.size()) - rates);
  walk_union({rates, count}, scratch + sides.size(),
             [&](std::uint32_t k, const std::uint32_t* next, std::size_t lowest) {
               if (next[lowest] > 0 && next[lowest] < rates[lowest]) {
                 visit(k, next[lowest], rates[lowest]);
               }
             });
}

/// What samples are asked for.
struct BoundaryWishes {
  std::size_t dimension; ///< components of positions
  bool normals;
  bool every_patch;    ///< a sample for every patch that has a vertex, else for the first of them
  std::size_t samples; ///< the most that are kept
};

/// One thread's samples, gathered patch by patch.
template <typename T>
class BoundarySamples {
public:
  [[nodiscard]] static std::size_t bytes(const MeshData& mesh,
                                         const BoundaryWishes& wishes) noexcept {
    return whole_lines(wishes.samples * sizeof(BoundaryEntry)) +
           whole_lines(2 * mesh.most_sides * sizeof(std::uint32_t)) +
           2 * whole_lines(line_values(mesh) * sizeof(T)) +
           whole_lines(CornerCache<T>::memory_corners() * sizeof(CornerValues<T>)) +
           whole_lines(UnionLines<T>::memory_values() * sizeof(T)) +
           whole_lines(BoundaryRings<T>::memory_values(mesh, planes(wishes)) * sizeof(T)) +
           planes(wishes) * whole_lines(plane_values(wishes) * sizeof(T));
  }
  BoundarySamples(const MeshData& mesh, const BoundaryWishes& wishes, PatchRunner<T>& runner,
                  ParameterLines<T>& lines, unsigned char* memory) noexcept
      : mesh_(mesh), topology_(*mesh.topology.data()), wishes_(wishes), runner_(runner),
        lines_(lines), corners_(runner, topology_, wishes.dimension, wishes.normals,
                                take<CornerValues<T>>(memory, CornerCache<T>::memory_corners())),
        unions_(take<T>(memory, UnionLines<T>::memory_values())),
        rings_(mesh, runner, lines, wishes.dimension, wishes.normals,
               take<T>(memory, BoundaryRings<T>::memory_values(mesh, planes(wishes)))) {
    entries_ = take<BoundaryEntry>(memory, wishes.samples);
    scratch_ = take<std::uint32_t>(memory, 2 * mesh.most_sides);
    line_[0] = take<T>(memory, line_values(mesh));
    line_[1] = take<T>(memory, line_values(mesh));
    for (std::size_t c = 0; c < wishes.dimension; ++c) {
      positions_.component[c] = take<T>(memory, plane_values(wishes));
    }
    for (std::size_t c = 0; c < 3 && wishes.normals; ++c) {
      normals_.component[c] = take<T>(memory, plane_values(wishes));
    }
  }

  void clear() noexcept { count_ = entry_count_ = 0; }
  /// Whether there is room for one more patch.
  [[nodiscard]] bool has_room() const noexcept {
    return count_ + mesh_.most_boundary_samples <= wishes_.samples;
  }
  /// Evaluates the corners and edges that a patch owns.
  void add(std::size_t patch) noexcept {
    topology_.for_owned(
        patch, [this](std::uint32_t corner) { add_corner(corner); },
        [this](std::uint32_t edge) { add_edge(edge); });
  }
  /// Some joined corners. lowest: the first of them.
  void add_corner(std::uint32_t lowest) noexcept {
    BoundaryEntry& entry = entries_[entry_count_++];
    entry = {lowest, true, static_cast<std::uint32_t>(count_), 1, 0};
    topology_.for_joined(lowest, [&](std::size_t corner) {
      if (wishes_.every_patch || entry.members == 0) {
        const auto number = static_cast<std::uint32_t>(corner);
        if (topology_.short_sides_at(corner) != 0 ||
            !rings_.fetch_corner(number, positions_, normals_, count_)) {
          corners_.fetch(number, positions_, normals_, count_);
        }
        ++count_;
        ++entry.members;
      }
    });
  }

  void add_edge(std::uint32_t edge) noexcept {
    const std::uint32_t points = mesh_.segments[edge] - 1;
    if (points == 0) {
      return;
    }
    const auto all = topology_.sides_of(edge);
    const auto sides = all.first(wishes_.every_patch ? all.size() : 1);
    entries_[entry_count_++] = {edge, false, static_cast<std::uint32_t>(count_), points,
                                static_cast<std::uint32_t>(sides.size())};
    const T* along[2] = {nullptr, nullptr}; // parameters in the edge's direction, and against it
    for (const std::uint32_t side : sides) {
      const bool reversed = topology_.sides[side].reversed();
      if (mesh_.rate(side) != points + 1 ||
          !rings_.fetch_side(side, reversed, positions_, normals_, count_)) {
        if (along[0] == nullptr) {
          along[0] = parameters_of(edge, all, points);
        }
        if (reversed && along[1] == nullptr) {
          std::transform(along[0], along[0] + points + kMaxLanes, line_[1],
                         [](T x) { return T(0) - x; }); // no -0
          along[1] = line_[1];
        }
        run_side(side, along[reversed ? 1 : 0], points);
      }
      count_ += points;
    }
  }

  [[nodiscard]] std::span<const BoundaryEntry> entries() const noexcept {
    return {entries_, entry_count_};
  }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  /// What samples are made with.
  [[nodiscard]] CornerCache<T>& corners() noexcept { return corners_; }
  /// add_edge() may put other lines in its place: whoever waits with a line of it goes first.
  [[nodiscard]] UnionLines<T>& unions() noexcept { return unions_; }
  [[nodiscard]] const Planes<T>& positions() const noexcept { return positions_; }
  [[nodiscard]] const Planes<T>& normals() const noexcept { return normals_; }

private:
  static std::size_t planes(const BoundaryWishes& wishes) noexcept {
    return wishes.dimension + (wishes.normals ? 3 : 0);
  }
  /// Samples are read in blocks.
  static std::size_t plane_values(const BoundaryWishes& wishes) noexcept {
    return wishes.samples + PointBlock<T>::kPoints;
  }
  static std::size_t line_values(const MeshData& mesh) noexcept {
    return mesh.most_segments + kMaxLanes;
  }
  template <typename Value>
  static Value* take(unsigned char*& memory, std::size_t count) noexcept {
    auto* const taken = reinterpret_cast<Value*>(memory);
    memory += whole_lines(count * sizeof(Value));
    return taken;
  }

  void run_side(std::uint32_t side, const T* along, std::uint32_t points) noexcept {
    PieceTarget<T> to;
    for (std::size_t c = 0; c < 3; ++c) {
      to.position.component[c] = moved(positions_.component[c]);
      to.normal.component[c] = moved(normals_.component[c]);
    }
    runner_.run_side(side / kPatchEdges, side % kPatchEdges, along, points, to);
  }
  [[nodiscard]] T* moved(T* plane) const noexcept {
    return plane == nullptr ? nullptr : plane + count_;
  }

  /// Half-centred parameters of an edge's points, in its direction.
  const T* parameters_of(std::uint32_t edge, std::span<const std::uint32_t> sides,
                         std::uint32_t points) noexcept {
    const std::uint32_t rate = mesh_.rate(sides[0]);
    if (rate == points + 1) { // the other rates are divisors of it
      return lines_.line(rate);
    }
    const std::uint32_t other = mesh_.rate(sides[sides.size() - 1]);
    const auto [low, high] = std::minmax(rate, other);
    if (sides.size() == 2 && high <= UnionLines<T>::kMost) {
      return unions_.line(low, high);
    }
    fill_union(edge, points);
    return line_[0];
  }
  void fill_union(std::uint32_t edge, std::uint32_t points) noexcept {
    for_edge_points(mesh_, edge, scratch_,
                    [&](std::uint32_t k, std::uint32_t numerator, std::uint32_t denominator) {
                      line_[0][k - 1] = uniform_parameter<T>(numerator, denominator);
                    });
    std::fill_n(line_[0] + points, kMaxLanes, line_[0][points - 1]);
  }

  const MeshData& mesh_;
  const TopologyData& topology_;
  BoundaryWishes wishes_;
  PatchRunner<T>& runner_;
  ParameterLines<T>& lines_;
  CornerCache<T> corners_;
  UnionLines<T> unions_;
  BoundaryRings<T> rings_;
  BoundaryEntry* entries_ = nullptr;
  std::uint32_t* scratch_ = nullptr;
  T* line_[2] = {nullptr, nullptr}; ///< of an edge with several rates; the same reversed
  Planes<T> positions_;
  Planes<T> normals_;
  std::size_t count_ = 0;
  std::size_t entry_count_ = 0;
};

} // namespace simdbezier::detail
