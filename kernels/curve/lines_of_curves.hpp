// Rows of few samples, of which a cache line holds one or several: lanes = samples, of as many
// curves as fit in.
//
// A line of each plane, or three of triples, are computed in registers and leave at once, past the
// caches as well. With curves in lanes, rows would have to be put together from pieces of 128 bits,
// which wait in the store queue behind those to memory.
#pragma once

#include "kernels/curve/curve_rows.hpp"
#include "kernels/simd/structures_across.hpp"
#include "kernels/simd/value_stream.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T>
inline constexpr std::size_t kLineSamples = 64 / sizeof(T);

/// Returns how many curves a register holds of rows of n samples that fill lines: 1 where a row is
/// a register or more.
template <typename T>
SIMDBEZIER_PART std::size_t curves_in_register(std::size_t n) {
  constexpr std::size_t kAll = kLanes<vec<T>>;
  return n < kAll ? kAll / n : 1;
}
/// This is the most that it returns.
template <typename T>
inline constexpr std::size_t kMostCurves = kLanes<vec<T>> / 4;

/// Rows of cubics without origins by lines.
template <std::size_t kCurves, bool kTriples, typename T>
class CurveLines {
  using V = vec<T>;
  static constexpr std::size_t kParts = kLineSamples<T> / kLanes<V>;

public:
  static constexpr std::size_t kStreams = CurveRows<kTriples, T>::kStreams;
  static constexpr std::size_t kRegisters = 3 / kStreams * kParts; ///< of each stream
  using Lines = LinePart<T>[kStreams][kRegisters];

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

  /// Evaluates a line of each plane, or three of triples: those of the curves whose first component
  /// has its values at `from` and a stride behind each other.
  SIMDBEZIER_PART void evaluate(const T* from, Lines& lines) const {
    repeat<kParts>([&](std::size_t part) SIMDBEZIER_INLINE_LAMBDA {
      const T* const curve = from + place_[part];
      LinePart<T> value[3];
      repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
        value[c] = __builtin_bit_cast(LinePart<T>, position(curve + c * kCubicValues, x_[part]));
      });
      if constexpr (kTriples) {
        LinePart<T> records[3];
        form_records<T>(value, records);
        repeat<3>([&](std::size_t k)
                      SIMDBEZIER_INLINE_LAMBDA { lines[0][3 * part + k] = records[k]; });
      } else {
        repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA { lines[c][part] = value[c]; });
      }
    });
  }
  /// Writes them to rows, from their value `at` on.
  SIMDBEZIER_PART void put(const T* from, const CurveRows<kTriples, T>& rows, std::size_t at,
                           bool streaming) const {
    Lines lines;
    evaluate(from, lines);
    repeat<kStreams>([&](std::size_t s) SIMDBEZIER_INLINE_LAMBDA {
      repeat<kRegisters>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
        store(rows.first[s] + at + k * kLanes<V>, lines[s][k], streaming);
      });
    });
  }
  /// Streams them, wherever rows begin.
  SIMDBEZIER_PART void put(const T* from, LineStream<V, true> (&streams)[kStreams]) const {
    Lines lines;
    evaluate(from, lines);
    repeat<kStreams>([&](std::size_t s) SIMDBEZIER_INLINE_LAMBDA {
      streams[s].put_row(kRegisters * kLanes<V>, [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
        return __builtin_bit_cast(V, lines[s][k]);
      });
    });
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
    split_groups<4>(coefficients, power);
    const V inside = row_series<0>(Order<kOrderOfCubics>(kOrderOfCubics), x,
                                   [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return power[k]; })
                         .value;
    const V ends = join_fours<kCurves, V>(values + 2, stride_);
    return select_ends(x, broadcast_in_groups<4, 2>(ends), broadcast_in_groups<4, 3>(ends), inside);
  }

  std::size_t n_;
  std::size_t stride_;
  V x_[kParts];
  std::size_t place_[kParts]; ///< of each part's first curve
};

/// Writes the curves that are too few for a line, `count` of them, by way of the stack, because
/// nothing is read behind the last one, nor written.
template <std::size_t kCurves, bool kTriples, typename T>
SIMDBEZIER_PART void fill_last_line(const CurveLines<kCurves, kTriples, T>& lines, const T* from,
                                    std::size_t stride, std::size_t count,
                                    const CurveRows<kTriples, T>& rows, std::size_t row) {
  constexpr std::size_t kValues = (kTriples ? 3 : 1) * kLineSamples<T>; // of each stream
  constexpr std::size_t kMostStride = kMostComponents * kCubicValues;
  T values[kLineSamples<T> / 4 * kMostStride];
  for (std::size_t k = 0; k < lines.curves(); ++k) {
    __builtin_memcpy(values + k * stride, from + std::min(k, count - 1) * stride,
                     3 * kCubicValues * sizeof(T));
  }
  alignas(64) T line[CurveRows<kTriples, T>::kStreams * kValues];
  CurveRows<kTriples, T> to;
  for (std::size_t k = 0; k < rows.kStreams; ++k) {
    to.first[k] = line + k * kValues;
  }
  lines.put(values, to, 0, false);
  for (std::size_t k = 0; k < rows.kStreams; ++k) {
    __builtin_memcpy(rows.first[k], to.first[k], count * row * sizeof(T));
  }
}

/// Writes the rows of all curves of a task.
///
/// One place serves all streams, so that it and they stay in registers: pointers that were kept in
/// memory and read back as a pair waited for all streaming stores before them.
template <std::size_t kCurves, bool kTriples, typename T>
SIMDBEZIER_KERNEL void fill_lines(const CurveTask<T>& shared_task,
                                  const CurveRows<kTriples, T>& shared_rows) {
  using Lines = CurveLines<kCurves, kTriples, T>;
  constexpr std::size_t kValues = (kTriples ? 3 : 1) * kLineSamples<T>; // of each stream
  const CurveTask<T> task = shared_task;
  const CurveRows<kTriples, T> rows = shared_rows;
  const std::size_t stride = shared_task.shape->values();
  const Lines lines(task.x, task.n, stride);
  const std::size_t together = lines.curves();
  const T* from = task.values + task.first_component * kCubicValues;
  const std::size_t whole = task.curve_count / together;
  std::size_t at = 0;
  const auto for_lines = [&](const auto& put) SIMDBEZIER_INLINE_LAMBDA {
    for (std::size_t k = 0; k < whole; ++k, from += together * stride, at += kValues) {
      if (task.prefetch) {
        prefetch_values(from + kValuesAhead<T>, together * stride);
      }
      if (task.streaming && is_turn_to_ask<T, kValues>(at)) [[unlikely]] {
        repeat<Lines::kStreams>([&](std::size_t s) SIMDBEZIER_INLINE_LAMBDA {
          ask_until_next_turn<kValues>(rows.first[s] + at);
        });
      }
      put();
    }
  };
  if (task.streaming && whole > 0 && !rows.begin_lines()) {
    LineStream<vec<T>, true> streams[Lines::kStreams];
    repeat<Lines::kStreams>([&](std::size_t s)
                                SIMDBEZIER_INLINE_LAMBDA { streams[s].begin(rows.first[s]); });
    for_lines([&]() SIMDBEZIER_INLINE_LAMBDA { lines.put(from, streams); });
    repeat<Lines::kStreams>([&](std::size_t s) SIMDBEZIER_INLINE_LAMBDA { streams[s].finish(); });
  } else {
    for_lines([&]() SIMDBEZIER_INLINE_LAMBDA { lines.put(from, rows, at, task.streaming); });
  }
  const std::size_t rest = task.curve_count - whole * together;
  if (rest > 0) [[unlikely]] {
    fill_last_line(lines, from, stride, rest, rows.at(at), rows.row(task.n));
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
