// Several planes that are written at once, in whole lines that go past the caches.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/simd/line_stream.hpp"
#include "kernels/simd/repeat.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// Values that are put one behind the other into each of some planes, as LineStream has it. The
/// planes begin at the same place within a line, so that their registers are turned alike.
template <typename V, std::size_t kPlanes>
class PlaneStreams {
  using T = ScalarOf<V>;
  static constexpr std::size_t kL = kLanes<V>;
  static constexpr unsigned kAll = (1U << kL) - 1U;

public:
  using Values = V[kPlanes];

  PlaneStreams() = default; ///< has no values yet
  /// Members are copied one by one, for LineStream's reason.
  SIMDBEZIER_INLINE PlaneStreams(const PlaneStreams& other) { *this = other; }
  SIMDBEZIER_INLINE PlaneStreams& operator=(const PlaneStreams& other) {
    first_ = other.first_;
    at_ = other.at_;
    filled_ = other.filled_;
    own_ = other.own_;
    repeat<kPlanes>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA { last_[c] = other.last_[c]; });
    return *this;
  }
  ~PlaneStreams() = default;

  /// first: where the planes begin; these pointers stay until finish() has been called.
  SIMDBEZIER_INLINE void begin(T* const (&first)[kPlanes]) {
    first_ = first;
    filled_ = reinterpret_cast<std::uintptr_t>(first[0]) % 64 / sizeof(T);
    at_ = -static_cast<std::ptrdiff_t>(filled_);
    own_ = kAll << filled_;
    for (V& last : last_) {
      last = broadcast<V>(T(0));
    }
  }
  SIMDBEZIER_INLINE void put(const Values& values) {
    const LaneWindow window(kL - filled_, T());
    repeat<kPlanes>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      store(c, window.of(last_[c], values[c]));
      last_[c] = values[c];
    });
    end_line();
  }
  /// The first `count` lanes, fewer than all.
  SIMDBEZIER_INLINE void put_first(const Values& values, std::size_t count) {
    const LaneWindow window(kL - filled_, T());
    const LaneWindow kept(count, T());
    filled_ += count;
    const bool full = filled_ >= kL;
    repeat<kPlanes>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      if (full) {
        store(c, window.of(last_[c], values[c]));
      }
      last_[c] = kept.of(last_[c], values[c]);
    });
    if (full) {
      end_line();
      filled_ -= kL;
    }
  }
  /// One value each, `step` values from one plane to the next.
  SIMDBEZIER_INLINE void put_values(const T* values, std::size_t step) {
    const bool full = ++filled_ == kL;
    repeat<kPlanes>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      last_[c] = append_value(last_[c], values + c * step);
      if (full) {
        store(c, last_[c]);
      }
    });
    if (full) {
      end_line();
      filled_ = 0;
    }
  }
  SIMDBEZIER_INLINE void finish() const {
    const unsigned lanes = own_ & ((1U << filled_) - 1U);
    const LaneWindow window(kL - filled_, T());
    for (std::size_t c = 0; lanes != 0 && c < kPlanes; ++c) {
      store_line(first_[c] + at_, lanes, window.of(last_[c], last_[c]));
    }
  }

private:
  SIMDBEZIER_INLINE void store(std::size_t c, V line) const {
    if (own_ == kAll) [[likely]] {
      store_any<true>(first_[c] + at_, __builtin_bit_cast(LinePart<T>, line));
    } else {
      store_line(first_[c] + at_, own_, line);
    }
  }
  SIMDBEZIER_INLINE void end_line() {
    own_ = kAll;
    at_ += std::ptrdiff_t{kL};
  }

  // As in LineStream; the next line of plane c begins at first_[c] + at_.
  T* const* first_ = nullptr;
  std::ptrdiff_t at_ = 0;
  std::size_t filled_ = 0;
  unsigned own_ = 0;
  V last_[kPlanes];
};
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
