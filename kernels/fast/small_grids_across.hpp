// Small grids (fast/small_grids.hpp) whose lanes are patches.
//
// Coefficients of a register of patches are turned on their way from memory, and samples on their
// way back; in between no lane is idle, whatever the size of the grid. The last patches that do not
// fill a register are computed together with some of those before them, once more. What positions
// need stands here, all else in fast/small_jets_across.hpp.
#pragma once

#include "kernels/fast/small_grids.hpp"
#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/structures_across.hpp"
#include "src/tables/sample_record.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_AVX512)

/// A small grid has at most so many samples.
constexpr std::size_t kMostSmallSamples = kMostSmall * kMostSmall;

/// The parameters of a small grid, each in all lanes. Those that are too many are never used.
/// kInner: the compiler knows the grid as so many rows and columns between edges, the rows being
/// pairs; 0: it does not.
template <typename V, std::size_t kInner>
struct SmallGridAcross {
  using T = ScalarOf<V>;
  static_assert(kMostInner == 4);

  const T* x; ///< of all columns
  std::size_t nu;
  std::size_t nv;
  bool mirrored; ///< rows are pairs Y and -Y
  RowPoint<V> column[kMostInner];
  RowPoint<V> row[kMostInner];
  RowPoint<V> end[2] = {point(T(-0.5)), point(T(0.5))};

  explicit SIMDBEZIER_PART SmallGridAcross(const GridTask<T>& task)
      : x(task.x), nu(kInner > 0 ? kInner + 2 : task.nu),
        nv(kInner > 0 ? kInner + 2 : inner_rows(task) + 2),
        mirrored(kInner > 0 || are_mirrored(task.runs[1].y, inner_rows(task))),
        column{point(task.x[1]), point(task.x[2]), point(task.x[3]), point(task.x[4])},
        row{point(task.runs[1].y[0]), point(task.runs[1].y[1]), point(task.runs[1].y[2]),
            point(task.runs[1].y[3])} {}

  [[nodiscard]] SIMDBEZIER_PART std::size_t samples() const { return nu * nv; }
  /// Whether there are samples besides corners, whose values and derivatives edges determine.
  [[nodiscard]] SIMDBEZIER_PART bool has_more() const { return kInner > 0 || nu + nv > 4; }
  /// These two call f(i) for the columns and for the rows between the edges.
  template <typename F>
  SIMDBEZIER_INLINE void for_columns(const F& f) const {
    for_inner(nu - 2, f);
  }
  template <typename F>
  SIMDBEZIER_INLINE void for_rows(const F& f) const {
    for_inner(nv - 2, f);
  }
  /// Calls f(r, value) with the value of a cubic at each row.
  template <typename F>
  SIMDBEZIER_INLINE void for_row_values(const V c[kOrder], const F& f) const {
    const std::size_t rows = nv - 2;
    const auto pair = [&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
      const Parts<V> parts = value_parts(c, row[r]);
      f(r, parts.sum());
      f(rows - 1 - r, parts.difference());
    };
    if constexpr (kInner > 0) {
      repeat<kInner / 2>(pair);
      if constexpr (kInner % 2 != 0) {
        f(kInner / 2, row_value(c, row[kInner / 2]));
      }
    } else {
      std::size_t r = 0;
      for (; mirrored && r < rows / 2; ++r) {
        pair(r);
      }
      for (const std::size_t behind = rows - r; r < behind; ++r) {
        f(r, row_value(c, row[r]));
      }
    }
  }

private:
  static SIMDBEZIER_PART std::size_t inner_rows(const GridTask<T>& task) {
    return task.run_count == 2 ? 0 : task.runs[1].rows;
  }
  template <typename F>
  static SIMDBEZIER_INLINE void for_inner(std::size_t count, const F& f) {
    if constexpr (kInner > 0) {
      repeat<kInner>(f);
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        f(i);
      }
    }
  }
  static SIMDBEZIER_PART RowPoint<V> point(T parameter) {
    return RowPoint<V>(broadcast<V>(parameter));
  }
};

/// One component of a register of patches.
template <typename V>
struct ComponentAcross {
  using T = ScalarOf<V>;

  V matrix[kOrder * kOrder]; ///< [power of X][power of Y]; for corners nothing
  V edge[kOrder * kEdges];   ///< [power][edge]
  V corner[kEdges];

  template <typename Grid>
  SIMDBEZIER_PART ComponentAcross(const GridTask<T>& task, const Grid& grid, std::size_t patch,
                                  std::size_t c) {
    const Component<T> first(task, patch, c);
    if (grid.has_more()) {
      load_values_across<kOrder * kOrder>(first.matrix, detail::kCoefficients, matrix);
    }
    load_values_across<kOrder * kEdges>(first.edge, detail::kEdgeBlock, edge);
    load_values_across<kEdges>(first.corner, detail::kEdgeBlock, corner);
  }

  SIMDBEZIER_PART void column(V x, V q[kOrder], V dq[kOrder]) const {
    for (std::size_t l = 0; l < kOrder; ++l) {
      const V k[kOrder] = {matrix[l], matrix[kOrder + l], matrix[2 * kOrder + l],
                           matrix[3 * kOrder + l]};
      q[l] = horner(k, x, dq[l]);
    }
  }
  SIMDBEZIER_PART void column(V x, V q[kOrder]) const {
    V dq[kOrder]; // takes no instruction where nothing reads it
    column(x, q, dq);
  }
  SIMDBEZIER_PART void edge_cubic(std::size_t number, V e[kOrder]) const {
    for (std::size_t p = 0; p < kOrder; ++p) {
      e[p] = edge[p * kEdges + number];
    }
  }
};

/// Finds the positions of one component, row after row.
template <typename V, std::size_t kInner>
SIMDBEZIER_PART void positions_across(const ComponentAcross<V>& c,
                                      const SmallGridAcross<V, kInner>& grid, V* sample) {
  const std::size_t nu = grid.nu;
  V* const last_row = sample + (grid.nv - 1) * nu;
  V q[kOrder];
  grid.for_columns([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
    c.column(grid.column[i].y, q);
    V* const first = sample + nu + 1 + i;
    grid.for_row_values(q, [&](std::size_t r, V value)
                               SIMDBEZIER_INLINE_LAMBDA { first[r * nu] = value; });
  });
  repeat<2>([&](std::size_t s) SIMDBEZIER_INLINE_LAMBDA {
    V* const along = s == 0 ? sample : last_row;
    c.edge_cubic(detail::kEdgeV0 + s, q);
    grid.for_columns([&](std::size_t i)
                         SIMDBEZIER_INLINE_LAMBDA { along[1 + i] = row_value(q, grid.column[i]); });
    along[0] = c.corner[detail::corner_index(0, s)];
    along[nu - 1] = c.corner[detail::corner_index(1, s)];
    c.edge_cubic(detail::kEdgeU0 + s, q);
    V* const first = sample + nu + s * (nu - 1);
    grid.for_row_values(q, [&](std::size_t r, V value)
                               SIMDBEZIER_INLINE_LAMBDA { first[r * nu] = value; });
  });
}

/// Stores lane p of sample k in to[p * step + k].
template <typename V>
SIMDBEZIER_PART void put_across(const V* sample, std::size_t samples, ScalarOf<V>* to,
                                std::size_t step) {
  constexpr std::size_t kTogether = kQuad<V>;
  std::size_t k = 0;
  if constexpr (kLineWide<V>) {
    constexpr std::size_t kL = kLanes<V>;
    for (; k + kL <= samples; k += kL) {
      store_lines_across(sample + k, to + k, step);
    }
    if (samples >= kL && samples - k > kTogether) { // some of them once more
      return store_lines_across(sample + samples - kL, to + samples - kL, step);
    }
  }
  for (; k + kTogether <= samples; k += kTogether) {
    store_across(sample + k, to + k, step);
  }
  if (k < samples) { // some of them once more
    store_across(sample + samples - kTogether, to + samples - kTogether, step);
  }
}

/// Stores samples of one component of a register of patches in the planes of an output.
template <typename V>
SIMDBEZIER_PART void put_across(const GridTask<ScalarOf<V>>& task, Output output, std::size_t c,
                                std::size_t patch, const V* sample, std::size_t samples) {
  put_across(sample, samples, task.out[output_index(output)].component[c] + patch * task.patch_step,
             task.patch_step);
}

/// Stores a vector of each sample of a register of patches in records of kSampleRecord values, and
/// its last component once more, so that all stores are whole. vectors: of patch 0's first sample.
template <typename V>
SIMDBEZIER_PART void put_vectors_across(const V* x, const V* y, const V* z, std::size_t samples,
                                        ScalarOf<V>* vectors, std::size_t patch_step) {
  constexpr std::size_t kRecord = detail::kSampleRecord;
  for (std::size_t k = 0; k < samples; ++k) {
    const V value[4] = {x[k], y[k], z[k], z[k]};
    store_values_across<4>(value, vectors + k * kRecord, patch_step * kRecord);
  }
}

/// Calls sweep(patch, how many are new) for registers of patches. The task has at least one.
template <typename T, typename Sweep>
SIMDBEZIER_INLINE void for_patches_across(const GridTask<T>& task, const Sweep& sweep) {
  constexpr std::size_t kL = kLanes<vec<T>>;
  const bool only_corners = task.nu == 2 && task.run_count == 2;
  for (std::size_t done = 0; done < task.patch_count;) {
    const std::size_t left = task.patch_count - done;
    const std::size_t fresh = left < kL ? left : kL;
    if (task.prefetch) {
      for (std::size_t p = 0; p < fresh; ++p) {
        prefetch_patch(task, done + p + kL - kPatchesAhead, only_corners);
      }
    }
    sweep(done + fresh - kL, fresh);
    done += fresh;
  }
}

#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
