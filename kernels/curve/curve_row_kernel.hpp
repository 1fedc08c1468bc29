// Positions of curves straight to the caller's layout: planes or x y z triples, through the caches
// or past them, at any place in memory. Where they are streamed, cubics leave from registers, as
// lines of whole curves (lines_of_curves.hpp) or joined (joined_rows.hpp), and others by way of
// rings in the first-level cache.
#pragma once

#include "kernels/curve/joined_rows.hpp"
#include "kernels/curve/lanes_are_curves.hpp"
#include "kernels/curve/lanes_are_samples.hpp"
#include "kernels/curve/line_ring.hpp"
#include "kernels/curve/lines_of_curves.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Curves that are whole lines, whatever the number of samples.
template <typename T>
inline constexpr std::size_t kLineCurves = 64 / sizeof(T);

/// This many values are passed on while as many are computed, or those of kLineCurves where they
/// are more. They are few, because lines that coefficients push out of the first-level cache cost a
/// store as much as the way to memory; but stores must have reached that cache before they are
/// read.
template <typename T>
inline constexpr std::size_t kRowBatch = 2048 / sizeof(T);

/// This is the room for rings of all planes, and for what is put together before it is copied.
template <typename T>
inline constexpr std::size_t kRowMemory = 2 * (3 * detail::kMostRow + 3) * kLineCurves<T>;

/// Rings that rows go through on their way past the caches, and how much of them is passed on at a
/// time.
template <bool kTriples, typename T>
class RowRings {
  using Rows = CurveRows<kTriples, T>;

public:
  /// memory has room for two batches of `batch` values of each stream, and a step passes on `lines`
  /// of what goes to `to`.
  SIMDBEZIER_PART void start(T* memory, std::size_t batch, std::size_t lines, const Rows& to) {
    lines_per_step_ = lines;
    for (std::size_t k = 0; k < Rows::kStreams; ++k) {
      ring_[k].start(memory, batch, to.first[k]);
      memory += LineRing<T>::room(batch);
    }
  }

  /// Returns where the next batch is to be written.
  [[nodiscard]] SIMDBEZIER_PART Rows batch() const {
    Rows rows;
    for (std::size_t k = 0; k < Rows::kStreams; ++k) {
      rows.first[k] = ring_[k].batch();
    }
    return rows;
  }
  SIMDBEZIER_PART void pass_on() {
    std::size_t lines = lines_per_step_;
    for (std::size_t k = 0; k < Rows::kStreams && lines > 0; ++k) {
      lines = ring_[k].pass_on(lines);
    }
  }
  /// The batch is written, so many values of each stream.
  SIMDBEZIER_PART void turn(std::size_t values) {
    for (LineRing<T>& r : ring_) {
      r.pass_all();
      r.turn(values);
    }
  }
  SIMDBEZIER_PART void finish() {
    for (LineRing<T>& r : ring_) {
      r.finish();
    }
  }

private:
  LineRing<T> ring_[Rows::kStreams];
  std::size_t lines_per_step_ = 0;
};

/// A register is filled with samples of a curve, or with a sample of each of many curves. Any other
/// number is that of the curves whose samples fill it, by lines, which need no rings.
inline constexpr std::size_t kAlong = 0;
inline constexpr std::size_t kAcross = ~std::size_t(0);

/// Fills rows of curves [begin, end), `batch` at a time, by way of rings in `memory`, or in place
/// where that is null. There is one copy of the code for both.
template <std::size_t kKnownOrder, bool kAcrossCurves, bool kTriples, typename T>
SIMDBEZIER_PART void fill_by_rings(const CurveTask<T>& task, const CurveShape& shape,
                                   std::size_t begin, std::size_t end, std::size_t batch,
                                   const CurveRows<kTriples, T>& rows, T* memory) {
  const std::size_t row = rows.row(task.n);
  // Rings are made here and stay here: copied as a whole, they would be read in pieces other than
  // those that were written, and wait for all streaming stores before.
  RowRings<kTriples, T> rings;
  const bool by_rings = memory != nullptr;
  if (by_rings) {
    constexpr std::size_t kStep = kLanes<vec<T>> * (kAcrossCurves ? kAcrossStep : 1);
    rings.start(memory, batch * row, (3 * kStep * sizeof(T) + 63) / 64, rows);
  }
  const auto pass_on = [&]() SIMDBEZIER_INLINE_LAMBDA {
    if (by_rings) {
      rings.pass_on();
    }
  };
  for (std::size_t first = begin; first < end; first += batch) {
    const std::size_t last = std::min(first + batch, end);
    const CurveRows<kTriples, T> to = by_rings ? rings.batch() : rows.at((first - begin) * row);
    if constexpr (kAcrossCurves) {
      fill_across<kKnownOrder>(task, shape, first, last, to, pass_on);
    } else {
      fill_along<kKnownOrder>(task, shape, first, last, to, false, pass_on);
    }
    if (by_rings) {
      rings.turn((last - first) * row);
    }
  }
  if (by_rings) {
    rings.finish();
  }
}

/// Writes curves [begin, end) to rows, `batch` at a time: by way of rings where there is memory for
/// them, else in place. It is a function of its own, because it is large and there are several ways
/// to it.
template <std::size_t kKnownOrder, std::size_t kWay, bool kTriples, typename T>
SIMDBEZIER_KERNEL void
fill_rows(const CurveTask<T>& shared_task, std::size_t begin, std::size_t end, std::size_t batch,
          const CurveRows<kTriples, T>& shared_rows, bool streaming, T* memory) {
  // Copies, because stores through vector types might change anything that others can see.
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  const CurveRows<kTriples, T> rows = shared_rows;
  if constexpr (kWay != kAlong && kWay != kAcross) {
    fill_lines<kWay>(task, shape, begin, end, rows, streaming);
  } else if constexpr (kWay == kAcross) {
    fill_by_rings<kKnownOrder, true>(task, shape, begin, end, batch, rows, memory);
  } else if (memory != nullptr) {
    fill_by_rings<kKnownOrder, false>(task, shape, begin, end, batch, rows, memory);
  } else { // without a test after every register: 5 % of streaming stores
    const std::size_t row = rows.row(task.n);
    for (std::size_t first = begin; first < end; first += batch) {
      const CurveRows<kTriples, T> to = rows.at((first - begin) * row);
      if (streaming) { // triples, as fill_along() says: one stream
        ask_for_pages(page_behind(to.first[0]), batch * row * sizeof(T));
      }
      fill_along<kKnownOrder>(task, shape, first, std::min(first + batch, end), to, streaming,
                              []() SIMDBEZIER_INLINE_LAMBDA {});
    }
  }
}

/// This is fill_rows() for a degree and a way.
template <bool kTriples, typename T>
struct RowFiller {
  void (*fill)(const CurveTask<T>& task, std::size_t begin, std::size_t end, std::size_t batch,
               const CurveRows<kTriples, T>& rows, bool streaming, T* memory);
  bool across = false; ///< whole registers of curves
  bool lines = false;  ///< by lines
};
template <std::size_t kKnownOrder, std::size_t kWay, bool kTriples, typename T>
constexpr RowFiller<kTriples, T> row_filler() {
  return {fill_rows<kKnownOrder, kWay, kTriples, T>, kWay == kAcross,
          kWay != kAlong && kWay != kAcross};
}

/// Writes rows in place; where lanes are curves, those too few for a register go through `memory`.
template <bool kTriples, typename T>
SIMDBEZIER_PART void write_rows(const CurveTask<T>& task, const CurveRows<kTriples, T>& out,
                                const RowFiller<kTriples, T>& way, T* memory) {
  constexpr std::size_t kAll = kLanes<vec<T>>;
  const std::size_t row = out.row(task.n);
  const std::size_t count = task.curve_count;
  if (!way.across) {
    const std::size_t batch = std::max<std::size_t>(kRowBatch<T> / (3 * task.n), 1);
    return way.fill(task, 0, count, batch, out, task.streaming, nullptr);
  }
  const std::size_t whole = count / kAll * kAll;
  way.fill(task, 0, whole, whole, out, false, nullptr);
  if (whole < count) {
    CurveRows<kTriples, T> rows;
    for (std::size_t k = 0; k < out.kStreams; ++k) {
      rows.first[k] = memory + k * kAll * row;
    }
    way.fill(task, whole, count, count, rows, false, nullptr);
    for (std::size_t k = 0; k < out.kStreams; ++k) {
      __builtin_memcpy(out.first[k] + whole * row, rows.first[k],
                       (count - whole) * row * sizeof(T));
    }
  }
}

/// Writes rows to rings that pass them on past the caches, since streaming stores take whole lines.
template <bool kTriples, typename T>
SIMDBEZIER_PART void stream_rows(const CurveTask<T>& task, const CurveRows<kTriples, T>& out,
                                 const RowFiller<kTriples, T>& way, T* memory) {
  const std::size_t groups = kRowBatch<T> / (3 * task.n * kLineCurves<T>);
  const std::size_t batch = std::max<std::size_t>(groups, 1) * kLineCurves<T>;
  way.fill(task, 0, task.curve_count, batch, out, false, memory);
}

/// Returns of how many curves registers are filled by lines, 0 where that does not pay. Stores that
/// stay in the caches want it for triples of several curves alone, and streaming ones need no help
/// where each register is a line already.
template <bool kTriples, typename T>
SIMDBEZIER_PART std::size_t curves_by_lines(const CurveTask<T>& task, bool begin_lines) {
  if (task.shape->degree != 3 || task.shape->origins) {
    return 0;
  }
  const std::size_t curves = curves_in_register<T>(task.n);
  const bool are_lines = kLineWide<vec<T>> && task.n == kLanes<vec<T>> && begin_lines;
  return (task.streaming ? !are_lines : kTriples && curves > 1) ? curves : 0;
}

/// Chooses how rows are filled: short ones of cubics by lines where that pays, other rows of fewer
/// samples than a register with curves in its lanes.
template <bool kTriples, typename T>
SIMDBEZIER_PART RowFiller<kTriples, T> choose_filler(const CurveTask<T>& task, bool begin_lines) {
  constexpr std::size_t kAll = kLanes<vec<T>>;
  const bool cubic = task.shape->degree == 3;
  if constexpr (kAll * sizeof(T) >= 32) {
    const std::size_t curves = curves_by_lines<kTriples>(task, begin_lines);
    if constexpr (kMostCurves<T> >= 4) {
      if (curves == 4) {
        return row_filler<4, 4, kTriples, T>();
      }
    }
    if constexpr (kMostCurves<T> >= 2) {
      if (curves == 2) {
        return row_filler<4, 2, kTriples, T>();
      }
    }
    if (curves == 1) {
      return row_filler<4, 1, kTriples, T>();
    }
  }
  if constexpr (kAll > detail::kLeastRow) {
    if (task.n < kAll) {
      return cubic ? row_filler<4, kAcross, kTriples, T>() : row_filler<0, kAcross, kTriples, T>();
    }
  }
  return cubic ? row_filler<4, kAlong, kTriples, T>() : row_filler<0, kAlong, kTriples, T>();
}

template <bool kTriples, typename T>
SIMDBEZIER_KERNEL void evaluate_rows(const CurveTask<T>& task) {
  CurveRows<kTriples, T> out;
  for (std::size_t k = 0; k < out.kStreams; ++k) {
    out.first[k] =
        kTriples ? task.triples : task.out[output_index(CurveOutput::position)].component[k];
  }
  const RowFiller<kTriples, T> way = choose_filler<kTriples>(task, out.begin_lines());
  if constexpr (kLanes<vec<T>> * sizeof(T) >= 32) {
    if (task.may_join && !way.lines) {
      return stream_joined(task, out);
    }
  }
  const bool whole_lines = way.lines || (kTriples && out.begin_lines() && !way.across &&
                                         kLineWide<vec<T>> && task.n % kLanes<vec<T>> == 0);
  static_assert(kRowBatch<T> <= 3 * detail::kMostRow * kLineCurves<T>);
  alignas(64) T memory[kRowMemory<T>];
  if (task.streaming && !whole_lines) {
    stream_rows(task, out, way, memory);
  } else {
    write_rows(task, out, way, memory);
  }
}

template <typename T>
SIMDBEZIER_PART void evaluate_rows(const CurveTask<T>& task) {
  task.triples != nullptr ? evaluate_rows<true>(task) : evaluate_rows<false>(task);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
