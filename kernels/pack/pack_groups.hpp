// What the kernels that pack have in common, whatever they pack: a register of patches or curves at
// a time, one a lane.
#pragma once

#include <type_traits>

#include "kernels/pack/double_double.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// What coefficients are formed in: wide enough that only the rounding to T counts.
template <typename T, typename S>
using CarriedIn =
    std::conditional_t<std::is_same_v<T, float> && std::is_same_v<S, float>, Wide, DoubleDouble>;

/// Packs [begin, end) of a task up to the first group that may hold a fault; see PackDoubt. Group
/// is made of the task, and pack(first, count) says of at most kWideLanes whether all is well.
template <typename Group, typename Task>
SIMDBEZIER_INLINE detail::PackDoubt pack_groups(const Task& task, std::size_t begin,
                                                std::size_t end) {
  Group group(task);
  for (std::size_t at = begin; at < end; at += kWideLanes) {
    const std::size_t count = end - at < kWideLanes ? end - at : kWideLanes;
    if (!group.pack(at, count)) {
      return {at, at + count};
    }
  }
  return {end, end};
}

/// Stores kTransposed values of each of the first `count` lanes.
template <typename T>
SIMDBEZIER_INLINE void store_lanes(const Wide* values, T* to, std::ptrdiff_t stride,
                                   std::size_t count) {
  if (count == kWideLanes) {
    return store_transposed(values, to, stride);
  }
  alignas(64) T lanes[kWideLanes * kTransposed];
  store_transposed(values, lanes, static_cast<std::ptrdiff_t>(kTransposed));
  for (std::size_t p = 0; p < count; ++p, to += stride) {
    for (std::size_t k = 0; k < kTransposed; ++k) {
      to[k] = lanes[p * kTransposed + k];
    }
  }
}

/// Stores one value of each of the first `count` lanes, rounded to T, with +0 for -0.
template <typename T>
SIMDBEZIER_INLINE void store_value(Wide value, T* to, std::size_t stride, std::size_t count) {
  alignas(64) double lanes[kWideLanes];
  store_vector<Wide>(lanes, value);
  for (std::size_t p = 0; p < count; ++p, to += stride) {
    *to = static_cast<T>(lanes[p]) + T(0);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
