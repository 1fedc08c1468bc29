// Watertight grids of 4 x 4 samples from edge to edge, whose parameters are pairs X and -X.
//
// Three samples in four are on the border, and each component has just four others. A register of
// four groups of four lanes therefore holds all three components of a patch, a group each, and the
// last group is idle. In a group,
//   lane l of a column           is power l of Y of the polynomial that the column is,
//   lane 2 i + j of the inner    is the sample of inner column i and inner row j,
//   lane e of the border         is an inner sample of edge e; a second register has the others,
//   lane 2 v + u of the corners  is corner (u, v).
// A component's samples fill one register, which takes two permutations. Larger grids fill groups
// by themselves (fast/small_grids.hpp), and derivatives lanes that are patches. The operations of a
// sample are those of tiles, and so are its bits.
#pragma once

#include "kernels/fast/small_grids.hpp"
#include "kernels/grid/tile_normals.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX512)

/// Where the samples of a square stand, row after row: 16 times the number of one of four registers
/// plus the lane of the first component.
struct SquareSources {
  std::uint8_t position[16]; ///< first border register, second one, inner samples, corners
  std::uint8_t du[16];       ///< edges v = const, their ends, inner samples, edges u = const
  std::uint8_t dv[16];       ///< likewise, u and v exchanged

  constexpr SquareSources() : position{}, du{}, dv{} {
    for (std::size_t at = 0; at < 16; ++at) {
      const std::size_t i = at % 4;
      const std::size_t j = at / 4;
      const bool on_u = i == 0 || i == 3;
      const bool on_v = j == 0 || j == 3;
      const std::size_t u = i / 3; // which edge
      const std::size_t v = j / 3;
      const std::size_t inner = 32 + 2 * (i - 1) + (j - 1);
      position[at] = code(on_u && on_v ? 48 + detail::corner_index(u, v)
                          : on_u       ? 16 * (j - 1) + detail::kEdgeU0 + u
                          : on_v       ? 16 * (i - 1) + detail::kEdgeV0 + v
                                       : inner);
      du[at] = code(on_u && on_v ? 16 + 2 * v + u
                    : on_u       ? 48 + 2 * u + (j - 1)
                    : on_v       ? 2 * v + (i - 1)
                                 : inner);
      dv[at] = code(on_u && on_v ? 16 + 2 * u + v
                    : on_u       ? 2 * u + (j - 1)
                    : on_v       ? 48 + 2 * (i - 1) + v
                                 : inner);
    }
  }

private:
  static constexpr std::uint8_t code(std::size_t number) {
    return static_cast<std::uint8_t>(number);
  }
};
inline constexpr SquareSources kSquareSources;

/// The parameters of a square, in every group.
template <typename V>
struct SquareOfFour {
  using T = ScalarOf<V>;

  V x[2];            ///< of the inner columns
  RowPoint<V> rows;  ///< of inner samples
  RowPoint<V> along; ///< of the first inner sample of each edge
  RowPoint<V> ends;  ///< of the ends of columns
  RowPoint<V> end;   ///< the second one of each edge

  explicit SIMDBEZIER_PART SquareOfFour(const GridTask<T>& task)
      : SquareOfFour(task.x + 1, task.runs[1].y) {}

private:
  static SIMDBEZIER_PART RowPoint<V> four(T a, T b, T c, T d) {
    const T values[4] = {a, b, c, d};
    return RowPoint<V>(repeat_four<V>(values));
  }
  SIMDBEZIER_PART SquareOfFour(const T* columns, const T* y)
      : x{broadcast<V>(columns[0]), broadcast<V>(columns[1])}, rows(four(y[0], y[1], y[0], y[1])),
        along(four(columns[0], columns[0], y[0], y[0])),
        ends(four(T(-0.5), T(0.5), T(-0.5), T(0.5))), end(broadcast<V>(T(0.5))) {}
};

/// Polynomials of two columns as those of rows: their powers apart, lanes 0 and 1 the first one.
template <typename V>
SIMDBEZIER_INLINE void split_two(V first, V second, V power[kOrder]) {
  power[0] = broadcast_halves<0>(first, second);
  power[1] = broadcast_halves<1>(first, second);
  power[2] = broadcast_halves<2>(first, second);
  power[3] = broadcast_halves<3>(first, second);
}

/// One output of all components: its samples are lanes of four registers, in two pairs.
class SquareOutput {
public:
  explicit SIMDBEZIER_INLINE SquareOutput(const std::uint8_t codes[16]) {
    for (std::size_t c = 0; c < 3; ++c) {
      component_[c] = Assembly(codes, static_cast<int>(4 * c));
    }
  }
  SIMDBEZIER_INLINE vec<float> of(std::size_t c, const vec<float> (&from)[4]) const {
    return component_[c](from[0], from[1], from[2], from[3]);
  }

private:
  Assembly component_[3];
};

/// The registers that hold the samples of one patch, in the order of SquareSources.
template <typename V, bool kDerivatives>
struct SquareSamples {
  using T = ScalarOf<V>;

  V position[4];
  V du[4];
  V dv[4];

  /// coefficients, edges: of the patch, as they are packed.
  SIMDBEZIER_PART SquareSamples(const T* coefficients, const T* edges,
                                const SquareOfFour<V>& grid) {
    V k[kOrder];
    V q[kOrder];
    V e[kOrder];
    load_three_quads(coefficients, kOrder * kOrder, k);
    load_three_quads(edges, kOrder * kEdges, e);
    position[3] = load_vector<V>(edges + detail::kCornersAt);
    if constexpr (!kDerivatives) {
      split_two(horner(k, grid.x[0]), horner(k, grid.x[1]), q);
      position[2] = row_value(q, grid.rows);
      const Parts<V> border = value_parts(e, grid.along);
      position[0] = border.sum();
      position[1] = border.difference();
    } else {
      V dq[kOrder];
      V slope[2];
      const V first_column = horner(k, grid.x[0], slope[0]);
      split_two(first_column, horner(k, grid.x[1], slope[1]), q);
      split_two(slope[0], slope[1], dq);
      position[2] = row_value(q, grid.rows, dv[2]);
      du[2] = row_value(dq, grid.rows);
      dv[3] = row_slope(q, grid.ends);
      split_two(horner_slope(k, -grid.end.y), horner_slope(k, grid.end.y), dq); // of edges
      du[3] = row_value(dq, grid.rows);
      Parts<V> slopes;
      const Parts<V> border = value_parts(e, grid.along, slopes);
      position[0] = border.sum();
      position[1] = border.difference();
      put_slopes(0, slopes.sum(), slopes.difference());
      const Parts<V> at_end = slope_parts(e, grid.end);
      put_slopes(1, at_end.difference(), at_end.sum());
    }
  }

private:
  /// Slopes along edges v = const are du, others dv.
  SIMDBEZIER_INLINE void put_slopes(std::size_t number, V first, V second) {
    du[number] = zip_low_halves(first, second);
    dv[number] = zip_high_halves(first, second);
  }
};

/// Whether the task is of such squares, given that it is of small grids.
template <typename T>
SIMDBEZIER_PART bool is_square_of_four(const GridTask<T>& task) {
  return task.nu == 4 && is_mirrored_square(task) && are_mirrored(task.x + 1, 2);
}

/// Looks again at the normals of a square that did not all pass the quick test.
template <typename V>
SIMDBEZIER_RARE void resolve_square_normals(const GridTask<ScalarOf<V>>& task, std::size_t patch,
                                            V squared, V floor) {
  using T = ScalarOf<V>;
  const T rows[4] = {T(-0.5), task.runs[1].y[0], task.runs[1].y[1], T(0.5)};
  alignas(64) T x[kLanes<V>];
  alignas(64) T y[kLanes<V>];
  for (std::size_t k = 0; k < kLanes<V>; ++k) {
    x[k] = task.x[k % 4];
    y[k] = rows[k / 4];
  }
  const UncertainNormals all{0, kLanes<V>, kLanes<V>, 1, patch * task.patch_step, 0, 1};
  resolve_normals(task, patch, all, load_vector<V>(x), load_vector<V>(y), squared, floor);
}

template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_KERNEL void sweep_squares_of_four(const GridTask<T>& shared_task) {
  using V = vec<T>;
  constexpr bool kJets = kOutputs != detail::kPosition;
  constexpr bool kNormals = kOutputs == detail::kPositionNormal;
  const GridTask<T> task = shared_task;
  const SquareOfFour<V> grid(task);
  const SquareOutput position(kSquareSources.position);
  const SquareOutput du(kSquareSources.du);
  const SquareOutput dv(kSquareSources.dv);
  const T* coefficients = task.coefficients;
  const T* edges = task.edges;
  std::size_t at = 0;
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    if (task.prefetch) {
      prefetch_patch<kJets ? kPatchesAhead : kSmallPatchesAhead>(task, patch);
    }
    const SquareSamples<V, kJets> samples(coefficients, edges, grid);
    const auto store = [&](Output output, std::size_t c, V value) SIMDBEZIER_INLINE_LAMBDA {
      store_vector(task.out[output_index(output)].component[c] + at, value);
    };
    NormalSamples<V> s;
    for (std::size_t c = 0; c < 3; ++c) {
      store(Output::position, c, position.of(c, samples.position));
      if constexpr (kNormals) {
        s.jet[c] = {{}, du.of(c, samples.du), dv.of(c, samples.dv)};
      } else if constexpr (kJets) {
        store(Output::du, c, du.of(c, samples.du));
        store(Output::dv, c, dv.of(c, samples.dv));
      }
    }
    if constexpr (kNormals) {
      s.cross();
      for (std::size_t c = 0; c < 3; ++c) {
        store(Output::normal, c, s.normal[c]);
      }
      const V floor = broadcast<V>(task.normal_floor[patch]);
      if (!all_of<V>(s.squared > floor)) [[unlikely]] {
        resolve_square_normals(shared_task, patch, s.squared, floor);
      }
    }
    drain_some(task.drain, (kNormals ? 6 : kJets ? 9 : 3) * std::size_t{16});
    coefficients += detail::kCoefficients;
    edges += detail::kEdgeBlock;
    at += task.patch_step;
  }
}

#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
