// Values that follow one another in memory, written in whole lines wherever they begin: a store
// across two lines takes an Intel processor as long as five others, and each line that a row's
// unaligned registers touch is touched twice.
#pragma once

#include <cstdint>

#include "kernels/simd/interleave.hpp"
#include "kernels/simd/lanes.hpp"
#include "kernels/simd/register_pair.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX512)
inline constexpr bool kStreamsLines = true;

struct LaneNumbers {
  std::int32_t by_4[32];
  std::int64_t by_8[16];
  constexpr LaneNumbers() : by_4{}, by_8{} {
    for (int k = 0; k < 32; ++k) {
      by_4[k] = k;
      by_8[k / 2] = k / 2;
    }
  }
};
inline constexpr LaneNumbers kLaneNumbers;

/// Registers whose lanes are the n-th to the (n+15)-th, or (n+7)-th, of two others side by side; n
/// is at most the number of lanes of one.
class LaneWindow {
public:
  explicit SIMDBEZIER_INLINE LaneWindow(std::size_t n, float /*type*/)
      : lanes_(_mm512_loadu_si512(kLaneNumbers.by_4 + n)) {}
  explicit SIMDBEZIER_INLINE LaneWindow(std::size_t n, double /*type*/)
      : lanes_(_mm512_loadu_si512(kLaneNumbers.by_8 + n)) {}

  SIMDBEZIER_INLINE vec<float> of(vec<float> low, vec<float> high) const {
    return vec<float>(_mm512_permutex2var_ps(low, lanes_, high));
  }
  SIMDBEZIER_INLINE vec<double> of(vec<double> low, vec<double> high) const {
    return vec<double>(_mm512_permutex2var_pd(low, lanes_, high));
  }

private:
  __m512i lanes_;
};

/// Lanes from the second on, and behind them a lane of another register.
struct AppendedLanes {
  alignas(64) std::int32_t by_4[16][16];
  alignas(64) std::int64_t by_8[8][8];
  constexpr AppendedLanes() : by_4{}, by_8{} {
    for (int lane = 0; lane < 16; ++lane) {
      for (int k = 0; k < 16; ++k) {
        by_4[lane][k] = k < 15 ? k + 1 : 16 + lane;
        by_8[lane / 2][k / 2] = k / 2 < 7 ? k / 2 + 1 : 8 + lane / 2;
      }
    }
  }
};
inline constexpr AppendedLanes kAppendedLanes;

SIMDBEZIER_INLINE vec<float> append_lane(vec<float> values, vec<float> from, std::size_t lane) {
  const __m512i lanes = _mm512_load_si512(kAppendedLanes.by_4[lane]);
  return vec<float>(_mm512_permutex2var_ps(values, lanes, from));
}
SIMDBEZIER_INLINE vec<double> append_lane(vec<double> values, vec<double> from, std::size_t lane) {
  const __m512i lanes = _mm512_load_si512(kAppendedLanes.by_8[lane]);
  return vec<double>(_mm512_permutex2var_pd(values, lanes, from));
}
/// Lanes from the second on, and behind them a value.
SIMDBEZIER_INLINE vec<float> append_value(vec<float> values, const float* value) {
  const __m512i next = _mm512_castps_si512(broadcast<vec<float>>(*value));
  return vec<float>(_mm512_castsi512_ps(_mm512_alignr_epi32(next, _mm512_castps_si512(values), 1)));
}
SIMDBEZIER_INLINE vec<double> append_value(vec<double> values, const double* value) {
  const __m512i next = _mm512_castpd_si512(broadcast<vec<double>>(*value));
  return vec<double>(
      _mm512_castsi512_pd(_mm512_alignr_epi64(next, _mm512_castpd_si512(values), 1)));
}
SIMDBEZIER_INLINE void store_line(float* line, unsigned lanes, vec<float> value) {
  _mm512_mask_storeu_ps(line, static_cast<__mmask16>(lanes), value);
}
SIMDBEZIER_INLINE void store_line(double* line, unsigned lanes, vec<double> value) {
  _mm512_mask_storeu_pd(line, static_cast<__mmask8>(lanes), value);
}

/// Values that are put one behind the other, as they are to lie from `to` on. Once finish() has
/// been called all of them are written, each once, and nothing besides. kPastCaches: whole lines go
/// past the caches.
template <typename V, bool kPastCaches = false>
class LineStream {
  using T = ScalarOf<V>;
  static constexpr unsigned kAll = (1U << (kLanes<V>)) - 1U;

public:
  LineStream() = default; ///< has no values yet
  /// Members are copied one by one. As a whole they would be read in larger pieces than they were
  /// written in, which waits for all streaming stores before.
  SIMDBEZIER_INLINE LineStream(const LineStream& other) { *this = other; }
  SIMDBEZIER_INLINE LineStream& operator=(const LineStream& other) {
    filled_ = other.filled_;
    line_ = other.line_;
    own_ = other.own_;
    last_ = other.last_;
    return *this;
  }
  explicit SIMDBEZIER_INLINE LineStream(T* to)
      : filled_(reinterpret_cast<std::uintptr_t>(to) % 64 / sizeof(T)), line_(to - filled_),
        own_(kAll << filled_), last_(broadcast<V>(T(0))) {}

  SIMDBEZIER_INLINE void put(V values) {
    store(own_, LaneWindow(kLanes<V> - filled_, T()).of(last_, values));
    own_ = kAll;
    last_ = values;
  }
  SIMDBEZIER_INLINE void put(RegisterPair<V> values) {
    put(values.low);
    put(values.high);
  }
  /// The first `count` lanes, all of them at most.
  SIMDBEZIER_INLINE void put_first(V values, std::size_t count) {
    const V line = LaneWindow(kLanes<V> - filled_, T()).of(last_, values);
    last_ = LaneWindow(count, T()).of(last_, values);
    advance(count, line);
  }
  /// More than those of one register.
  SIMDBEZIER_INLINE void put_first(RegisterPair<V> values, std::size_t count) {
    put(values.low);
    put_first(values.high, count - kLanes<V>);
  }
  SIMDBEZIER_INLINE void put_value(const T* value) {
    last_ = append_value(last_, value);
    advance(1, last_);
  }
  SIMDBEZIER_INLINE void put_lane(V from, std::size_t lane) {
    last_ = append_lane(last_, from, lane);
    advance(1, last_);
  }
  SIMDBEZIER_INLINE void finish() const {
    const unsigned rest = (1U << filled_) - 1U;
    if (rest != 0) {
      const V line = LaneWindow(kLanes<V> - filled_, T()).of(last_, last_);
      store_line(line_, own_ & rest, line);
    }
  }

private:
  SIMDBEZIER_INLINE void store(unsigned lanes, V line) {
    if (kPastCaches && lanes == kAll) [[likely]] {
      store_any<true>(line_, __builtin_bit_cast(LinePart<T>, line));
    } else {
      store_line(line_, lanes, line);
    }
    line_ += kLanes<V>;
  }
  SIMDBEZIER_INLINE void advance(std::size_t count, V line) {
    filled_ += count;
    if (filled_ >= kLanes<V>) {
      filled_ -= kLanes<V>;
      store(own_, line);
      own_ = kAll;
    }
  }

  std::size_t filled_; ///< first lanes of the line that are put already, or somebody else's
  T* line_;            ///< the next one to be stored
  unsigned own_;       ///< those of its lanes that are not somebody else's
  V last_;             ///< a register of the values put last, the very last one in its last lane
};
#else
inline constexpr bool kStreamsLines = false;

/// On AVX2, simd/value_stream.hpp has those that go past the caches.
template <typename V, bool kPastCaches = false>
class LineStream;
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
