// Positions and derivatives of wide rows: the registers of a row side by side, and then the next
// row.
//
// Tile by tile, each line that two registers share would be written twice, rows apart, which takes
// twice as long as side by side; and every row of a tile would be one more stream for the
// prefetchers on the way to the second-level cache. Polynomials for which there are no registers
// left are operands in memory. If columns are no whole registers, the last one begins within the
// one before it. A single column behind whole registers is swept down the column instead, into a
// buffer, from which each row takes its own.
#pragma once

#include "kernels/fast/band_plan.hpp"
#include "kernels/simd/register_pair.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// kCount tiles of a V each; kSingle: and a column in a buffer behind them. kStreams: they are
/// lines that go past the caches, plane by plane, which is cheaper than three planes at once,
/// although positions and dv form some sums twice.
template <detail::OutputSet kOutputs, std::size_t kCount, bool kSingle, typename V, bool kStreams>
class RowBand {
  using T = ScalarOf<V>;
  using Tile = ColumnTile<1, true, false, V, kStreams>;
  using Last = ColumnTile<1, true, kSingle, V, kStreams>;
  static constexpr std::size_t kL = kLanes<V>;
  static constexpr bool kJets = kOutputs == detail::kPositionDerivatives;
  static constexpr std::size_t kPlanes = kJets ? 3 : 1;
  static constexpr std::size_t kTogether = kStreams ? 1 : kPlanes;
  static constexpr std::size_t kOthers = kCount > 1 ? kCount - 1 : 1; ///< a single one stands twice
  /// Registers of a line have more to do for stores than for products: in the caches, rows in order
  /// are stored faster than rows from both ends.
  static constexpr RowPairs kPairs = kLineWide<V> && !kStreams ? RowPairs::never : RowPairs::always;

public:
  /// The band is columns [first, end).
  SIMDBEZIER_PART RowBand(const GridTask<T>& task, std::size_t first, std::size_t end)
      : RowBand(task, first, end, std::make_index_sequence<kOthers>()) {}

  /// Sweeps one component, whose planes are given from the band's first column on.
  SIMDBEZIER_PART void sweep(const RowPiece<T>& piece, const Component<T>& c, std::size_t nu,
                             const JetPlanes<T>& to, const ColumnPlanes<T>& extra) const {
    JetColumns<V, false> columns[kCount];
    for_tiles([&](std::size_t k, std::size_t /*column*/, const auto& tile)
                  SIMDBEZIER_INLINE_LAMBDA {
                    if constexpr (kJets) {
                      columns[k].build(c, tile);
                    } else {
                      column_polynomial(c, tile.column, columns[k].q);
                    }
                  });
    T* const planes[] = {to.position, to.du, to.dv};
    const auto store = [&](const auto& tile, std::size_t plane, std::size_t column, RowPlace place,
                           V value) SIMDBEZIER_INLINE_LAMBDA {
      tile.store(planes[plane] + place.at + column, nu, value, 1, extra.plane(plane) + place.row);
    };
    const auto parts_of = [&](std::size_t k, std::size_t plane,
                              const RowPoint<V>& at) SIMDBEZIER_INLINE_LAMBDA {
      if constexpr (kJets) {
        if (plane > 0) {
          return plane == 1 ? value_parts(columns[k].dq, at) : slope_parts(columns[k].q, at);
        }
      }
      return value_parts(columns[k].q, at);
    };
    const auto put_edge = [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
      for_tiles([&](std::size_t k, std::size_t column, const auto& tile) SIMDBEZIER_INLINE_LAMBDA {
        if constexpr (kJets) {
          const Jet<V> jet = columns[k].edge(c, tile, edge_of(kind));
          store(tile, 0, column, place, jet.p);
          store(tile, 1, column, place, jet.du);
          store(tile, 2, column, place, jet.dv);
        } else {
          store(tile, 0, column, place, tile.edge_rows(c, edge_of(kind)));
        }
      });
    };
    repeat<kPlanes / kTogether>([&](std::size_t first) SIMDBEZIER_INLINE_LAMBDA {
      const auto put = [&](const T* y, RowPlace place,
                           const auto&... mirror) SIMDBEZIER_INLINE_LAMBDA {
        const auto at = piece.template point<1, V>(y);
        for_tiles(
            [&](std::size_t k, std::size_t column, const auto& tile) SIMDBEZIER_INLINE_LAMBDA {
              Parts<V> parts[kTogether];
              repeat<kTogether>([&](std::size_t p) SIMDBEZIER_INLINE_LAMBDA {
                parts[p] = parts_of(k, first + p, at);
                store(tile, first + p, column, place, parts[p].sum());
              });
              repeat<kTogether>([&](std::size_t p) SIMDBEZIER_INLINE_LAMBDA {
                (tile.store_mirrored(planes[first + p] + mirror.at + column, nu,
                                     parts[p].difference(), extra.plane(first + p) + mirror.row),
                 ...);
              });
            });
      };
      for_rows<RowOrder{1, kPairs, 1}>(
          piece, 0, nu,
          [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
            if (first == 0) { // those of all planes
              put_edge(kind, place);
            }
          },
          put,
          [&](const T* y, RowPlace place, std::size_t /*rows*/)
              SIMDBEZIER_INLINE_LAMBDA { put(y, place); });
    });
  }

private:
  template <std::size_t... k>
  SIMDBEZIER_PART RowBand(const GridTask<T>& task, std::size_t first, std::size_t end,
                          std::index_sequence<k...> /*tiles*/)
      : tile_{{task.x, first + k * kL, kL, task.watertight}...},
        last_(task.x, end - kL, kL, task.watertight), last_column_(end - kL - first) {}

  /// Calls visit(k, column, tile) for all tiles, with the k-th one's first column within the band.
  /// All but the last column are constants: reading them from memory for each row made it a third
  /// slower.
  template <typename Visit>
  SIMDBEZIER_INLINE void for_tiles(const Visit& visit) const {
    repeat<kCount - 1>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { visit(k, k * kL, tile_[k]); });
    visit(kCount - 1, kSingle ? (kCount - 1) * kL : last_column_, last_);
  }

  Tile tile_[kOthers];
  Last last_;
  std::size_t last_column_;
};

/// Sweeps columns [first, end) of patches [patch, last_patch) in a band, and the column behind it
/// if kSingle.
template <detail::OutputSet kOutputs, std::size_t kCount, bool kSingle, bool kStreams = false,
          typename T>
SIMDBEZIER_KERNEL void sweep_band(const GridTask<T>& shared_task, const RowPiece<T>& shared_piece,
                                  std::size_t first, std::size_t end, std::size_t patch,
                                  std::size_t last_patch) {
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const RowPiece<T> piece = shared_piece;
  using V = std::conditional_t<kStreams, RegisterPair<vec<T>>, vec<T>>;
  const RowBand<kOutputs, kCount, kSingle, V, kStreams> band(task, first, end);
  const SingleColumnTile<vec<T>> column(task.x, kSingle ? end : 0, 1, task.watertight);
  ColumnBuffer<T, 3> buffer;
  const JetPlanes<T> there{buffer.first(0, piece), buffer.first(1, piece), buffer.first(2, piece)};
  const ColumnPlanes<T> extra = buffer.planes(piece);
  const bool prefetch = task.prefetch && first == 0;
  for (; patch < last_patch; ++patch) {
    if (prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * task.nu + first;
    Component<T> component(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
      const auto plane = [&](Output output) SIMDBEZIER_INLINE_LAMBDA {
        return task.out[output_index(output)].component[c] + at;
      };
      JetPlanes<T> to{plane(Output::position), nullptr, nullptr};
      if constexpr (kOutputs == detail::kPositionDerivatives) {
        to.du = plane(Output::du);
        to.dv = plane(Output::dv);
      }
      if constexpr (kSingle && kOutputs == detail::kPositionDerivatives) {
        sweep_derivatives(piece, component, column, 1, there, extra);
      } else if constexpr (kSingle) {
        sweep_position(piece, component, column, 1, there.position, extra);
      }
      band.sweep(piece, component, task.nu, to, extra);
    }
  }
}

/// Sweeps all columns of patches [patch, last_patch), at least two registers, in bands.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void sweep_bands(const GridTask<T>& task, const RowPiece<T>& piece,
                                 std::size_t patch, std::size_t last_patch) {
  constexpr std::size_t kL = kLanes<vec<T>>;
  const bool single = task.nu > 2 * kL && task.nu % kL == 1; // behind whole registers
  const std::size_t columns = single ? task.nu - 1 : task.nu;
  std::size_t left = band_registers<vec<T>>(columns);
  for (std::size_t first = 0; left > 0;) {
    const std::size_t count = even_share(left, kMostInBand<vec<T>>);
    left -= count;
    const std::size_t end = left > 0 ? first + count * kL : columns;
    const auto sweep_count = [&]<std::size_t kCount>() SIMDBEZIER_INLINE_LAMBDA {
      if (single && left == 0) {
        return sweep_band<kOutputs, kCount, true>(task, piece, first, end, patch, last_patch);
      }
      sweep_band<kOutputs, kCount, false>(task, piece, first, end, patch, last_patch);
    };
    with_one_of<2, 3, 4>(count, sweep_count);
    if constexpr (!kLineWide<vec<T>>) {
      with_one_of<5, 6, 7, 8>(count, sweep_count);
    }
    first = end;
  }
}

/// Whether rows of whole cache lines go straight to memory in bands: where two registers are a
/// line. Streaming stores overlap with arithmetic; copies from staging take their own time. But a
/// line has to be stored at once, and memory takes lines at a third to a half of its rate where
/// they leave others out, or where several planes come by turns that lie at the same place within a
/// page. So bands are swept plane by plane. Registers of a line stream tile by tile. Normals take
/// so much arithmetic, and six planes at once, that staging is faster.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kStreamsRows = kLineWide<RegisterPair<vec<T>>> &&
                              (kOutputs == detail::kPosition ||
                               kOutputs == detail::kPositionDerivatives);

/// Streams all rows of patches [patch, end), which are whole lines, in groups of two or three
/// lines: one alone would leave out lines.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void stream_rows(const GridTask<T>& task, const RowPiece<T>& piece,
                                 std::size_t patch, std::size_t end) {
  constexpr std::size_t kLine = 64 / sizeof(T);
  if (task.nu == kLine) {
    return sweep_band<kOutputs, 1, false, true>(task, piece, 0, kLine, patch, end);
  }
  std::size_t first = 0;
  if (task.nu / kLine % 2 != 0) {
    sweep_band<kOutputs, 3, false, true>(task, piece, 0, 3 * kLine, patch, end);
    first = 3 * kLine;
  }
  for (; first < task.nu; first += 2 * kLine) {
    sweep_band<kOutputs, 2, false, true>(task, piece, first, first + 2 * kLine, patch, end);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
