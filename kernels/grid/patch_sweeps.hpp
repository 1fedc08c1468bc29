// One tile of consecutive patches.
#pragma once

#include "kernels/drain/drain_kernel.hpp"
#include "kernels/grid/prefetch.hpp"
#include "kernels/grid/tile_components.hpp"
#include "kernels/grid/tile_normals.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Positions and normals, of a tile and the column behind it.
template <Scheme kScheme, bool kAny, typename Piece, typename SomeTile, typename T>
SIMDBEZIER_INLINE void sweep_normal_patches(const GridTask<T>& shared_task, const Piece& piece,
                                            const SomeTile& tile, std::size_t patch,
                                            std::size_t last_patch) {
  using V = typename SomeTile::Vector;
  // Copies, because stores through vector types might change anything that others can see.
  GridTask<T> task = shared_task;
  task.nu = piece.columns(task.nu);
  GridTask<T> column_task = shared_task;
  const ColumnTile<V> column(task.x, tile.first + (SomeTile::kBuffered ? tile.active : 0), 1,
                             is_watertight(kScheme));
  ColumnBuffer<T, 6> buffer;
  const ColumnPlanes<T> extra = buffer.planes(piece);
  for (std::size_t c = 0; c < 3; ++c) {
    column_task.out[detail::kPositionGroup].component[c] = buffer.first(c, piece);
    column_task.out[detail::kNormalGroup].component[c] = buffer.first(3 + c, piece);
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
template <detail::OutputSet kOutputs, Scheme kScheme, typename Piece, typename SomeTile, typename T>
SIMDBEZIER_INLINE void sweep_component_patches(const GridTask<T>& task, const Piece& piece,
                                               const SomeTile& tile, std::size_t patch,
                                               std::size_t last_patch) {
  using V = vec<T>;
  constexpr std::size_t kPlanes = kOutputs == detail::kPosition ? 1 : 3;
  const ColumnTile<V> column(task.x, tile.first + (SomeTile::kBuffered ? tile.active : 0), 1,
                             is_watertight(kScheme));
  ColumnBuffer<T, 3> buffer;
  const JetPlanes<T> there{buffer.first(0, piece), buffer.first(1, piece), buffer.first(2, piece)};
  const ColumnPlanes<T> extra = buffer.planes(piece);
  const std::size_t samples = piece.rows() * (tile.active + (SomeTile::kBuffered ? 1 : 0));
  const bool prefetch = task.prefetch && tile.first == 0;
  const std::size_t nu = piece.columns(task.nu);
  for (; patch < last_patch; ++patch) {
    if (prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * nu + tile.first;
    Component<T> component(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
      T* const position = task.out[detail::kPositionGroup].component[c] + at;
      if constexpr (kOutputs == detail::kPosition) {
        if constexpr (SomeTile::kBuffered) {
          sweep_position<kScheme>(piece, component, column, 1, there.position, extra);
        }
        sweep_position<kScheme>(piece, component, tile, nu, position, extra);
      } else if constexpr (kOutputs == detail::kPositionDerivatives) {
        const JetPlanes<T> to{position, task.out[detail::kDuGroup].component[c] + at,
                              task.out[detail::kDvGroup].component[c] + at};
        if constexpr (SomeTile::kBuffered) {
          sweep_derivatives<kScheme>(piece, component, column, 1, there, extra);
        }
        sweep_derivatives<kScheme>(piece, component, tile, nu, to, extra);
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
template <detail::OutputSet kOutputs, Scheme kScheme, typename SomeTile, typename Piece, typename T>
__attribute__((noinline)) void sweep_tile(const GridTask<T>& shared_task, const Piece& shared_piece,
                                          std::size_t first_column, std::size_t columns,
                                          std::size_t patch, std::size_t last_patch) {
  const Piece piece = shared_piece;
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

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
