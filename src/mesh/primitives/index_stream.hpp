// Vertex numbers on their way to the caller's memory: put together in the first-level cache, and
// passed on in whole lines.
//
// Lines are passed on some time after they were written, while the next ones are being written:
// streaming stores leave the processor slowly and in order, and a load of what was stored just
// before would wait for all of them (src/tables/drain_queue.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "src/tables/drain_queue.hpp"

namespace simdbezier::detail {

/// One thread's numbers, one after the other.
template <typename Index>
class IndexStream {
public:
  /// The most numbers that make_room() makes room for.
  static constexpr std::size_t kMostNumbers = 1024;
  /// So many more numbers may be written behind those that count; they will be overwritten.
  static constexpr std::size_t kSlack = 64;

  IndexStream(const KernelTable<float>& table, Index* to, bool streaming) noexcept
      : table_(table), streaming_(streaming) {
    passed_ = reinterpret_cast<std::uintptr_t>(to) % kLineBytes / sizeof(Index);
    to_ = to - passed_;
    waiting_ = cursor_ = buffer_ + passed_;
    queue_.streams = 1;
  }
  IndexStream(const IndexStream&) = delete;
  IndexStream& operator=(const IndexStream&) = delete;

  /// The place where the next numbers go.
  [[nodiscard]] Index* cursor() const noexcept { return cursor_; }
  /// Numbers up to `end` are written; returns where at least kMostNumbers more can go.
  Index* make_room(Index* end) noexcept {
    cursor_ = end;
    if (cursor_ - waiting_ >= static_cast<std::ptrdiff_t>(kBurst)) {
      turn();
    }
    return cursor_;
  }
  /// Writes what is left; to be called after the last number.
  void finish(Index* end) noexcept {
    pass_lines(end);
    put_part(end);
    if (streaming_) {
      table_.fence();
    }
  }

private:
  static constexpr std::size_t kLineBytes = 64;
  static constexpr std::size_t kLine = kLineBytes / sizeof(Index);
  static constexpr std::size_t kBurst = 32 * kLine;
  static constexpr std::size_t kBatch = 256 * kLine;

  /// Passes on what was written before the last turn; begins anew where the buffer is full.
  void turn() noexcept {
    const bool full = cursor_ - buffer_ >= static_cast<std::ptrdiff_t>(kBatch);
    pass_lines(full ? cursor_ : waiting_);
    waiting_ = cursor_;
    if (full) {
      const std::size_t done = passed_ / kLine * kLine;
      const auto kept = static_cast<std::size_t>(cursor_ - buffer_) - done;
      std::memmove(buffer_, buffer_ + done, kept * sizeof(Index));
      to_ += done;
      passed_ -= done;
      waiting_ = cursor_ = buffer_ + kept;
    }
  }
  /// Whole lines before `end`.
  void pass_lines(const Index* end) noexcept {
    const auto written = static_cast<std::size_t>(end - buffer_) / kLine * kLine;
    if (passed_ % kLine != 0 && passed_ < written) { // the first line may have others' numbers
      put_part(buffer_ + (passed_ / kLine + 1) * kLine);
    }
    if (passed_ < written) {
      // Kernels copy lines, whatever they hold.
      DrainStream<float>& stream = queue_.stream[0];
      stream.plane[0] = reinterpret_cast<const float*>(buffer_ + passed_);
      stream.at = 0;
      stream.members = 1;
      stream.to = reinterpret_cast<float*>(to_ + passed_);
      stream.stride = 1;
      stream.streaming = streaming_;
      stream.steps = (written - passed_) / kLine;
      queue_.current = 0;
      table_.drain(queue_);
      passed_ = written;
    }
  }
  void put_part(const Index* end) noexcept {
    const auto last = static_cast<std::size_t>(end - buffer_);
    if (passed_ < last) {
      std::copy(buffer_ + passed_, buffer_ + last, to_ + passed_);
      passed_ = last;
    }
  }

  const KernelTable<float>& table_;
  bool streaming_;
  Index* to_;          ///< where buffer_[0] belongs
  std::size_t passed_; ///< numbers of the buffer that are in place, others' numbers included
  Index* waiting_;     ///< what was written at the last turn
  Index* cursor_;
  DrainQueue<float> queue_;
  alignas(kLineBytes) Index buffer_[kBatch + kBurst + kMostNumbers + kSlack + kLine];
};

} // namespace simdbezier::detail
