// Positions and derivatives of wide rows: the registers of a row side by side, and then the next
// row.
//
// Tile by tile, each line that two registers share would be written twice, rows apart, which takes
// twice as long as side by side; and every row of a tile would be one more stream for the
// prefetchers on the way to the second-level cache. Polynomials for which there are no registers
// left are operands in memory. If columns are no whole registers, the last one begins within the
// one before it.
#pragma once

#include "kernels/fast/band_plan.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// kCount tiles of a register each.
template <detail::OutputSet kOutputs, std::size_t kCount, typename V>
class RowBand {
  using T = ScalarOf<V>;
  using Tile = ColumnTile<1, true, false, V>;
  static constexpr std::size_t kL = kLanes<V>;
  static constexpr bool kJets = kOutputs == detail::kPositionDerivatives;
  /// Registers of a line have more to do for stores than for products, and rows in order are stored
  /// faster than rows from both ends.
  static constexpr RowPairs kPairs = kLineWide<V> ? RowPairs::never : RowPairs::always;

public:
  /// The band is columns [first, end).
  SIMDBEZIER_PART RowBand(const GridTask<T>& task, std::size_t first, std::size_t end)
      : RowBand(task, first, end, std::make_index_sequence<kCount>()) {}

  /// Sweeps one component, whose planes are given from the band's first column on. A store costs
  /// less if the next one goes to the same line or the one behind it: a row goes plane by plane.
  SIMDBEZIER_PART void sweep(const RowPiece<T>& piece, const Component<T>& c, std::size_t nu,
                             const JetPlanes<T>& to) const {
    JetColumns<V, false> columns[kCount];
    for_tiles([&](std::size_t k, std::size_t /*column*/) SIMDBEZIER_INLINE_LAMBDA {
      if constexpr (kJets) {
        columns[k].build(c, tile_[k]);
      } else {
        column_polynomial(c, tile_[k].column, columns[k].q);
      }
    });
    // Calls put(plane, parts_of(columns)) for each plane and tile.
    const auto for_parts = [&](const RowPoint<V>& at, const auto& put) SIMDBEZIER_INLINE_LAMBDA {
      for_tiles([&](std::size_t k, std::size_t column) SIMDBEZIER_INLINE_LAMBDA {
        put(to.position + column, value_parts(columns[k].q, at));
      });
      if constexpr (kJets) {
        for_tiles([&](std::size_t k, std::size_t column) SIMDBEZIER_INLINE_LAMBDA {
          put(to.du + column, value_parts(columns[k].dq, at));
        });
        for_tiles([&](std::size_t k, std::size_t column) SIMDBEZIER_INLINE_LAMBDA {
          put(to.dv + column, slope_parts(columns[k].q, at));
        });
      }
    };
    for_rows<RowOrder{1, kPairs, 1}>(
        piece, 0, nu,
        [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
          for_tiles([&](std::size_t k, std::size_t column) SIMDBEZIER_INLINE_LAMBDA {
            const std::size_t at = place.at + column;
            if constexpr (kJets) {
              const Jet<V> jet = columns[k].edge(c, tile_[k], edge_of(kind));
              store_vector(to.position + at, jet.p);
              store_vector(to.du + at, jet.du);
              store_vector(to.dv + at, jet.dv);
            } else {
              store_vector(to.position + at, tile_[k].edge_rows(c, edge_of(kind)));
            }
          });
        },
        [&](const T* y, RowPlace place, RowPlace mirror) SIMDBEZIER_INLINE_LAMBDA {
          for_parts(piece.template point<1, V>(y),
                    [&](T* plane, const Parts<V>& parts) SIMDBEZIER_INLINE_LAMBDA {
                      store_vector(plane + place.at, parts.sum());
                      store_vector(plane + mirror.at, parts.difference());
                    });
        },
        [&](const T* y, RowPlace place, std::size_t /*rows*/) SIMDBEZIER_INLINE_LAMBDA {
          for_parts(piece.template point<1, V>(y),
                    [&](T* plane, const Parts<V>& parts)
                        SIMDBEZIER_INLINE_LAMBDA { store_vector(plane + place.at, parts.sum()); });
        });
  }

private:
  template <std::size_t... k>
  SIMDBEZIER_PART RowBand(const GridTask<T>& task, std::size_t first, std::size_t end,
                          std::index_sequence<k...> /*tiles*/)
      : tile_{{task.x, k + 1 < kCount ? first + k * kL : end - kL, kL, task.watertight}...},
        last_column_(end - kL - first) {}

  /// Calls visit(k, column) for all tiles, with the k-th one's first column within the band. All
  /// but the last one are constants: reading them from memory for each row made it a third slower.
  template <typename Visit>
  SIMDBEZIER_INLINE void for_tiles(const Visit& visit) const {
    repeat<kCount - 1>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { visit(k, k * kL); });
    visit(kCount - 1, last_column_);
  }

  Tile tile_[kCount];
  std::size_t last_column_;
};

/// Sweeps columns [first, end) of patches [patch, last_patch) in a band.
template <detail::OutputSet kOutputs, std::size_t kCount, typename T>
SIMDBEZIER_KERNEL void sweep_band(const GridTask<T>& shared_task, const RowPiece<T>& shared_piece,
                                  std::size_t first, std::size_t end, std::size_t patch,
                                  std::size_t last_patch) {
  // Copies, because stores through vector types might change anything that others can see.
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const RowPiece<T> piece = shared_piece;
  const RowBand<kOutputs, kCount, vec<T>> band(task, first, end);
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
      band.sweep(piece, component, task.nu, to);
    }
  }
}

/// Sweeps all columns of patches [patch, last_patch), at least two registers, in bands.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void sweep_bands(const GridTask<T>& task, const RowPiece<T>& piece,
                                 std::size_t patch, std::size_t last_patch) {
  constexpr std::size_t kL = kLanes<vec<T>>;
  std::size_t left = band_registers<vec<T>>(task.nu);
  for (std::size_t first = 0; left > 0;) {
    const std::size_t count = even_share(left, kMostInBand);
    left -= count;
    const std::size_t end = left > 0 ? first + count * kL : task.nu;
    const auto sweep_count = [&]<std::size_t kCount>() SIMDBEZIER_INLINE_LAMBDA {
      sweep_band<kOutputs, kCount>(task, piece, first, end, patch, last_patch);
    };
    with_one_of<2, 3, 4, 5, 6, 7, 8, 9>(count, sweep_count);
    first = end;
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
