// Watertight grids of 3 x 3 to 6 x 6 samples that end at the patch's edges, in one piece, of sets
// without origins.
//
// Most of their samples are on the border, and what a tile prepares (grid/column_tile.hpp) would
// serve only a row or two. A component therefore takes registers of four groups of four lanes:
//   columns   group g, lane l   power l of Y of the polynomial that inner column g is: Horner in X
//                               of the coefficients as they lie in memory
//   inner     group g, lane r   inner column g, inner row r: the row in Y
//   border    group s, lane e   inner sample s of edge e: along the edge
// One permutation makes 16 consecutive samples of these, and another one adds corners. The
// operations of a sample are those of the tiles, and so are its bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/drain/drain_kernel.hpp"
#include "kernels/grid/column_tile.hpp"
#include "kernels/grid/prefetch.hpp"
#include "kernels/simd/assembly.hpp"
#include "kernels/simd/quads.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Samples between edges that four groups, or four lanes of a group, have room for.
constexpr std::size_t kMostInner = 4;
constexpr std::size_t kLeastSmall = 1 + 2;
constexpr std::size_t kMostSmall = kMostInner + 2;

/// Whether the task is a watertight grid that ends at the patch's edges, with at most kMostInner
/// rows and columns between them: two rows alone are the edges v = 0 and 1.
template <typename T>
SIMDBEZIER_PART bool is_closed_grid(const GridTask<T>& task) {
  if (!task.watertight || task.origins != nullptr || task.nu < 2 || task.nu > kMostSmall ||
      task.run_count < 2 || task.run_count > 3) {
    return false;
  }
  const RowRun<T>& first = task.runs[0];
  const RowRun<T>& last = task.runs[task.run_count - 1];
  bool closed = first.kind == RowKind::edge_v0 && first.rows == 1 &&
                last.kind == RowKind::edge_v1 && last.rows == 1 && task.x[0] == T(-0.5) &&
                task.x[task.nu - 1] == T(0.5);
  if (task.run_count == 3) {
    closed = closed && task.runs[1].kind == RowKind::interior && task.runs[1].rows <= kMostInner;
  }
  for (std::size_t i = 1; i + 1 < task.nu; ++i) {
    closed = closed && task.x[i] > T(-0.5) && task.x[i] < T(0.5);
  }
  return closed;
}

/// Whether it has rows and columns between the edges as well.
template <typename T>
SIMDBEZIER_PART bool is_small_grid(const GridTask<T>& task) {
  return task.nu >= kLeastSmall && task.run_count == 3 && is_closed_grid(task);
}

/// Whether rows of a small grid are as many as its columns, and pairs.
template <typename T>
SIMDBEZIER_PART bool is_mirrored_square(const GridTask<T>& task) {
  return task.nu == task.runs[1].rows + std::size_t{2} &&
         are_mirrored(task.runs[1].y, task.runs[1].rows);
}

#if defined(SIMDBEZIER_KERNELS_AVX512)

/// In which lane of which register the samples of small grids are computed. A code for every
/// sample, row after row: 16 times the register plus the lane (see Assembly). Registers are inner,
/// border and the four corners, in each group.
class SmallGridSources {
public:
  constexpr SmallGridSources() {
    for (std::size_t nv = kLeastSmall; nv <= kMostSmall; ++nv) {
      for (std::size_t nu = kLeastSmall; nu <= kMostSmall; ++nu) {
        for (std::size_t k = 0; k < nu * nv; ++k) {
          codes_[nv - kLeastSmall][nu - kLeastSmall][k] =
              static_cast<std::uint8_t>(code(k % nu, nu, k / nu, nv));
        }
      }
    }
  }
  [[nodiscard]] constexpr const std::uint8_t* of(std::size_t nu, std::size_t nv) const {
    return codes_[nv - kLeastSmall][nu - kLeastSmall];
  }

private:
  static constexpr std::size_t kBorder = 16;
  static constexpr std::size_t kCorners = 32;

  static constexpr std::size_t code(std::size_t i, std::size_t nu, std::size_t j, std::size_t nv) {
    const bool on_u = i == 0 || i + 1 == nu;
    const bool on_v = j == 0 || j + 1 == nv;
    const std::size_t u = i == 0 ? 0 : 1; // which of the two edges
    const std::size_t v = j == 0 ? 0 : 1;
    return on_u && on_v ? kCorners + detail::corner_index(u, v)
           : on_u       ? kBorder + 4 * (j - 1) + detail::kEdgeU0 + u
           : on_v       ? kBorder + 4 * (i - 1) + detail::kEdgeV0 + v
                        : 4 * (i - 1) + j - 1;
  }

  std::uint8_t codes_[kMostInner][kMostInner][(kMostSmall * kMostSmall + 15) / 16 * 16] = {};
};

inline constexpr SmallGridSources kSmallGrids;

/// The parameters of a small grid. Groups and lanes that are too many repeat the last edge.
template <typename V>
struct SmallGrid {
  using T = ScalarOf<V>;
  using Groups = RowGroups<4, V>;

  std::size_t rows;    ///< inner ones
  std::size_t samples; ///< of a patch
  MaskOf<V> edges_v;   ///< lanes of edges v = const
  V x;                 ///< of column g, in all lanes of group g
  RowPoint<V> y;       ///< of row r, in lane r of all groups
  RowPoint<V> along;   ///< of sample s, in group s: X on edges v = const, Y on u = const

  explicit SIMDBEZIER_PART SmallGrid(const GridTask<T>& task)
      : rows(task.runs[1].rows), samples(task.nu * (rows + 2)), edges_v(lanes_of_edges_v()),
        x(Groups::spread(task.x + 1)), y(Groups::repeat(task.runs[1].y)),
        along(select_where<V>(edges_v, x, Groups::spread(task.runs[1].y))) {}

private:
  static SIMDBEZIER_PART MaskOf<V> lanes_of_edges_v() {
    static_assert(detail::kEdgeV0 < 2 && detail::kEdgeV1 < 2);
    constexpr T kFirstTwo[kEdges] = {0, 0, 1, 1};
    return repeat_four<V>(kFirstTwo) == broadcast<V>(T(0));
  }
};

/// Sweeps the positions of small grids. kFull is the number of whole registers of samples, before
/// the last one.
template <std::size_t kFull, typename T>
SIMDBEZIER_KERNEL void sweep_small_positions(const GridTask<T>& shared_task) {
  using V = vec<T>;
  const GridTask<T> task = shared_task;
  const SmallGrid<V> grid(task);
  const std::uint8_t* const sources = kSmallGrids.of(task.nu, grid.rows + 2);
  Assembly sample[kFull + 1];
  for (std::size_t k = 0; k <= kFull; ++k) {
    sample[k] = Assembly(sources + 16 * k);
  }
  const std::size_t rest = grid.samples - kFull * kLanes<V>;
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    if (task.prefetch) {
      prefetch_patch<kSmallPatchesAhead>(task, patch);
    }
    Component<T> component(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
      V k[kOrder];
      V q[kOrder];
      V e[kOrder];
      load_fours(component.matrix, k);
      load_fours(component.edge, e);
      split_groups<4>(horner(k, grid.x), q);
      const V inner = row_value(q, grid.y);
      const V border = row_value(e, grid.along);
      const V corner = repeat_four<V>(component.corner);
      T* const to = task.out[output_index(Output::position)].component[c] + patch * task.patch_step;
      for (std::size_t r = 0; r < kFull; ++r) {
        store_vector(to + r * kLanes<V>, sample[r].with_quad(inner, border, corner));
      }
      masked_store(to + kFull * kLanes<V>, sample[kFull].with_quad(inner, border, corner), rest);
    }
    drain_some(task.drain, 3 * grid.samples);
  }
}

template <typename T>
SIMDBEZIER_PART void small_grid_positions(const GridTask<T>& task) {
  const std::size_t samples = task.nu * (task.runs[1].rows + 2);
  with_one_of<0, 1, 2>((samples - 1) / 16, [&]<std::size_t kFull>() SIMDBEZIER_INLINE_LAMBDA {
    sweep_small_positions<kFull>(task);
  });
}

#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
