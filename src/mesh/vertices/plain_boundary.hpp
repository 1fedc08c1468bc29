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
    const std::size_t place = mesh_.corners[lowest] - to.first;
    const CornerValues<T> own = corner_values(lowest);
    put_vertex(own.position, to.position, place, to.step);
    if (!normals_) {
      return true;
    }
    NormalSum<T> sum(own.normal, topology_.is_turned(lowest / kPatchCorners));
    for (std::uint32_t corner = topology_.next_corner[lowest]; corner != lowest;
         corner = topology_.next_corner[corner]) {
      if (!topology_.is_apart(corner, kApartCorner)) {
        sum.add(corner_values(corner).normal, topology_.is_turned(corner / kPatchCorners));
      }
    }
    T merged[3];
    sum.finish(merged);
    put_vertex(merged, to.normal, place, to.step);
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
  /// Writes the edges that wait. to: as for add_edge().
  void run(const VertexTarget<T>& to) noexcept {
    if (count_ > 0) {
      runner_.run_edges({jobs_, count_}, bucket_, {to.position, to.normal, to.step, to.drain});
      count_ = 0;
    }
  }

private:
  static constexpr std::size_t kMost = 64;

  CornerValues<T> corner_values(std::uint32_t corner) noexcept {
    const ClosedGrid<T>* const grid =
        topology_.short_sides_at(corner) == 0 ? grids_.of(corner / kPatchCorners) : nullptr;
    if (grid == nullptr) {
      return corners_.at(corner);
    }
    CornerValues<T> values{};
    const std::size_t sample = grid->corner(corner % kPatchCorners);
    grids_.read_position(*grid, sample, values.position);
    grids_.read_normal(*grid, sample, values.normal);
    return values;
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
    if (grid == nullptr || beyond == nullptr || !grids_.is_whole(*grid, patch) ||
        (merges && !grids_.is_whole(*beyond, other_patch))) {
      return false;
    }
    if (to.parameters.wanted()) {
      put_parameters(edge, own, nullptr, to);
    }
    const std::uint32_t segments = mesh_.segments[edge];
    const std::size_t place = mesh_.edge_first[edge] - to.first;
    const auto point_on = [&](const ClosedGrid<T>& of, std::uint32_t side, std::uint32_t k) {
      return of.side_point(side, topology_.sides[side].reversed() ? segments - k : k);
    };
    for (std::uint32_t k = 1; k < segments; ++k) {
      const std::size_t sample = point_on(*grid, own, k);
      T values[3] = {};
      grids_.read_position(*grid, sample, values);
      put_vertex(values, to.position, place + k - 1, to.step);
      if (normals_) {
        grids_.read_normal(*grid, sample, values);
        NormalSum<T> sum(values, topology_.is_turned(patch));
        if (merges) {
          grids_.read_normal(*beyond, point_on(*beyond, other, k), values);
          sum.add(values, topology_.is_turned(other_patch));
        }
        sum.finish(values);
        put_vertex(values, to.normal, place + k - 1, to.step);
      }
    }
    return true;
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
  std::size_t count_ = 0;
  std::uint32_t bucket_ = 0; ///< of all edges that wait
  EdgeJob<T> jobs_[kMost];
};

} // namespace simdbezier::detail
