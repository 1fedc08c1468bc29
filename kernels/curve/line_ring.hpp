// One stream of values on its way to memory, in whole lines past the caches.
//
// Values are written in batches, in any order, into a ring of two batches that stays in the
// first-level cache; a batch is passed on line by line while the next one is written. Streaming
// stores leave the processor slowly and in order, so a line that was written in small pieces must
// not be read back at once: it would wait for all streaming stores before those pieces.
#pragma once

#include <cstdint>

#include "kernels/simd/interleave.hpp"
#include "kernels/simd/pages.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T>
class LineRing {
public:
  static constexpr std::size_t kLine = 64 / sizeof(T);
  /// Returns the room for batches of `values`, which are whole lines.
  static constexpr std::size_t room(std::size_t values) { return 2 * (values + kLine); }

  LineRing() = default;
  /// ring has room(batch) values, from a line's start on. to is where the stream goes, aligned to
  /// T.
  SIMDBEZIER_INLINE void start(T* ring, std::size_t batch, T* to) {
    ring_ = ring;
    batch_ = batch;
    phase_ = foreign_ = reinterpret_cast<std::uintptr_t>(to) % 64 / sizeof(T);
    to_ = to - phase_;
  }

  /// Returns where the next batch is to be written.
  [[nodiscard]] SIMDBEZIER_INLINE T* batch() const { return half() + phase_; }

  /// The batch is written: `values` of them, fewer in the last one only. What was passed on until
  /// now must be finished.
  SIMDBEZIER_INLINE void turn(std::size_t values) {
    from_ = half();
    lines_ = (phase_ + values) / kLine;
    rest_ = (phase_ + values) % kLine;
    half_ = 1 - half_;
    // The line that both batches share is the next one's. One by one: such loads can be forwarded.
    for (std::size_t k = 0; k < phase_; ++k) {
      half()[k] = from_[batch_ + k];
    }
  }

  /// Passes on up to `lines`, and returns how many fewer there were.
  SIMDBEZIER_INLINE std::size_t pass_on(std::size_t lines) {
    const std::size_t count = lines < lines_ ? lines : lines_;
    if (count > 0) {
      ask_for_pages(page_behind(to_), count * 64);
      std::size_t k = 0;
      if (foreign_ > 0) [[unlikely]] {
        put_part(kLine);
        ++k;
      }
      for (; k < count; ++k) {
        copy_line<true>(from_ + k * kLine, to_ + k * kLine);
      }
      from_ += count * kLine;
      to_ += count * kLine;
      lines_ -= count;
    }
    return lines - count;
  }

  /// Passes on all that is left of the batch before the one being written.
  SIMDBEZIER_INLINE void pass_all() { pass_on(lines_); }

  /// Passes on all that is left; to be called after the last turn().
  SIMDBEZIER_INLINE void finish() {
    pass_all();
    put_part(rest_);
  }

private:
  [[nodiscard]] SIMDBEZIER_INLINE T* half() const { return ring_ + half_ * (batch_ + kLine); }

  /// Stores the first `end` values of a line, less those that belong to others.
  SIMDBEZIER_INLINE void put_part(std::size_t end) {
    for (std::size_t k = foreign_; k < end; ++k) {
      to_[k] = from_[k];
    }
    foreign_ = 0;
  }

  T* ring_ = nullptr;
  std::size_t batch_ = 0;
  std::size_t half_ = 0;
  std::size_t phase_ = 0;   ///< place of every batch in its first line
  std::size_t foreign_ = 0; ///< values of the line at `to_` that are not the stream's
  const T* from_ = nullptr;
  T* to_ = nullptr; ///< the next line
  std::size_t lines_ = 0;
  std::size_t rest_ = 0;
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
