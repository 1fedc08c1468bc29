// Rows of short curves: lanes = curves.
//
// Where samples are lanes (curve/lanes_are_samples.hpp), a curve of few samples leaves most of a
// register idle and every coefficient is broadcast for it. Here coefficients are turned once a
// curve, parameters are the same in all lanes, ends cost nothing, and results are turned back into
// rows, whatever the number of samples.
#pragma once

#include <algorithm>

#include "kernels/curve/curve_rows.hpp"
#include "kernels/simd/structures_across.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Samples that are turned into rows at a time. The last ones of a curve may be done twice.
inline constexpr std::size_t kAcrossStep = detail::kLeastRow;

/// Three components of a register of curves of one cell.
template <typename V, std::size_t kKnownOrder>
class CurveColumns {
  using T = ScalarOf<V>;
  using N = Order<kKnownOrder>;
  static constexpr std::size_t kMostOrderAcross =
      kKnownOrder > 0 ? kKnownOrder : detail::kMostWholeDegree + 1;

public:
  static constexpr std::size_t kMostValues = 3 * (kMostOrderAcross + 3);

  /// values are those of the first component of the first curve.
  SIMDBEZIER_PART CurveColumns(const CurveShape& shape, const T* values, std::size_t stride)
      : order_(shape.order()), channel_(shape.channel_values()), origins_(shape.origins) {
    const std::size_t count = 3 * channel_;
    for (std::size_t k = 0; k + kQuad<V> < count; k += kQuad<V>) {
      load_across<V>(values + k, stride, value_ + k);
    }
    // Some of them are loaded twice, but nothing behind the last curve.
    load_across<V>(values + count - kQuad<V>, stride, value_ + count - kQuad<V>);
  }

  /// Evaluates one component of kAcrossStep samples. any_end says that some of them may be ends.
  SIMDBEZIER_PART void evaluate(std::size_t component, const T* x, bool any_end, V* result) const {
    const V* const c = value_ + component * channel_;
    repeat<kAcrossStep>([&](std::size_t j) SIMDBEZIER_INLINE_LAMBDA {
      const auto coefficient = [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return c[k]; };
      result[j] = row_series<0>(order_, broadcast<V>(x[j]), coefficient).value;
    });
    if (origins_) [[unlikely]] {
      repeat<kAcrossStep>([&](std::size_t j) SIMDBEZIER_INLINE_LAMBDA {
        result[j] = result[j] + c[order_.value() + 2];
      });
    }
    if (any_end) {
      repeat<kAcrossStep>([&](std::size_t j) SIMDBEZIER_INLINE_LAMBDA {
        if (x[j] == T(-0.5)) {
          result[j] = c[order_.value()];
        } else if (x[j] == T(0.5)) {
          result[j] = c[order_.value() + 1];
        }
      });
    }
  }

private:
  V value_[kMostValues];
  N order_;
  std::size_t channel_;
  bool origins_;
};

template <typename T>
SIMDBEZIER_PART bool any_end(const T* x) {
  bool any = false;
  for (std::size_t j = 0; j < kAcrossStep; ++j) {
    any |= x[j] == T(-0.5) || x[j] == T(0.5);
  }
  return any;
}

/// Stores kCount values of every curve in rows.
template <std::size_t kCount, typename V>
SIMDBEZIER_PART void store_samples(const V* values, ScalarOf<V>* to, std::size_t stride) {
  repeat<kCount / kQuad<V>>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    store_across(values + k * kQuad<V>, to + k * kQuad<V>, stride);
  });
}

/// Fills the rows of a register of curves.
template <bool kTriples, typename V, std::size_t kKnownOrder, typename T>
SIMDBEZIER_INLINE void fill_columns(const CurveColumns<V, kKnownOrder>& curves, const T* x,
                                    std::size_t n, const CurveRows<kTriples, T>& rows) {
  for (std::size_t begin = 0; begin < n; begin += kAcrossStep) {
    const std::size_t s = begin + kAcrossStep <= n ? begin : n - kAcrossStep;
    const bool ends = any_end(x + s);
    V value[3][kAcrossStep];
    repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      curves.evaluate(c, x + s, ends, value[c]);
      if constexpr (!kTriples) {
        store_samples<kAcrossStep>(value[c], rows.first[c] + s, n);
      }
    });
    if constexpr (kTriples) {
      V triples[3 * kAcrossStep];
      repeat<3 * kAcrossStep>([&](std::size_t k)
                                  SIMDBEZIER_INLINE_LAMBDA { triples[k] = value[k % 3][k / 3]; });
      store_samples<3 * kAcrossStep>(triples, rows.first[0] + 3 * s, 3 * n);
    }
  }
}

/// Writes curves [begin, end) to rows, which must have room for whole registers of curves.
template <std::size_t kKnownOrder, bool kTriples, typename T>
SIMDBEZIER_INLINE void fill_across(const CurveTask<T>& task, const CurveShape& shape,
                                   std::size_t begin, std::size_t end,
                                   const CurveRows<kTriples, T>& rows) {
  using V = vec<T>;
  using Columns = CurveColumns<V, kKnownOrder>;
  const std::size_t values = 3 * shape.channel_values();
  for (std::size_t first = begin; first < end; first += kLanes<V>) {
    std::size_t stride = shape.values();
    const T* from = task.values + first * stride + task.first_component * shape.channel_values();
    T padded[Columns::kMostValues * kLanes<V>];
    if (end - first < kLanes<V>) [[unlikely]] { // there is nothing to read behind the last curve
      for (std::size_t p = 0; p < kLanes<V>; ++p) {
        const T* const curve = from + std::min(p, end - first - 1) * stride;
        for (std::size_t k = 0; k < values; ++k) {
          padded[p * values + k] = curve[k];
        }
      }
      from = padded;
      stride = values;
    }
    if (task.prefetch) {
      prefetch_values(from + kValuesAhead<T>, kLanes<V> * stride);
    }
    const Columns curves(shape, from, stride);
    fill_columns(curves, task.x, task.n, rows.at((first - begin) * rows.row(task.n)));
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
