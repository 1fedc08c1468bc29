// Grid kernels: small grids have registers of their own (grid/small.hpp); of all others, which
// columns go to which tile (grid/tile.hpp). With L lanes a row of nu columns is
// nu / L whole registers and a rest, which takes
//   1 column           the buffered column (kExtra) of the last whole register
//   up to L/4, L/2     a tile of 4 or 2 rows a register
//   more               a masked register
// Without normals one component is swept after the other (4 or 8 registers, one to three store
// streams); normals need all three at once (24 registers, which AVX2 keeps partly in L1).
#pragma once

#include <type_traits>

#include "kernels/grid/components.hpp"
#include "kernels/grid/normals.hpp"
#include "kernels/grid/prefetch.hpp"
#include "kernels/grid/records.hpp"
#include "kernels/grid/small_jets.hpp"
#include "kernels/output/drain_kernel.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Positions and normals, of a tile and the column behind it.
template <Scheme kScheme, bool kAny, typename SomeTile, typename T>
SIMDBEZIER_INLINE void sweep_normal_patches(const GridTask<T>& shared_task,
                                            const RowPiece<T>& piece, const SomeTile& tile,
                                            std::size_t patch, std::size_t last_patch) {
  using V = typename SomeTile::Vector;
  // Copies, because stores through vector types might change anything that others can see.
  const GridTask<T> task = shared_task;
  GridTask<T> column_task = shared_task;
  const ColumnTile<V> column(task.x, tile.first + (SomeTile::kBuffered ? tile.active : 0), 1,
                             is_watertight(kScheme));
  ColumnBuffer<T, 6> buffer;
  NormalExtra<T> extra{};
  for (std::size_t c = 0; c < 3; ++c) {
    extra.position[c] = column_task.out[detail::kPositionGroup].component[c] =
        buffer.first(c, piece);
    extra.normal[c] = column_task.out[detail::kNormalGroup].component[c] =
        buffer.first(3 + c, piece);
  }
  column_task.nu = 1;
  const std::size_t samples = piece.rows() * (tile.active + (SomeTile::kBuffered ? 1 : 0));
  const bool prefetch = task.prefetch && tile.first == 0;
  for (; patch < last_patch; ++patch) {
    if (prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * task.nu + tile.first;
    if constexpr (SomeTile::kBuffered) {
      if (task.status != nullptr) {
        column_task.status = task.status + at + tile.active;
      }
      sweep_normals<kScheme, kAny>(column_task, column_task, piece, column, patch, 0, task.nu,
                                   extra);
    }
    sweep_normals<kScheme, kAny>(task, shared_task, piece, tile, patch, at, 1, extra);
    pace(task.drain, samples * (kAny ? 12 : 6));
  }
}

/// Positions and derivatives, component by component, of a tile and the column behind it.
template <detail::OutputSet kOutputs, Scheme kScheme, typename SomeTile, typename T>
SIMDBEZIER_INLINE void sweep_component_patches(const GridTask<T>& task, const RowPiece<T>& piece,
                                               const SomeTile& tile, std::size_t patch,
                                               std::size_t last_patch) {
  using V = typename SomeTile::Vector;
  constexpr std::size_t kPlanes = kOutputs == detail::kPosition ? 1 : 3;
  const ColumnTile<V> column(task.x, tile.first + (SomeTile::kBuffered ? tile.active : 0), 1,
                             is_watertight(kScheme));
  ColumnBuffer<T, 3> buffer;
  const JetPlanes<T> there{buffer.first(0, piece), buffer.first(1, piece), buffer.first(2, piece)};
  const JetPlanes<const T> extra{there.position, there.du, there.dv};
  const std::size_t samples = piece.rows() * (tile.active + (SomeTile::kBuffered ? 1 : 0));
  const bool prefetch = task.prefetch && tile.first == 0;
  for (; patch < last_patch; ++patch) {
    if (prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * task.nu + tile.first;
    for (std::size_t c = 0; c < 3; ++c) {
      const Component<T> component(task, patch, c);
      T* const position = task.out[detail::kPositionGroup].component[c] + at;
      if constexpr (kOutputs == detail::kPosition) {
        if constexpr (SomeTile::kBuffered) {
          sweep_position<kScheme>(piece, component, column, 1, there.position, extra.position);
        }
        sweep_position<kScheme>(piece, component, tile, task.nu, position, extra.position);
      } else if constexpr (kOutputs == detail::kPositionDerivatives) {
        const JetPlanes<T> to{position, task.out[detail::kDuGroup].component[c] + at,
                              task.out[detail::kDvGroup].component[c] + at};
        if constexpr (SomeTile::kBuffered) {
          sweep_derivatives<kScheme>(piece, component, column, 1, there, extra);
        }
        sweep_derivatives<kScheme>(piece, component, tile, task.nu, to, extra);
      } else {
        sweep_second<kScheme>(task, piece, component, tile, c, at);
      }
      pace(task.drain, samples * kPlanes);
    }
  }
}

/// Rarer outputs do with whole registers and masked ones, and ask the task whether edges are
/// watertight: code is not free either.
template <detail::OutputSet kOutputs>
constexpr bool kUsual = kOutputs == detail::kPosition || kOutputs == detail::kPositionNormal ||
                        kOutputs == detail::kPositionDerivatives;

/// One tile of consecutive patches. A function of its own, or what other tiles keep in registers
/// would be in the way.
template <detail::OutputSet kOutputs, Scheme kScheme, typename SomeTile, typename T>
__attribute__((noinline)) void sweep_tile(const GridTask<T>& shared_task,
                                          const RowPiece<T>& shared_piece, std::size_t first_column,
                                          std::size_t columns, std::size_t patch,
                                          std::size_t last_patch) {
  const RowPiece<T> piece = shared_piece;
  const bool watertight = is_watertight(kScheme) && (kUsual<kOutputs> || shared_task.watertight);
  const SomeTile tile(shared_task.x, first_column, columns, watertight);
  if constexpr (kOutputs == detail::kPositionNormal || kOutputs == detail::kAnyOutputs) {
    sweep_normal_patches<kScheme, kOutputs == detail::kAnyOutputs>(shared_task, piece, tile, patch,
                                                                   last_patch);
  } else {
    const GridTask<T> task = shared_task;
    sweep_component_patches<kOutputs, kScheme>(task, piece, tile, patch, last_patch);
  }
}

/// The columns of a grid, by the tiles that take them.
template <typename V>
struct ColumnSplit {
  std::size_t full; ///< whole registers
  std::size_t rest; ///< behind them
  bool column;      ///< and one more behind these

  SIMDBEZIER_INLINE ColumnSplit(std::size_t nu, bool single_columns)
      : full(nu / kLanes<V> * kLanes<V>), rest(nu - full), column(false) {
    constexpr std::size_t kL = kLanes<V>;
    if (single_columns && kL > 1 && rest == 1) {
      --rest;
      column = true;
    }
  }
};

/// Bytes of samples that stay in the first-level cache while one tile follows the other.
constexpr std::size_t kCachedBytes = 12288;

/// Planes that a kernel writes.
constexpr std::size_t written_planes(detail::OutputSet outputs) {
  return outputs == detail::kPosition         ? 3
         : outputs == detail::kPositionNormal ? 6
         : outputs == detail::kAnyOutputs     ? 12
                                              : 9;
}

/// All tiles of patches [patch, end).
template <detail::OutputSet kOutputs, Scheme kScheme, typename T>
SIMDBEZIER_INLINE void sweep_tiles(const GridTask<T>& task, const ColumnSplit<vec<T>>& split,
                                   const RowPiece<T>& piece, std::size_t patch, std::size_t end) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  constexpr std::size_t kHalf = kL >= 4 ? 2 : 1; // rows of a tile of lanes/2 columns
  constexpr std::size_t kQuarter = kL >= 8 ? 4 : kHalf;
  const auto sweep = [&]<typename SomeTile>(std::type_identity<SomeTile>, std::size_t first,
                                            std::size_t columns) SIMDBEZIER_INLINE_LAMBDA {
    sweep_tile<kOutputs, kScheme, SomeTile>(task, piece, first, columns, patch, end);
  };
  // A single column goes along with the last whole register.
  const std::size_t plain = split.column && split.full > 0 ? split.full - kL : split.full;
  if constexpr (kPutsRecords<V> && kUsual<kOutputs>) {
    if (task.record > 1) {
      sweep_record_tiles<kOutputs, kScheme>(task, piece, patch, end);
      return;
    }
  }
  if constexpr (kLineWide<V> && kUsual<kOutputs>) {
    if (task.streaming) [[unlikely]] { // whole registers only
      for (std::size_t first = 0; first < plain; first += kL) {
        sweep(std::type_identity<Tile<1, true, false, V, true>>{}, first, kL);
      }
      return;
    }
  }
  for (std::size_t first = 0; first < plain; first += kL) {
    sweep(std::type_identity<Tile<1, true, false, V>>{}, first, kL);
  }
  if constexpr (kL > 1) {
    if constexpr (!kUsual<kOutputs>) {
      if (split.rest != 0) {
        sweep(std::type_identity<Tile<1, false, false, V>>{}, split.full, split.rest);
      }
    } else if (split.column) {
      if (split.full != 0) {
        sweep(std::type_identity<Tile<1, true, true, V>>{}, plain, kL);
      } else {
        sweep(std::type_identity<Tile<kL, false, false, V>>{}, 0, 1);
      }
    } else if (split.rest > kL / 2) {
      sweep(std::type_identity<Tile<1, false, false, V>>{}, split.full, split.rest);
    } else if (split.rest > kL / kQuarter) {
      sweep(std::type_identity<Tile<kHalf, false, false, V>>{}, split.full, split.rest);
    } else if (split.rest > 0) {
      sweep(std::type_identity<Tile<kQuarter, false, false, V>>{}, split.full, split.rest);
    }
  }
}

template <typename T, detail::OutputSet kOutputs, Scheme kScheme>
void grid_kernel(GridTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  if (sweep_small_grid<kOutputs, kScheme>(task)) {
    return;
  }
  const ColumnSplit<vec<T>> split(task.nu, kUsual<kOutputs>);
  const std::size_t most = split.column ? kBufferRows : std::size_t{1} << 30;
  for (RowPieces<kScheme, T> pieces(task, most); pieces.more();) {
    const RowPiece<T> piece = pieces.next();
    const std::size_t bytes = piece.rows() * task.nu * written_planes(kOutputs) * sizeof(T);
    const std::size_t together = kCachedBytes / bytes + 1;
    for (std::size_t patch = 0; patch < task.patch_count; patch += together) {
      const std::size_t left = task.patch_count - patch;
      sweep_tiles<kOutputs, kScheme>(task, split, piece, patch,
                                     patch + (left < together ? left : together));
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
