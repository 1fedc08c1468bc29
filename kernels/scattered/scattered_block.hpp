// One register of scattered samples: from parameters to outputs, in whichever way the columns'
// polynomials are computed (scattered/patch_runs.hpp: for samples of one patch;
// scattered/mixed_patches.hpp: of any patches).
//
// Registers run the interior's formula. Samples on edges and others that it does not fit are rare:
// they are found by one comparison and evaluated again, one by one.
#pragma once

#include "kernels/scattered/bicubic_sample.hpp"
#include "kernels/simd/quads.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A column needs so many polynomials in Y: one for each order of derivatives by u.
template <detail::OutputSet kOutputs>
inline constexpr std::size_t kPolynomials = detail::depth(kOutputs) + 1;

/// The polynomials are q, its derivative in X, and its second derivative, as far as they are
/// needed.
template <detail::OutputSet kOutputs, typename V>
struct Polynomials {
  V power[kPolynomials<kOutputs>][kOrder];

  /// Finds coefficient l of all of them by Horner's rule in X.
  SIMDBEZIER_PART void set(std::size_t l, const V k[kOrder], V x) {
    if constexpr (detail::depth(kOutputs) == 0) {
      power[0][l] = horner(k, x);
    } else {
      power[0][l] = horner(k, x, power[1][l]);
    }
    if constexpr (detail::depth(kOutputs) == 2) {
      power[2][l] = horner_second(k, x);
    }
  }
};

/// The samples that stand in one register, from the task's sample `first` on.
template <typename V>
struct Block {
  using T = ScalarOf<V>;

  const ScatteredTask<T>& task;
  std::size_t first;
  V x;
  V y;

  SIMDBEZIER_PART Block(const ScatteredTask<T>& the_task, std::size_t first_sample)
      : task(the_task), first(first_sample),
        x(half_centred(the_task, load_vector<V>(the_task.u + first_sample))),
        y(half_centred(the_task, load_vector<V>(the_task.v + first_sample))) {}

  SIMDBEZIER_PART void store(T* plane, V value) const { store_vector(plane + first, value); }
  SIMDBEZIER_PART void store_if_wanted(Output output, std::size_t component, V value) const {
    compute_here(value);
    T* const plane = task.out[output_index(output)].component[component];
    if (plane != nullptr) {
      store(plane, value);
    }
  }

  /// Returns which samples are strictly inside of the patch: there is nothing special about those.
  SIMDBEZIER_PART MaskOf<V> interior() const {
    const V half = broadcast<V>(T(0.5));
    return (x < half) & (x > -half) & (y < half) & (y > -half);
  }
};

/// The normals of one block, made unit vectors while the next block is computed: root and quotient
/// take so long that processors run out of room for what is behind them, unless their operands have
/// been there for a while.
template <detail::OutputSet kOutputs, typename V>
class WaitingNormals {
public:
  SIMDBEZIER_PART void take_root() {}
  SIMDBEZIER_PART void store(const ScatteredTask<ScalarOf<V>>&) {}
};

template <typename V>
class WaitingNormals<detail::kAnyOutputs, V> {
public:
  using T = ScalarOf<V>;

  /// Takes n = du x dv and |n|^2 of the samples from `first` on.
  SIMDBEZIER_PART void put(const V n[3], V squared, std::size_t first) {
    for (std::size_t c = 0; c < 3; ++c) {
      n_[c] = n[c];
    }
    length_ = squared;
    first_ = first;
    waiting_ = true;
  }

  // These are the two steps of normalise(), with other work before and between them.
  SIMDBEZIER_PART void take_root() {
    if (waiting_) {
      length_ = square_root(length_);
      compute_here(length_);
    }
  }
  SIMDBEZIER_PART void store(const ScatteredTask<T>& task) {
    if (waiting_) {
      const V inverse = divide(broadcast<V>(T(1)), length_);
      for (std::size_t c = 0; c < 3; ++c) {
        store_vector(task.out[output_index(Output::normal)].component[c] + first_, n_[c] * inverse);
      }
      waiting_ = false;
    }
  }

private:
  V n_[3];
  V length_; ///< its square at first
  std::size_t first_ = 0;
  bool waiting_ = false;
};

/// What is left to do about a block once its three components are known.
template <detail::OutputSet kOutputs, typename V>
struct Tangents {
  V du[3];
  V dv[3];
};

/// Adds the origin, if there is one. Here the compiler knows whether there are origins: asking for
/// them costs random samples a tenth of their speed and more.
template <bool kOrigins, typename V>
SIMDBEZIER_PART V with_origin(V p, V origin) {
  if constexpr (kOrigins) {
    p = p + origin;
  }
  return p;
}

/// Finishes one component, from its columns' polynomials in Y.
template <bool kOrigins, detail::OutputSet kOutputs, typename V>
SIMDBEZIER_PART void finish_component(const Block<V>& block, const Polynomials<kOutputs, V>& q,
                                      std::size_t c, V origin, Tangents<kOutputs, V>& tangents) {
  const RowPoint<V> at(block.y);
  if constexpr (detail::depth(kOutputs) == 0) {
    block.store(block.task.out[output_index(Output::position)].component[c],
                with_origin<kOrigins>(row_value(q.power[0], at), origin));
  } else if constexpr (detail::depth(kOutputs) == 1) {
    const V p = row_value(q.power[0], at, tangents.dv[c]);
    tangents.du[c] = row_value(q.power[1], at);
    block.store_if_wanted(Output::position, c, with_origin<kOrigins>(p, origin));
    block.store_if_wanted(Output::du, c, tangents.du[c]);
    block.store_if_wanted(Output::dv, c, tangents.dv[c]);
  } else {
    block.store_if_wanted(Output::duu, c, row_value(q.power[2], at));
    block.store_if_wanted(Output::duv, c, row_slope(q.power[1], at));
    block.store_if_wanted(Output::dvv, c, row_second(q.power[0], at));
  }
}

/// Evaluates the samples of a block again, one by one, that the interior's formula does not fit, or
/// for which unusual(lane, |x|, |y|) holds.
template <bool kSecond, typename V, typename Unusual>
SIMDBEZIER_INLINE void evaluate_lanes_again(const ScatteredTask<ScalarOf<V>>& task,
                                            std::size_t first, V x, V y, const Unusual& unusual) {
  using T = ScalarOf<V>;
  alignas(64) T lanes[2][kLanes<V>];
  store_vector(lanes[0], x);
  store_vector(lanes[1], y);
  for (std::size_t i = 0; i < kLanes<V>; ++i) {
    const T ax = lanes[0][i] < 0 ? -lanes[0][i] : lanes[0][i];
    const T ay = lanes[1][i] < 0 ? -lanes[1][i] : lanes[1][i];
    const bool edge = task.watertight && (ax == T(0.5) || ay == T(0.5));
    const bool finite = ax - ax == T(0) && ay - ay == T(0);
    if (edge || !finite || unusual(i, ax, ay)) {
      evaluate_sample<kSecond>(task, first + i);
    }
  }
}

/// This is evaluate_lanes_again() for samples whose normal may not have passed the quick test.
/// Vectors come by value, or the fast path would have to keep them in memory.
template <typename V>
SIMDBEZIER_RARE void evaluate_normals_again(const ScatteredTask<ScalarOf<V>>& task,
                                            std::size_t first, V x, V y, V squared, V floor) {
  using T = ScalarOf<V>;
  alignas(64) T lanes[2][kLanes<V>];
  store_vector(lanes[0], squared);
  store_vector(lanes[1], floor);
  evaluate_lanes_again<false>(task, first, x, y,
                              [&](std::size_t i, T ax, T ay) SIMDBEZIER_INLINE_LAMBDA {
                                return !(lanes[0][i] > lanes[1][i]) || ax > T(0.5) || ay > T(0.5);
                              });
}

/// This is evaluate_lanes_again() for outputs without normals, for which the formula holds outside
/// of the patch as well.
template <bool kSecond, typename V>
SIMDBEZIER_RARE void evaluate_again(const ScatteredTask<ScalarOf<V>>& task, std::size_t first, V x,
                                    V y) {
  evaluate_lanes_again<kSecond>(task, first, x, y, [](std::size_t, auto, auto) { return false; });
}

/// Finishes normals, where they are wanted, and the samples that have to be evaluated again. Floor
/// gives the normal_floor of the samples' patches, and at first a bound on all of them.
template <bool kOrigins, detail::OutputSet kOutputs, typename V, typename Floor>
SIMDBEZIER_INLINE void finish_block(const Block<V>& block, const Tangents<kOutputs, V>& tangents,
                                    const Floor& floor, WaitingNormals<kOutputs, V>& waiting) {
  const auto& task = block.task;
  const MaskOf<V> interior = block.interior();
  if constexpr (kOutputs == detail::kAnyOutputs) {
    V n[3];
    const V squared = cross_product(tangents.du, tangents.dv, n);
    const auto all_above = [&](V enough) SIMDBEZIER_INLINE_LAMBDA {
      return all_of<V>(interior & (squared > enough));
    };
    if (all_above(floor.highest()) || all_above(floor.each())) [[likely]] {
      waiting.put(n, squared, block.first);
      return;
    }
    normalise(n, squared);
    for (std::size_t c = 0; c < 3; ++c) {
      block.store(task.out[output_index(Output::normal)].component[c], n[c]);
    }
    const V enough = floor.each();
    if (!all_above(enough)) {
      evaluate_normals_again(task, block.first, block.x, block.y, squared, enough);
    }
  } else if (!all_of<V>(interior)) [[unlikely]] {
    evaluate_again<detail::depth(kOutputs) == 2>(task, block.first, block.x, block.y);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
