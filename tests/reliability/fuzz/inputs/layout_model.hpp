// What calls have to do with outputs that lie anywhere in a block.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/reliability/fuzz/inputs/hostile.hpp"

namespace simdbezier::fuzz {

/// One component of one output: `samples` values from an offset on.
struct Member {
  std::ptrdiff_t offset;
  std::ptrdiff_t stride;
};

/// What is known of a request before it is made.
enum class Expectation : std::uint8_t { anything, success, failure, untried };

/// The product of two counts of samples. Beyond all memory it may be too small, but stays beyond.
[[nodiscard]] inline Wide sample_product(Wide a, Wide b) {
  return a > kLastOffset || b > kLastOffset ? std::max(a, b) : a * b;
}

/// Statuses begin at one of the first elements of a block of their own.
inline constexpr std::size_t kStatusPlaces = 20;

/// Says what a call has to do with `count` samples in a block of `elements`. Where outputs lie
/// within it, `taken` tells which elements they take.
[[nodiscard]] inline Expectation expect_of(const std::vector<Member>& members, Wide count,
                                           bool statuses, std::size_t elements,
                                           std::vector<std::uint8_t>& taken) {
  if (count == 0) {
    return Expectation::anything;
  }
  bool overflow = count > kLastOffset;
  for (const Member& member : members) {
    const Wide reach = overflow ? 0 : (count - 1) * member.stride;
    overflow = overflow || (reach < 0 ? -reach : reach) > kLastOffset / 2;
    const Wide last = member.offset + reach;
    if (!overflow && (last < 0 || last >= static_cast<Wide>(elements))) {
      return Expectation::untried;
    }
  }
  if (overflow) {
    return Expectation::failure;
  }
  if (statuses && count > static_cast<Wide>(elements - kStatusPlaces)) {
    return Expectation::untried;
  }
  taken.assign(elements, 0);
  bool equal_strides = true;
  for (const Member& member : members) {
    equal_strides = equal_strides && member.stride == members.front().stride;
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      auto& element = taken[static_cast<std::size_t>(member.offset + k * member.stride)];
      if (element != 0) {
        return Expectation::failure;
      }
      element = 1;
    }
  }
  // Strides that differ are refused where the ranges meet, which only the header defines.
  return equal_strides ? Expectation::success : Expectation::anything;
}

} // namespace simdbezier::fuzz
