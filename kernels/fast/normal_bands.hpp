// Positions and normals of rows that are a multiple of eight registers long: eight registers of a
// row side by side, and then the next row, if a tile's lines would leave the cache.
//
// Lines of such rows share few sets of a first-level cache. Tile by tile, rows would have to go in
// strips (src/choice/row_strips.hpp), too short for pairs of mirrored rows. Other rows gain
// nothing: what a tile keeps in registers is an operand in memory here.
#pragma once

#include "kernels/fast/band_plan.hpp"
#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/register_pair.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether there are bands with normals. WebAssembly has none of floats, which lose a fourth by
/// them: V8 has few registers left.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kSweepsNormalBands = (kOutputs == detail::kPositionNormal) && !kIsScalar<vec<T>> &&
                                    !(kSimd128 && sizeof(T) == sizeof(float));

/// The tiles of a band, of one patch.
template <typename T>
class NormalBand {
  using V = vec<T>;
  using Tile = ColumnTile<1, true, false, V>;
  using Sweep = NormalSweep<1, true, false, false, false, V, false>;
  static constexpr std::size_t kL = kLanes<V>;

public:
  static constexpr std::size_t kTiles = 8;

  SIMDBEZIER_PART NormalBand(const GridTask<T>& task, std::size_t first)
      : NormalBand(task, first, std::make_index_sequence<kTiles>()) {}

  /// shared_task is the task whose address may leave.
  SIMDBEZIER_PART void sweep(const GridTask<T>& task, const GridTask<T>& shared_task,
                             const RowPiece<T>& piece, std::size_t patch) const {
    sweep(task, shared_task, piece, patch, std::make_index_sequence<kTiles>());
  }

private:
  template <std::size_t... k>
  SIMDBEZIER_PART NormalBand(const GridTask<T>& task, std::size_t first,
                             std::index_sequence<k...> /*tiles*/)
      : tile_{{task.x, first + k * kL, kL, task.watertight}...} {}

  /// It is a function, or there would be eight of it in a row.
  static SIMDBEZIER_KERNEL Sweep sweep_of(const GridTask<T>& task, const Tile& tile,
                                          std::size_t patch, DoubtfulSamples<T>& doubts) {
    return Sweep(task, tile, patch, 1, ColumnPlanes<T>{nullptr}, doubts);
  }

  template <std::size_t... k>
  SIMDBEZIER_PART void sweep(const GridTask<T>& task, const GridTask<T>& shared_task,
                             const RowPiece<T>& piece, std::size_t patch,
                             std::index_sequence<k...> /*tiles*/) const {
    DoubtfulSamples<T> doubts(shared_task, patch);
    const Sweep sweeps[] = {sweep_of(task, tile_[k], patch, doubts)...};
    const V floor = broadcast<V>(task.normal_floor[patch]);
    const bool outside = piece.middle.kind == RowKind::outside;
    const auto middle_floor = [&](const Sweep& tile) SIMDBEZIER_INLINE_LAMBDA {
      return outside ? no_floor<V>() : floor_inside(tile.tile.column.x, floor);
    };
    const auto at = [](RowPlace place, const Sweep& tile) SIMDBEZIER_INLINE_LAMBDA {
      return RowPlace{place.at + tile.tile.first, place.row};
    };
    for_rows<RowOrder{1, RowPairs::always, 1}>(
        piece, patch * task.patch_step + piece.first * task.nu, task.nu,
        [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
          for (const Sweep& tile : sweeps) {
            tile.store_edge(tile.edge(edge_of(kind)), kind, at(place, tile).at, place.row,
                            floor_inside(tile.tile.column.x, floor));
          }
        },
        [&](const T* y, RowPlace place, RowPlace mirrored) SIMDBEZIER_INLINE_LAMBDA {
          for (const Sweep& tile : sweeps) {
            tile.pair(y, at(place, tile), at(mirrored, tile), middle_floor(tile));
          }
        },
        [&](const T* y, RowPlace place, std::size_t rows) SIMDBEZIER_INLINE_LAMBDA {
          for (const Sweep& tile : sweeps) {
            tile.interior(y, at(place, tile), rows, middle_floor(tile));
          }
        });
    if (doubts.any()) [[unlikely]] {
      doubts.resolve();
    }
  }

  Tile tile_[kTiles];
};

/// Whether such a piece is faster in bands. In staging, samples are passed on in smaller portions
/// tile by tile.
template <typename T>
SIMDBEZIER_PART bool pays_in_normal_bands(const GridTask<T>& task, const RowPiece<T>& piece) {
  const bool whole = task.nu % (NormalBand<T>::kTiles * kLanes<vec<T>>) == 0;
  if (task.drain != nullptr || !whole) {
    return false;
  }
  const auto& position = task.out[output_index(Output::position)].component;
  const auto& normal = task.out[output_index(Output::normal)].component;
  const T* const planes[] = {position[0], position[1], position[2],
                             normal[0],   normal[1],   normal[2]};
  return !lines_stay(task, planes, piece.rows());
}

/// Sweeps patches [patch, end) without origins, whose rows are a number of bands.
template <typename T>
SIMDBEZIER_KERNEL void sweep_normal_bands(const GridTask<T>& shared_task,
                                          const RowPiece<T>& shared_piece, std::size_t patch,
                                          std::size_t end) {
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const RowPiece<T> piece = shared_piece;
  for (std::size_t first = 0; first < task.nu; first += NormalBand<T>::kTiles * kLanes<vec<T>>) {
    const NormalBand<T> band(task, first);
    for (std::size_t p = patch; p < end; ++p) {
      if (task.prefetch && first == 0) {
        prefetch_patch(task, p);
      }
      band.sweep(task, shared_task, piece, p);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
