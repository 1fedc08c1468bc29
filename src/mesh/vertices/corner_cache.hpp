// Positions and normals in the corners of patches. A corner is asked for by each of its patches.
// Consecutive patches ask for corners of consecutive patches, so that whole blocks are evaluated
// and kept for a while.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "src/mesh/topology/topology_data.hpp"
#include "src/mesh/vertices/merged_normals.hpp"
#include "src/mesh/vertices/patch_runner.hpp"

namespace simdbezier::detail {

/// What is known of a corner.
template <typename T>
struct CornerValues {
  T position[3];
  T normal[3];
};

/// One thread's cache.
template <typename T>
class CornerCache {
public:
  /// Corners of scratch, whose memory begins on a line of the cache.
  [[nodiscard]] static std::size_t memory_corners() noexcept { return kBlocks * kBlockCorners; }
  CornerCache(PatchRunner<T>& runner, const TopologyData& topology, std::size_t dimension,
              bool normals, CornerValues<T>* memory) noexcept
      : runner_(runner), topology_(topology), dimension_(dimension), normals_(normals),
        memory_(memory) {
    std::fill_n(known_, kBlocks, ~std::size_t(0));
    std::fill_n(x_, kMaxLanes + 2, T(0.5));
    x_[0] = y_[0] = T(-0.5);
    std::fill_n(y_ + 1, kMaxLanes + 1, T(0.5));
    runs_[0] = {y_, 1, RowKind::edge_v0};
    runs_[1] = {y_ + 1, 1, RowKind::edge_v1};
  }

  /// Corner 4 * patch + corner. Valid until the next call.
  const CornerValues<T>& at(std::uint32_t corner) noexcept {
    const std::size_t block = corner / kBlockCorners;
    const std::size_t slot = block % kBlocks;
    CornerValues<T>* const values = memory_ + slot * kBlockCorners;
    if (known_[slot] != block) [[unlikely]] {
      known_[slot] = block;
      evaluate(block * kBlockPatches, values);
    }
    return values[corner % kBlockCorners];
  }
  /// Copies a corner to sample `to` of planes.
  void fetch(std::uint32_t corner, const Planes<T>& position, const Planes<T>& normal,
             std::size_t to) noexcept {
    const CornerValues<T>& known = at(corner);
    for (std::size_t c = 0; c < dimension_; ++c) {
      position.component[c][to] = known.position[c];
    }
    for (std::size_t c = 0; c < 3 && normals_; ++c) {
      normal.component[c][to] = known.normal[c];
    }
  }

private:
  static constexpr std::size_t kBlocks = 64;
  static constexpr std::size_t kBlockPatches = 8;
  static constexpr std::size_t kBlockCorners = kBlockPatches * kPatchCorners;

  __attribute__((noinline)) void evaluate(std::size_t first, CornerValues<T>* values) noexcept {
    const std::size_t last = std::min(topology_.patches(), first + kBlockPatches);
    for (std::size_t patch = first; patch < last;) {
      const std::size_t count = runner_.together(patch, last - patch);
      const std::size_t at = kPatchCorners * (patch - first);
      PieceTarget<T> target;
      for (std::size_t c = 0; c < dimension_; ++c) {
        target.position.component[c] = planes_[c] + at;
      }
      for (std::size_t c = 0; c < 3 && normals_; ++c) {
        target.normal.component[c] = planes_[3 + c] + at;
      }
      runner_.run(patch, count, {x_, 2, runs_, 2, 2}, target);
      patch += count;
    }
    for (std::size_t k = 0; k < kPatchCorners * (last - first); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        values[k].position[c] = planes_[c][k];
        values[k].normal[c] = planes_[3 + c][k];
      }
      const unsigned points = normals_ ? topology_.short_sides_at(kPatchCorners * first + k) : 0;
      if (points != 0) {
        runner_.find_corner_normal(first + k / kPatchCorners, k % kPatchCorners, points,
                                   values[k].normal);
      }
    }
  }

  PatchRunner<T>& runner_;
  const TopologyData& topology_;
  std::size_t dimension_;
  bool normals_;
  CornerValues<T>* memory_;
  T planes_[6][kBlockCorners] = {}; ///< what kernels write: positions, then normals
  std::size_t known_[kBlocks];
  T x_[kMaxLanes + 2];
  T y_[kMaxLanes + 2];
  RowRun<T> runs_[2];
};

} // namespace simdbezier::detail
