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

/// One thread's cache.
template <typename T>
class CornerCache {
public:
  /// Values of scratch, for corners of `planes` values each.
  [[nodiscard]] static std::size_t memory_values(std::size_t planes) noexcept {
    return kBlocks * kBlockCorners * planes + PointBlock<T>::kPoints;
  }
  CornerCache(PatchRunner<T>& runner, std::size_t patches, std::size_t dimension, bool normals,
              T* memory) noexcept
      : runner_(runner), patches_(patches), dimension_(dimension), normals_(normals),
        memory_(memory) {
    std::fill_n(known_, kBlocks, ~std::size_t(0));
    std::fill_n(x_, kMaxLanes + 2, T(0.5));
    x_[0] = y_[0] = T(-0.5);
    std::fill_n(y_ + 1, kMaxLanes + 1, T(0.5));
    runs_[0] = {y_, 1, RowKind::edge_v0};
    runs_[1] = {y_ + 1, 1, RowKind::edge_v1};
  }

  /// What is known of corner 4 * patch + corner, as sample 0 of planes of which a PointBlock may be
  /// read. Valid until the next call.
  void look_up(std::uint32_t corner, Planes<T>& position, Planes<T>& normal) noexcept {
    const std::size_t block = corner / kBlockCorners;
    const std::size_t slot = block % kBlocks;
    T* const values = memory_ + slot * kBlockCorners * planes();
    if (known_[slot] != block) {
      known_[slot] = block;
      evaluate(block * kBlockPatches, values);
    }
    T* from = values + corner % kBlockCorners;
    for (std::size_t c = 0; c < dimension_; ++c, from += kBlockCorners) {
      position.component[c] = from;
    }
    for (std::size_t c = 0; c < 3 && normals_; ++c, from += kBlockCorners) {
      normal.component[c] = from;
    }
  }
  /// Copies it to sample `at` of planes.
  void fetch(std::uint32_t corner, const Planes<T>& position, const Planes<T>& normal,
             std::size_t at) noexcept {
    Planes<T> known_position;
    Planes<T> known_normal;
    look_up(corner, known_position, known_normal);
    for (std::size_t c = 0; c < dimension_; ++c) {
      position.component[c][at] = *known_position.component[c];
    }
    for (std::size_t c = 0; c < 3 && normals_; ++c) {
      normal.component[c][at] = *known_normal.component[c];
    }
  }

private:
  static constexpr std::size_t kBlocks = 64;
  static constexpr std::size_t kBlockPatches = 8;
  static constexpr std::size_t kBlockCorners = kBlockPatches * kPatchCorners;

  [[nodiscard]] std::size_t planes() const noexcept { return dimension_ + (normals_ ? 3 : 0); }

  void evaluate(std::size_t first, T* values) noexcept {
    const std::size_t last = std::min(patches_, first + kBlockPatches);
    for (std::size_t patch = first; patch < last;) {
      const std::size_t count = runner_.together(patch, last - patch);
      T* const to = values + kPatchCorners * (patch - first);
      PieceTarget<T> target;
      for (std::size_t c = 0; c < dimension_; ++c) {
        target.position.component[c] = to + c * kBlockCorners;
      }
      for (std::size_t c = 0; c < 3 && normals_; ++c) {
        target.normal.component[c] = to + (dimension_ + c) * kBlockCorners;
      }
      runner_.run(patch, count, {x_, 2, runs_, 2, 2}, target);
      patch += count;
    }
  }

  PatchRunner<T>& runner_;
  std::size_t patches_;
  std::size_t dimension_;
  bool normals_;
  T* memory_;
  std::size_t known_[kBlocks];
  T x_[kMaxLanes + 2];
  T y_[kMaxLanes + 2];
  RowRun<T> runs_[2];
};

} // namespace simdbezier::detail
