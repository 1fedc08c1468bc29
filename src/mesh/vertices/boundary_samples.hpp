// The samples that corners and edges of a mesh are made of: one for every vertex there, or, where
// normals are merged, one for every patch that has the vertex.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/vertices/closed_grids.hpp"
#include "src/mesh/vertices/parameter_lines.hpp"
#include "src/mesh/vertices/patch_runner.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier::detail {

/// Some vertices that lie one after the other, and their samples: all points for the first side,
/// then all points for the next one. In a corner of patches there is one point, and `members`
/// counts the joined corners.
template <typename T>
struct BoundaryEntry {
  std::uint32_t place; ///< an edge, or 4 * patch + corner
  bool corner;
  std::uint32_t points;
  std::uint32_t members;
  const VertexSample<T>* samples;
};

/// One thread's samples of one entry.
template <typename T>
class BoundarySamples {
public:
  [[nodiscard]] static std::size_t bytes(const MeshData& mesh) noexcept {
    return whole_lines(mesh.most_boundary_samples * sizeof(VertexSample<T>)) +
           whole_lines(lines_values(mesh) * sizeof(T)) +
           whole_lines(line_values(mesh) * sizeof(T)) +
           whole_lines(2 * mesh.most_sides * sizeof(std::uint32_t)) + ClosedGrids<T>::bytes(mesh) +
           PatchRunner<T>::bytes(mesh.most_segments);
  }
  /// every_patch: a sample for every patch that has a vertex, else for the first of them.
  BoundarySamples(const MeshData& mesh, const PatchKernels<T>& kernels, std::size_t dimension,
                  bool normals, bool every_patch, unsigned char* memory) noexcept
      : mesh_(mesh), topology_(*mesh.topology.data()), every_patch_(every_patch),
        samples_(take<VertexSample<T>>(memory, mesh.most_boundary_samples)),
        lines_(take<T>(memory, lines_values(mesh)), mesh.most_rate()),
        line_(take<T>(memory, line_values(mesh)), mesh.most_segments),
        reversed_(line_.shares + mesh.most_segments + kMaxLanes),
        scratch_(take<std::uint32_t>(memory, 2 * mesh.most_sides)),
        runner_(kernels, dimension, normals, mesh.most_segments,
                take<unsigned char>(memory, PatchRunner<T>::bytes(mesh.most_segments))),
        grids_(mesh, runner_, normals, memory) {
    std::fill_n(samples_, mesh.most_boundary_samples, VertexSample<T>{});
  }
  BoundarySamples(const BoundarySamples&) = delete;
  BoundarySamples& operator=(const BoundarySamples&) = delete;

  /// What samples are made with.
  [[nodiscard]] PatchRunner<T>& runner() noexcept { return runner_; }
  [[nodiscard]] ParameterLines<T>& lines() noexcept { return lines_; }
  [[nodiscard]] ClosedGrids<T>& grids() noexcept { return grids_; }

  /// A corner, 4 * patch + corner. Valid until the next call of anything here.
  [[nodiscard]] SampleRun<T> corner(std::uint32_t corner) noexcept {
    return grids_.of(corner / kPatchCorners).corner(corner % kPatchCorners);
  }
  /// Some joined corners. lowest: the first of them. Valid until the next joined() or edge().
  BoundaryEntry<T> joined(std::uint32_t lowest) noexcept {
    BoundaryEntry<T> entry{lowest, true, 1, 0, samples_};
    topology_.for_joined(lowest, [&](std::size_t number) {
      if (every_patch_ || entry.members == 0) {
        samples_[entry.members++] = corner(static_cast<std::uint32_t>(number)).first[0];
      }
    });
    return entry;
  }
  /// An edge of at least two segments, in its own direction; likewise.
  BoundaryEntry<T> edge(std::uint32_t edge) noexcept {
    const std::uint32_t points = mesh_.segments[edge] - 1;
    const auto all = topology_.sides_of(edge);
    const auto sides = all.first(every_patch_ ? all.size() : 1);
    const ParameterLine<T> line = line_of(edge);
    VertexSample<T>* to = samples_;
    for (const std::uint32_t side : sides) {
      const std::size_t patch = side / kPatchEdges;
      const bool reversed = topology_.sides[side].reversed();
      if (mesh_.rate(side) == points + 1 && points < ClosedGrids<T>::kMostRate &&
          grids_.of(patch).whole) {
        const SampleRun<T> run = grids_.of(patch).side(side, reversed);
        const VertexSample<T>* sample = run.first;
        for (std::uint32_t k = 0; k < points; ++k, sample += run.step) {
          to[k] = *sample;
        }
      } else {
        if (reversed) {
          std::transform(line.along, line.along + points + kMaxLanes, reversed_,
                         [](T x) { return T(0) - x; }); // no -0
        }
        runner_.sample_side(patch, side % kPatchEdges, reversed ? reversed_ : line.along, points,
                            to);
      }
      to += points;
    }
    return {edge, false, points, static_cast<std::uint32_t>(sides.size()), samples_};
  }

  /// The points between an edge's ends. Valid until the next call of anything here.
  ParameterLine<T> line_of(std::uint32_t edge) noexcept {
    const auto sides = topology_.sides_of(edge);
    const auto [low, high] = std::minmax({mesh_.rate(sides.front()), mesh_.rate(sides.back())});
    if (sides.size() <= 2 && high <= ParameterLines<T>::kMost) {
      return lines_.line(low, high);
    }
    std::uint32_t* const rates = scratch_;
    std::transform(sides.begin(), sides.end(), rates,
                   [this](std::uint32_t side) { return mesh_.rate(side); });
    sort_range(rates, rates + sides.size());
    const auto count = static_cast<std::size_t>(std::unique(rates, rates + sides.size()) - rates);
    return line_.fill({rates, count}, scratch_ + sides.size());
  }

private:
  static std::size_t lines_values(const MeshData& mesh) noexcept {
    return ParameterLines<T>::memory_values(mesh.most_rate());
  }
  /// Of an edge with many rates, and the same reversed.
  static std::size_t line_values(const MeshData& mesh) noexcept {
    return LineMemory<T>::values(mesh.most_segments) + mesh.most_segments + kMaxLanes;
  }
  template <typename Value>
  static Value* take(unsigned char*& memory, std::size_t count) noexcept {
    auto* const taken = reinterpret_cast<Value*>(memory);
    memory += whole_lines(count * sizeof(Value));
    return taken;
  }

  const MeshData& mesh_;
  const TopologyData& topology_;
  bool every_patch_;
  VertexSample<T>* samples_;
  ParameterLines<T> lines_;
  LineMemory<T> line_; ///< of an edge with other rates than lines_ has
  T* reversed_;        ///< parameters against an edge's direction
  std::uint32_t* scratch_;
  PatchRunner<T> runner_;
  ClosedGrids<T> grids_;
};

} // namespace simdbezier::detail
