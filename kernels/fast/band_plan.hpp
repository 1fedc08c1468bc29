// Which rows go in bands (fast/row_bands.hpp), and how; which lines compete for the same places of
// a first-level cache.
#pragma once

#include <cstdint>

#include "kernels/grid/patch_sweeps.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether the lines that a tile writes to these planes stay in the first-level cache, of 64 sets
/// and 8 lines each, until the next tile comes to the same sets: rows that lie a power of two apart
/// use few sets, and so do planes that begin at the same place within such a distance.
template <typename T, std::size_t kPlanes>
SIMDBEZIER_PART bool lines_stay(const GridTask<T>& task, const T* const (&planes)[kPlanes],
                                std::size_t rows) {
  constexpr std::size_t kSetBytes = 64 * 64;
  // Registers of a fourth of a line come to each line so often that half of them are too many. In
  // WebAssembly, what is swept instead gains less.
  constexpr std::size_t kLines = kLanes<vec<T>> * sizeof(T) < 32 && !kSimd128 ? 4 : 8;
  const std::size_t row = task.nu * sizeof(T);
  const std::size_t distance = row & (~row + 1); // the largest power of two in it
  const auto place = [&](const T* plane) SIMDBEZIER_INLINE_LAMBDA {
    return reinterpret_cast<std::uintptr_t>(plane) % distance / 64;
  };
  std::size_t most = 0;
  for (const T* const a : planes) {
    std::size_t together = 0;
    for (const T* const b : planes) {
      together += place(a) == place(b) ? 1 : 0;
    }
    most = together > most ? together : most;
  }
  return most * rows * distance <= kLines * kSetBytes;
}

/// Whether there are bands. Normals take so much arithmetic that stores do not matter; of shorter
/// registers too many would have to lie side by side.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kSweepsBands = (kOutputs == detail::kPosition ||
                               kOutputs == detail::kPositionDerivatives) &&
                              kMakesLines<vec<T>>;

/// The most registers of a band. Each number has code of its own, and more would gain less than
/// theirs costs.
template <typename V>
constexpr std::size_t kMostInBand = kLineWide<V> ? 4 : 8;
/// The same where planes go one by one; for registers of a line it is kMostInBand.
constexpr std::size_t kMostPlaneByPlane = 6;

/// Whether rows of the task lie a multiple of 512 bytes apart, and leave the cache while one tile
/// follows the other. Below 4096 bytes there are no strips of such rows
/// (src/choice/row_strips.hpp).
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool rows_leave(const GridTask<T>& task, std::size_t rows) {
  if (task.nu * sizeof(T) % 512 != 0) {
    return false;
  }
  const auto& position = task.out[output_index(Output::position)].component;
  if constexpr (kOutputs == detail::kPosition) {
    const T* const planes[] = {position[0], position[1], position[2]};
    return !lines_stay(task, planes, rows);
  } else {
    const T* const planes[] = {position[0], task.out[output_index(Output::du)].component[0],
                               task.out[output_index(Output::dv)].component[0]};
    return !lines_stay(task, planes, rows);
  }
}

/// The registers of a row, and how bands sweep them.
template <detail::OutputSet kOutputs, typename V>
struct BandPlan {
  static constexpr std::size_t kL = kLanes<V>;
  static constexpr bool kMayGoPlaneByPlane =
      kOutputs == detail::kPositionDerivatives && sizeof(ScalarOf<V>) == sizeof(float);

  std::size_t rest; ///< columns behind whole registers
  /// Whether planes go one by one. That pays where stores across lines are cheap and rows are no
  /// whole registers. On AVX2 it does not from seven registers on, nor from five on if rows are
  /// whole quarters of a line: their polynomials are operands in memory either way.
  bool plane_by_plane;
  /// Whether the rest takes a register of its own: masked in registers of a line, else beginning
  /// within the one before it. If it does not, a single column goes along with the last whole
  /// register, and other columns are left to another tile.
  bool partial;
  std::size_t registers;

  explicit SIMDBEZIER_PART BandPlan(const GridTask<ScalarOf<V>>& task)
      : rest(task.nu % kL), plane_by_plane(kMayGoPlaneByPlane && rest != 0 && !task.by_lines),
        partial(rest > (kLineWide<V> && !plane_by_plane ? kL / 4 : 1)),
        registers(task.nu / kL + (partial ? 1 : 0)) {
    if (!kLineWide<V>) {
      plane_by_plane = plane_by_plane && registers <= kMostPlaneByPlane &&
                       (task.nu % (kL / 2) != 0 || registers <= kMostPlaneByPlane - 2);
    }
  }
};

/// Whether bands are faster than tiles. In staging they are where planes go one by one and
/// registers are shorter than a line; elsewhere samples are passed on in smaller portions, tile by
/// tile.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool pays_in_bands(const GridTask<T>& task, const RowPiece<T>& piece,
                                   const BandPlan<kOutputs, vec<T>>& plan) {
  using V = vec<T>;
  const std::size_t registers = plan.registers;
  constexpr std::size_t kL = kLanes<V>;
  constexpr std::size_t kMost = kLineWide<V> ? 6 : 8;
  constexpr bool kPositions = kOutputs == detail::kPosition;
  constexpr bool kFloat = sizeof(T) == sizeof(float);
  const std::size_t nu = task.nu;
  if (task.drain != nullptr && (kLineWide<V> || !plan.plane_by_plane)) {
    return false;
  }
  if (rows_leave<kOutputs>(task, piece.rows())) {
    return true;
  }
  // Positions that are whole lines are as fast in pairs of registers. Few rows are not worth the
  // preparations, least of all where rows are not in pairs.
  const bool whole_lines = nu * sizeof(T) % 64 == 0;
  const std::size_t least_rows = kPositions           ? 5
                                 : !kLineWide<V>      ? (plan.plane_by_plane ? 14 : 18)
                                 : registers <= kMost ? 16
                                                      : 30;
  if ((kPositions && whole_lines) || piece.rows() < least_rows) {
    return false;
  }
  if constexpr (kLineWide<V>) {
    const bool joins = kPositions && kFloat && nu % kL > kL / 4;
    const std::size_t least = joins || plan.plane_by_plane ? 2 : 3;
    return registers >= least && registers <= (kPositions ? 1 : 3) * kMost;
  } else {
    // By plain stores to memory, rows of a few lines go slowly in any order but that of tiles.
    const std::size_t least = kPositions && task.plain_to_memory ? 5 : 2;
    const std::size_t most = !kPositions && kFloat && whole_lines ? 2 * kMost : kMost;
    // Rows of two registers and a column pay only plane by plane.
    const std::size_t narrow = plan.plane_by_plane ? 2 * kL : 2 * kL + 1;
    return nu > narrow && registers >= least && registers <= most;
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
