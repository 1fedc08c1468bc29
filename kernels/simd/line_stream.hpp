// Values that follow one another in memory, written in whole lines wherever they begin: a store
// across two lines takes an Intel processor as long as five others, and each line that a row's
// unaligned registers touch is touched twice.
#pragma once

#include <cstdint>

#include "kernels/simd/interleave.hpp"
#include "kernels/simd/lanes.hpp"
#include "kernels/simd/register_pair.hpp"
#include "kernels/simd/repeat.hpp"

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

/// Values that are put one behind the other, as they are to lie from some place on, into one plane
/// or several at once, which begin at the same place within a line. Once finish() has been called
/// all of them are written, each once, and nothing besides. kPastCaches: whole lines go past the
/// caches.
template <typename V, bool kPastCaches = false, std::size_t kPlanes = 1>
class LineStream {
  using T = ScalarOf<V>;
  static constexpr std::size_t kL = kLanes<V>;
  static constexpr unsigned kAll = (1U << kL) - 1U;
  static constexpr bool kOne = kPlanes == 1;

public:
  using Values = V[kPlanes];

  LineStream() = default; ///< has no values yet
  /// Members are copied one by one. As a whole they would be read in larger pieces than they were
  /// written in, which waits for all streaming stores before.
  SIMDBEZIER_INLINE LineStream(const LineStream& other) { *this = other; }
  SIMDBEZIER_INLINE LineStream& operator=(const LineStream& other) {
    filled_ = other.filled_;
    line_ = other.line_;
    own_ = other.own_;
    if constexpr (!kOne) {
      first_ = other.first_;
    }
    repeat<kPlanes>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA { last_[c] = other.last_[c]; });
    return *this;
  }
  ~LineStream() = default;
  explicit SIMDBEZIER_INLINE LineStream(T* to) { begin(to); }

  SIMDBEZIER_INLINE void begin(T* to) {
    filled_ = reinterpret_cast<std::uintptr_t>(to) % 64 / sizeof(T);
    line_ = to - filled_;
    own_ = kAll << filled_;
    for (V& last : last_) {
      last = broadcast<V>(T(0));
    }
  }
  /// These pointers stay until finish() has been called.
  SIMDBEZIER_INLINE void begin(T* const (&first)[kPlanes]) {
    first_ = first;
    begin(first[0]);
  }
  SIMDBEZIER_INLINE void put(const Values& values) {
    const LaneWindow window(kL - filled_, T());
    repeat<kPlanes>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      store(c, window.of(last_[c], values[c]));
      last_[c] = values[c];
    });
    end_line();
  }
  SIMDBEZIER_INLINE void put(V values) {
    const Values one = {values};
    put(one);
  }
  SIMDBEZIER_INLINE void put(RegisterPair<V> values) {
    put(values.low);
    put(values.high);
  }
  /// The first `count` lanes, all of them at most.
  SIMDBEZIER_INLINE void put_first(const Values& values, std::size_t count) {
    const LaneWindow window(kL - filled_, T());
    const LaneWindow kept(count, T());
    const bool full = advance(count);
    repeat<kPlanes>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      if (full) {
        store(c, window.of(last_[c], values[c]));
      }
      last_[c] = kept.of(last_[c], values[c]);
    });
    if (full) {
      end_line();
    }
  }
  SIMDBEZIER_INLINE void put_first(V values, std::size_t count) {
    const Values one = {values};
    put_first(one, count);
  }
  /// More than those of one register.
  SIMDBEZIER_INLINE void put_first(RegisterPair<V> values, std::size_t count) {
    put(values.low);
    put_first(values.high, count - kL);
  }
  /// Puts `count` values, a register and more. value(k) is the k-th register of them; of the last
  /// one, as many lanes count as there are values.
  template <typename Value>
  SIMDBEZIER_INLINE void put_row(std::size_t count, const Value& value) {
    const LaneWindow window(kL - filled_, T());
    const std::size_t whole = count / kL;
    T* line = line_;
    V last = last_[0];
    std::size_t k = 0;
    if (own_ != kAll) [[unlikely]] {
      put(value(0));
      line = line_;
      last = last_[0];
      ++k;
    }
    for (; k < whole; ++k, line += kL) {
      const V values = value(k);
      store_whole(line, window.of(last, values));
      last = values;
    }
    line_ = line;
    last_[0] = last;
    if (count % kL > 0) {
      put_first(value(whole), count % kL);
    }
  }
  /// One value each, `step` values from one plane to the next.
  SIMDBEZIER_INLINE void put_value(const T* values, std::size_t step = 0) {
    put_appended([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      return append_value(last_[c], values + c * step);
    });
  }
  SIMDBEZIER_INLINE void put_lane(V from, std::size_t lane) {
    put_appended([&](std::size_t c)
                     SIMDBEZIER_INLINE_LAMBDA { return append_lane(last_[c], from, lane); });
  }
  SIMDBEZIER_INLINE void finish() const {
    const unsigned lanes = own_ & ((1U << filled_) - 1U);
    const LaneWindow window(kL - filled_, T());
    for (std::size_t c = 0; lanes != 0 && c < kPlanes; ++c) {
      store_line(place(c), lanes, window.of(last_[c], last_[c]));
    }
  }

private:
  /// Returns where the line of plane c begins.
  SIMDBEZIER_INLINE T* place(std::size_t c) const {
    return kOne ? line_ : first_[c] + (line_ - first_[0]);
  }
  static SIMDBEZIER_INLINE void store_whole(T* to, V line) {
    store_any<kPastCaches>(to, __builtin_bit_cast(LinePart<T>, line));
  }
  SIMDBEZIER_INLINE void store(std::size_t c, V line) const {
    if (kPastCaches && own_ == kAll) [[likely]] {
      store_whole(place(c), line);
    } else {
      store_line(place(c), own_, line);
    }
  }
  SIMDBEZIER_INLINE void end_line() {
    own_ = kAll;
    line_ += kL;
  }
  /// Counts lanes, and returns whether the line is full.
  SIMDBEZIER_INLINE bool advance(std::size_t count) {
    filled_ += count;
    const bool full = filled_ >= kL;
    filled_ -= full ? kL : 0;
    return full;
  }
  template <typename Append>
  SIMDBEZIER_INLINE void put_appended(const Append& append) {
    const bool full = advance(1);
    repeat<kPlanes>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      last_[c] = append(c);
      if (full) {
        store(c, last_[c]);
      }
    });
    if (full) {
      end_line();
    }
  }

  std::size_t filled_ = 0;    ///< first lanes of the line that are put already, or somebody else's
  T* line_ = nullptr;         ///< the next one to be stored, of the first plane
  unsigned own_ = 0;          ///< those of its lanes that are not somebody else's
  T* const* first_ = nullptr; ///< where several planes begin
  V last_[kPlanes]; ///< registers of the values put last, the very last ones in their last lanes
};
#else
inline constexpr bool kStreamsLines = false;

/// On AVX2, simd/value_stream.hpp has those that go past the caches.
template <typename V, bool kPastCaches = false, std::size_t kPlanes = 1>
class LineStream;
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
