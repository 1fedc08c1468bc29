// Samples of patches of few cells: inner points, edges and corners alike, as one grid that ends at
// the patch's edges. A kernel that takes a register of such patches needs as long for all of them
// as another one for a single side.
//
// A vertex on an edge is asked for by both patches. Consecutive patches have neighbours that are
// consecutive, so blocks of them are evaluated and kept for a while. In a block, patches of equal
// rates go together. Of patches with more cells, and where too many rates differ, it holds the
// corners.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/vertices/parameter_lines.hpp"
#include "src/mesh/vertices/patch_copies.hpp"
#include "src/mesh/vertices/patch_runner.hpp"

namespace simdbezier::detail {

/// The samples of one patch, in planes of unit stride: those of the positions, if they are wanted,
/// and then those of the normals.
template <typename T>
struct ClosedGrid {
  const T* first;
  std::uint32_t plane; ///< values from one plane to the next
  std::uint16_t columns;
  std::uint16_t rows;

  [[nodiscard]] std::size_t corner(std::size_t corner) const noexcept {
    return sample(corner % 2 == 0 ? 0 : columns - 1U, corner / 2 == 0 ? 0 : rows - 1U);
  }
  /// Point k of a side, in its own direction.
  [[nodiscard]] std::size_t side_point(std::size_t side, std::size_t k) const noexcept {
    const bool far = side % 2 != 0;
    return runs_in_u(side) ? sample(k, far ? rows - 1U : 0) : sample(far ? columns - 1U : 0, k);
  }
  [[nodiscard]] std::size_t sample(std::size_t column, std::size_t row) const noexcept {
    return row * columns + column;
  }
};

/// One thread's blocks.
template <typename T>
class ClosedGrids {
public:
  /// Patches of at most so many cells in each direction have all of their samples.
  static constexpr std::uint32_t kMostRate = 5;

  [[nodiscard]] static std::size_t bytes(const MeshData& mesh, bool positions,
                                         bool normals) noexcept {
    return blocks_bytes(mesh, positions, normals) + PatchCopies<T>::bytes(kPatches + kMaxLanes);
  }
  ClosedGrids(const MeshData& mesh, PatchRunner<T>& runner, ParameterLines<T>& lines,
              bool positions, bool normals, unsigned char* memory) noexcept
      : mesh_(mesh), runner_(runner), lines_(lines), positions_(positions), normals_(normals),
        exists_(runner.takes_closed_grids()), values_(reinterpret_cast<T*>(memory)),
        copies_(kPatches + kMaxLanes, memory + blocks_bytes(mesh, positions, normals)) {}

  /// Whether a patch's grid has all of its samples.
  [[nodiscard]] bool is_whole(const ClosedGrid<T>& grid, std::size_t patch) const noexcept {
    return grid.columns == mesh_.nu[patch] + 1 && grid.rows == mesh_.nv[patch] + 1;
  }
  /// Whether the grids of two patches can be there at once.
  [[nodiscard]] static bool are_apart(std::size_t a, std::size_t b) noexcept {
    return a / kPatches == b / kPatches || a / kPatches % kBlocks != b / kPatches % kBlocks;
  }
  /// A patch's grid; null where there is none, or where blocks are asked for too seldom to pay.
  /// Valid until one is asked for that is not apart.
  const ClosedGrid<T>* of(std::size_t patch) noexcept {
    if (!exists_) {
      return nullptr;
    }
    ++asked_;
    const std::size_t number = patch / kPatches;
    Block& block = blocks_[number % kBlocks];
    if (block.number != number) [[unlikely]] {
      if (kPatches * filled_ > asked_ + 4 * kPatches) {
        return nullptr;
      }
      block.number = number;
      block.usable = fill(number, block);
    }
    return block.usable ? &block.grid[patch % kPatches] : nullptr;
  }

  /// These read a sample; `position` or `normal` stays as it is where it is not wanted.
  void read_position(const ClosedGrid<T>& grid, std::size_t sample,
                     T (&position)[3]) const noexcept {
    if (positions_) {
      read(grid.first + sample, grid.plane, position);
    }
  }
  void read_normal(const ClosedGrid<T>& grid, std::size_t sample, T (&normal)[3]) const noexcept {
    if (normals_) {
      const std::size_t before = positions_ ? 3 : 0;
      read(grid.first + before * grid.plane + sample, grid.plane, normal);
    }
  }

private:
  static void read(const T* from, std::size_t plane, T (&values)[3]) noexcept {
    for (std::size_t c = 0; c < 3; ++c) {
      values[c] = from[c * plane];
    }
  }

  static constexpr std::size_t kPatches = 64;
  static constexpr std::size_t kBlocks = 8;
  static constexpr std::size_t kNone = ~std::size_t(0);
  static constexpr std::size_t kMostSamples = (kMostRate + 1) * (kMostRate + 1);
  /// Of a plane: a register of patches is written, however few of them there are.
  static constexpr std::size_t kPlaneValues = (kPatches + kMaxLanes) * kMostSamples;

  struct Block {
    std::size_t number = kNone;
    bool usable = false;
    ClosedGrid<T> grid[kPatches];
  };
  struct Rates {
    std::uint32_t u;
    std::uint32_t v;

    static constexpr std::size_t kKeys = kMostRate * kMostRate;
    static_assert(kKeys <= 32);
    [[nodiscard]] std::size_t key() const noexcept { return (v - 1) * kMostRate + u - 1; }
    [[nodiscard]] std::size_t samples() const noexcept { return std::size_t{u + 1} * (v + 1); }
  };
  /// Patches of equal rates.
  struct Group {
    std::size_t first; ///< patch of the set, or copy
    std::size_t count;
    bool copied;
    Rates rates;
  };

  static std::size_t blocks_bytes(const MeshData& mesh, bool positions, bool normals) noexcept {
    return std::min(kBlocks, mesh.patches() / kPatches + 1) * block_values(positions, normals) *
           sizeof(T);
  }
  static std::size_t block_values(bool positions, bool normals) noexcept {
    return ((positions ? 3 : 0) + (normals ? 3 : 0)) * kPlaneValues;
  }
  /// The rates of a patch's grid. whole: not only of its corners.
  [[nodiscard]] Rates rates_of(std::size_t patch, bool whole) const noexcept {
    const std::uint32_t nu = mesh_.nu[patch];
    const std::uint32_t nv = mesh_.nv[patch];
    return whole && nu <= kMostRate && nv <= kMostRate ? Rates{nu, nv} : Rates{1, 1};
  }
  /// Whether patches of a block are worth more than their corners. To copy doubles takes as long as
  /// what it saves; floats are copied unless registers remain too empty.
  [[nodiscard]] bool pays(std::size_t first, std::size_t count) const noexcept {
    std::uint32_t found = 0;
    for (std::size_t k = 0; k < count; ++k) {
      found |= 1U << rates_of(first + k, true).key();
    }
    constexpr std::size_t kLeastMembers = 5;
    const auto groups = static_cast<std::size_t>(std::popcount(found));
    return groups == 1 || (sizeof(T) == sizeof(float) && kLeastMembers * groups <= count);
  }

  /// False where the patches are not all of one shape that kernels for closed grids know.
  [[gnu::noinline]] bool fill(std::size_t number, Block& block) noexcept {
    const std::size_t first = number * kPatches;
    const std::size_t count = std::min(kPatches, mesh_.patches() - first);
    const std::uint32_t bucket = runner_.edge_bucket(first);
    for (std::size_t k = 0; k < count; ++k) {
      if (bucket == PatchRunner<T>::kNoEdges || runner_.edge_bucket(first + k) != bucket) {
        return false;
      }
    }
    ++filled_;
    const bool whole = pays(first, count);
    std::size_t end[Rates::kKeys + 1] = {}; // of each group, once its members are in their places
    std::size_t samples = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Rates rates = rates_of(first + k, whole);
      ++end[rates.key() + 1];
      samples += rates.samples();
    }
    const bool alike = end[rates_of(first, whole).key() + 1] == count;
    for (std::size_t key = 0; key < Rates::kKeys; ++key) {
      end[key + 1] += end[key];
    }
    const std::size_t plane = samples + kMaxLanes * kMostSamples;
    std::uint8_t member[kPatches]; // of the groups, one after the other
    for (std::size_t k = 0; k < count; ++k) {
      member[end[rates_of(first + k, whole).key()]++] = static_cast<std::uint8_t>(k);
    }
    const bool copied = !alike || runner_.together(first, count) < count;
    if (copied) {
      const std::size_t last = rates_of(first + member[count - 1], whole).key();
      make_copies(first, member, count, count - (last == 0 ? 0 : end[last - 1]));
    }
    T* values = values_ + number % kBlocks * block_values(positions_, normals_);
    for (std::size_t at = 0; at < count;) {
      const Rates rates = rates_of(first + member[at], whole);
      const std::size_t behind = end[rates.key()];
      evaluate(bucket, {copied ? at : first, behind - at, copied, rates}, target(values, plane));
      for (; at < behind; ++at, values += rates.samples()) {
        block.grid[member[at]] = {values, static_cast<std::uint32_t>(plane),
                                  static_cast<std::uint16_t>(rates.u + 1),
                                  static_cast<std::uint16_t>(rates.v + 1)};
      }
    }
    return true;
  }

  /// Copies the members of groups in the order in which they are read fastest. If the last group,
  /// of `last_count` members, fills no register, more copies of its last one follow.
  void make_copies(std::size_t first, const std::uint8_t* member, std::size_t count,
                   std::size_t last_count) noexcept {
    std::uint8_t copy[kPatches];
    for (std::size_t k = 0; k < count; ++k) {
      copy[member[k]] = static_cast<std::uint8_t>(k);
    }
    for (std::size_t k = 0; k < count; ++k) {
      runner_.copy(first + k, copies_, copy[k], normals_);
    }
    for (std::size_t k = last_count; k < runner_.lanes(); ++k) {
      runner_.copy(first + member[count - 1], copies_, count + k - last_count, normals_);
    }
  }

  /// Copies behind the last one of a group fill its register; the next group writes over their
  /// samples.
  void evaluate(std::uint32_t bucket, const Group& group, const PieceTarget<T>& to) noexcept {
    T x[kMostRate + 1 + kMaxLanes];
    T y[kMostRate + 1 + kMaxLanes];
    const auto [nu, nv] = group.rates;
    fill_line(nu, x);
    fill_line(nv, y);
    const RowRun<T> runs[3] = {{y, 1, RowKind::edge_v0},
                               {y + 1, nv - 1, RowKind::interior},
                               {y + nv, 1, RowKind::edge_v1}};
    const RowRun<T> ends[2] = {runs[0], runs[2]};
    const bool inner = nv > 1;
    const PieceParameters<T> piece{x, nu + std::size_t{1}, inner ? runs : ends,
                                   inner ? std::size_t{3} : std::size_t{2}, nv + std::size_t{1}};
    if (group.copied) {
      runner_.run(copies_, bucket, group.first, std::max(group.count, runner_.lanes()), piece, to);
    } else {
      runner_.run(group.first, group.count, piece, to);
    }
  }
  void fill_line(std::uint32_t rate, T* line) noexcept {
    line[0] = T(-0.5);
    std::copy_n(lines_.line(rate), rate - 1, line + 1);
    std::fill_n(line + rate, kMaxLanes + 1, T(0.5));
  }
  [[nodiscard]] PieceTarget<T> target(T* values, std::size_t plane) const noexcept {
    PieceTarget<T> to;
    for (std::size_t c = 0; c < 3; ++c) {
      to.position.component[c] = positions_ ? values + c * plane : nullptr;
      to.normal.component[c] = normals_ ? values + (positions_ ? 3 + c : c) * plane : nullptr;
    }
    return to;
  }

  const MeshData& mesh_;
  PatchRunner<T>& runner_;
  ParameterLines<T>& lines_;
  bool positions_;
  bool normals_;
  bool exists_;
  T* values_;
  PatchCopies<T> copies_;
  Block blocks_[kBlocks];
  std::size_t filled_ = 0;
  std::size_t asked_ = 0;
};

} // namespace simdbezier::detail
