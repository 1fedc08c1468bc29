// Positions and derivatives of wide rows: the registers of a row side by side, and then the next
// row.
//
// Tile by tile, each line that two registers share would be written twice, rows apart, which takes
// twice as long as side by side; and every row of a tile would be one more stream for the
// prefetchers on the way to the second-level cache. Polynomials for which there are no registers
// left are operands in memory.
//
// Where stores across lines are cheap, floats with derivatives whose rows are no whole registers
// take their three planes one after the other (BandPlan says which): a store costs less where the
// next one goes to the same line or the one behind it, and each plane has fewer polynomials.
#pragma once

#include "kernels/fast/band_plan.hpp"
#include "kernels/simd/register_pair.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The columns of a band.
struct BandColumns {
  std::size_t first;
  std::size_t last;   ///< where its last tile begins
  std::size_t active; ///< columns of that tile

  [[nodiscard]] SIMDBEZIER_PART std::size_t end() const { return last + active; }
};

/// The order of a component's planes.
enum class PlaneOrder { together, plane_by_plane };

/// kCount tiles of a register each, the last one of type Last.
template <detail::OutputSet kOutputs, PlaneOrder kOrder, std::size_t kCount, typename Last>
class RowBand {
  using V = typename Last::Vector;
  using T = ScalarOf<V>;
  using Tile = ColumnTile<1, true, false, V>;
  static constexpr std::size_t kL = kLanes<V>;
  static constexpr bool kJets = kOutputs == detail::kPositionDerivatives;
  static constexpr bool kPlaneByPlane = kOrder == PlaneOrder::plane_by_plane;
  static_assert(kJets || !kPlaneByPlane);
  /// Where the planes of derivatives go together, registers of a line have more to do for stores
  /// than for products, and rows in order are stored faster than rows from both ends.
  static constexpr RowPairs kPairs =
      kJets && kLineWide<V> && !kPlaneByPlane ? RowPairs::never : Last::kPairs;
  /// Whether the last tile may begin within the one before it. All other places are constants:
  /// reading them from memory for each row made it a third slower.
  static constexpr bool kOverlaps = !kLineWide<V> && !Last::kBuffered;

public:
  SIMDBEZIER_PART RowBand(const T* x, const BandColumns& at, bool watertight)
      : RowBand(x, at, watertight, std::make_index_sequence<kCount - 1>()) {}

  /// Sweeps one component, whose planes are given from the band's first column on. extra is the
  /// column behind the last tile, as in sweep_position().
  SIMDBEZIER_PART void sweep(const RowPiece<T>& piece, const Component<T>& c, std::size_t nu,
                             const JetPlanes<T>& to, const ColumnPlanes<T>& extra) const {
    JetColumns<V, false> columns[kCount];
    for_tiles([&](std::size_t k, std::size_t /*column*/, const auto& tile)
                  SIMDBEZIER_INLINE_LAMBDA { build(columns[k], c, tile); });
    const auto put = [&](const auto& tile, const Jet<V>& jet, std::size_t at, std::size_t row)
                         SIMDBEZIER_INLINE_LAMBDA {
                           tile.store(to.position + at, nu, jet.p, 1, extra.plane(0) + row);
                           if constexpr (kJets) {
                             tile.store(to.du + at, nu, jet.du, 1, extra.plane(1) + row);
                             tile.store(to.dv + at, nu, jet.dv, 1, extra.plane(2) + row);
                           }
                         };
    const auto put_edge = [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
      for_tiles([&](std::size_t k, std::size_t column, const auto& tile) SIMDBEZIER_INLINE_LAMBDA {
        put(tile, edge(columns[k], c, tile, edge_of(kind)), place.at + column, place.row);
      });
    };
    if constexpr (kPlaneByPlane) {
      const auto stored = [](RowKind /*kind*/, RowPlace /*place*/) SIMDBEZIER_INLINE_LAMBDA {};
      sweep_plane_rows(piece, nu, to.position, extra.plane(0), put_edge,
                       [&](std::size_t k, const RowPoint<V>& at)
                           SIMDBEZIER_INLINE_LAMBDA { return value_parts(columns[k].q, at); });
      sweep_plane_rows(piece, nu, to.du, extra.plane(1), stored,
                       [&](std::size_t k, const RowPoint<V>& at)
                           SIMDBEZIER_INLINE_LAMBDA { return value_parts(columns[k].dq, at); });
      sweep_plane_rows(piece, nu, to.dv, extra.plane(2), stored,
                       [&](std::size_t k, const RowPoint<V>& at)
                           SIMDBEZIER_INLINE_LAMBDA { return slope_parts(columns[k].q, at); });
      return;
    }
    for_rows<RowOrder{1, kPairs, 1}>(
        piece, 0, nu, put_edge,
        [&](const T* y, RowPlace place, RowPlace mirror) SIMDBEZIER_INLINE_LAMBDA {
          const auto at = piece.template point<1, V>(y);
          for_tiles([&](std::size_t k, std::size_t column, const auto& tile)
                        SIMDBEZIER_INLINE_LAMBDA {
                          Jet<V> jet;
                          Jet<V> mirrored;
                          pair(columns[k], at, jet, mirrored);
                          put(tile, jet, place.at + column, place.row);
                          put(tile, mirrored, mirror.at + column, mirror.row);
                        });
        },
        [&](const T* y, RowPlace place, std::size_t /*rows*/) SIMDBEZIER_INLINE_LAMBDA {
          const auto at = piece.template point<1, V>(y);
          for_tiles([&](std::size_t k, std::size_t column, const auto& tile)
                        SIMDBEZIER_INLINE_LAMBDA {
                          put(tile, interior(columns[k], at), place.at + column, place.row);
                        });
        });
  }

private:
  /// Sweeps one plane; parts_of(k, at) returns the parts of the k-th tile's row. Each row is stored
  /// as a whole, and then its mirror image.
  template <typename Edge, typename PartsOf>
  SIMDBEZIER_INLINE void sweep_plane_rows(const RowPiece<T>& piece, std::size_t nu, T* plane,
                                          const T* extra, const Edge& edge,
                                          const PartsOf& parts_of) const {
    for_rows<RowOrder{1, kPairs, 1}>(
        piece, 0, nu, edge,
        [&](const T* y, RowPlace place, RowPlace mirror) SIMDBEZIER_INLINE_LAMBDA {
          const auto at = piece.template point<1, V>(y);
          V mirrored[kCount];
          for_tiles(
              [&](std::size_t k, std::size_t column, const auto& tile) SIMDBEZIER_INLINE_LAMBDA {
                const Parts<V> parts = parts_of(k, at);
                mirrored[k] = parts.difference();
                tile.store(plane + place.at + column, nu, parts.sum(), 1, extra + place.row);
              });
          for_tiles(
              [&](std::size_t k, std::size_t column, const auto& tile) SIMDBEZIER_INLINE_LAMBDA {
                tile.store(plane + mirror.at + column, nu, mirrored[k], 1, extra + mirror.row);
              });
        },
        [&](const T* y, RowPlace place, std::size_t /*rows*/) SIMDBEZIER_INLINE_LAMBDA {
          const auto at = piece.template point<1, V>(y);
          for_tiles([&](std::size_t k, std::size_t column,
                        const auto& tile) SIMDBEZIER_INLINE_LAMBDA {
            tile.store(plane + place.at + column, nu, parts_of(k, at).sum(), 1, extra + place.row);
          });
        });
  }

  // JetColumns without what positions do not need.
  template <typename SomeTile>
  static SIMDBEZIER_PART void build(JetColumns<V, false>& columns, const Component<T>& c,
                                    const SomeTile& tile) {
    if constexpr (kJets) {
      columns.build(c, tile);
    } else {
      column_polynomial(c, tile.column, columns.q);
    }
  }
  template <typename SomeTile>
  static SIMDBEZIER_PART Jet<V> edge(const JetColumns<V, false>& columns, const Component<T>& c,
                                     const SomeTile& tile, std::size_t edge) {
    if constexpr (kJets) {
      return columns.edge(c, tile, edge);
    } else {
      return {tile.edge_rows(c, edge), {}, {}};
    }
  }
  static SIMDBEZIER_PART void pair(const JetColumns<V, false>& columns, const RowPoint<V>& at,
                                   Jet<V>& jet, Jet<V>& mirrored) {
    if constexpr (kJets) {
      columns.pair(at, jet, mirrored);
    } else {
      const Parts<V> p = value_parts(columns.q, at);
      jet.p = p.sum();
      mirrored.p = p.difference();
    }
  }
  static SIMDBEZIER_PART Jet<V> interior(const JetColumns<V, false>& columns,
                                         const RowPoint<V>& at) {
    if constexpr (kJets) {
      return columns.interior(at);
    } else {
      return {row_value(columns.q, at), {}, {}};
    }
  }

  template <std::size_t... k>
  SIMDBEZIER_PART RowBand(const T* x, const BandColumns& at, bool watertight,
                          std::index_sequence<k...> /*tiles*/)
      : tile_{{x, at.first + k * kL, kL, watertight}...}, last_(x, at.last, at.active, watertight),
        last_column_(at.last - at.first) {}

  /// Calls visit(k, column, tile) for all tiles, with the k-th one's first column within the band.
  template <typename Visit>
  SIMDBEZIER_INLINE void for_tiles(const Visit& visit) const {
    repeat<kCount - 1>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { visit(k, k * kL, tile_[k]); });
    visit(kCount - 1, kOverlaps ? last_column_ : (kCount - 1) * kL, last_);
  }

  Tile tile_[kCount - 1];
  Last last_;
  std::size_t last_column_;
};

/// Sweeps a band of patches [patch, end), and the column behind it.
template <detail::OutputSet kOutputs, PlaneOrder kOrder, std::size_t kCount, typename Last,
          typename T>
SIMDBEZIER_KERNEL void sweep_band(const GridTask<T>& shared_task, const RowPiece<T>& shared_piece,
                                  BandColumns at, std::size_t patch, std::size_t end) {
  constexpr bool kJets = kOutputs == detail::kPositionDerivatives;
  // Copies, because stores through vector types might change anything that others can see.
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const RowPiece<T> piece = shared_piece;
  const RowBand<kOutputs, kOrder, kCount, Last> band(task.x, at, task.watertight);
  const SingleColumnTile<typename Last::Vector> column(task.x, Last::kBuffered ? at.end() : 0, 1,
                                                       task.watertight);
  ColumnBuffer<T, 3> buffer;
  const JetPlanes<T> there{buffer.first(0, piece), buffer.first(1, piece), buffer.first(2, piece)};
  const ColumnPlanes<T> extra = buffer.planes(piece);
  const bool prefetch = task.prefetch && at.first == 0;
  const std::size_t columns = at.end() - at.first + (Last::kBuffered ? 1 : 0);
  const std::size_t values = piece.rows() * columns * (kJets ? 3 : 1); // of a component
  for (; patch < end; ++patch) {
    if (prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t first = patch * task.patch_step + piece.first * task.nu + at.first;
    Component<T> component(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
      const auto plane = [&](Output output) SIMDBEZIER_INLINE_LAMBDA {
        return task.out[output_index(output)].component[c] + first;
      };
      JetPlanes<T> to{plane(Output::position), nullptr, nullptr};
      if constexpr (kJets) {
        to.du = plane(Output::du);
        to.dv = plane(Output::dv);
      }
      if constexpr (Last::kBuffered && kJets) {
        sweep_derivatives(piece, component, column, 1, there, extra);
      } else if constexpr (Last::kBuffered) {
        sweep_position(piece, component, column, 1, there.position, extra);
      }
      band.sweep(piece, component, task.nu, to, extra);
      drain_some(task.drain, values);
    }
  }
}

/// Sweeps columns of patches [patch, end) in bands, if that pays, and returns how many: what is
/// left is a fourth of a register at most, and nothing where planes go one by one.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART std::size_t sweep_bands(const GridTask<T>& task, const RowPiece<T>& piece,
                                        std::size_t patch, std::size_t end) {
  using V = vec<T>;
  using Plan = BandPlan<kOutputs, V>;
  constexpr std::size_t kL = kLanes<V>;
  const std::size_t nu = task.nu;
  Plan plan(task);
  if (!pays_in_bands<kOutputs>(task, piece, plan)) {
    return 0;
  }
  std::size_t first = 0;
  const auto sweep = [&]<typename Last>(std::size_t count, std::size_t last,
                                        std::size_t active) SIMDBEZIER_INLINE_LAMBDA {
    const BandColumns at{first, last, active};
    const auto sweep_count = [&]<std::size_t kCount>() SIMDBEZIER_INLINE_LAMBDA {
      if constexpr (Plan::kMayGoPlaneByPlane && kCount <= kMostPlaneByPlane) {
        if (plan.plane_by_plane) {
          return sweep_band<kOutputs, PlaneOrder::plane_by_plane, kCount, Last>(task, piece, at,
                                                                                patch, end);
        }
      }
      sweep_band<kOutputs, PlaneOrder::together, kCount, Last>(task, piece, at, patch, end);
    };
    with_one_of<2, 3, 4>(count, sweep_count);
    if constexpr (!kLineWide<V>) {
      with_one_of<5, 6, 7, 8>(count, sweep_count);
    }
    first += count * kL;
    plan.registers -= count;
  };
  while (plan.registers > kMostInBand<V>) {
    const std::size_t count = even_share(plan.registers, kMostInBand<V>);
    sweep.template operator()<ColumnTile<1, true, false, V>>(count, first + (count - 1) * kL, kL);
  }
  if (plan.rest == 1) {
    sweep.template operator()<ColumnTile<1, true, true, V>>(plan.registers, nu - 1 - kL, kL);
    return nu;
  }
  if (kLineWide<V> && plan.partial) {
    sweep.template operator()<ColumnTile<1, false, false, V>>(plan.registers, nu - plan.rest,
                                                              plan.rest);
    return nu;
  }
  const std::size_t swept = plan.partial ? nu : nu - plan.rest;
  sweep.template operator()<ColumnTile<1, true, false, V>>(plan.registers, swept - kL, kL);
  return swept;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
