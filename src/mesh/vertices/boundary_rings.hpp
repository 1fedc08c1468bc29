// The boundaries of patches with equal rates, which are evaluated together: a kernel call for every
// side would take most of the time of small patches. A side is asked for by the patch that owns its
// edge. Consecutive patches ask for sides of consecutive patches, so blocks are kept for a while.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/vertices/merged_normals.hpp"
#include "src/mesh/vertices/parameter_lines.hpp"
#include "src/mesh/vertices/patch_runner.hpp"

namespace simdbezier::detail {

/// One thread's blocks of boundaries.
template <typename T>
class BoundaryRings {
public:
  /// Values of scratch, for samples of `planes` values each.
  [[nodiscard]] static std::size_t memory_values(const MeshData& mesh,
                                                 std::size_t planes) noexcept {
    return kBlocks * planes * plane_values(most_rate(mesh)) + 2 * PointBlock<T>::kPoints;
  }
  BoundaryRings(const MeshData& mesh, PatchRunner<T>& runner, ParameterLines<T>& lines,
                std::size_t dimension, bool normals, T* memory) noexcept
      : mesh_(mesh), runner_(runner), lines_(lines), dimension_(dimension),
        planes_(dimension + (normals ? 3 : 0)), plane_values_(plane_values(most_rate(mesh))),
        memory_(memory) {}

  /// Copies the samples between a side's ends, at its own rate, to planes from sample `at` on;
  /// reversed: from the last one to the first. False where the side is in none of the blocks.
  bool fetch_side(std::uint32_t side, bool reversed, const Planes<T>& position,
                  const Planes<T>& normal, std::size_t at) noexcept {
    const std::size_t patch = side / kPatchEdges;
    const Block* const block = block_of(patch);
    if (block == nullptr) {
      return false;
    }
    const std::size_t from = runs_in_u(side) ? row(patch, side % 2) : column(patch, side % 2);
    const std::size_t step = runs_in_u(side) ? 1 : 2;
    const std::size_t points = mesh_.rate(side) - 1;
    for (std::size_t p = 0; p < planes_; ++p) {
      const T* const values = block->values + p * plane_values_ + from + (step == 1 ? 1 : 0);
      copy(values, step, points, reversed, plane(position, normal, p) + at);
    }
    return true;
  }
  /// Fetches a corner, 4 * patch + corner, likewise.
  bool fetch_corner(std::uint32_t corner, const Planes<T>& position, const Planes<T>& normal,
                    std::size_t at) noexcept {
    const std::size_t patch = corner / kPatchCorners;
    const Block* const block = block_of(patch);
    if (block == nullptr) {
      return false;
    }
    const std::size_t from =
        row(patch, corner % kPatchCorners / 2) + (corner % 2 != 0 ? mesh_.nu[patch] : 0);
    for (std::size_t p = 0; p < planes_; ++p) {
      plane(position, normal, p)[at] = block->values[p * plane_values_ + from];
    }
    return true;
  }

private:
  static constexpr std::size_t kBlocks = 32;
  static constexpr std::size_t kBlockPatches = 8;
  static constexpr std::uint32_t kMost = 32;
  static constexpr std::size_t kNone = ~std::size_t(0);

  struct Block {
    std::size_t number = kNone;
    bool usable = false;
    T* values = nullptr;
  };

  static std::uint32_t most_rate(const MeshData& mesh) noexcept {
    return std::min(kMost, mesh.most_rate());
  }
  /// The values of a plane: two rows with their ends, and two columns without.
  static std::size_t plane_values(std::size_t rate) noexcept {
    return kBlockPatches * 2 * (rate + 1 + rate - 1);
  }
  /// Where a row begins in a plane, or a column, whose points are two values apart.
  [[nodiscard]] std::size_t row(std::size_t patch, std::size_t end) const noexcept {
    return (patch % kBlockPatches * 2 + end) * (mesh_.nu[patch] + 1);
  }
  [[nodiscard]] std::size_t column(std::size_t patch, std::size_t end) const noexcept {
    return columns_at(patch) + patch % kBlockPatches * 2 * (mesh_.nv[patch] - 1) + end;
  }
  [[nodiscard]] std::size_t columns_at(std::size_t patch) const noexcept {
    return kBlockPatches * 2 * (mesh_.nu[patch] + 1);
  }
  [[nodiscard]] T* plane(const Planes<T>& position, const Planes<T>& normal,
                         std::size_t p) const noexcept {
    return p < dimension_ ? position.component[p] : normal.component[p - dimension_];
  }

  static void copy(const T* from, std::size_t step, std::size_t points, bool reversed,
                   T* to) noexcept {
    if (!reversed) { // what is behind them is written later
      using Block = PointBlock<T>;
      for (std::size_t k = 0; k < points; k += Block::kPoints) {
        const auto values = step == 1 ? Block::load(from + k) : Block::load_even(from + 2 * k);
        Block::store(values, Block::kPoints, to + k, 1);
      }
      return;
    }
    for (std::size_t k = 0; k < points; ++k) {
      to[k] = from[(points - 1 - k) * step];
    }
  }

  /// The block of a patch; null where the patch is not like those beside it, or where blocks are
  /// asked for too seldom to pay.
  const Block* block_of(std::size_t patch) noexcept {
    ++asked_;
    const std::size_t number = patch / kBlockPatches;
    Block& block = blocks_[number % kBlocks];
    if (block.number != number) {
      if (8 * filled_ > asked_ + 64) {
        return nullptr;
      }
      block.number = number;
      block.values = memory_ + number % kBlocks * planes_ * plane_values_;
      block.usable = fill(number * kBlockPatches, block.values);
    }
    return block.usable ? &block : nullptr;
  }

  bool fill(std::size_t first, T* values) noexcept {
    const std::size_t count = std::min(kBlockPatches, mesh_.patches() - first);
    const std::uint32_t nu = mesh_.nu[first];
    const std::uint32_t nv = mesh_.nv[first];
    const auto alike = [&](const auto& rates, std::uint32_t rate) {
      const auto begin = rates.begin() + static_cast<std::ptrdiff_t>(first);
      return rate >= 2 && rate <= kMost &&
             std::all_of(begin, begin + static_cast<std::ptrdiff_t>(count),
                         [&](std::uint32_t other) { return other == rate; });
    };
    if (!alike(mesh_.nu, nu) || !alike(mesh_.nv, nv) || runner_.together(first, count) < count) {
      return false;
    }
    ++filled_;
    constexpr T kEnds[2] = {T(-0.5), T(0.5)};
    T x[kMost + 1 + kMaxLanes];
    T ends[2 + kMaxLanes];
    x[0] = ends[0] = kEnds[0];
    std::copy_n(lines_.line(nu), nu - 1, x + 1);
    std::fill_n(x + nu, kMaxLanes + 1, kEnds[1]);
    std::fill_n(ends + 1, kMaxLanes + 1, kEnds[1]);
    T y[2 + kMaxLanes];
    std::copy_n(ends, 2 + kMaxLanes, y);
    const RowRun<T> rows[2] = {{y, 1, RowKind::edge_v0}, {y + 1, 1, RowKind::edge_v1}};
    runner_.run(first, count, {x, nu + std::size_t{1}, rows, 2, 2}, target(values));
    const RowRun<T> inner{lines_.line(nv), nv - 1, RowKind::interior};
    runner_.run(first, count, {ends, 2, &inner, 1, nv - std::size_t{1}},
                target(values + columns_at(first)));
    return true;
  }
  [[nodiscard]] PieceTarget<T> target(T* values) const noexcept {
    PieceTarget<T> to;
    for (std::size_t p = 0; p < planes_; ++p) {
      T*& component =
          p < dimension_ ? to.position.component[p] : to.normal.component[p - dimension_];
      component = values + p * plane_values_;
    }
    return to;
  }

  const MeshData& mesh_;
  PatchRunner<T>& runner_;
  ParameterLines<T>& lines_;
  std::size_t dimension_;
  std::size_t planes_;
  std::size_t plane_values_;
  T* memory_;
  Block blocks_[kBlocks];
  std::size_t filled_ = 0;
  std::size_t asked_ = 0;
};

} // namespace simdbezier::detail
