// Rows of whole cache lines that go straight to memory, where two registers are a line.
//
// Streaming stores overlap with arithmetic; copies from staging take their own time. But a line has
// to be stored at once, and memory takes lines at a third to a half of its rate where they leave
// others out, or where several planes come by turns that lie at the same place within a page. So
// the tiles of a row are swept together, row by row and plane by plane. Their polynomials, more
// than there are registers, are operands in memory.
#pragma once

#include <utility>

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/register_pair.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether there are such rows. Registers of a line stream tile by tile. Normals take so much
/// arithmetic, and six planes at once, that staging is faster.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kStreamsRows = kLineWide<RegisterPair<vec<T>>> &&
                              (kOutputs == detail::kPosition ||
                               kOutputs == detail::kPositionDerivatives);

/// Lines of columns that lie side by side.
template <typename T, std::size_t kLines>
struct LineTiles {
  using Vector = RegisterPair<vec<T>>;
  using Tile = ColumnTile<1, true, false, Vector, true>;
  Tile tile[kLines];

  SIMDBEZIER_PART LineTiles(const T* x, std::size_t first, bool watertight)
      : LineTiles(x, first, watertight, std::make_index_sequence<kLines>()) {}

  /// Calls visit(tile, k, column), with the k-th tile and its first column from the first one on.
  template <typename Visit>
  SIMDBEZIER_INLINE void for_each(const Visit& visit) const {
    for (std::size_t k = 0; k < kLines; ++k) {
      visit(tile[k], k, k * kLanes<Vector>);
    }
  }

private:
  template <std::size_t... k>
  SIMDBEZIER_PART LineTiles(const T* x, std::size_t first, bool watertight,
                            std::index_sequence<k...> /*lines*/)
      : tile{{x, first + k * kLanes<Vector>, kLanes<Vector>, watertight}...} {}
};

/// Streams the rows of one plane: edge(kind, place) stores those on edges, parts(k, at) gives the
/// parts of the k-th tile's row at a point, whose sum it is.
template <typename T, std::size_t kLines, typename Edge, typename RowParts>
SIMDBEZIER_INLINE void stream_plane(const RowPiece<T>& piece, const LineTiles<T, kLines>& tiles,
                                    std::size_t nu, T* to, const Edge& edge,
                                    const RowParts& parts) {
  using V = typename LineTiles<T, kLines>::Vector;
  for_rows<RowOrder{1, RowPairs::always, 1}>(
      piece, 0, nu, edge,
      [&](const T* y, RowPlace place, RowPlace mirrored) SIMDBEZIER_INLINE_LAMBDA {
        const auto at = piece.template point<1, V>(y);
        tiles.for_each(
            [&](const auto& tile, std::size_t k, std::size_t x) SIMDBEZIER_INLINE_LAMBDA {
              const Parts<V> row = parts(k, at);
              tile.store(to + place.at + x, nu, row.sum(), 1, nullptr);
              tile.store_mirrored(to + mirrored.at + x, nu, row.difference(), nullptr);
            });
      },
      [&](const T* y, RowPlace place, std::size_t) SIMDBEZIER_INLINE_LAMBDA {
        const auto at = piece.template point<1, V>(y);
        tiles.for_each([&](const auto& tile, std::size_t k, std::size_t x)
                           SIMDBEZIER_INLINE_LAMBDA {
                             tile.store(to + place.at + x, nu, parts(k, at).sum(), 1, nullptr);
                           });
      });
}

/// Streams one component's positions.
template <typename T, std::size_t kLines>
SIMDBEZIER_INLINE void stream_position(const RowPiece<T>& piece, const Component<T>& c,
                                       const LineTiles<T, kLines>& tiles, std::size_t nu, T* to) {
  using V = typename LineTiles<T, kLines>::Vector;
  V q[kLines][kOrder];
  tiles.for_each([&](const auto& tile, std::size_t k, std::size_t)
                     SIMDBEZIER_INLINE_LAMBDA { tile_polynomial(c, tile, q[k]); });
  stream_plane(
      piece, tiles, nu, to,
      [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
        tiles.for_each([&](const auto& tile, std::size_t, std::size_t x) SIMDBEZIER_INLINE_LAMBDA {
          tile.store_edge(to + place.at + x, tile.edge_rows(c, edge_of(kind)), kind, nullptr);
        });
      },
      [&](std::size_t k, const RowPoint<V>& at)
          SIMDBEZIER_INLINE_LAMBDA { return value_parts(q[k], at); });
}

/// Streams one component's positions and first derivatives, plane by plane. Sums that both
/// positions and dv need are formed twice, which is cheaper than three planes at once.
template <typename T, std::size_t kLines>
SIMDBEZIER_INLINE void stream_derivatives(const RowPiece<T>& piece, const Component<T>& c,
                                          const LineTiles<T, kLines>& tiles, std::size_t nu,
                                          const JetPlanes<T>& to) {
  using V = typename LineTiles<T, kLines>::Vector;
  JetColumns<V, false> columns[kLines];
  tiles.for_each([&](const auto& tile, std::size_t k, std::size_t)
                     SIMDBEZIER_INLINE_LAMBDA { columns[k].build(c, tile); });
  stream_plane(
      piece, tiles, nu, to.position,
      [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
        tiles.for_each([&](const auto& tile, std::size_t k, std::size_t x)
                           SIMDBEZIER_INLINE_LAMBDA {
                             const Jet<V> jet = columns[k].edge(c, tile, edge_of(kind));
                             tile.store_edge(to.position + place.at + x, jet.p, kind, nullptr);
                             tile.store_edge(to.du + place.at + x, jet.du, kind, nullptr);
                             tile.store_edge(to.dv + place.at + x, jet.dv, kind, nullptr);
                           });
      },
      [&](std::size_t k, const RowPoint<V>& at)
          SIMDBEZIER_INLINE_LAMBDA { return value_parts(columns[k].q, at); });
  const auto stored = [](RowKind, RowPlace) SIMDBEZIER_INLINE_LAMBDA {}; // edges, with positions
  stream_plane(piece, tiles, nu, to.du, stored,
               [&](std::size_t k, const RowPoint<V>& at)
                   SIMDBEZIER_INLINE_LAMBDA { return value_parts(columns[k].dq, at); });
  stream_plane(piece, tiles, nu, to.dv, stored,
               [&](std::size_t k, const RowPoint<V>& at)
                   SIMDBEZIER_INLINE_LAMBDA { return slope_parts(columns[k].q, at); });
}

/// Streams lines [first, first + kLines) of the rows of patches [patch, last_patch).
template <detail::OutputSet kOutputs, std::size_t kLines, typename T>
SIMDBEZIER_KERNEL void stream_lines(const GridTask<T>& shared_task, const RowPiece<T>& piece,
                                    std::size_t first, std::size_t patch, std::size_t last_patch) {
  // A copy, because stores through vector types might change anything that others can see.
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const std::size_t column = first * (64 / sizeof(T));
  const LineTiles<T, kLines> tiles(task.x, column, task.watertight);
  for (; patch < last_patch; ++patch) {
    if (task.prefetch && first == 0) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * task.nu + column;
    Component<T> component(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
      const auto plane = [&](Output output) SIMDBEZIER_INLINE_LAMBDA {
        return task.out[output_index(output)].component[c] + at;
      };
      if constexpr (kOutputs == detail::kPosition) {
        stream_position(piece, component, tiles, task.nu, plane(Output::position));
      } else {
        stream_derivatives(piece, component, tiles, task.nu,
                           {plane(Output::position), plane(Output::du), plane(Output::dv)});
      }
    }
  }
}

/// Streams all rows of patches [patch, end), which are whole lines, in groups of two or three
/// lines: one alone would leave out lines.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void stream_rows(const GridTask<T>& task, const RowPiece<T>& piece,
                                 std::size_t patch, std::size_t end) {
  const std::size_t lines = task.nu * sizeof(T) / 64;
  if (lines == 1) {
    return stream_lines<kOutputs, 1>(task, piece, 0, patch, end);
  }
  std::size_t first = 0;
  if (lines % 2 != 0) {
    stream_lines<kOutputs, 3>(task, piece, 0, patch, end);
    first = 3;
  }
  for (; first < lines; first += 2) {
    stream_lines<kOutputs, 2>(task, piece, first, patch, end);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
