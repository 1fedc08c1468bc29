// The samples that corners and edges of a mesh are made of: one for every vertex there, or one for
// every patch that has it, where normals are merged.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/mesh/mesh_data.hpp"
#include "src/mesh/parameter_lines.hpp"

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
  std::sort(rates, rates + sides.size());
  const auto count = static_cast<std::size_t>(std::unique(rates, rates + sides.size()) - rates);
  walk_union({rates, count}, scratch + sides.size(),
             [&](std::uint32_t k, const std::uint32_t* next, std::size_t lowest) {
               if (next[lowest] > 0 && next[lowest] < rates[lowest]) {
                 visit(k, next[lowest], rates[lowest]);
               }
             });
}

/// One thread's list of samples, gathered patch by patch.
template <typename T>
class BoundarySamples {
public:
  /// Room for `samples`, in memory of as many bytes.
  [[nodiscard]] static std::size_t bytes(const MeshData& mesh, std::size_t samples) noexcept {
    return whole_lines(samples * sizeof(BoundaryEntry)) + whole_lines(samples * sizeof(*patch_)) +
           2 * whole_lines(samples * sizeof(T)) +
           whole_lines(2 * mesh.most_sides * sizeof(*patch_));
  }
  /// every_patch: a sample for every patch that has a vertex, else for the first of them.
  BoundarySamples(const MeshData& mesh, bool every_patch, std::size_t samples,
                  ParameterLines<T>& lines, unsigned char* memory) noexcept
      : mesh_(mesh), topology_(*mesh.topology.data()), every_patch_(every_patch), lines_(lines) {
    const auto take = [&]<typename Value>(Value*& to, std::size_t count) {
      to = reinterpret_cast<Value*>(memory);
      memory += whole_lines(count * sizeof(Value));
    };
    take(entries_, samples);
    take(patch_, samples);
    take(u_, samples);
    take(v_, samples);
    take(scratch_, 2 * mesh.most_sides);
  }

  void clear() noexcept { count_ = entry_count_ = 0; }
  /// Of the corners and edges that a patch owns; there has to be room for most_boundary_samples.
  void add(std::size_t patch) noexcept {
    for (std::size_t k = kPatchCorners * patch; k < kPatchCorners * (patch + 1); ++k) {
      if (topology_.corners[k] == k) {
        add_corner(static_cast<std::uint32_t>(k));
      }
    }
    for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
      if (topology_.owns_edge(side)) {
        add_edge(topology_.sides[side].edge());
      }
    }
  }

  [[nodiscard]] std::span<const BoundaryEntry> entries() const noexcept {
    return {entries_, entry_count_};
  }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] const std::uint32_t* patch() const noexcept { return patch_; }
  /// Centred parameters.
  [[nodiscard]] const T* u() const noexcept { return u_; }
  [[nodiscard]] const T* v() const noexcept { return v_; }

private:
  void add_corner(std::uint32_t lowest) noexcept {
    BoundaryEntry& entry = entries_[entry_count_++];
    entry = {lowest, true, static_cast<std::uint32_t>(count_), 1, 0};
    topology_.for_joined(lowest, [&](std::size_t corner) {
      if (every_patch_ || entry.members == 0) {
        patch_[count_] = static_cast<std::uint32_t>(corner / kPatchCorners);
        u_[count_] = T(corner % 2 != 0 ? 1 : -1);
        v_[count_] = T(corner % kPatchCorners >= 2 ? 1 : -1);
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
    const auto sides =
        topology_.sides_of(edge).first(every_patch_ ? topology_.sides_of(edge).size() : 1);
    BoundaryEntry& entry = entries_[entry_count_++];
    entry = {edge, false, static_cast<std::uint32_t>(count_), points,
             static_cast<std::uint32_t>(sides.size())};
    // The first side has the edge's direction.
    T* const line = runs_in_u(sides[0]) ? u_ + count_ : v_ + count_;
    fill_line(edge, points, line);
    for (const std::uint32_t side : sides) {
      const bool in_u = runs_in_u(side);
      T* const along = (in_u ? u_ : v_) + count_;
      const bool reversed = topology_.sides[side].reversed();
      for (std::uint32_t k = 0; k < points; ++k) {
        along[k] = reversed ? T(0) - line[k] : line[k]; // no -0
      }
      std::fill_n((in_u ? v_ : u_) + count_, points, T(side % 2 != 0 ? 1 : -1));
      std::fill_n(patch_ + count_, points, static_cast<std::uint32_t>(side / kPatchEdges));
      count_ += points;
    }
  }

  /// Centred parameters of an edge's points.
  void fill_line(std::uint32_t edge, std::uint32_t points, T* to) noexcept {
    const auto sides = topology_.sides_of(edge);
    const std::uint32_t rate = mesh_.rate(sides[0]);
    if (rate == points + 1) { // the other rates are divisors of it
      const T* const line = lines_.line(rate);
      std::transform(line, line + points, to, [](T x) { return T(2) * x; });
      return;
    }
    for_edge_points(mesh_, edge, scratch_,
                    [&](std::uint32_t k, std::uint32_t numerator, std::uint32_t denominator) {
                      to[k - 1] = T(2) * uniform_parameter<T>(numerator, denominator);
                    });
  }

  const MeshData& mesh_;
  const TopologyData& topology_;
  bool every_patch_;
  ParameterLines<T>& lines_;
  BoundaryEntry* entries_ = nullptr;
  std::uint32_t* patch_ = nullptr;
  T* u_ = nullptr;
  T* v_ = nullptr;
  std::uint32_t* scratch_ = nullptr;
  std::size_t count_ = 0;
  std::size_t entry_count_ = 0;
};

} // namespace simdbezier::detail
