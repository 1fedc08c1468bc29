// Stores a register of samples of one curve in the planes of a task.
#pragma once

#include "kernels/curve/curve_formulas.hpp"
#include "kernels/poly/normal_lanes.hpp"
#include "kernels/poly/sample_jets.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A register of samples goes to consecutive values from `at` on.
template <typename V>
struct CurveRange {
  std::size_t curve;
  std::size_t at;
  std::size_t writable; ///< lanes that may be written
  std::size_t own;      ///< lanes that are samples of this curve
  bool streaming;

  SIMDBEZIER_INLINE void store(ScalarOf<V>* plane, V value) const {
    if (writable < kLanes<V>) [[unlikely]] {
      store_first(plane + at, value, writable);
      return;
    }
    store_line(plane + at, value, streaming);
  }
  SIMDBEZIER_INLINE void store_if_wanted(ScalarOf<V>* plane, V value) const {
    if (plane != nullptr) {
      store(plane, value);
    }
  }
};

/// Decides each lane that did not pass the quick test by itself; out of line, because it is rare.
template <typename V, typename Task>
SIMDBEZIER_RARE void resolve_lanes(const Task& task, const CurveShape& shape,
                                   const CurveRange<V>& range, V x, V squared, V floor) {
  using T = ScalarOf<V>;
  alignas(64) T lanes[3][kLanes<V>];
  store_vector(lanes[0], x);
  store_vector(lanes[1], squared);
  store_vector(lanes[2], floor);
  for (std::size_t i = 0; i < range.own; ++i) {
    if (lanes[1][i] > lanes[2][i]) {
      continue;
    }
    const std::size_t at = range.at + i;
    const detail::TangentQuery<T> query{
        &shape, task.given.net(range.curve * shape.control_values()), lanes[0][i]};
    detail::TangentAnswer<T> answer;
    task.resolve_tangent(query, answer);
    for (std::size_t c = 0; c < 3; ++c) {
      T* const plane = task.out[output_index(CurveOutput::tangent)].component[c];
      if (plane != nullptr) {
        plane[at] = answer.tangent[c];
      }
    }
    if (task.curvature != nullptr) {
      task.curvature[at] = answer.curvature;
    }
    if (task.status != nullptr) {
      task.status[at] = answer.status;
    }
  }
}

/// Returns what |C'|^2 has to exceed. inverse is 1 / w of rational curves.
template <bool kRational, typename V>
SIMDBEZIER_INLINE V tangent_floor(ScalarOf<V> of_curve, V inverse, V squared) {
  using T = ScalarOf<V>;
  const V size = broadcast<V>(of_curve);
  if constexpr (!kRational) {
    return size;
  }
  const V infinity = broadcast<V>(static_cast<T>(__builtin_inf()));
  const V error = size * inverse * inverse;
  const V floor = madd(error, error, broadcast<V>(kLeastSquare<T>));
  return select_where<V>(squared < infinity, floor, infinity);
}

/// Stores wanted tangents and curvatures; `jet` has zeros for the components that a curve lacks.
template <bool kRational, typename V, typename Task>
SIMDBEZIER_INLINE void store_tangents(const Task& task, const CurveShape& shape,
                                      const CurveRange<V>& range, V x, V inverse_weight,
                                      const CurveJet<V>& jet) {
  using T = ScalarOf<V>;
  const auto& planes = task.out[output_index(CurveOutput::tangent)];
  const V squared = dot(jet.d1, jet.d1);
  const V inverse = divide(broadcast<V>(T(1)), square_root(squared));
  V tangent[3];
  for (std::size_t c = 0; c < 3; ++c) {
    tangent[c] = jet.d1[c] * inverse;
    range.store_if_wanted(planes.component[c], tangent[c]);
  }
  if (task.curvature != nullptr) {
    // |C' x C''| / |C'|^3 = |t x C''| / |C'|^2, whose squares have a smaller range.
    V normal[3];
    const V bend = square_root(cross_product(tangent, jet.d2, normal));
    range.store(task.curvature, divide(bend, squared));
  }
  const V floor = floor_inside(
      x, tangent_floor<kRational>(task.tangent_floor[range.curve], inverse_weight, squared));
  if (!all_of<V>(squared > floor)) {
    resolve_lanes(task, shape, range, x, squared, floor);
  }
}

/// Returns how far a task needs derivatives.
template <typename Task>
SIMDBEZIER_INLINE std::size_t depth_of(const Task& task) {
  if (task.curvature != nullptr || task.out[output_index(CurveOutput::d2)].wanted()) {
    return 2;
  }
  return task.out[output_index(CurveOutput::d1)].wanted() ||
                 task.out[output_index(CurveOutput::tangent)].wanted()
             ? 1
             : 0;
}

/// Calls f(slot) for three components. This is a loop where their polynomials are loops as well.
template <bool kUnrolled, typename F>
SIMDBEZIER_INLINE void for_slots(const F& f) {
  if constexpr (kUnrolled) {
    repeat<3>(f);
  } else {
#pragma GCC unroll 1
    for (std::size_t slot = 0; slot < 3; ++slot) {
      f(slot);
    }
  }
}

/// Computes and stores all outputs that a task wants of a register of samples. kDepth is what
/// depth_of() returns.
template <std::size_t kKnownOrder, bool kRational, std::size_t kDepth, bool kMixed, typename V,
          bool kHalves, typename Task>
SIMDBEZIER_INLINE void finish_samples(const Task& task, const CurveShape& shape,
                                      const CurvePoints<V, kHalves>& points,
                                      const CurveRange<V>& range) {
  using T = ScalarOf<V>;
  using Channel = CurveChannel<V, kMixed>;
  const T* const values = task.values + range.curve * shape.values();
  const auto components = static_cast<std::size_t>(shape.components);
  const Order<kKnownOrder> order(shape.order());
  const V zero = broadcast<V>(T(0));
  Series<V> weight{points.x, zero, zero};
  if constexpr (kRational) {
    weight = Channel(shape, values + components * shape.channel_values(), points)
                 .template series<kDepth>(order);
    weight.first = kDepth > 0 ? negated(weight.first) : zero;
    weight.second = kDepth > 1 ? negated(weight.second) : zero;
  }
  const Quotient<V> quotient = Quotient<V>::by(weight.value);
  CurveJet<V> jet;
  for_slots<kKnownOrder != 0>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
    const std::size_t component = task.first_component + slot;
    if (component >= components) {
      jet.d1[slot] = jet.d2[slot] = zero;
      return;
    }
    const Channel channel(shape, values + component * shape.channel_values(), points);
    Series<V> s = channel.template series<kDepth>(order);
    if constexpr (kRational) {
      divide_series<kDepth>(quotient, weight, s);
    }
    range.store_if_wanted(task.out[output_index(CurveOutput::position)].component[slot],
                          channel.finished(shape, s.value));
    jet.d1[slot] = kDepth > 0 ? scaled_first<kMixed>(s.first) : zero;
    jet.d2[slot] = kDepth > 1 ? scaled_second<kMixed>(s.second) : zero;
    if constexpr (kDepth > 0) {
      range.store_if_wanted(task.out[output_index(CurveOutput::d1)].component[slot], jet.d1[slot]);
    }
    if constexpr (kDepth > 1) {
      range.store_if_wanted(task.out[output_index(CurveOutput::d2)].component[slot], jet.d2[slot]);
    }
  });
  if (kDepth > 0 &&
      (task.curvature != nullptr || task.out[output_index(CurveOutput::tangent)].wanted())) {
    store_tangents<kRational>(task, shape, range, points.x, quotient.inverse, jet);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
