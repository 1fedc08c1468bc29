// Rates of bicubic patches: what the base code asks a kernel for. No xsimd in here.
#pragma once

#include "src/tables/net_table.hpp"

namespace simdbezier::detail {

/// A step from one uniform parameter to the next may be longer than the exact one by so much, since
/// parameters are rounded, which matters in single precision.
inline constexpr double kStepRounding = 4 * 0x1p-24;

/// Where hardly more than the mixed derivative counts, all pairs of rates of one product are nearly
/// as good. The others count as at least this share of it, so that cells are of one shape in both
/// directions then, and no slivers.
inline constexpr double kMixedShare = 1.0 / 64;

/// A bound on point sets takes as long as hundreds of vertices: it is asked for where second
/// derivatives along the normal tell that at most this share of a distance, or of the cells, may be
/// enough (the other one if the search is thorough), and for rates where there are at least so many
/// cells.
inline constexpr double kWorthLooking = 1.0 / 8;
inline constexpr double kThoroughlyWorthLooking = 1 / 1.6;
inline constexpr std::uint32_t kFewestLooked = 32;

/// Rates of a patch that the kernel leaves to GroupBound: its numbers are too large or too small,
/// no tolerance is left, the kernel has found no cells that keep it, or its bound may be far above
/// the distance.
inline constexpr std::uint32_t kUndecided = 0xffffffff;
/// Deviations of such patches: of those whose values are finite, and of those that may have others.
inline constexpr double kSoundUndecided = -1;
inline constexpr double kDoubtfulUndecided = -2;

/// Certifies rates, given ones or those that the kernel chooses, for bicubic polynomial nets of
/// three components. The scratch has kRateValues values.
template <typename T>
struct RateTask {
  NetView<const T> in;
  bool choose;
  std::uint32_t fewest_looked; ///< of so many cells, a bound that may be far too large is undecided
  double tolerance;            ///< of all patches …
  const double* tolerances;    ///< … or one value a patch; null: none
  const double* errors; ///< to be taken from the tolerance, and added to deviations; may be null
  std::uint32_t most;   ///< segments
  std::uint32_t* nu;    ///< from 1 to `most`, or kUndecided
  std::uint32_t* nv;
  std::uint16_t* diagonals; ///< of rates that are decided, as are deviations
  double* deviations;       ///< one of the two values above where undecided
};

/// The scratch has so many values, as NetTable's other kernels count them: points, and the nets of
/// four quarters side by side.
inline constexpr std::size_t kRateValues = 3 * 16 + 9 * 7 * 7 + 4 * 3;

} // namespace simdbezier::detail
