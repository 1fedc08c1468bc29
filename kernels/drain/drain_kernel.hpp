// Passes staged samples on: planes as they are, or as records that are put together in registers.
//
// Only whole cache lines are passed on. In a streaming store nothing may come between the parts of
// a line, and streams alternate rarely; either costs more than half of the speed of memory.
#pragma once

#include <algorithm>

#include "kernels/simd/pages.hpp"
#include "kernels/simd/registers_to_records.hpp"
#include "src/tables/drain_queue.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::DrainQueue;
using detail::DrainStream;
using detail::kDrainStep;

template <bool kStreaming, typename T>
SIMDBEZIER_INLINE void drain_plane(const DrainStream<T>& s, std::size_t steps) {
  const T* from = s.plane[0] + s.at;
  T* to = s.to;
  for (std::size_t k = 0; k < steps; ++k, from += kDrainStep<T>, to += kDrainStep<T>) {
    copy_line<kStreaming>(from, to);
  }
}

/// Pointers are read one by one where they are needed: g++ makes vectors of a loop that copies
/// them, which wait for streaming stores (src/tables/drain_queue.hpp).
template <bool kStreaming, std::size_t kMembers, typename T>
SIMDBEZIER_INLINE void drain_packed(const DrainStream<T>& s, std::size_t steps) {
  T* const to = s.to;
  for (std::size_t k = 0; k < steps * kDrainStep<T>; k += kDrainStep<T>) {
    interleave<kStreaming, kMembers>(s.plane, s.at + k, to + kMembers * k);
  }
}

template <bool kStreaming, typename T>
SIMDBEZIER_KERNEL void drain_nonuples(const DrainStream<T>& s, std::size_t steps) {
  drain_packed<kStreaming, 9>(s, steps);
}

/// Passes on records of any length, at any distance.
template <typename T>
SIMDBEZIER_INLINE void drain_records(const DrainStream<T>& s, std::size_t at, T* to,
                                     std::ptrdiff_t stride) {
  std::size_t member = 0;
  for (; member + kGroupLanes<T> <= s.members; member += kGroupLanes<T>) {
    interleave_group<kGroupLanes<T>>(s.plane + member, at, to + member, stride);
  }
  with_one_of<1, 2, 3>(s.members - member, [&]<std::size_t kRest>() SIMDBEZIER_INLINE_LAMBDA {
    if constexpr (kRest < kGroupLanes<T>) {
      interleave_group<kRest>(s.plane + member, at, to + member, stride);
    }
  });
}

/// Passes on records without gaps by way of a buffer, so that they leave in whole lines. There are
/// two buffers, because a line read back at once would wait for the small stores that made it.
template <typename T>
SIMDBEZIER_KERNEL void drain_buffered(const DrainStream<T>& s, std::size_t steps) {
  alignas(64) T buffer[2][kDrainStep<T> * detail::kMostMembers];
  const std::size_t step = kDrainStep<T> * s.members;
  for (std::size_t k = 0; k <= steps; ++k) {
    if (k < steps) {
      drain_records(s, s.at + k * kDrainStep<T>, buffer[k % 2], s.stride);
    }
    if (k > 0) {
      const T* const from = buffer[(k - 1) % 2];
      for (std::size_t line = 0; line < step; line += kDrainStep<T>) {
        copy_line<true>(from + line, s.to + (k - 1) * step + line);
      }
    }
  }
}

template <typename T>
SIMDBEZIER_KERNEL void drain_with_gaps(const DrainStream<T>& s, std::size_t steps) {
  for (std::size_t k = 0; k < steps * kDrainStep<T>; k += kDrainStep<T>) {
    drain_records(s, s.at + k, s.to + static_cast<std::ptrdiff_t>(k) * s.stride, s.stride);
  }
}

template <typename T>
SIMDBEZIER_INLINE void drain_steps(const DrainStream<T>& s, std::size_t steps) {
  if (s.streaming) {
    ask_for_pages(page_behind(s.to), steps * 64 * s.members);
  }
  const bool packed = s.stride == static_cast<std::ptrdiff_t>(s.members);
  if (s.members == 1 && packed) {
    s.streaming ? drain_plane<true>(s, steps) : drain_plane<false>(s, steps);
  } else if (s.members == 3 && packed) {
    s.streaming ? drain_packed<true, 3>(s, steps) : drain_packed<false, 3>(s, steps);
  } else if (s.members == 6 && packed) {
    s.streaming ? drain_packed<true, 6>(s, steps) : drain_packed<false, 6>(s, steps);
  } else if (kNonuples && s.members == 9 && packed && (kNonupleLines || !s.streaming)) {
    if constexpr (kNonuples) {
      s.streaming ? drain_nonuples<kNonupleLines>(s, steps) : drain_nonuples<false>(s, steps);
    }
  } else {
    s.streaming ? drain_buffered(s, steps) : drain_with_gaps(s, steps);
  }
}

/// Passes on as many values as are owed. It is out of line, so that the registers of a kernel's
/// rows wait in the first-level cache meanwhile, which is cheaper than keeping some free for this.
template <typename T>
SIMDBEZIER_KERNEL void drain_owed(DrainQueue<T>& queue) {
  while (queue.current < queue.streams) {
    DrainStream<T>& stream = queue.stream[queue.current];
    const std::size_t step = kDrainStep<T> * stream.members;
    const std::size_t steps = std::min(queue.owed / step, stream.steps);
    queue.owed -= steps * step;
    if (steps > 0) {
      drain_steps(stream, steps);
      const std::size_t samples = steps * kDrainStep<T>;
      stream.at += samples;
      stream.to += static_cast<std::ptrdiff_t>(samples) * stream.stride;
      stream.steps -= steps;
    }
    if (stream.steps > 0) {
      return;
    }
    ++queue.current;
  }
  queue.owed = 0;
}

/// Kernels call this after every few rows: `values` of T have been written since the last call. It
/// passes about as many on, so that memory and arithmetic overlap, but not one line at a time,
/// since every call costs as much as several. In WebAssembly, where nothing goes past the caches,
/// all is passed on at the end.
template <typename T>
SIMDBEZIER_INLINE void drain_some(DrainQueue<T>* drain, std::size_t values) {
  if (!kSimd128 && drain != nullptr) [[unlikely]] {
    drain->owed += values;
    if (drain->owed >= detail::kDrainBurst<T>) {
      drain_owed(*drain);
    }
  }
}

/// Passes on all that is left.
template <typename T>
SIMDBEZIER_KERNEL void drain_all(DrainQueue<T>& queue) {
  for (; queue.current < queue.streams; ++queue.current) {
    DrainStream<T>& stream = queue.stream[queue.current];
    drain_steps(stream, stream.steps);
    stream.steps = 0;
  }
  queue.owed = 0;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
