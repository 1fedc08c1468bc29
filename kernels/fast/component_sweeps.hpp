// Patches whose outputs leave the first-level cache while one tile follows the other.
//
// Registers shorter than a line write each line twice or more often, tile by tile. Where all planes
// of a patch together are too large for the cache, lines would have left it in between. So all
// tiles of one component come before those of the next one.
#pragma once

#include "kernels/grid/tile_sweeps.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether there are such sweeps: where a component has three planes. Positions have one, and gain
/// by this with SSE2 only, whose rows are the most tiles; normals need all components at once.
template <detail::OutputSet kOutputs, typename V>
constexpr bool kSweepsByComponents = !kLineWide<V> && (kOutputs == detail::kPositionDerivatives ||
                                                       kOutputs == detail::kSecondDerivatives ||
                                                       (kOutputs == detail::kPosition && kSse2));

/// The columns that are swept together.
template <detail::OutputSet kOutputs, typename V>
using ComponentTile =
    ColumnTile<1, true, false,
               std::conditional_t<kOutputs == detail::kPosition, RegisterPair<V>, V>>;

/// Sweeps patches [patch, last_patch) without origins in such tiles, at least two a row. Where
/// these do not fit, the last one begins within the one before it, even for a single column: a
/// buffer for it would be filled three times a patch.
template <detail::OutputSet kOutputs, Known kKnown, typename Piece, typename T>
SIMDBEZIER_KERNEL void sweep_by_components(const GridTask<T>& shared_task,
                                           const Piece& shared_piece, std::size_t patch,
                                           std::size_t last_patch) {
  using V = vec<T>;
  using Tile = ComponentTile<kOutputs, V>;
  constexpr std::size_t kL = Tile::kColumns;
  constexpr std::size_t kPlanes = kOutputs == detail::kPosition ? 1 : 3;
  GridTask<T> task = shared_task;
  assume<kKnown>(task);
  std::conditional_t<kKnown == Known::closed, Piece, const Piece&> piece = shared_piece;
  if constexpr (kKnown == Known::closed) {
    assume_rows<kKnown>(piece);
  }
  const std::size_t nu = task.nu;
  const ColumnPlanes<T> none{nullptr};
  for (; patch < last_patch; ++patch) {
    if (task.prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * nu;
    Component<T> component(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
      for (std::size_t next = 0; next < nu; next += kL) {
        const std::size_t first = next + kL <= nu ? next : nu - kL;
        const Tile tile(task.x, first, kL, is_watertight<kKnown>(task));
        const auto plane = [&](Output output) SIMDBEZIER_INLINE_LAMBDA {
          return task.out[output_index(output)].component[c] + at + first;
        };
        if constexpr (kOutputs == detail::kSecondDerivatives) {
          sweep_second(task, piece, component, tile, c, at + first);
        } else if constexpr (kOutputs == detail::kPosition) {
          sweep_position(piece, component, tile, nu, plane(Output::position), none);
        } else {
          const JetPlanes<T> to{plane(Output::position), plane(Output::du), plane(Output::dv)};
          sweep_derivatives(piece, component, tile, nu, to, none);
        }
        drain_some(task.drain, piece.rows() * fresh_columns(tile) * kPlanes);
      }
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
