// What is left to pass on from staging to the caller's memory while a kernel computes.
#pragma once

#include <cstddef>

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// A drain passes on so many samples at a time: whole cache lines in every layout.
template <typename T>
inline constexpr std::size_t kDrainStep = 64 / sizeof(T);

/// A kernel computes so many values before it passes any on: 32 lines.
template <typename T>
inline constexpr std::size_t kDrainBurst = 32 * kDrainStep<T>;

inline constexpr std::size_t kMostMembers = 3 * kVectorOutputs;

// Streaming stores leave the processor's store queue slowly, and in order. A load that needs two
// recent stores has to wait for all stores before them, hundreds of cycles: what is written for
// each chunk is therefore read in the same pieces, or was written one chunk earlier.

/// One output stream: planes of staged samples that become consecutive records.
template <typename T>
struct DrainStream {
  const T* plane[kMostMembers]; ///< the first sample of each member, in the record's order
  std::size_t at;               ///< samples passed on
  std::size_t members;
  T* to;                 ///< the next record's first member
  std::ptrdiff_t stride; ///< from one record to the next, in elements
  bool streaming;        ///< by stores that bypass the caches: no gaps, `to` at a line's start
  std::size_t steps;     ///< of kDrainStep records each
};

/// Streams that are passed on one after the other, since bursts to one place suit write buffers.
template <typename T>
struct DrainQueue {
  DrainStream<T> stream[kMostMembers];
  std::size_t streams = 0;
  std::size_t current = 0; ///< all before it are finished
  std::size_t owed = 0;    ///< values that the kernel has computed and the queue not yet matched
};

} // namespace simdbezier::detail
