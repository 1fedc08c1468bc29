// Watertight grids of 3 x 3 to 6 x 6 samples that end at the patch's edges, in one piece.
//
// Most of their samples are on the border, and all preparations of a tile (grid_tile.hpp) would
// serve a row or two. So a component takes three registers of four groups of four lanes:
//   columns   group g, lane l   power l of Y of the polynomial that inner column g is: Horner in X
//                               of the coefficients as they lie in memory
//   inner     group g, lane r   inner column g, inner row r: Horner in Y
//   border    group s, lane e   inner sample s of edge e: Horner along the edge
// of which one permutation makes 16 consecutive samples, and another one adds corners. The
// operations of a sample are those of the tiles, and so are its bits.
#pragma once

#include <array>

#include "kernels/drain_kernel.hpp"
#include "kernels/grid_tile.hpp"
#include "kernels/isa/assembly.hpp"
#include "kernels/isa/quads.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Samples between edges that four groups, or four lanes of a group, have room for.
constexpr std::size_t kMostInner = 4;
constexpr std::size_t kMostSmall = kMostInner + 2;

/// Whether registers have four groups of four lanes.
template <typename V>
constexpr bool kFourQuads = kLanes<V> == 16;

#if defined(SIMDBEZIER_KERNELS_AVX512)

/// For every sample of a small grid, row after row, where it comes from: see Assembly.
/// First register: inner, second: border, memory: corners.
class SmallGridSources {
public:
  static constexpr std::size_t kRegisters = (kMostSmall * kMostSmall + 15) / 16;

  constexpr SmallGridSources(std::size_t nu, std::size_t nv) {
    for (std::size_t j = 0; j < nv; ++j) {
      for (std::size_t i = 0; i < nu; ++i) {
        codes_[j * nu + i] = static_cast<std::uint8_t>(source(i, nu, j, nv));
      }
    }
  }
  [[nodiscard]] constexpr const std::uint8_t* of_register(std::size_t k) const {
    return codes_ + 16 * k;
  }

private:
  static constexpr std::size_t source(std::size_t i, std::size_t nu, std::size_t j,
                                      std::size_t nv) {
    const bool on_u = i == 0 || i + 1 == nu;
    const bool on_v = j == 0 || j + 1 == nv;
    if (on_u && on_v) {
      return 32 + detail::corner_index(i == 0 ? 0 : 1, j == 0 ? 0 : 1);
    }
    if (on_v) {
      return 16 + 4 * (i - 1) + (j == 0 ? detail::kEdgeV0 : detail::kEdgeV1);
    }
    if (on_u) {
      return 16 + 4 * (j - 1) + (i == 0 ? detail::kEdgeU0 : detail::kEdgeU1);
    }
    return 4 * (i - 1) + (j - 1);
  }

  std::uint8_t codes_[16 * kRegisters] = {};
};

/// [nv - 3][nu - 3]
inline constexpr auto kSmallGridSources = [] {
  constexpr std::size_t kSizes = kMostInner;
  using Row = std::array<SmallGridSources, kSizes>;
  return std::array<Row, kSizes>{
      Row{SmallGridSources{3, 3}, {4, 3}, {5, 3}, {6, 3}},
      Row{SmallGridSources{3, 4}, {4, 4}, {5, 4}, {6, 4}},
      Row{SmallGridSources{3, 5}, {4, 5}, {5, 5}, {6, 5}},
      Row{SmallGridSources{3, 6}, {4, 6}, {5, 6}, {6, 6}},
  };
}();

/// Whether the task's grid is a small one: rows and columns begin and end on edges, nothing in
/// between does.
template <typename T>
SIMDBEZIER_INLINE bool is_small_grid(const GridTask<T>& task) {
  if (task.nu < 3 || task.nu > kMostSmall || task.run_count != 3) {
    return false;
  }
  const RowRun<T>* const run = task.runs;
  bool small = run[0].kind == RowKind::edge_v0 && run[0].rows == 1 &&
               run[1].kind == RowKind::interior && run[1].rows <= kMostInner &&
               run[2].kind == RowKind::edge_v1 && run[2].rows == 1 && task.x[0] == T(-0.5) &&
               task.x[task.nu - 1] == T(0.5);
  for (std::size_t i = 1; i + 1 < task.nu; ++i) {
    small = small && task.x[i] != T(-0.5) && task.x[i] != T(0.5);
  }
  return small;
}

/// The parameters of a small grid.
template <typename V>
struct SmallGrid {
  using T = ScalarOf<V>;
  using Quads = RowGroups<4, V>;

  V x;     ///< of column g, in all lanes of group g
  V y;     ///< of row r, in lane r of all groups
  V along; ///< of sample s, in group s: X for edges v = const, Y for u = const
  std::size_t samples;
  Assembly sample[SmallGridSources::kRegisters];

  explicit SIMDBEZIER_INLINE SmallGrid(const GridTask<T>& task)
      : x(Quads::spread(task.x + 1)), y(Quads::repeat(task.runs[1].y)),
        along(select_where<V>(across_v(), x, Quads::spread(task.runs[1].y))) {
    const std::size_t inner = task.runs[1].rows;
    samples = task.nu * (inner + 2);
    const SmallGridSources& sources = kSmallGridSources[inner - 1][task.nu - 3];
    for (std::size_t k = 0; k < SmallGridSources::kRegisters; ++k) {
      sample[k] = Assembly(sources.of_register(k));
    }
  }

private:
  /// Lanes of edges v = const.
  static SIMDBEZIER_INLINE MaskOf<V> across_v() {
    constexpr T kV[kEdges] = {0, 0, 1, 1};
    static_assert(detail::kEdgeV0 < 2 && detail::kEdgeV1 < 2);
    return Quads::repeat(kV) == broadcast<V>(T(0));
  }
};

/// Positions of one component: see above.
template <Scheme kScheme, typename V>
struct SmallPositions {
  using T = ScalarOf<V>;
  using Quads = RowGroups<4, V>;
  V inner;
  V border;
  V corner;

  SIMDBEZIER_INLINE SmallPositions(const Component<T>& c, const SmallGrid<V>& grid) {
    V k[kOrder];
    V e[kOrder];
    for (std::size_t i = 0; i < kOrder; ++i) {
      k[i] = Quads::repeat(c.matrix + i * kOrder);
      e[i] = Quads::repeat(c.edge + i * kEdges);
    }
    const V columns = horner(k, grid.x);
    const V q[kOrder] = {lane_broadcast<0>(columns), lane_broadcast<1>(columns),
                         lane_broadcast<2>(columns), lane_broadcast<3>(columns)};
    inner = horner(q, grid.y);
    border = horner(e, grid.along);
    corner = Quads::repeat(c.corner);
    if constexpr (has_origins(kScheme)) {
      inner = inner + broadcast<V>(c.origin()[0]);
      border = border + Quads::repeat(c.origin() + detail::kEdgeOriginsAt);
    }
  }
  SIMDBEZIER_INLINE V samples(const Assembly& from) const { return from(inner, border, corner); }
};

/// kFull: whole registers of samples, before the last one.
template <Scheme kScheme, std::size_t kFull, typename T>
__attribute__((noinline)) void sweep_small_positions(const GridTask<T>& shared_task) {
  using V = vec<T>;
  const GridTask<T> task = shared_task;
  const SmallGrid<V> grid(task);
  const std::size_t rest = grid.samples - kFull * kLanes<V>;
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    if (task.prefetch) {
      prefetch_patch(task, patch);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const SmallPositions<kScheme, V> positions(Component<T>(task, patch, c), grid);
      T* const to = task.out[detail::kPositionGroup].component[c] + patch * task.patch_step;
      for (std::size_t k = 0; k < kFull; ++k) {
        store_vector(to + k * kLanes<V>, positions.samples(grid.sample[k]));
      }
      masked_store(to + kFull * kLanes<V>, positions.samples(grid.sample[kFull]), rest);
    }
    pace(task.drain, 3 * grid.samples);
  }
}

#endif

/// Positions of a small grid; false, and nothing done, where the task has none.
template <Scheme kScheme, typename T>
SIMDBEZIER_INLINE bool small_grid_positions(const GridTask<T>& task) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  if constexpr (is_watertight(kScheme) && kFourQuads<vec<T>>) {
    if (!is_small_grid(task)) {
      return false;
    }
    const std::size_t samples = task.nu * (task.runs[1].rows + 2);
    if (samples <= 16) {
      sweep_small_positions<kScheme, 0>(task);
    } else if (samples <= 32) {
      sweep_small_positions<kScheme, 1>(task);
    } else {
      sweep_small_positions<kScheme, 2>(task);
    }
    return true;
  }
#endif
  static_cast<void>(task);
  return false;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
