// From staging to the caller's memory: what is left to pass on while a kernel computes.
#pragma once

#include <cstddef>

#include "kernels/kernel_table.hpp"

namespace simdbezier::detail {

/// Samples per step of a drain: whole cache lines of every layout.
template <typename T>
inline constexpr std::size_t kDrainSamples = 64 / sizeof(T);

/// One output stream: planes of staged samples that become consecutive records.
template <typename T>
struct DrainStream {
  const T* plane[3 * kGroups]; ///< in the order of the record's members
  std::size_t members;         ///< planes
  T* to;                       ///< where the next record goes
  std::size_t steps;           ///< of kDrainSamples records each
};

/// Streams, passed on one after the other: bursts to one place keep write buffers short.
template <typename T>
struct DrainQueue {
  DrainStream<T> stream[3 * kGroups];
  std::size_t streams = 0;
  std::size_t current = 0; ///< all before it are finished
  std::size_t owed = 0;    ///< values that the kernel has computed and the queue not yet matched
  bool streaming = false;  ///< by stores that bypass the caches
};

} // namespace simdbezier::detail
