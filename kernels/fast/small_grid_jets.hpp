// Small grids (fast/small_grids.hpp): positions with first derivatives or normals.
//
// Inner samples and tangents along edges fall out of the positions' schemes. Besides, edges
// take the patch's derivative across them, and corners the tangents of two edges each.
#pragma once

#include "kernels/fast/small_grids.hpp"
#include "kernels/grid/tile_normals.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX512)

/// The parameters that derivatives take besides.
template <typename V>
struct SmallEnds {
  using T = ScalarOf<V>;
  static constexpr T kEnds[4] = {T(-0.5), T(0.5), T(-0.5), T(0.5)};
  static constexpr T kHalves[4] = {0, 0, 1, 1};

  V by_group = RowGroups<4, V>::spread(kEnds); ///< the first end in groups 0 and 2
  RowPoint<V> by_lane{RowGroups<4, V>::repeat(kEnds)};
  MaskOf<V> first_half = RowGroups<4, V>::spread(kHalves) == broadcast<V>(T(0));
};

/// The registers of one component; see SmallGridSources.
template <typename V>
struct SmallJets {
  using T = ScalarOf<V>;

  Jet<V> inner;
  Jet<V> border; ///< du: of edges v = const only
  V corner;
  V third;

  SIMDBEZIER_PART SmallJets(const Component<T>& c, const SmallGrid<V>& grid,
                            const SmallEnds<V>& ends) {
    V k[kOrder];
    V q[kOrder];
    V dq[kOrder];
    load_fours(c.matrix, k);
    V slopes;
    split_fours(horner(k, grid.x, slopes), q);
    split_fours(slopes, dq);
    inner.p = row_value(q, grid.y, inner.dv);
    inner.du = row_value(dq, grid.y);
    const V across_v = row_slope(q, ends.by_lane);
    split_fours(horner_slope(k, ends.by_group), dq); // of the columns that are edges
    const V across_u = row_value(dq, grid.y);

    V e[kOrder];
    load_fours(c.edge, e);
    border.p = row_value(e, grid.along, border.du);
    border.dv = select_where<V>(grid.edges_v, across_v, border.du);
    corner = repeat_four<V>(c.corner);
    third = select_where<V>(ends.first_half, across_u, row_slope(e, RowPoint<V>(ends.by_group)));
  }
};

/// Looks again at the normals of 16 consecutive samples that did not all pass the quick test.
template <typename V>
SIMDBEZIER_RARE void resolve_small_normals(const GridTask<ScalarOf<V>>& task, std::size_t patch,
                                           std::size_t first, std::size_t active, V squared,
                                           V floor) {
  using T = ScalarOf<V>;
  alignas(64) T x[kLanes<V>] = {};
  alignas(64) T y[kLanes<V>] = {};
  for (std::size_t k = 0; k < active; ++k) {
    const std::size_t row = (first + k) / task.nu;
    x[k] = task.x[(first + k) % task.nu];
    y[k] = row == 0 ? T(-0.5) : row <= task.runs[1].rows ? task.runs[1].y[row - 1] : T(0.5);
  }
  const UncertainNormals uncertain{0, kLanes<V>, active, 1, patch * task.patch_step + first, 0, 1};
  resolve_normals(task, patch, uncertain, load_vector<V>(x), load_vector<V>(y), squared, floor);
}

/// Finds the normals of a register of consecutive samples, `active` of them, puts them by
/// store(output, component, value), and looks again at those that did not pass the quick test.
/// task: one whose address may leave.
template <typename V, typename Store>
SIMDBEZIER_INLINE void finish_small_normals(const GridTask<ScalarOf<V>>& task, std::size_t patch,
                                            std::size_t first, std::size_t active, V floor,
                                            NormalSamples<V>& s, const Store& store) {
  s.cross();
  for (std::size_t c = 0; c < 3; ++c) {
    store(Output::normal, c, s.normal[c]);
  }
  if (!all_of<V>(s.squared > floor)) [[unlikely]] {
    resolve_small_normals<V>(task, patch, first, active, s.squared, floor);
  }
}

/// Which samples of a small grid stand where.
template <typename V>
struct SmallSamples {
  static constexpr std::size_t kMost = SmallGridSources::kRegisters;

  std::size_t registers; ///< that the samples of a patch fill, the last one in part
  std::size_t samples;
  Assembly position[kMost];
  Assembly du[kMost];
  Assembly dv[kMost];

  explicit SIMDBEZIER_PART SmallSamples(std::size_t nu, std::size_t nv)
      : registers((nu * nv + kLanes<V> - 1) / kLanes<V>), samples(nu * nv) {
    const SmallGridTables& tables = kSmallGrids.of(nu, nv);
    for (std::size_t r = 0; r < registers; ++r) {
      position[r] = Assembly(tables.position.of_register(r));
      du[r] = Assembly(tables.du.of_register(r));
      dv[r] = Assembly(tables.dv.of_register(r));
    }
  }
  [[nodiscard]] SIMDBEZIER_PART std::size_t active(std::size_t r) const {
    return r + 1 < registers ? kLanes<V> : samples - r * kLanes<V>;
  }
  SIMDBEZIER_PART Jet<V> jet(std::size_t r, const SmallJets<V>& of) const {
    return {position[r].with_quad(of.inner.p, of.border.p, of.corner),
            du[r](of.inner.du, of.border.du, of.third), dv[r](of.inner.dv, of.border.dv, of.third)};
  }
};

/// Sweeps positions with normals, or with du and dv.
template <bool kNormals, typename T>
SIMDBEZIER_KERNEL void sweep_small_jets(const GridTask<T>& shared_task) {
  using V = vec<T>;
  const GridTask<T> task = shared_task;
  const SmallGrid<V> grid(task);
  const SmallEnds<V> ends;
  const SmallSamples<V> samples(task.nu, grid.rows + 2);
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    if (task.prefetch) {
      prefetch_patch(task, patch);
    }
    const Component<T> x(task, patch, 0);
    const Component<T> y = x.next();
    const SmallJets<V> jets[3] = {{x, grid, ends}, {y, grid, ends}, {y.next(), grid, ends}};
    for (std::size_t r = 0; r < samples.registers; ++r) {
      const std::size_t first = r * kLanes<V>;
      const std::size_t active = samples.active(r);
      const auto store = [&](Output output, std::size_t c, V value) SIMDBEZIER_INLINE_LAMBDA {
        T* const plane = task.out[output_index(output)].component[c];
        masked_store(plane + patch * task.patch_step + first, value, active);
      };
      NormalSamples<V> s;
      for (std::size_t c = 0; c < 3; ++c) {
        s.jet[c] = samples.jet(r, jets[c]);
        store(Output::position, c, s.jet[c].p);
        if constexpr (!kNormals) {
          store(Output::du, c, s.jet[c].du);
          store(Output::dv, c, s.jet[c].dv);
        }
      }
      if constexpr (kNormals) {
        finish_small_normals(shared_task, patch, first, active,
                             broadcast<V>(task.normal_floor[patch]), s, store);
      }
    }
    drain_some(task.drain, (kNormals ? 6 : 9) * grid.samples);
  }
}

#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
