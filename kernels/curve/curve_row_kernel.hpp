// Positions of curves straight to the caller's layout: planes or x y z triples, through the caches
// or past them, at any place in memory. Cubics whose rows are a part of a line leave as whole lines
// from registers, the others by way of rings in the first-level cache where they are streamed.
#pragma once

#include "kernels/curve/lanes_are_curves.hpp"
#include "kernels/curve/lanes_are_samples.hpp"
#include "kernels/curve/lines_of_curves.hpp"
#include "kernels/simd/line_ring.hpp"

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
struct RowRings {
  static constexpr std::size_t kStreams = CurveRows<kTriples, T>::kStreams;
  LineRing<T> ring[kStreams];
  std::size_t lines_per_step = 0;

  SIMDBEZIER_PART void pass_on() {
    std::size_t lines = lines_per_step;
    for (std::size_t k = 0; k < kStreams && lines > 0; ++k) {
      lines = ring[k].pass_on(lines);
    }
  }
  [[nodiscard]] SIMDBEZIER_PART CurveRows<kTriples, T> batch() const {
    CurveRows<kTriples, T> rows;
    for (std::size_t k = 0; k < kStreams; ++k) {
      rows.first[k] = ring[k].batch();
    }
    return rows;
  }
};

/// A register is filled with samples of a curve, or with a sample of each of many curves. Any other
/// number is that of the curves whose samples fill it, by lines, which need no rings.
inline constexpr std::size_t kAlong = 0;
inline constexpr std::size_t kAcross = ~std::size_t(0);

/// Writes curves [begin, end) to rows, `batch` at a time. rings are passed on meanwhile, and null
/// where there are none. It is a function of its own, because it is large and there are several
/// ways to it.
template <std::size_t kKnownOrder, std::size_t kWay, bool kTriples, typename T>
SIMDBEZIER_KERNEL void
fill_rows(const CurveTask<T>& shared_task, std::size_t begin, std::size_t end, std::size_t batch,
          const CurveRows<kTriples, T>& shared_rows, bool streaming, RowRings<kTriples, T>* rings) {
  // Copies, because stores through vector types might change anything that others can see.
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  const CurveRows<kTriples, T> rows = shared_rows;
  RowRings<kTriples, T> ring_state;
  if (rings != nullptr) {
    ring_state = *rings;
  }
  const bool streams = rings != nullptr;
  const auto pass_on = [&]() SIMDBEZIER_INLINE_LAMBDA {
    if (streams) {
      ring_state.pass_on();
    }
  };
  if constexpr (kWay != kAlong && kWay != kAcross) {
    fill_lines<kWay>(task, shape, begin, end, rows, streaming);
  } else if constexpr (kWay == kAcross) {
    fill_across<kKnownOrder>(task, shape, begin, end, rows, pass_on);
  } else if (streams) {
    fill_along<kKnownOrder>(task, shape, begin, end, rows, false, pass_on);
  } else { // without a test after every register: 5 % of streaming stores
    for (std::size_t first = begin; first < end; first += batch) {
      fill_along<kKnownOrder>(task, shape, first, std::min(first + batch, end),
                              rows.at((first - begin) * rows.row(task.n)), streaming,
                              []() SIMDBEZIER_INLINE_LAMBDA {});
    }
  }
  if (rings != nullptr) {
    *rings = ring_state;
  }
}

/// This is fill_rows() for a degree and a way.
template <bool kTriples, typename T>
struct RowFiller {
  void (*fill)(const CurveTask<T>& task, std::size_t begin, std::size_t end, std::size_t batch,
               const CurveRows<kTriples, T>& rows, bool streaming, RowRings<kTriples, T>* rings);
  std::size_t step;    ///< samples of each component between two calls of step()
  bool across = false; ///< whole registers of curves
  bool lines = false;  ///< by lines
};
template <std::size_t kKnownOrder, std::size_t kWay, bool kTriples, typename T>
constexpr RowFiller<kTriples, T> row_filler() {
  return {fill_rows<kKnownOrder, kWay, kTriples, T>,
          kLanes<vec<T>> * (kWay == kAcross ? kAcrossStep : 1), kWay == kAcross,
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
  const std::size_t row = out.row(task.n);
  const std::size_t groups = kRowBatch<T> / (3 * task.n * kLineCurves<T>);
  const std::size_t batch = std::max<std::size_t>(groups, 1) * kLineCurves<T>;
  RowRings<kTriples, T> rings;
  // This is what a step computes, in lines.
  rings.lines_per_step = (3 * way.step * sizeof(T) + 63) / 64;
  for (std::size_t k = 0; k < out.kStreams; ++k) {
    rings.ring[k].start(memory, batch * row, out.first[k]);
    memory += LineRing<T>::room(batch * row);
  }
  for (std::size_t begin = 0; begin < task.curve_count; begin += batch) {
    const std::size_t end = std::min(begin + batch, task.curve_count);
    way.fill(task, begin, end, batch, rings.batch(), false, &rings);
    for (LineRing<T>& r : rings.ring) {
      r.pass_all();
      r.turn((end - begin) * row);
    }
  }
  for (LineRing<T>& r : rings.ring) {
    r.finish();
  }
}

/// Chooses how rows are filled: short ones of cubics by lines where that pays, with stores that
/// stay in the caches for triples alone; other rows of fewer samples than a register with curves in
/// its lanes. aligned says that all streams begin on a line.
template <bool kTriples, typename T>
SIMDBEZIER_PART RowFiller<kTriples, T> choose_filler(const CurveTask<T>& task, bool aligned) {
  constexpr std::size_t kAll = kLanes<vec<T>>;
  const bool cubic = task.shape->degree == 3;
  if constexpr (kAll * sizeof(T) >= 32) {
    constexpr std::size_t kLeast = kTriples ? 2 : kLeastCurves<T>;
    const bool pays = task.streaming ? aligned : kTriples;
    const std::size_t curves =
        cubic && !task.shape->origins && pays ? curves_in_register<T>(task.n) : 0;
    if constexpr ((kMostCurves<T>) > kLeast) {
      if (curves == 2 * kLeast) {
        return row_filler<4, 2 * kLeast, kTriples, T>();
      }
    }
    if constexpr (kMostCurves<T> >= kLeast) {
      if (curves == kLeast) {
        return row_filler<4, kLeast, kTriples, T>();
      }
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
  bool aligned = true;
  for (std::size_t k = 0; k < out.kStreams; ++k) {
    out.first[k] =
        kTriples ? task.triples : task.out[output_index(CurveOutput::position)].component[k];
    aligned = aligned && reinterpret_cast<std::uintptr_t>(out.first[k]) % 64 == 0;
  }
  const RowFiller<kTriples, T> way = choose_filler<kTriples>(task, aligned);
  const bool whole_lines = way.lines || (kTriples && aligned && !way.across && kLineWide<vec<T>> &&
                                         task.n % kLanes<vec<T>> == 0);
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
