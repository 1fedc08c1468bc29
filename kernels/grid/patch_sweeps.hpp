// One tile of consecutive patches.
#pragma once

#include "kernels/drain/drain_kernel.hpp"
#include "kernels/grid/prefetch.hpp"
#include "kernels/grid/tile_components.hpp"
#include "kernels/grid/tile_normals.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// All outputs of the single column behind a square's tile, in registers, as ColumnBuffer has them
/// in memory. Where stores and loads are many, some have the low bits of their addresses in common,
/// and processors let such loads wait.
template <typename V, std::size_t kSide, std::size_t kPlanes>
struct SquareColumn {
  using Plane = const ColumnLanes<V, kSide>*;
  ColumnLanes<V, kSide> planes[kPlanes];

  SIMDBEZIER_PART Plane plane(std::size_t k) const { return planes + k; }

  template <typename T, bool kAcross>
  SIMDBEZIER_PART void find(const SquarePiece<T, kSide, kAcross>& piece, const Component<T>& c,
                            const SingleColumnTile<V>& tile) {
    JetColumns<V, false> columns;
    columns.build(c, tile);
    const Jet<V> edges = columns.edge(c, tile, 0);
    planes[0].edges = edges.p;
    if constexpr (kPlanes == 3) {
      planes[1].edges = edges.du;
      planes[2].edges = edges.dv;
    }
    for (std::size_t row = 0; row < kSide - 2; row += kLanes<V>) {
      const auto at = RowPowers<T>::template point<kLanes<V>, V>(piece.middle.y + row);
      const Jet<V> jet = columns.interior(at);
      planes[0].middle[row / kLanes<V>] = jet.p;
      if constexpr (kPlanes == 3) {
        planes[1].middle[row / kLanes<V>] = jet.du;
        planes[2].middle[row / kLanes<V>] = jet.dv;
      }
    }
  }
};

/// What the compiler knows of a task. To ask for origins, which most sets lack, costs small grids
/// up to a tenth of their speed; to ask for exact edges costs open grids as much, and normals more.
enum class Known {
  watertight, ///< and that there are no origins
  open,       ///< likewise
  closed,     ///< likewise, that edges are watertight, and that RowPiece::is_closed() holds
  no_origins,
  nothing
};

template <Known kKnown, typename T>
SIMDBEZIER_PART void assume(GridTask<T>& task) {
  if constexpr (kKnown != Known::nothing) {
    task.origins = nullptr;
  }
  if constexpr (kKnown == Known::watertight || kKnown == Known::open) {
    task.watertight = kKnown == Known::watertight;
  }
}
/// The same for a task that is no copy.
template <Known kKnown, typename T>
SIMDBEZIER_PART void assume(const GridTask<T>& task) {
  if (kKnown != Known::nothing && task.origins != nullptr) {
    __builtin_unreachable();
  }
}
template <Known kKnown, typename T>
SIMDBEZIER_PART bool is_watertight(const GridTask<T>& task) {
  return kKnown == Known::watertight || kKnown == Known::closed ||
         (kKnown != Known::open && task.watertight);
}

/// The same for a piece: constants for the compiler.
template <Known kKnown, typename Piece>
SIMDBEZIER_PART void assume_rows(Piece& piece) {
  if constexpr (kKnown == Known::open) {
    piece.lead = piece.trail = false;
  }
  if constexpr (kKnown == Known::closed) {
    piece.lead = piece.mirrored = piece.trail = true;
    piece.lead_kind = RowKind::edge_v0;
    piece.trail_kind = RowKind::edge_v1;
  }
}

/// Makes a task of the single column behind a tile, whose positions and normals go to a buffer.
template <typename Piece, typename T>
SIMDBEZIER_PART void put_into_buffer(GridTask<T>& column_task, const Piece& piece,
                                     ColumnBuffer<T, 6>& buffer) {
  for (std::size_t c = 0; c < 3; ++c) {
    column_task.out[output_index(Output::position)].component[c] = buffer.first(c, piece);
    column_task.out[output_index(Output::normal)].component[c] = buffer.first(3 + c, piece);
  }
  column_task.nu = 1;
}

/// Returns how many columns a tile adds to those before it, with the one behind it: fewer than it
/// has where it begins within the one before. A drain that counted them all would be through with
/// the chunk before too early, and memory idle for the rest.
template <typename SomeTile>
SIMDBEZIER_PART std::size_t fresh_columns(const SomeTile& tile) {
  constexpr std::size_t kL = kLanes<vec<typename SomeTile::T>>;
  const std::size_t before = (tile.first + kL - 1) / kL * kL;
  return tile.first + tile.active - before + (SomeTile::kBuffered ? 1 : 0);
}

/// Sweeps positions and normals of a tile and the column behind it.
template <bool kAny, Known kKnown, typename Piece, typename SomeTile, typename T>
SIMDBEZIER_PART void sweep_normal_patches(const GridTask<T>& shared_task, const Piece& piece,
                                          const SomeTile& tile, std::size_t patch,
                                          std::size_t last_patch) {
  using V = typename SomeTile::Vector;
  GridTask<T> task = shared_task;
  task.nu = piece.columns(task.nu);
  assume<kKnown>(task);
  GridTask<T> column_task = shared_task;
  const SingleColumnTile<V> column(task.x, tile.first + (SomeTile::kBuffered ? tile.active : 0), 1,
                                   task.watertight);
  ColumnBuffer<T, 6> buffer;
  const ColumnPlanes<T> extra = buffer.planes(piece);
  put_into_buffer(column_task, piece, buffer);
  const std::size_t samples = piece.rows() * fresh_columns(tile);
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
      sweep_normals<kAny, kKnown == Known::nothing>(column_task, column_task, piece, column, patch,
                                                    0, task.nu, extra);
    }
    sweep_normals<kAny, kKnown == Known::nothing>(task, shared_task, piece, tile, patch, at, 1,
                                                  extra);
    drain_some(task.drain, samples * (kAny ? 12 : 6));
  }
}

/// Whether each component has stores of its own. Those of straight code then go from patch to patch
/// by one distance, which prefetchers of stores follow; in a loop over components their distances
/// change, and lines on their way to the second-level cache take up to twice as long.
template <typename Piece>
constexpr bool kOwnStores = (Piece::kKnown) && !(Piece::kAcross);

/// Sweeps positions and derivatives, component by component, of a tile and the column behind it.
template <detail::OutputSet kOutputs, typename Piece, typename SomeTile, typename T>
SIMDBEZIER_PART void sweep_component_patches(const GridTask<T>& task, const Piece& piece,
                                             const SomeTile& tile, std::size_t patch,
                                             std::size_t last_patch) {
  using V = vec<T>;
  constexpr std::size_t kPlanes = kOutputs == detail::kPosition ? 1 : 3;
  const SingleColumnTile<V> column(task.x, tile.first + (SomeTile::kBuffered ? tile.active : 0), 1,
                                   task.watertight);
  ColumnBuffer<T, 3> buffer;
  const JetPlanes<T> there{buffer.first(0, piece), buffer.first(1, piece), buffer.first(2, piece)};
  const ColumnPlanes<T> extra = buffer.planes(piece);
  const std::size_t samples = piece.rows() * fresh_columns(tile);
  const bool prefetch = task.prefetch && tile.first == 0;
  const std::size_t nu = piece.columns(task.nu);
  for (; patch < last_patch; ++patch) {
    if (prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * nu + tile.first;
    Component<T> component(task, patch, 0);
    for_components<kOwnStores<Piece>>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      T* const position = own_plane(task.out[output_index(Output::position)].component[c] + at);
      if constexpr (Piece::kAcross && SomeTile::kBuffered) {
        SquareColumn<V, Piece::rows(), kPlanes> behind;
        behind.find(piece, component, column);
        if constexpr (kOutputs == detail::kPosition) {
          sweep_position(piece, component, tile, nu, position, behind);
        } else {
          const JetPlanes<T> to{position, task.out[output_index(Output::du)].component[c] + at,
                                task.out[output_index(Output::dv)].component[c] + at};
          sweep_derivatives(piece, component, tile, nu, to, behind);
        }
      } else if constexpr (kOutputs == detail::kPosition) {
        if constexpr (SomeTile::kBuffered) {
          sweep_position(piece, component, column, 1, there.position, extra);
        }
        sweep_position(piece, component, tile, nu, position, extra);
      } else if constexpr (kOutputs == detail::kPositionDerivatives) {
        const JetPlanes<T> to{position,
                              own_plane(task.out[output_index(Output::du)].component[c] + at),
                              own_plane(task.out[output_index(Output::dv)].component[c] + at)};
        if constexpr (SomeTile::kBuffered) {
          sweep_derivatives(piece, component, column, 1, there, extra);
        }
        sweep_derivatives(piece, component, tile, nu, to, extra);
      } else {
        sweep_second(task, piece, component, tile, c, at);
      }
      drain_some(task.drain, samples * kPlanes);
      component = component.next();
    });
  }
}

/// Returns the number of planes that a kernel writes.
constexpr std::size_t written_planes(detail::OutputSet outputs) {
  return outputs == detail::kPosition         ? 3
         : outputs == detail::kPositionNormal ? 6
         : outputs == detail::kAnyOutputs     ? 12
                                              : 9;
}

/// Rarer outputs have tiles of whole and masked registers only, since code has a cost as well.
template <detail::OutputSet kOutputs>
constexpr bool kUsual = kOutputs == detail::kPosition || kOutputs == detail::kPositionNormal ||
                        kOutputs == detail::kPositionDerivatives;

/// Sweeps one tile of consecutive patches. It is a function of its own because values that other
/// tiles keep in registers would leave it too few.
template <detail::OutputSet kOutputs, Known kKnown, typename SomeTile, typename Piece, typename T>
SIMDBEZIER_KERNEL void sweep_tile(const GridTask<T>& __restrict shared_task,
                                  const Piece& shared_piece, std::size_t first_column,
                                  std::size_t columns, std::size_t patch, std::size_t last_patch) {
  Piece piece = shared_piece;
  assume_rows<kKnown>(piece);
  if constexpr (kKnown == Known::open || kKnown == Known::nothing) {
    piece.by_lines = true; // a constant as well: no pairs of rows that share lines, to save code
  }
  const SomeTile tile(shared_task.x, first_column, columns, is_watertight<kKnown>(shared_task));
  if constexpr (kOutputs == detail::kPositionNormal || kOutputs == detail::kAnyOutputs) {
    sweep_normal_patches<kOutputs == detail::kAnyOutputs, kKnown>(shared_task, piece, tile, patch,
                                                                  last_patch);
  } else {
    // In WebAssembly, a copy would be a call that takes as long as a tile of a small patch.
    std::conditional_t<kSimd128, const GridTask<T>&, GridTask<T>> task = shared_task;
    assume<kKnown>(task);
    sweep_component_patches<kOutputs>(task, piece, tile, patch, last_patch);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
