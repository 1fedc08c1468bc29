// Values that follow one another in memory and go past the caches, wherever they begin: registers
// are turned to where lines are, since streaming stores have to be aligned.
#pragma once

#include <cstdint>

#include "kernels/simd/interleave.hpp"
#include "kernels/simd/lanes.hpp"
#include "kernels/simd/line_stream.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX2)
/// For each number n of 32-bit lanes: where the lanes of a register come from that is turned by n,
/// and a mask of the first n.
struct Turns {
  alignas(32) std::int32_t from[8][8];
  alignas(32) std::int32_t first[8][8];
  constexpr Turns() : from{}, first{} {
    for (int n = 0; n < 8; ++n) {
      for (int k = 0; k < 8; ++k) {
        from[n][k] = (k + 8 - n) % 8;
        first[n][k] = k < n ? -1 : 0;
      }
    }
  }
};
inline constexpr Turns kTurns;

/// Turns registers by a number of lanes, and joins them with the ones before.
template <typename V>
class Turn {
public:
  explicit SIMDBEZIER_INLINE Turn(std::size_t n) {
    const std::size_t lanes = n * (sizeof(ScalarOf<V>) / sizeof(float));
    from_ = _mm256_load_si256(reinterpret_cast<const __m256i*>(kTurns.from[lanes]));
    first_ = _mm256_load_ps(reinterpret_cast<const float*>(kTurns.first[lanes]));
  }
  SIMDBEZIER_INLINE V of(V values) const {
    const __m256 lanes = __builtin_bit_cast(__m256, values);
    return __builtin_bit_cast(V, _mm256_permutevar8x32_ps(lanes, from_));
  }
  /// The first lanes of `kept`, and the others of `turned`.
  SIMDBEZIER_INLINE V join(V kept, V turned) const {
    return __builtin_bit_cast(V, _mm256_blendv_ps(__builtin_bit_cast(__m256, turned),
                                                  __builtin_bit_cast(__m256, kept), first_));
  }

private:
  __m256i from_;
  __m256 first_;
};

/// Stores the lanes from number `first` on, which begin a stream: the others are somebody else's.
template <typename V>
SIMDBEZIER_INLINE void store_from(std::size_t first, ScalarOf<V>* to, V values) {
  alignas(64) ScalarOf<V> lanes[kLanes<V>];
  store_vector(lanes, values);
  for (std::size_t k = first; k < kLanes<V>; ++k) {
    to[k] = lanes[k];
  }
}

/// What simd/line_stream.hpp has for registers that are lines themselves.
template <typename V, bool kPastCaches>
class LineStream<V, kPastCaches, 1> {
  static_assert(kPastCaches);
  using T = ScalarOf<V>;
  static constexpr std::size_t kL = kLanes<V>;

public:
  LineStream() = default; ///< has no values yet
  explicit SIMDBEZIER_INLINE LineStream(T* to) { begin(to); }
  /// Members are copied one by one, or they might be read in larger pieces than they were written
  /// in, which waits for all streaming stores before.
  SIMDBEZIER_INLINE LineStream(const LineStream& other) { *this = other; }
  SIMDBEZIER_INLINE LineStream& operator=(const LineStream& other) {
    to_ = other.to_;
    filled_ = other.filled_;
    foreign_ = other.foreign_;
    kept_ = other.kept_;
    return *this;
  }
  ~LineStream() = default;

  SIMDBEZIER_INLINE void begin(T* to) {
    filled_ = reinterpret_cast<std::uintptr_t>(to) / sizeof(T) % kL;
    foreign_ = filled_;
    to_ = to - filled_;
    kept_ = broadcast<V>(T(0));
  }
  /// Puts `count` values, a register and more. value(k) is the k-th register of them; of the last
  /// one, as many lanes count as there are values.
  template <typename Value>
  SIMDBEZIER_INLINE void put_row(std::size_t count, const Value& value) {
    const Turn<V> turn(filled_);
    // Finds what is stored next; `turned` is what stays for the register after it.
    const auto joined = [&](V values, V& turned) SIMDBEZIER_INLINE_LAMBDA {
      turned = turn.of(values);
      return turn.join(kept_, turned);
    };
    const std::size_t whole = count / kL;
    const std::size_t rest = count % kL;
    T* to = to_;
    V turned;
    std::size_t k = 0;
    if (foreign_ > 0) [[unlikely]] {
      store_from(foreign_, to, joined(value(0), turned));
      kept_ = turned;
      foreign_ = 0;
      to += kL;
      ++k;
    }
    for (V between; k + 2 <= whole; k += 2, to += 2 * kL) { // two, so that nothing is moved
      stream(to, joined(value(k), between));
      kept_ = between;
      stream(to + kL, joined(value(k + 1), turned));
      kept_ = turned;
    }
    if (k < whole) {
      stream(to, joined(value(k), turned));
      kept_ = turned;
      to += kL;
    }
    if (rest > 0) {
      kept_ = joined(value(whole), turned);
      filled_ += rest;
      if (filled_ >= kL) {
        stream(to, kept_);
        kept_ = turned;
        filled_ -= kL;
        to += kL;
      }
    }
    to_ = to;
  }
  SIMDBEZIER_INLINE void finish() const {
    if (filled_ > 0) {
      store_first(to_, kept_, filled_);
    }
  }

  SIMDBEZIER_INLINE void put(V values) {
    const Turn<V> turn(filled_);
    const V turned = turn.of(values);
    end_register(turn.join(kept_, turned), turned);
  }
  SIMDBEZIER_INLINE void put(RegisterPair<V> values) {
    put(values.low);
    put(values.high);
  }
  /// The first `count` lanes, all of them at most.
  SIMDBEZIER_INLINE void put_first(V values, std::size_t count) {
    const Turn<V> turn(filled_);
    const V turned = turn.of(values);
    kept_ = turn.join(kept_, turned);
    filled_ += count;
    if (filled_ >= kLanes<V>) {
      filled_ -= kLanes<V>;
      end_register(kept_, turned);
    }
  }
  /// More than those of one register.
  SIMDBEZIER_INLINE void put_first(RegisterPair<V> values, std::size_t count) {
    put(values.low);
    put_first(values.high, count - kLanes<V>);
  }
  SIMDBEZIER_INLINE void put_value(const T* value) {
    kept_ = Turn<V>(filled_).join(kept_, broadcast<V>(*value));
    if (++filled_ == kLanes<V>) {
      filled_ = 0;
      end_register(kept_, kept_);
    }
  }

private:
  static SIMDBEZIER_INLINE void stream(T* to, V values) {
    store_any<true>(to, __builtin_bit_cast(LinePart<T>, values));
  }
  /// Stores a register, behind which come lanes of `next`.
  SIMDBEZIER_INLINE void end_register(V values, V next) {
    if (foreign_ > 0) [[unlikely]] {
      store_from(foreign_, to_, values);
      foreign_ = 0;
    } else {
      stream(to_, values);
    }
    kept_ = next;
    to_ += kLanes<V>;
  }

  T* to_ = nullptr;         ///< the next register
  std::size_t filled_ = 0;  ///< first lanes of it that are put already, or somebody else's
  std::size_t foreign_ = 0; ///< those of them that are somebody else's
  V kept_;                  ///< has the filled lanes
};
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
