// One thread's way from staged planes to the caller's memory, chunk by chunk.
//
// Kernels write planes of unit stride, and records where OutputPlan::put_directly() says so. Where
// the caller wants other records, or stores that bypass the caches, they write into staging memory
// instead, from which a drain forms the caller's bytes in whole cache lines. Samples that do not
// fill a line wait in front of the next chunk's planes. Streaming takes two staging areas: one
// chunk is passed on while the next one is computed.
#pragma once

#include <cstddef>

#include "src/output/output_plan.hpp"

namespace simdbezier::detail {

template <typename T>
class Delivery {
public:
  /// Samples that one chunk should hold.
  [[nodiscard]] static std::size_t chunk_samples(const OutputPlan<T>& plan) noexcept;
  /// Bytes of scratch that a thread needs for chunks of up to `samples`; 64-byte aligned.
  [[nodiscard]] static std::size_t scratch_bytes(std::size_t staged_planes, bool streaming,
                                                 std::size_t samples) noexcept;

  Delivery(const OutputPlan<T>& plan, const KernelTable<T>& table, std::size_t samples,
           void* scratch) noexcept;

  /// The planes that the kernel is to put a chunk in, whose first sample has the caller's index
  /// `sample`, until end(): those of each vector output, null where not wanted.
  const Planes<T>* begin(std::size_t sample) noexcept;
  /// The planes of the chunk after it, where all planes are staged.
  [[nodiscard]] const Planes<T>* next() const noexcept { return planes_[1 - buffer_]; }
  /// What the kernel passes on meanwhile; null where there is nothing to overlap.
  [[nodiscard]] DrainQueue<T>* queue() noexcept {
    return plan_.streaming() && plan_.staged() ? &queue_ : nullptr;
  }
  /// The chunk is computed: `count` samples.
  void end(std::size_t count) noexcept;
  /// Ends the delivery after the last chunk: nothing is left behind, streaming stores are complete.
  void finish() noexcept;

private:
  /// One stream between two chunks.
  struct State {
    std::size_t next;    ///< record that goes out next
    std::size_t pending; ///< records that wait in front of the planes
    std::size_t peel;    ///< records to go before the first whole line
  };
  static constexpr std::size_t kNone = ~std::size_t(0);

  [[nodiscard]] T* plane(std::size_t index) const noexcept;
  void restart(std::size_t sample) noexcept;
  void put_single(std::size_t stream, std::ptrdiff_t from, std::size_t count) noexcept;
  void flush() noexcept;

  const OutputPlan<T>& plan_;
  const KernelTable<T>& table_;
  T* staging_[2] = {};
  std::size_t plane_step_;
  std::size_t buffer_ = 0;
  std::size_t expected_ = kNone; ///< sample with which a chunk that continues this one begins
  State state_[kMostMembers];    ///< written once there is a chunk
  Planes<T> planes_[2][kVectorOutputs];
  DrainQueue<T> queue_;
};

} // namespace simdbezier::detail
