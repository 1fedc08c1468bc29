// Small grids whose lanes are patches (fast/small_grids_across.hpp): first derivatives, normals,
// and the sweep of all outputs.
#pragma once

#include "kernels/drain/drain_kernel.hpp"
#include "kernels/fast/small_grids_across.hpp"
#include "kernels/grid/tile_normals.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_AVX512)

/// Positions and first derivatives of one component, row after row.
template <typename V>
struct JetsAcross {
  V p[kMostSmallSamples];
  V du[kMostSmallSamples];
  V dv[kMostSmallSamples];

  template <std::size_t kInner>
  SIMDBEZIER_PART void find(const ComponentAcross<V>& c, const SmallGridAcross<V, kInner>& grid) {
    const std::size_t nu = grid.nu;
    const std::size_t last_row = (grid.nv - 1) * nu;
    V q[kOrder];
    V dq[kOrder];
    grid.for_columns([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
      c.column(grid.column[i].y, q, dq);
      grid.for_rows([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
        const std::size_t at = (1 + r) * nu + 1 + i;
        p[at] = row_value(q, grid.row[r], dv[at]);
        du[at] = row_value(dq, grid.row[r]);
      });
      dv[1 + i] = row_slope(q, grid.end[0]);
      dv[last_row + 1 + i] = row_slope(q, grid.end[1]);
    });
    repeat<2>([&](std::size_t s) SIMDBEZIER_INLINE_LAMBDA {
      const std::size_t along_u = s * last_row;
      const std::size_t along_v = s * (nu - 1);
      c.edge_cubic(detail::kEdgeV0 + s, q);
      grid.for_columns([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
        p[along_u + 1 + i] = row_value(q, grid.column[i], du[along_u + 1 + i]);
      });
      p[along_u] = c.corner[detail::corner_index(0, s)];
      p[along_u + nu - 1] = c.corner[detail::corner_index(1, s)];
      du[along_u] = row_slope(q, grid.end[0]);
      du[along_u + nu - 1] = row_slope(q, grid.end[1]);
      c.edge_cubic(detail::kEdgeU0 + s, q);
      if (grid.has_more()) {
        V of_patch[kOrder]; // the edge's control points do not determine du
        c.column(grid.end[s].y, of_patch, dq);
        grid.for_rows([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
          const std::size_t at = (1 + r) * nu + along_v;
          p[at] = row_value(q, grid.row[r], dv[at]);
          du[at] = row_value(dq, grid.row[r]);
        });
      }
      dv[along_v] = row_slope(q, grid.end[0]);
      dv[last_row + along_v] = row_slope(q, grid.end[1]);
    });
  }
};

/// Looks again at the normals of a register of patches that did not all pass the quick test.
template <std::size_t kInner, typename V>
SIMDBEZIER_RARE void resolve_normals_across(const GridTask<ScalarOf<V>>& task,
                                            const SmallGridAcross<V, kInner>& grid,
                                            std::size_t patch, const V* squared, V floor) {
  using T = ScalarOf<V>;
  alignas(64) T floors[kLanes<V>];
  alignas(64) T squares[kMostSmallSamples][kLanes<V>];
  store_vector(floors, floor);
  for (std::size_t k = 0; k < grid.samples(); ++k) {
    store_vector(squares[k], squared[k]);
  }
  for (std::size_t p = 0; p < kLanes<V>; ++p) {
    DoubtfulSamples<T> doubts(task, patch + p);
    for (std::size_t k = 0; k < grid.samples(); ++k) {
      if (!(squares[k][p] > floors[p])) {
        const std::size_t row = k / grid.nu;
        const V y = row == 0            ? grid.end[0].y
                    : row + 1 < grid.nv ? grid.row[row - 1].y
                                        : grid.end[1].y;
        doubts.add(
            UncertainNormals{p, 1, 1, 1, (patch + p) * task.patch_step + k, 0, 1, task.record},
            broadcast<V>(grid.x[k % grid.nu]), y, squared[k], floor);
      }
    }
    if (doubts.any()) {
      doubts.resolve();
    }
  }
}

/// Stores an output of a register of patches, whose values are in jets[c].p.
template <typename V>
SIMDBEZIER_PART void put_across(const GridTask<ScalarOf<V>>& task, Output output, std::size_t patch,
                                const JetsAcross<V> (&jets)[3], std::size_t samples) {
  if (task.record == detail::kSampleRecord) {
    ScalarOf<V>* const first = task.out[output_index(output)].component[0];
    put_vectors_across(jets[0].p, jets[1].p, jets[2].p, samples,
                       first + patch * task.patch_step * task.record, task.patch_step);
    return;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    put_across(task, output, c, patch, jets[c].p, samples);
  }
}

template <detail::OutputSet kOutputs, std::size_t kInner, typename T>
SIMDBEZIER_KERNEL void sweep_across(const GridTask<T>& shared_task) {
  using V = vec<T>;
  const GridTask<T> task = shared_task;
  const SmallGridAcross<V, kInner> grid(task);
  for_patches_across(task, [&](std::size_t patch, std::size_t fresh) SIMDBEZIER_INLINE_LAMBDA {
    if constexpr (kOutputs == detail::kPosition) {
      constexpr bool kApart = kLineWide<V> && kInner == 2; // more code is no faster
      for_components<kApart>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
        V sample[kMostSmallSamples];
        positions_across(ComponentAcross<V>(task, grid, patch, c), grid, sample);
        put_across(task, Output::position, c, patch, sample, grid.samples());
      });
    } else if constexpr (kOutputs == detail::kPositionDerivatives) {
      for (std::size_t c = 0; c < 3; ++c) {
        JetsAcross<V> jets;
        jets.find(ComponentAcross<V>(task, grid, patch, c), grid);
        put_across(task, Output::position, c, patch, jets.p, grid.samples());
        put_across(task, Output::du, c, patch, jets.du, grid.samples());
        put_across(task, Output::dv, c, patch, jets.dv, grid.samples());
      }
    } else {
      JetsAcross<V> jets[3];
      for (std::size_t c = 0; c < 3; ++c) {
        jets[c].find(ComponentAcross<V>(task, grid, patch, c), grid);
      }
      put_across(task, Output::position, patch, jets, grid.samples());
      const V floor = load_vector<V>(task.normal_floor + patch);
      V squared[kMostSmallSamples];
      bool passed = true;
      for (std::size_t k = 0; k < grid.samples(); ++k) {
        NormalSamples<V> s;
        for (std::size_t c = 0; c < 3; ++c) {
          s.jet[c] = {jets[c].p[k], jets[c].du[k], jets[c].dv[k]};
        }
        s.cross();
        for (std::size_t c = 0; c < 3; ++c) {
          jets[c].p[k] = s.normal[c];
        }
        squared[k] = s.squared;
        passed = passed && all_of<V>(s.squared > floor);
      }
      put_across(task, Output::normal, patch, jets, grid.samples());
      if (!passed) [[unlikely]] {
        resolve_normals_across(shared_task, grid, patch, squared, floor);
      }
    }
    drain_some(task.drain, fresh * written_planes(kOutputs) * grid.samples());
  });
}

/// Whether the compiler knows squares of `side` samples where registers are lines. Floats of 4 x 4
/// have kernels of their own (fast/squares_of_four.hpp), and doubles are faster so than in tiles.
template <detail::OutputSet kOutputs, typename T>
constexpr bool is_known_across(std::size_t side) {
  constexpr bool kPositions = kOutputs == detail::kPosition;
  constexpr bool kNormals = kOutputs == detail::kPositionNormal;
  if constexpr (sizeof(T) == 4) {
    return side == 5 && !kPositions;
  } else {
    return (side == 4 && (kPositions || kNormals)) || (side == 5 && kPositions);
  }
}

/// Whether lanes of a small grid are better patches: records of kSampleRecord values are put
/// together so only. Else there is a register of patches, and results go to planes that stay in the
/// caches. Samples that leave them by plain stores are stored faster patch by patch: by lanes,
/// parts of many lines are written in turns, and these are read first. Rows that are whole
/// registers have tiles which find tangents as fast. Where registers are lines, there are floats
/// with derivatives or normals, and mirrored squares of doubles; staged ones are stored faster
/// patch by patch as well, unless a register has room for all samples of a patch; and idle lanes of
/// the last register cost what is gained: half of the patches at most for positions, an eighth of
/// them elsewhere. Grids of two rows or columns have edges only.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool pays_across(const GridTask<T>& task) {
  constexpr std::size_t kL = kLanes<vec<T>>;
  if (task.record == detail::kSampleRecord) {
    return true;
  }
  if (task.patch_count < kL || task.record > 1 || task.streaming || task.plain_to_memory) {
    return false;
  }
  if (!is_small_grid(task)) { // tiles of two rows keep up where a register is a whole line
    constexpr bool kPays =
        !kLineWide<vec<T>> || (sizeof(T) == 4 && kOutputs != detail::kPositionDerivatives);
    return kPays || task.nu == 2;
  }
  if constexpr (kLineWide<vec<T>>) {
    const std::size_t idle = (kL - task.patch_count % kL) % kL; // lanes of the last register
    const bool filled = (kOutputs == detail::kPosition ? 2 : 8) * idle <= task.patch_count;
    if constexpr (sizeof(T) == 4) {
      const bool few = task.nu * (task.runs[1].rows + 2) <= kL;
      return kOutputs != detail::kPosition && filled && (task.drain == nullptr || few);
    } else {
      return task.drain == nullptr && filled && is_known_across<kOutputs, T>(task.nu) &&
             is_mirrored_square(task);
    }
  } else {
    return kOutputs == detail::kPosition || task.nu != kL;
  }
}

/// Sweeps a small grid for which pays_across() holds.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void sweep_small_grid_across(const GridTask<T>& task) {
  const auto sweep_known = [&]<std::size_t kSide>() SIMDBEZIER_INLINE_LAMBDA {
    if constexpr (!kLineWide<vec<T>> || kOutputs == detail::kPositionNormal ||
                  is_known_across<kOutputs, T>(kSide)) {
      if (task.nu == kSide) {
        sweep_across<kOutputs, kSide - 2>(task);
        return true;
      }
    }
    return false;
  };
  const bool known = is_small_grid(task) && is_mirrored_square(task);
  if (known && (sweep_known.template operator()<4>() || sweep_known.template operator()<5>())) {
    return;
  }
  sweep_across<kOutputs, 0>(task);
}

#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
