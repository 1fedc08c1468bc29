// Corners and edges of meshes as most of them are: edges of one or two patches whose kernels know
// edges, and vertices that are not split. They are put straight in their places. All others go by
// way of BoundarySamples and BoundaryStore.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/vertices/boundary_parameters.hpp"
#include "src/mesh/vertices/boundary_samples.hpp"
#include "src/mesh/vertices/closed_grids.hpp"
#include "src/mesh/vertices/corner_cache.hpp"
#include "src/mesh/vertices/parameter_lines.hpp"
#include "src/mesh/vertices/patch_runner.hpp"
#include "src/mesh/vertices/vertex_target.hpp"

namespace simdbezier::detail {

/// One thread's edges, which wait until there are enough for a call of the kernel.
template <typename T>
class PlainBoundary {
public:
  PlainBoundary(const MeshData& mesh, PatchRunner<T>& runner, ParameterLines<T>& lines,
                UnionLines<T>& unions, CornerCache<T>& corners, ClosedGrids<T>& grids,
                bool normals) noexcept
      : mesh_(mesh), topology_(*mesh.topology.data()), runner_(runner), lines_(lines),
        unions_(unions), corners_(corners), grids_(grids), normals_(normals) {}

  /// Writes the vertex of some joined corners. lowest: the first of them. False where nothing is
  /// written, because it is none of the plain ones.
  bool put_corner(std::uint32_t lowest, const VertexTarget<T>& to) noexcept {
    if (!mesh_.side_first.empty()) {
      return false;
    }
    if (to.parameters.wanted()) {
      put_corner_parameters(topology_, lowest, mesh_.corners[lowest] - to.parameters_first,
                            to.parameters);
    }
    if (has_grids(lowest) || find_grids(lowest)) {
      put_corner(lowest, to, [this](std::uint32_t corner) {
        const std::size_t patch = corner / kPatchCorners;
        return grids_.known(patch).corner(corner % kPatchCorners, topology_.is_turned(patch));
      });
    } else {
      put_corner(lowest, to, [this](std::uint32_t corner) {
        const CornerValues<T>& known = corners_.at(corner);
        const bool turned = topology_.is_turned(corner / kPatchCorners);
        return SampleRun<T>{known.position, known.normal, 1, 0, turned ? T(-1) : T(1)};
      });
    }
    return true;
  }

  /// Takes down an edge, whose points run() writes. False where it is none of the plain ones.
  bool add_edge(std::uint32_t edge, const VertexTarget<T>& to) noexcept {
    const std::uint32_t segments = mesh_.segments[edge];
    if (segments <= 1) {
      return true;
    }
    const auto sides = topology_.sides_of(edge);
    if (sides.size() > 2 || mesh_.is_split(sides.front())) {
      return false;
    }
    const std::uint32_t rate = mesh_.rate(sides.front());
    const std::uint32_t other = mesh_.rate(sides.back());
    // No branches: in a mesh of many rates nothing predicts which of both is larger.
    const std::uint32_t low = std::min(rate, other);
    const std::uint32_t high = std::max(rate, other);
    if (low == high && high <= ClosedGrids<T>::kMostRate && put_small_edge(edge, sides, to)) {
      return true;
    }
    const bool united = high <= UnionLines<T>::kMost; // equal rates as well
    const std::uint32_t bucket = runner_.edge_bucket(sides.front() / kPatchEdges);
    if (!(united || (segments == high && ParameterLines<T>::is_kept(high))) ||
        bucket == PatchRunner<T>::kNoEdges ||
        bucket != runner_.edge_bucket(sides.back() / kPatchEdges)) {
      return false;
    }
    if (count_ == kMost || bucket_ != bucket || (united && !unions_.holds(low, high))) {
      run(to);
    }
    bucket_ = bucket;
    EdgeJob<T>& job = jobs_[count_++];
    job.along = united ? unions_.line(low, high) : lines_.line(high);
    if (to.parameters.wanted()) {
      put_parameters(edge, sides.front(), united ? unions_.shares(low, high) : nullptr, to);
    }
    job.points = segments - 1;
    job.place = mesh_.edge_first[edge] - to.first;
    job.members = 0;
    for (const std::uint32_t side : sides) {
      if (job.members == 0 || (normals_ && !topology_.is_apart(side, kApartSide))) {
        const std::size_t patch = side / kPatchEdges;
        job.member[job.members++] = {runner_.index_of(patch), side % kPatchEdges,
                                     topology_.sides[side].reversed() ? T(-1) : T(1),
                                     topology_.is_turned(patch) ? T(-1) : T(1)};
      }
    }
    return true;
  }
  /// Writes the edges and the normals that wait. to: as for add_edge() and put_corner().
  void run(const VertexTarget<T>& to) noexcept {
    sums_.finish(to.normal, to.step);
    if (count_ > 0) {
      runner_.run_edges({jobs_, count_}, bucket_, {to.position, to.normal, to.step, to.drain});
      count_ = 0;
    }
  }

private:
  static constexpr std::size_t kMost = 64;

  /// Whether the grids of all patches at a corner are there, which nearly always holds: so what
  /// follows needs no calls, around which registers would be saved.
  [[nodiscard]] bool has_grids(std::uint32_t lowest) noexcept {
    bool has = true;
    std::size_t patches = 0;
    std::uint32_t corner = lowest;
    do {
      ++patches;
      has &= grids_.is_known(corner / kPatchCorners) && topology_.short_sides_at(corner) == 0;
      corner = topology_.next_corner[corner];
    } while (normals_ && corner != lowest);
    grids_.count(patches);
    return has;
  }
  /// Looks for those that are not there.
  [[gnu::noinline]] bool find_grids(std::uint32_t lowest) noexcept {
    std::uint32_t corner = lowest;
    do {
      if (grids_.of(corner / kPatchCorners) == nullptr) {
        return false;
      }
      corner = topology_.next_corner[corner];
    } while (normals_ && corner != lowest);
    return has_grids(lowest);
  }
  /// sample_of(corner): valid until the next one is asked for.
  template <typename SampleOf>
  [[gnu::always_inline]] void put_corner(std::uint32_t lowest, const VertexTarget<T>& to,
                                         const SampleOf& sample_of) noexcept {
    const SampleRun<T> own = sample_of(lowest);
    begin<1>(own, mesh_.corners[lowest] - to.first, to);
    for (std::uint32_t corner = topology_.next_corner[lowest]; normals_ && corner != lowest;
         corner = topology_.next_corner[corner]) {
      if (!topology_.is_apart(corner, kApartCorner)) {
        sums_.template add<1>(sample_of(corner));
      }
    }
  }
  /// Writes positions, and lets sums of normals wait that begin with the first patch's.
  template <std::size_t kPoints>
  void begin(const SampleRun<T>& run, std::size_t place, const VertexTarget<T>& to) noexcept {
    for (std::size_t c = 0; c < 3 && to.position.component[c] != nullptr; ++c) {
      T values[kPoints];
      run.read(run.position, c, values);
      for (std::size_t k = 0; k < kPoints; ++k) {
        to.position.component[c][(place + k) * to.step] = values[k];
      }
    }
    if (!normals_) {
      return;
    }
    if (!sums_.has_room(kPoints)) {
      sums_.finish(to.normal, to.step);
    }
    sums_.template put<kPoints>(run, place);
  }
  /// The points of an edge between patches of few cells. False where nothing is written.
  bool put_small_edge(std::uint32_t edge, std::span<const std::uint32_t> sides,
                      const VertexTarget<T>& to) noexcept {
    const std::uint32_t own = sides.front();
    const std::uint32_t other = sides.back();
    const std::size_t patch = own / kPatchEdges;
    const std::size_t other_patch = other / kPatchEdges;
    if (!ClosedGrids<T>::are_apart(patch, other_patch)) {
      return false;
    }
    const bool merges = normals_ && other != own && !topology_.is_apart(other, kApartSide);
    const ClosedGrid<T>* const grid = grids_.of(patch);
    const ClosedGrid<T>* const beyond = merges ? grids_.of(other_patch) : grid;
    if (grid == nullptr || beyond == nullptr || !grid->whole || !beyond->whole) {
      return false;
    }
    if (to.parameters.wanted()) {
      put_parameters(edge, own, nullptr, to);
    }
    const std::size_t points = mesh_.segments[edge] - 1;
    const std::size_t place = mesh_.edge_first[edge] - to.first;
    const SampleRun<T> samples = run_of(*grid, own);
    const SampleRun<T> others = merges ? run_of(*beyond, other) : samples;
    static_assert(ClosedGrids<T>::kMostRate == 5);
    with_known_count(points, [&]<std::size_t kPoints>() {
      begin<kPoints>(samples, place, to);
      if (merges) {
        sums_.template add<kPoints>(others);
      }
    });
    return true;
  }
  /// A side's samples between its ends, in the direction of its edge.
  [[nodiscard]] SampleRun<T> run_of(const ClosedGrid<T>& grid, std::uint32_t side) const noexcept {
    return grid.side(side, topology_.sides[side].reversed(),
                     topology_.is_turned(side / kPatchEdges));
  }

  /// Those of the points between an edge's ends, on its first side. shares: where they are on the
  /// edge; null where all segments are equal.
  void put_parameters(std::uint32_t edge, std::uint32_t side, const T* shares,
                      const VertexTarget<T>& to) const noexcept {
    const std::size_t at = mesh_.edge_first[edge] - to.parameters_first;
    const std::uint32_t segments = mesh_.segments[edge];
    const bool reversed = topology_.sides[side].reversed();
    const T end = T(side % 2);
    for (std::uint32_t k = 1; k < segments; ++k) {
      const std::uint32_t along = reversed ? segments - k : k;
      const T t =
          shares == nullptr ? static_cast<T>(along) / static_cast<T>(segments) : shares[along - 1];
      to.parameters.put(at + k - 1, side / kPatchEdges, runs_in_u(side) ? t : end,
                        runs_in_u(side) ? end : t);
    }
  }

  const MeshData& mesh_;
  const TopologyData& topology_;
  PatchRunner<T>& runner_;
  ParameterLines<T>& lines_;
  UnionLines<T>& unions_;
  CornerCache<T>& corners_;
  ClosedGrids<T>& grids_;
  bool normals_;
  WaitingSums<T> sums_;
  std::size_t count_ = 0;
  std::uint32_t bucket_ = 0; ///< of all edges that wait
  EdgeJob<T> jobs_[kMost];
};

} // namespace simdbezier::detail
