// Rows of few samples, of which a cache line holds one or several: lanes = samples, of as many
// curves as fit in.
//
// A line of each plane, or three of triples, are computed in registers and leave at once, past the
// caches as well. Where curves are lanes (curve/lanes_are_curves.hpp) rows are put together from
// pieces of 128 bits, which wait in the store queue behind those to memory.
#pragma once

#include "kernels/curve/curve_rows.hpp"
#include "kernels/simd/structures_across.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T>
inline constexpr std::size_t kLineSamples = 64 / sizeof(T);

/// Returns how many curves a register holds of rows of n samples: 1 where a row is a register or
/// more, 0 where rows are not written by lines. Rows of one register that is a line need no such
/// help.
template <typename T>
SIMDBEZIER_PART std::size_t curves_in_register(std::size_t n) {
  constexpr std::size_t kAll = kLanes<vec<T>>;
  if (n < 4 || kLineSamples<T> % n != 0 || (kLineWide<vec<T>> && n == kAll)) {
    return 0;
  }
  return n < kAll ? kAll / n : 1;
}
/// These are the fewest and the most curves of a register.
template <typename T>
inline constexpr std::size_t kLeastCurves = kLineWide<vec<T>> ? 2 : 1;
template <typename T>
inline constexpr std::size_t kMostCurves = kLanes<vec<T>> / 4;

/// Rows of cubics without origins by lines.
template <std::size_t kCurves, bool kTriples, typename T>
class CurveLines {
  using V = vec<T>;
  static constexpr std::size_t kParts = kLineSamples<T> / kLanes<V>;
  static constexpr std::size_t kOrderOfCubics = 4;

public:
  CurveLines(const T* x, std::size_t n, std::size_t stride) : n_(n), stride_(stride) {
    for (std::size_t part = 0; part < kParts; ++part) {
      alignas(64) T own[kLanes<V>];
      for (std::size_t lane = 0; lane < kLanes<V>; ++lane) {
        own[lane] = x[(part * kLanes<V> + lane) % n];
      }
      x_[part] = load_vector<V>(own);
      place_[part] = part * kLanes<V> / n * stride;
    }
  }

  /// Returns the number of curves of one line.
  [[nodiscard]] SIMDBEZIER_PART std::size_t curves() const { return kLineSamples<T> / n_; }

  /// Writes the curves whose first component has its values at `from` and a stride behind each
  /// other.
  SIMDBEZIER_PART void put(const T* from, const CurveRows<kTriples, T>& rows,
                           bool streaming) const {
    LinePart<T> value[kParts][3];
    repeat<kParts>([&](std::size_t part) SIMDBEZIER_INLINE_LAMBDA {
      const T* const curve = from + place_[part];
      repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
        value[part][c] =
            __builtin_bit_cast(LinePart<T>, position(curve + c * (kOrderOfCubics + 2), x_[part]));
      });
    });
    if constexpr (kTriples) {
      LinePart<T> line[kParts][3];
      repeat<kParts>([&](std::size_t part)
                         SIMDBEZIER_INLINE_LAMBDA { form_records<T>(value[part], line[part]); });
      repeat<kParts>([&](std::size_t part) SIMDBEZIER_INLINE_LAMBDA {
        repeat<3>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
          store(rows.first[0] + (3 * part + k) * kLanes<V>, line[part][k], streaming);
        });
      });
    } else {
      repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
        repeat<kParts>([&](std::size_t part) SIMDBEZIER_INLINE_LAMBDA {
          store(rows.first[c] + part * kLanes<V>, value[part][c], streaming);
        });
      });
    }
  }

private:
  /// Both kinds of stores have one place, since twice the code would gain nothing.
  static SIMDBEZIER_PART void store(T* to, LinePart<T> value, bool streaming) {
    if (streaming) {
      store_any<true>(to, value);
    } else {
      store_any<false>(to, value);
    }
  }

  /// Evaluates one component, whose values are its coefficients and then both ends.
  SIMDBEZIER_PART V position(const T* values, V x) const {
    const V coefficients = join_fours<kCurves, V>(values, stride_);
    V power[kOrderOfCubics];
    split_fours(coefficients, power);
    const V inside = row_series<0>(Order<kOrderOfCubics>(kOrderOfCubics), x,
                                   [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return power[k]; })
                         .value;
    const V ends = join_fours<kCurves, V>(values + 2, stride_);
    return select_where<V>(
        x == broadcast<V>(T(-0.5)), broadcast_in_four<2>(ends),
        select_where<V>(x == broadcast<V>(T(0.5)), broadcast_in_four<3>(ends), inside));
  }

  std::size_t n_;
  std::size_t stride_;
  V x_[kParts];
  std::size_t place_[kParts]; ///< of each part's first curve
};

/// Writes curves [begin, end) to rows. Where they are streamed, rows begin on a line.
template <std::size_t kCurves, bool kTriples, typename T>
SIMDBEZIER_PART void fill_lines(const CurveTask<T>& task, const CurveShape& shape,
                                std::size_t begin, std::size_t end, CurveRows<kTriples, T> rows,
                                bool streaming) {
  constexpr std::size_t kValues = (kTriples ? 3 : 1) * kLineSamples<T>; // of each stream
  constexpr std::size_t kCubic = 3 * 6;
  constexpr std::size_t kMostStride = kMostComponents * 6;
  const std::size_t stride = shape.values();
  const CurveLines<kCurves, kTriples, T> lines(task.x, task.n, stride);
  const std::size_t together = lines.curves();
  const T* from = task.values + begin * stride + task.first_component * shape.channel_values();
  T values[kLineSamples<T> / 4 * kMostStride];
  alignas(64) T line[CurveRows<kTriples, T>::kStreams * kValues];
  for (; begin < end; begin += together, from += together * stride, rows = rows.at(kValues)) {
    const std::size_t left = end - begin;
    CurveRows<kTriples, T> to = rows;
    if (left < together) [[unlikely]] { // nothing is read behind the last curve, nor written
      for (std::size_t k = 0; k < together; ++k) {
        __builtin_memcpy(values + k * stride, from + std::min(k, left - 1) * stride,
                         kCubic * sizeof(T));
      }
      from = values;
      for (std::size_t k = 0; k < rows.kStreams; ++k) {
        to.first[k] = line + k * kValues;
      }
    }
    if (task.prefetch) {
      prefetch_values(from + kValuesAhead<T>, together * stride);
    }
    lines.put(from, to, streaming && left >= together);
    if (left < together) [[unlikely]] {
      for (std::size_t k = 0; k < rows.kStreams; ++k) {
        __builtin_memcpy(rows.first[k], to.first[k], left * rows.row(task.n) * sizeof(T));
      }
      return;
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
