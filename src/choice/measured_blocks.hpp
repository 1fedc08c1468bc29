// Which part of a large call is measured (choice/destined_call.hpp), in blocks of equal size.
#pragma once

#include <algorithm>
#include <cstddef>

#include "src/runtime/cache_sizes.hpp"

namespace simdbezier::detail {

/// Measured blocks of each way. One half block runs ahead of them.
inline constexpr std::size_t kMeasurements = 3;
inline constexpr std::size_t kHalvesOfWay = 1 + 2 * kMeasurements;

/// Returns the half blocks of all ways.
constexpr std::size_t half_blocks(std::size_t ways) noexcept { return kHalvesOfWay * ways; }

/// Returns at most `items`, and a multiple of 16 if there are as many: so many rows are whole
/// lines.
constexpr std::size_t aligned_items(std::size_t items) noexcept {
  constexpr std::size_t kLine = 16;
  return items < kLine ? items : items / kLine * kLine;
}

/// Returns how many patches or samples half a block has, those of all threads together: of a call
/// with so many items and bytes, for so many ways. 0 where measuring would be more than a quarter
/// of it.
inline std::size_t half_block(std::size_t items, std::size_t bytes, std::size_t ways,
                              int threads) noexcept {
  // A thread's block is as large as its second-level cache, and up to four times as large where
  // that is no more of the call than may be measured: the last chunk of a block has nothing to
  // overlap, and a chunk is up to a third of that cache.
  constexpr std::size_t kMostOfCall = 4;
  const auto many = static_cast<std::size_t>(threads);
  const std::size_t share = bytes / (half_blocks(ways) * kMostOfCall * many);
  const std::size_t least = std::max<std::size_t>(second_level_cache() / 2, 1);
  return share < least ? 0 : aligned_items(items / (bytes / std::min(share, 4 * least) + 1)) * many;
}

} // namespace simdbezier::detail
