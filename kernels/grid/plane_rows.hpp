// The rows of one piece on their way to one plane: stored where they belong, one by one, or, where
// a tile is as wide as the grid, in whole lines (simd/line_stream.hpp).
#pragma once

#include "kernels/grid/column_tile.hpp"
#include "kernels/grid/square_pieces.hpp"
#include "kernels/simd/line_stream.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Puts rows into one plane. Where Piece::kAcross holds, rows come in order, without mirror images,
/// and are as wide as the tile and the column behind it. Extra is how the column behind the tile is
/// read, where there is one.
template <typename Piece, typename Tile, typename Extra,
          bool kStream = (Piece::kAcross) && (Tile::kTileRows == 1)>
class PlaneRows {
  using V = typename Tile::Vector;
  using T = ScalarOf<V>;

public:
  SIMDBEZIER_PART PlaneRows(const Tile& tile, T* to, std::size_t nu, Extra extra)
      : tile_(tile), to_(to), nu_(nu), extra_(extra) {}

  SIMDBEZIER_PART void edge(V value, RowKind kind, RowPlace place) {
    tile_.store_edge(to_ + place.at, value, kind, extra_ + place.row);
  }
  SIMDBEZIER_PART void rows(V value, RowPlace place, std::size_t count) {
    tile_.store(to_ + place.at, nu_, value, count, extra_ + place.row);
  }
  SIMDBEZIER_PART void mirrored(V value, RowPlace place) {
    tile_.store_mirrored(to_ + place.at, nu_, value, extra_ + place.row);
  }
  SIMDBEZIER_PART void finish() {}

#if defined(SIMDBEZIER_KERNELS_AVX512)
  /// Stores the first two rows and the last two of a square. edges holds its first row and its last
  /// one, beside the rows next to these.
  SIMDBEZIER_PART void borders(V edges, V beside) {
    store_vector(to_, first_rows(edges, beside));
    store_vector(to_ + (Piece::rows() - 2) * nu_, second_rows(beside, edges));
  }
#endif

private:
  const Tile& tile_;
  T* to_;
  std::size_t nu_;
  Extra extra_;
};

/// Whether a square whose lines hold two rows is stored a line at a time: first the borders, each
/// edge with the row beside it, then the rows between. If edges were stored by themselves, as in
/// other tiles, all registers of the rows between them would lie across lines.
template <typename Piece, typename Tile>
constexpr bool kSweepsLines = kStreamsLines && (Piece::kAcross) && (Tile::kTileRows == 2);

#if defined(SIMDBEZIER_KERNELS_AVX512)
template <typename Piece, typename Tile, typename Extra>
class PlaneRows<Piece, Tile, Extra, true> {
  using V = typename Tile::Vector;
  using T = ScalarOf<V>;
  using Register = vec<T>;

public:
  SIMDBEZIER_PART PlaneRows(const Tile& tile, T* to, std::size_t /*nu*/, Extra extra)
      : columns_(Piece::columns(tile.active)), stream_(to), extra_(extra) {}

  SIMDBEZIER_PART void edge(V value, RowKind kind, RowPlace /*place*/) {
    put(value);
    if constexpr (Tile::kBuffered) {
      stream_.put_lane(extra_->edges, kind == RowKind::edge_v1 ? kLanes<Register> / 2 : 0);
    }
  }
  SIMDBEZIER_PART void rows(V value, RowPlace place, std::size_t /*count*/) {
    put(value);
    if constexpr (Tile::kBuffered) {
      const std::size_t at = place.row - 1;
      stream_.put_lane(extra_->middle[at / kLanes<Register>], at % kLanes<Register>);
    }
  }
  SIMDBEZIER_PART void mirrored(V /*value*/, RowPlace /*place*/) {}
  SIMDBEZIER_PART void finish() { stream_.finish(); }

private:
  SIMDBEZIER_PART void put(V value) {
    if constexpr (Tile::kEveryLane) {
      stream_.put(value);
    } else {
      stream_.put_first(value, columns_);
    }
  }

  std::size_t columns_;
  LineStream<Register> stream_;
  Extra extra_;
};
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
