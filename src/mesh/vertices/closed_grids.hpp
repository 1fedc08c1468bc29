// Samples of patches of few cells: inner points, edges and corners alike, as one grid that ends at
// the patch's edges. A kernel that takes a register of such patches needs as long for all of them
// as another one for a single side. Of other patches, there are the corners.
//
// A vertex on the boundary is asked for by each of its patches. Consecutive patches have neighbours
// that are consecutive, so blocks of them are evaluated and kept for a while. In a block, patches
// of equal rates go together. Where too many rates differ, it holds corners only.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/vertices/patch_copies.hpp"
#include "src/mesh/vertices/patch_runner.hpp"
#include "src/mesh/vertices/vertex_samples.hpp"

namespace simdbezier::detail {

/// The samples of one patch, row after row.
template <typename T>
struct ClosedGrid {
  static constexpr std::uint32_t kNone = ~0U;

  const VertexSample<T>* first = nullptr;
  std::uint32_t patch = kNone;
  T sign = 1;         ///< of normals
  bool whole = false; ///< not only the patch's corners
  std::uint8_t columns = 0;
  std::uint8_t corners[4] = {}; ///< their samples

  [[nodiscard]] SampleRun<T> corner(std::size_t corner) const noexcept {
    return {first + corners[corner], 0, sign};
  }
  /// The samples of a side between its ends. reversed: from its second end on.
  [[nodiscard]] SampleRun<T> side(std::size_t side, bool reversed) const noexcept {
    const std::ptrdiff_t along = runs_in_u(side) ? 1 : columns;
    const std::ptrdiff_t step = reversed ? -along : along;
    const std::size_t end = kSideCorners[side % kPatchEdges][reversed ? 1 : 0];
    return {first + corners[end] + step, step, sign};
  }
};

/// One thread's blocks.
template <typename T>
class ClosedGrids {
public:
  /// Patches of at most so many cells in each direction have all of their samples.
  static constexpr std::uint32_t kMostRate = 5;

  [[nodiscard]] static std::size_t bytes(const MeshData& mesh) noexcept {
    return samples_bytes(mesh) + PatchCopies<T>::bytes(kPatches);
  }
  ClosedGrids(const MeshData& mesh, PatchRunner<T>& runner, bool normals,
              unsigned char* memory) noexcept
      : mesh_(mesh), topology_(*mesh.topology.data()), runner_(runner), normals_(normals),
        samples_(reinterpret_cast<VertexSample<T>*>(memory)), block_samples_(block_samples(mesh)),
        copies_(kPatches, memory + samples_bytes(mesh)) {}

  /// Says that one more patch's vertices are asked for.
  void count_patch() noexcept { ++passed_; }
  /// A patch's grid. If another one is asked for, it is still there if its `patch` is the same.
  [[nodiscard]] const ClosedGrid<T>& of(std::size_t patch) noexcept {
    const ClosedGrid<T>& grid = grids_[place_of(patch)];
    return grid.patch == patch ? grid : find(patch);
  }

private:
  static constexpr std::size_t kPatches = 64; ///< of a block
  static constexpr std::size_t kBlocks = 8;

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
  };
  /// Patches of a block one after the other, or the first copies.
  struct Group {
    std::size_t first;
    std::size_t count;
    Rates rates;
  };

  /// A register of patches is written, however few of them there are.
  static std::size_t block_samples(const MeshData& mesh) noexcept {
    const std::size_t side = std::min(kMostRate, mesh.most_rate()) + std::size_t{1};
    return (kPatches + kMaxLanes) * side * side;
  }
  /// A single patch's corners follow the blocks.
  static std::size_t samples_bytes(const MeshData& mesh) noexcept {
    const std::size_t blocks = std::min(kBlocks, mesh.patches() / kPatches + 1);
    return whole_lines((blocks * block_samples(mesh) + kPatchCorners) * sizeof(VertexSample<T>));
  }

  /// Patches that are a power of two apart, as neighbours may be, do not share a place.
  static std::size_t place_of(std::size_t patch) noexcept {
    constexpr std::size_t kAll = kBlocks * kPatches;
    return (patch + patch / kAll * kPatches) % kAll;
  }
  /// Makes a grid known, with its block unless neighbours are so far apart that blocks do not pay.
  [[gnu::noinline]] const ClosedGrid<T>& find(std::size_t patch) noexcept {
    if (kPatches * filled_ <= 4 * (passed_ + kPatches)) {
      ++filled_;
      const std::size_t first = place_of(patch) / kPatches * kPatches;
      fill(patch / kPatches * kPatches, samples_ + first / kPatches * block_samples_,
           grids_ + first);
      return grids_[place_of(patch)];
    }
    if (single_.patch != patch) {
      const std::size_t blocks = std::min(kBlocks, mesh_.patches() / kPatches + 1);
      const Group group{patch, 1, {1, 1}};
      VertexSample<T>* const samples = samples_ + blocks * block_samples_;
      evaluate(group, nullptr, samples);
      single_ = grid_of(group.rates);
      finish(patch, group.rates, samples, single_);
    }
    return single_;
  }

  void fill(std::size_t first, VertexSample<T>* samples, ClosedGrid<T>* grids) noexcept {
    const std::size_t count = std::min(kPatches, mesh_.patches() - first);
    const std::uint32_t bucket = runner_.bucket_of(first);
    const bool together = runner_.together(first, count) == count;
    bool can_copy = runner_.takes_closed_grids(bucket);
    for (std::size_t k = 1; k < count && !together; ++k) {
      can_copy = can_copy && runner_.bucket_of(first + k) == bucket;
    }
    std::uint8_t keys[kPatches];
    const std::uint32_t found = find_keys(first, count, can_copy, keys);
    const bool alike = std::popcount(found) == 1;
    std::size_t end[Rates::kKeys + 1] = {}; // of each group, once its members are in their places
    std::uint8_t member[kPatches] = {};     // of the groups, one after the other
    if (alike) {
      std::iota(member, member + count, std::uint8_t(0));
      end[keys[0]] = count;
    } else {
      sort_members(keys, count, member, end);
    }
    const bool copied = can_copy && !(alike && together);
    for (std::size_t at = 0; at < count;) {
      const Rates rates = Rates::of_key(keys[member[at]]);
      std::size_t behind = end[keys[member[at]]];
      if (copied) {
        copy(first, {member + at, behind - at}, at == 0 ? runner_.lanes() : 0);
        evaluate({0, behind - at, rates}, &bucket, samples);
      } else {
        const std::size_t patch = first + member[at];
        std::size_t more = 1;
        while (at + more < behind && member[at + more] == member[at] + more) {
          ++more;
        }
        behind = at + runner_.together(patch, more);
        evaluate({patch, behind - at, rates}, nullptr, samples);
      }
      const ClosedGrid<T> grid = grid_of(rates);
      for (; at < behind; ++at, samples += rates.samples()) {
        grids[member[at]] = grid;
        finish(first + member[at], rates, samples, grids[member[at]]);
      }
    }
    std::fill(grids + count, grids + kPatches, ClosedGrid<T>{});
  }
  /// Finds the keys of the grids' rates in a block. They are those of corners if that is better:
  /// where no kernel takes closed grids, but one takes edges; to copy doubles takes as long as what
  /// it saves; floats are copied unless registers remain too empty. Copies of more than 4 x 4
  /// samples pay for floats alone. Returns the set of all keys.
  std::uint32_t find_keys(std::size_t first, std::size_t count, bool can_copy,
                          std::uint8_t* keys) const noexcept {
    const std::uint32_t* const nu = mesh_.nu.data() + first;
    const std::uint32_t* const nv = mesh_.nv.data() + first;
    const std::uint32_t most = sizeof(T) == sizeof(float) || !can_copy ? kMostRate : 3;
    std::uint32_t found = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const bool few = nu[k] <= most && nv[k] <= most;
      keys[k] = static_cast<std::uint8_t>(few ? Rates{nu[k], nv[k]}.key() : 0);
      found |= 1U << keys[k];
    }
    constexpr std::size_t kLeastMembers = 5;
    const auto groups = static_cast<std::size_t>(std::popcount(found));
    const bool pays =
        groups == 1 || (sizeof(T) == sizeof(float) && kLeastMembers * groups <= count);
    if (can_copy ? pays : !runner_.has_edges(runner_.bucket_of(first))) {
      return found;
    }
    std::fill_n(keys, count, std::uint8_t(0));
    return 1;
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

  /// Copies the members of a group, and the last one once more for each of `least` copies that is
  /// left.
  void copy(std::size_t first, std::span<const std::uint8_t> members, std::size_t least) noexcept {
    for (std::size_t k = 0; k < std::max(members.size(), least); ++k) {
      runner_.copy(first + members[std::min(k, members.size() - 1)], copies_, k);
    }
  }

  /// bucket: that of the copies; null where they are patches. Copies of the groups before fill a
  /// group's register; the next group writes over their samples.
  void evaluate(const Group& group, const std::uint32_t* bucket, VertexSample<T>* to) noexcept {
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
                                   inner ? std::size_t{3} : std::size_t{2}, group.rates.samples()};
    if (bucket != nullptr) {
      runner_.sample(copies_, *bucket, std::max(group.count, runner_.lanes()), piece, to);
    } else {
      runner_.sample(group.first, group.count, piece, to);
    }
  }
  static void fill_line(std::uint32_t rate, T* line) noexcept {
    for (std::uint32_t i = 0; i <= rate; ++i) {
      line[i] = uniform_parameter<T>(i, rate);
    }
    std::fill_n(line + rate + 1, kMaxLanes, T(0.5));
  }
  /// A grid of some rates.
  static ClosedGrid<T> grid_of(const Rates& rates) noexcept {
    const auto byte = [](std::uint32_t value) { return static_cast<std::uint8_t>(value); };
    const std::uint32_t last_row = (rates.u + 1) * rates.v;
    ClosedGrid<T> grid;
    grid.columns = byte(rates.u + 1);
    grid.corners[1] = byte(rates.u);
    grid.corners[2] = byte(last_row);
    grid.corners[3] = byte(last_row + rates.u);
    return grid;
  }
  /// Makes it that of a patch, and finds normals in corners whose sides count as points.
  void finish(std::size_t patch, const Rates& rates, VertexSample<T>* samples,
              ClosedGrid<T>& grid) const noexcept {
    grid.first = samples;
    grid.patch = static_cast<std::uint32_t>(patch);
    grid.sign = topology_.is_turned(patch) ? T(-1) : T(1);
    grid.whole = mesh_.nu[patch] == rates.u && mesh_.nv[patch] == rates.v;
    for (std::size_t k = 0; k < kPatchCorners && normals_ && !topology_.displacement.empty(); ++k) {
      const unsigned points = topology_.short_sides_at(kPatchCorners * patch + k);
      if (points != 0) {
        T normal[3];
        runner_.find_corner_normal(patch, k, points, normal);
        for (std::size_t c = 0; c < 3; ++c) {
          samples[grid.corners[k]].normal[c] = normal[c];
        }
      }
    }
  }

  const MeshData& mesh_;
  const TopologyData& topology_;
  PatchRunner<T>& runner_;
  bool normals_;
  VertexSample<T>* samples_;
  std::size_t block_samples_;
  PatchCopies<T> copies_;
  ClosedGrid<T> grids_[kBlocks * kPatches];
  ClosedGrid<T> single_;
  std::size_t filled_ = 0;
  std::size_t passed_ = 0;
};

} // namespace simdbezier::detail
