// The rows of one piece on their way to one plane: stored where they belong, one by one, or, where
// a tile is as wide as the grid, in whole lines (simd/line_stream.hpp).
#pragma once

#include "kernels/fast/square_pieces.hpp"
#include "kernels/grid/column_tile.hpp"
#include "kernels/simd/line_stream.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// One output of a column behind a square's tile. Both edges share a register, as in every tile of
/// a column.
template <typename V, std::size_t kSide>
struct ColumnLanes {
  V edges;
  V middle[(kSide - 3) / kLanes<V> + 1];
};

/// Puts rows into one plane. Where Piece::kAcross holds, rows come in order, without mirror images,
/// and are as wide as the tile and the column behind it. Extra is how the column behind the tile is
/// read, where there is one. To says where rows go: to values, or on with a stream of lines.
template <typename Piece, typename Tile, typename Extra, typename To,
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

#if defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_AVX512)
/// A stream of lines that begins where values are to lie, and ends with its rows.
template <typename To>
struct RowStream;
template <typename T>
struct RowStream<T*> {
  using Type = LineStream<vec<T>>;
  static SIMDBEZIER_PART Type begin(T* to) { return Type(to); }
  static SIMDBEZIER_PART void end(const Type& stream, T* /*to*/) { stream.finish(); }
};
/// One that has begun, and goes on behind its rows.
template <typename V, bool kPastCaches>
struct RowStream<LineStream<V, kPastCaches>*> {
  using Type = LineStream<V, kPastCaches>;
  static SIMDBEZIER_PART Type begin(const Type* kept) { return *kept; }
  static SIMDBEZIER_PART void end(const Type& stream, Type* kept) { *kept = stream; }
};

template <typename Piece, typename Tile, typename Extra, typename To>
class PlaneRows<Piece, Tile, Extra, To, true> {
  using V = typename Tile::Vector;
  using T = ScalarOf<V>;
  using Register = vec<T>;
  using Stream = RowStream<To>;

public:
  SIMDBEZIER_PART PlaneRows(const Tile& tile, To to, std::size_t /*nu*/, Extra extra)
      : columns_(Piece::columns(tile.active)), to_(to), stream_(Stream::begin(to)), extra_(extra) {}

  SIMDBEZIER_PART void edge(V value, RowKind kind, RowPlace place) {
    put(value);
    if constexpr (Tile::kBuffered) {
      put_behind(extra_, kind, place.row);
    }
  }
  SIMDBEZIER_PART void rows(V value, RowPlace place, std::size_t /*count*/) {
    put(value);
    if constexpr (Tile::kBuffered) {
      put_behind(extra_, RowKind::interior, place.row);
    }
  }
  SIMDBEZIER_PART void mirrored(V /*value*/, RowPlace /*place*/) {}
  SIMDBEZIER_PART void finish() { Stream::end(stream_, to_); }

private:
  SIMDBEZIER_PART void put(V value) {
    if constexpr (Tile::kEveryLane) {
      stream_.put(value);
    } else {
      stream_.put_first(value, columns_);
    }
  }
  /// Puts the value behind a row, from memory or from registers.
  SIMDBEZIER_PART void put_behind(const T* column, RowKind /*kind*/, std::size_t row) {
    stream_.put_value(column + row);
  }
  template <std::size_t kSide>
  SIMDBEZIER_PART void put_behind(const ColumnLanes<Register, kSide>* column, RowKind kind,
                                  std::size_t row) {
    constexpr std::size_t kL = kLanes<Register>;
    if (is_edge(kind)) {
      stream_.put_lane(column->edges, kind == RowKind::edge_v1 ? kL / 2 : 0);
    } else {
      stream_.put_lane(column->middle[(row - 1) / kL], (row - 1) % kL);
    }
  }

  std::size_t columns_;
  To to_;
  typename Stream::Type stream_;
  Extra extra_;
};
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
