// The table of strategies: in which ways grids are evaluated, and when. A strategy is a struct with
//
//   kName     its name (src/tables/grid_strategy.hpp)
//   kExists   whether the instruction set has it for these outputs
//   applies   whether a task, or a piece of its rows, is better evaluated so than by those below it
//   sweep     evaluates patches [patch, end) of a piece; or run, a whole task
//
// TaskStrategies, StreamedOrder and PieceStrategies are asked in this order. The general path,
// TileByTile, takes whatever no other one does.
#pragma once

#include "kernels/fast/component_sweeps.hpp"
#include "kernels/fast/normal_bands.hpp"
#include "kernels/fast/record_rows.hpp"
#include "kernels/fast/row_bands.hpp"
#include "kernels/fast/small_jets_across.hpp"
#include "kernels/fast/square_sweeps.hpp"
#include "kernels/fast/squares_of_four.hpp"
#include "kernels/fast/streamed_lines.hpp"
#include "kernels/fast/streamed_normals.hpp"
#include "kernels/fast/streamed_planes.hpp"
#include "kernels/grid/tile_sweeps.hpp"
#include "src/tables/grid_strategy.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridStrategy;

inline constexpr bool kWideKernels = sizeof(vec<float>) >= 32;

/// So many bytes of rarer outputs stay in the first-level cache while one tile follows the other;
/// for others, GridTask has the number.
constexpr std::size_t kCachedBytes = 12288;

/// Returns what a kernel writes of one patch.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART std::size_t bytes_of(const GridTask<T>& task, const RowPiece<T>& piece) {
  return piece.rows() * task.nu * written_planes(kOutputs) * sizeof(T);
}

/// Whether small grids have kernels in which a register is four groups of four lanes.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kInFourGroups = kUsual<kOutputs>&& kLanes<vec<T>> == 16;

/// 4 x 4 samples, all components in one register.
template <detail::OutputSet kOutputs, typename T>
struct SquaresOfFour {
  static constexpr GridStrategy kName = GridStrategy::squares_of_four;
  static constexpr bool kExists = kInFourGroups<kOutputs, T>;
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task) {
    return task.record <= 1 && is_small_grid(task) && is_square_of_four(task);
  }
  static SIMDBEZIER_PART void run(const GridTask<T>& task) {
    sweep_squares_of_four<kOutputs>(task);
  }
};

/// Small grids with patches as lanes.
template <detail::OutputSet kOutputs, typename T>
struct SmallAcross {
  static constexpr GridStrategy kName = GridStrategy::small_across;
  static constexpr bool kExists = kWideKernels && kUsual<kOutputs>;
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task) {
    return is_closed_grid(task) && pays_across<kOutputs>(task);
  }
  static SIMDBEZIER_PART void run(const GridTask<T>& task) {
    sweep_small_grid_across<kOutputs>(task);
  }
};

/// Positions of small grids in groups of four lanes.
template <detail::OutputSet kOutputs, typename T>
struct SmallGroups {
  static constexpr GridStrategy kName = GridStrategy::small_groups;
  static constexpr bool kExists = kOutputs == detail::kPosition && kInFourGroups<kOutputs, T>;
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task) { return is_small_grid(task); }
  static SIMDBEZIER_PART void run(const GridTask<T>& task) { small_grid_positions(task); }
};

/// Rows past the caches in order, each plane as one stream: if they are no whole registers, or lie
/// across lines; or if the lines of a tile are a fourth of a row or less, and rows a multiple of
/// four times as long, since memory takes every fourth line at 0.6 and every eighth at 0.3 of its
/// rate. Origins come with whole lines only. Its sweep takes all patches of the task at once.
template <detail::OutputSet kOutputs, typename T>
struct StreamedOrder {
  static constexpr GridStrategy kName = GridStrategy::streamed_order;
  static constexpr bool kNormals = kStreamsNormals<kOutputs, T>;
  static constexpr bool kExists =
      kWideKernels &&
      (kOutputs == detail::kPosition || kOutputs == detail::kPositionDerivatives || kNormals);
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task) {
    using V = vec<T>;
    constexpr std::size_t kTileLines = kLineWide<V> && !kStreamsPairs<kOutputs, T> ? 1 : 2;
    if (!task.streaming || task.record > 1) {
      return false;
    }
    if (task.nu % kLanes<V> != 0 || !planes_begin_lines(task)) {
      return true;
    }
    return task.origins == nullptr && task.nu <= detail::kMostStreamedRegisters * kLanes<V> &&
           task.nu * sizeof(T) % (4 * kTileLines * 64) == 0;
  }
  static SIMDBEZIER_PART void sweep(const GridTask<T>& task, const RowPiece<T>& piece) {
    if constexpr (kNormals) {
      stream_normals(task, piece);
    } else if (task.nu % kLanes<vec<T>> == 0 || !stream_tiles<kOutputs>(task, piece)) {
      stream_planes<kOutputs>(task, piece);
    }
  }
};

/// Triples and vertices, put together in registers.
template <detail::OutputSet kOutputs, typename T>
struct Records {
  static constexpr GridStrategy kName = GridStrategy::records;
  static constexpr bool kExists = kUsual<kOutputs> && kPutsRecords<vec<T>>;
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task, const RowPiece<T>& /*piece*/) {
    return task.record > 1;
  }
  static SIMDBEZIER_PART void sweep(const GridTask<T>& task, const RowPiece<T>& piece,
                                    std::size_t patch, std::size_t end) {
    sweep_record_tiles<kOutputs>(task, piece, patch, end);
  }
};

/// Whole lines past the caches, if a line is two registers.
template <detail::OutputSet kOutputs, typename T>
struct StreamedRows {
  static constexpr GridStrategy kName = GridStrategy::streamed_rows;
  static constexpr bool kExists = kStreamsRows<kOutputs, T>;
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task, const RowPiece<T>& /*piece*/) {
    return task.streaming;
  }
  static SIMDBEZIER_PART void sweep(const GridTask<T>& task, const RowPiece<T>& piece,
                                    std::size_t patch, std::size_t end) {
    stream_rows<kOutputs>(task, piece, patch, end);
  }
};

/// Whether a task is one that strategies for planes in the caches may take.
template <typename T>
SIMDBEZIER_PART bool stays_in_planes(const GridTask<T>& task) {
  return task.origins == nullptr && !task.streaming;
}

/// Squares whose size the compiler knows, with registers of 32 bytes and more.
template <detail::OutputSet kOutputs, typename T>
struct Squares {
  static constexpr GridStrategy kName = GridStrategy::squares;
  static constexpr bool kExists = kUsual<kOutputs> && kLanes<vec<T>> * sizeof(T) >= 32;
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task, const RowPiece<T>& piece) {
    return stays_in_planes(task) && task.watertight &&
           with_square_of<kOutputs>(SquareSides(), task, piece,
                                    []<typename Square>() SIMDBEZIER_INLINE_LAMBDA {});
  }
  static SIMDBEZIER_PART void sweep(const GridTask<T>& task, const RowPiece<T>& piece,
                                    std::size_t patch, std::size_t end) {
    with_square_of<kOutputs>(SquareSides(), task, piece,
                             [&]<typename Square>() SIMDBEZIER_INLINE_LAMBDA {
                               sweep_square<kOutputs>(task, Square(piece.middle.y), patch, end);
                             });
  }
};

/// All registers of a row side by side.
template <detail::OutputSet kOutputs, typename T>
struct Bands {
  static constexpr GridStrategy kName = GridStrategy::bands;
  static constexpr bool kNormals = kSweepsNormalBands<kOutputs, T>;
  static constexpr bool kExists = kSweepsBands<kOutputs, T> || kNormals;
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task, const RowPiece<T>& piece) {
    if (!stays_in_planes(task)) {
      return false;
    }
    if constexpr (kNormals) {
      return pays_in_normal_bands(task, piece);
    } else {
      return pays_in_bands<kOutputs>(task, piece);
    }
  }
  static SIMDBEZIER_PART void sweep(const GridTask<T>& task, const RowPiece<T>& piece,
                                    std::size_t patch, std::size_t end) {
    if constexpr (kNormals) {
      sweep_normal_bands(task, piece, patch, end);
    } else {
      sweep_bands<kOutputs>(task, piece, patch, end);
    }
  }
};

/// Whether rows from edge to edge have sweeps of their own.
template <detail::OutputSet kOutputs>
constexpr bool kKnowsRows = kUsual<kOutputs>&& kSimd128;

/// All tiles of one component of large patches before those of the next one. Plain stores get to
/// memory faster if lines of all planes come at once.
template <detail::OutputSet kOutputs, typename T>
struct Components {
  static constexpr GridStrategy kName = GridStrategy::components;
  static constexpr bool kExists = kSweepsByComponents<kOutputs, vec<T>>;
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task, const RowPiece<T>& piece) {
    constexpr std::size_t kColumns = ComponentTile<kOutputs, vec<T>>::kColumns;
    // Positions are too little arithmetic for tiles that overlap.
    const bool fits = kOutputs != detail::kPosition || task.nu % kColumns == 0;
    return (!kUsual<kOutputs> || stays_in_planes(task)) && !task.plain_to_memory && fits &&
           task.nu >= 2 * kColumns && bytes_of<kOutputs>(task, piece) >= kCachedBytes;
  }
  static SIMDBEZIER_PART void sweep(const GridTask<T>& task, const RowPiece<T>& piece,
                                    std::size_t patch, std::size_t end) {
    if constexpr (kKnowsRows<kOutputs>) {
      if (task.watertight && piece.is_closed()) {
        return sweep_by_components<kOutputs, Known::closed>(task, piece, patch, end);
      }
    }
    sweep_by_components<kOutputs, Known::no_origins>(task, piece, patch, end);
  }
};

/// Rows of one tile, put together to whole lines.
template <detail::OutputSet kOutputs, typename T>
struct AcrossLines {
  static constexpr GridStrategy kName = GridStrategy::across_lines;
  static constexpr bool kExists =
      kStreamsLines && kLineWide<vec<T>> &&
      (kOutputs == detail::kPosition || kOutputs == detail::kPositionDerivatives);
  static SIMDBEZIER_PART bool applies(const GridTask<T>& task, const RowPiece<T>& /*piece*/) {
    return stays_in_planes(task) && with_tile_across_lines<kOutputs>(
                                        task, []<typename SomeTile>() SIMDBEZIER_INLINE_LAMBDA {});
  }
  static SIMDBEZIER_PART void sweep(const GridTask<T>& task, const RowPiece<T>& piece,
                                    std::size_t patch, std::size_t end) {
    with_tile_across_lines<kOutputs>(task, [&]<typename SomeTile>() SIMDBEZIER_INLINE_LAMBDA {
      sweep_tile<kOutputs, Known::watertight, SomeTile>(task, AcrossPiece<T>(piece), 0, task.nu,
                                                        patch, end);
    });
  }
};

/// One or two registers of columns after the other.
template <detail::OutputSet kOutputs, typename T>
struct TileByTile {
  static constexpr GridStrategy kName = GridStrategy::tiles;
  static constexpr bool kExists = true;
  static SIMDBEZIER_PART bool applies(const GridTask<T>& /*task*/, const RowPiece<T>& /*piece*/) {
    return true;
  }
  static SIMDBEZIER_PART void sweep(const GridTask<T>& task, const RowPiece<T>& piece,
                                    std::size_t patch, std::size_t end) {
    if constexpr (kKnowsRows<kOutputs>) {
      if (stays_in_planes(task) && task.watertight && piece.is_closed()) {
        return sweep_tiles<kOutputs, Known::closed>(task, piece, patch, end);
      }
    }
    if constexpr (kUsual<kOutputs>) {
      if (stays_in_planes(task)) {
        return with_known_edges(task, [&]<Known kKnown>() SIMDBEZIER_INLINE_LAMBDA {
          sweep_tiles<kOutputs, kKnown>(task, piece, patch, end);
        });
      }
    }
    sweep_registers<kOutputs>(task, piece, patch, end);
  }
};

/// Some strategies, in the order in which they are asked.
template <typename... Strategies>
struct StrategyList {
  /// Calls visit.operator()<Strategy>() with the first one that is allowed, as tiles always are,
  /// and applies to (task, …). Returns whether there is one.
  template <typename T, typename Visit, typename... Piece>
  static SIMDBEZIER_INLINE bool with_first(GridTask<T>& task, const Visit& visit,
                                           const Piece&... piece) {
    const auto takes = [&]<typename Strategy>() SIMDBEZIER_INLINE_LAMBDA {
      if constexpr (Strategy::kExists) {
        constexpr GridStrategy kName = Strategy::kName;
        if ((kName == GridStrategy::tiles || task.allowed.has(kName)) &&
            Strategy::applies(task, piece...)) {
          task.taken.add(kName);
          visit.template operator()<Strategy>();
          return true;
        }
      }
      return false;
    };
    return (takes.template operator()<Strategies>() || ...);
  }
};

/// Those of whole tasks, and those of pieces of rows but for StreamedOrder.
template <detail::OutputSet kOutputs, typename T>
using TaskStrategies =
    StrategyList<SquaresOfFour<kOutputs, T>, SmallAcross<kOutputs, T>, SmallGroups<kOutputs, T>>;
template <detail::OutputSet kOutputs, typename T>
using PieceStrategies =
    StrategyList<Records<kOutputs, T>, StreamedRows<kOutputs, T>, Squares<kOutputs, T>,
                 Bands<kOutputs, T>, Components<kOutputs, T>, AcrossLines<kOutputs, T>,
                 TileByTile<kOutputs, T>>;

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
