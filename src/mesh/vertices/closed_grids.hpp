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
#include <numeric>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/vertices/merged_normals.hpp"
#include "src/mesh/vertices/parameter_lines.hpp"
#include "src/mesh/vertices/patch_copies.hpp"
#include "src/mesh/vertices/patch_runner.hpp"

namespace simdbezier::detail {

/// The samples of one patch, in planes of unit stride: those of positions, then those of normals.
/// Planes that are not wanted are there, but have no values.
template <typename T>
struct ClosedGrid {
  /// Patches of at most so many cells in each direction have all of their samples.
  static constexpr std::uint32_t kMostRate = 5;
  static constexpr std::size_t kPatches = 64; ///< of a block
  static constexpr std::size_t kMostSamples = (kMostRate + 1) * (kMostRate + 1);
  /// Values of a plane: a register of patches is written, however few of them there are.
  static constexpr std::size_t kPlane = (kPatches + kMaxLanes) * kMostSamples;

  const T* first;
  std::uint8_t columns;
  std::uint8_t rows;
  bool whole;              ///< not only the patch's corners
  std::uint8_t corners[4]; ///< their samples

  [[nodiscard]] SampleRun<T> corner(std::size_t corner, bool turned) const noexcept {
    return run(corners[corner], 0, turned);
  }
  /// The samples of a side between its ends. reversed: from its second end on.
  [[nodiscard]] SampleRun<T> side(std::size_t side, bool reversed, bool turned) const noexcept {
    const std::ptrdiff_t along = runs_in_u(side) ? 1 : columns;
    const std::ptrdiff_t step = reversed ? -along : along;
    return run(corners[kSideCorners[side % kPatchEdges][reversed ? 1 : 0]] + step, step, turned);
  }

private:
  [[nodiscard]] SampleRun<T> run(std::ptrdiff_t sample, std::ptrdiff_t step,
                                 bool turned) const noexcept {
    const T* const at = first + sample;
    return {at, at + 3 * kPlane, kPlane, step, turned ? T(-1) : T(1)};
  }
};

/// One thread's blocks.
template <typename T>
class ClosedGrids {
public:
  static constexpr std::uint32_t kMostRate = ClosedGrid<T>::kMostRate;

  [[nodiscard]] static std::size_t bytes(const MeshData& mesh) noexcept {
    return blocks_bytes(mesh) + PatchCopies<T>::bytes(kPatches + kMaxLanes);
  }
  ClosedGrids(const MeshData& mesh, PatchRunner<T>& runner, ParameterLines<T>& lines,
              bool positions, bool normals, unsigned char* memory) noexcept
      : mesh_(mesh), runner_(runner), lines_(lines), positions_(positions), normals_(normals),
        exists_(runner.takes_closed_grids()), values_(reinterpret_cast<T*>(memory)),
        copies_(kPatches + kMaxLanes, memory + blocks_bytes(mesh)) {
    std::fill_n(known_, kBlocks, kNone);
    std::fill_n(useless_, kBlocks, kNone);
  }

  /// Whether the grids of two patches can be there at once.
  [[nodiscard]] static bool are_apart(std::size_t a, std::size_t b) noexcept {
    return a / kPatches == b / kPatches || a / kPatches % kBlocks != b / kPatches % kBlocks;
  }
  /// Says that so many grids are asked for, besides those that of() is.
  void count(std::size_t asked) noexcept { asked_ += asked; }
  /// Whether a patch's grid is there, and the grid.
  [[nodiscard]] bool is_known(std::size_t patch) const noexcept {
    const std::size_t number = patch / kPatches;
    return known_[number % kBlocks] == number;
  }
  [[nodiscard]] const ClosedGrid<T>& known(std::size_t patch) const noexcept {
    return grids_[patch % (kBlocks * kPatches)];
  }
  /// A patch's grid; null where there is none, or where blocks are asked for too seldom to pay.
  /// Valid until one is asked for that is not apart.
  const ClosedGrid<T>* of(std::size_t patch) noexcept {
    ++asked_;
    return is_known(patch) || find(patch / kPatches) ? &known(patch) : nullptr;
  }

private:
  static constexpr std::size_t kPatches = ClosedGrid<T>::kPatches;
  static constexpr std::size_t kPlane = ClosedGrid<T>::kPlane;
  static constexpr std::size_t kBlocks = 8;
  static constexpr std::size_t kNone = ~std::size_t(0);

  struct Rates {
    std::uint32_t u;
    std::uint32_t v;

    static constexpr std::size_t kKeys = kMostRate * kMostRate;
    static_assert(kKeys <= 32);
    static Rates of_key(std::size_t key) noexcept {
      return {static_cast<std::uint32_t>(key % kMostRate + 1),
              static_cast<std::uint32_t>(key / kMostRate + 1)};
    }
    [[nodiscard]] std::size_t key() const noexcept { return (v - 1) * kMostRate + u - 1; }
    [[nodiscard]] std::size_t samples() const noexcept { return std::size_t{u + 1} * (v + 1); }
    /// A grid but for its place.
    [[nodiscard]] ClosedGrid<T> grid() const noexcept {
      const auto byte = [](std::uint32_t value) { return static_cast<std::uint8_t>(value); };
      const std::uint32_t last_row = (u + 1) * v;
      return {nullptr,
              byte(u + 1),
              byte(v + 1),
              false,
              {0, byte(u), byte(last_row), byte(last_row + u)}};
    }
  };
  /// Patches of equal rates.
  struct Group {
    std::size_t first; ///< patch of the set, or copy
    std::size_t count;
    bool copied;
    Rates rates;
  };

  static std::size_t blocks_bytes(const MeshData& mesh) noexcept {
    return std::min(kBlocks, mesh.patches() / kPatches + 1) * 6 * kPlane * sizeof(T);
  }
  /// Finds the keys of the grids' rates in a block. They are those of corners if that is better: to
  /// copy doubles takes as long as what it saves; floats are copied unless registers remain too
  /// empty. Returns the set of all keys.
  std::uint32_t find_keys(std::size_t first, std::size_t count, std::uint8_t* keys) const noexcept {
    const std::uint32_t* const nu = mesh_.nu.data() + first;
    const std::uint32_t* const nv = mesh_.nv.data() + first;
    std::uint32_t found = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const bool few = nu[k] <= kMostRate && nv[k] <= kMostRate;
      keys[k] = static_cast<std::uint8_t>(few ? Rates{nu[k], nv[k]}.key() : 0);
      found |= 1U << keys[k];
    }
    constexpr std::size_t kLeastMembers = 5;
    const auto groups = static_cast<std::size_t>(std::popcount(found));
    if (groups == 1 || (sizeof(T) == sizeof(float) && kLeastMembers * groups <= count)) {
      return found;
    }
    std::fill_n(keys, count, std::uint8_t(0));
    return 1;
  }

  /// Makes a block of grids known. False where there are none.
  [[gnu::noinline]] bool find(std::size_t number) noexcept {
    const std::size_t slot = number % kBlocks;
    if (!exists_ || useless_[slot] == number || kPatches * filled_ > asked_ + 4 * kPatches) {
      return false;
    }
    const bool filled = fill(number);
    (filled ? known_ : useless_)[slot] = number;
    return filled;
  }
  /// False where the patches are not all of one shape that kernels for closed grids know.
  bool fill(std::size_t number) noexcept {
    const std::size_t first = number * kPatches;
    const std::size_t count = std::min(kPatches, mesh_.patches() - first);
    const std::uint32_t bucket = runner_.edge_bucket(first);
    const bool together = runner_.together(first, count) == count;
    for (std::size_t k = 1; k < count && !together; ++k) {
      if (runner_.edge_bucket(first + k) != bucket) {
        return false;
      }
    }
    if (bucket == PatchRunner<T>::kNoEdges) {
      return false;
    }
    ++filled_;
    std::uint8_t keys[kPatches];
    const std::uint32_t found = find_keys(first, count, keys);
    std::size_t end[Rates::kKeys + 1] = {}; // of each group, once its members are in their places
    std::uint8_t member[kPatches] = {};     // of the groups, one after the other
    const bool alike = std::popcount(found) == 1;
    if (alike) {
      std::iota(member, member + count, std::uint8_t(0));
      end[keys[0]] = count;
    } else {
      sort_members(keys, count, member, end);
    }
    const bool copied = !together || !alike;
    if (copied) {
      const std::size_t last = keys[member[count - 1]];
      make_copies(first, member, count, count - (last == 0 ? 0 : end[last - 1]));
    }
    const std::size_t slot = number % kBlocks;
    T* values = values_ + slot * 6 * kPlane;
    for (std::size_t at = 0; at < count;) {
      const Rates rates = Rates::of_key(keys[member[at]]);
      const std::size_t behind = end[keys[member[at]]];
      evaluate(bucket, {copied ? at : first, behind - at, copied, rates}, values);
      ClosedGrid<T> grid = rates.grid();
      for (; at < behind; ++at, values += rates.samples()) {
        const std::size_t patch = first + member[at];
        grid.first = values;
        grid.whole = mesh_.nu[patch] == rates.u && mesh_.nv[patch] == rates.v;
        grids_[slot * kPatches + member[at]] = grid;
      }
    }
    return true;
  }
  static void sort_members(const std::uint8_t* keys, std::size_t count, std::uint8_t* member,
                           std::size_t (&end)[Rates::kKeys + 1]) noexcept {
    for (std::size_t k = 0; k < count; ++k) {
      ++end[keys[k] + 1];
    }
    for (std::size_t key = 0; key < Rates::kKeys; ++key) {
      end[key + 1] += end[key];
    }
    for (std::size_t k = 0; k < count; ++k) {
      member[end[keys[k]]++] = static_cast<std::uint8_t>(k);
    }
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
  void evaluate(std::uint32_t bucket, const Group& group, T* values) noexcept {
    const PieceTarget<T> to = target(values);
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
  [[nodiscard]] PieceTarget<T> target(T* values) const noexcept {
    PieceTarget<T> to;
    for (std::size_t c = 0; c < 3; ++c) {
      to.position.component[c] = positions_ ? values + c * kPlane : nullptr;
      to.normal.component[c] = normals_ ? values + (3 + c) * kPlane : nullptr;
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
  std::size_t known_[kBlocks];   ///< blocks whose grids are there
  std::size_t useless_[kBlocks]; ///< blocks that cannot have any
  ClosedGrid<T> grids_[kBlocks * kPatches];
  std::size_t filled_ = 0;
  std::size_t asked_ = 0;
};

} // namespace simdbezier::detail
