// Bounds on the cells of patches of any degrees and weights: what the base code asks kernels for.
// Lanes are patches. No xsimd in here.
#pragma once

#include <cstddef>

namespace simdbezier::detail {

/// As many patches as the widest register has lanes.
inline constexpr std::size_t kMostBoundLanes = 8;

/// One number a lane.
struct LaneValues {
  alignas(64) double at[kMostBoundLanes];

  double& operator[](std::size_t lane) { return at[lane]; }
  const double& operator[](std::size_t lane) const { return at[lane]; }
};

/// Zones of cells, as Zone numbers them: 3 * (of v) + (of u).
inline constexpr std::size_t kZoneCount = 9;
/// The zone whose cells lie in all quarters of a patch.
inline constexpr std::size_t kEverywhere = 8;
/// Sets of zones: a bit each.
inline constexpr unsigned kAllZones = 0b111'111'111;
inline constexpr unsigned kQuarterZones = 0b000'011'011; ///< those of one quarter each

/// Numbers that belong to the second derivatives uu, uv and vv.
struct SecondValues {
  LaneValues uu;
  LaneValues uv;
  LaneValues vv;
};

/// A group of patches of one shape.
struct BoundGroup {
  std::size_t columns; ///< degree in u, plus 1
  std::size_t rows;
  bool rational;
  /// Control points, [j][i][component][lane], with as many lanes as the kernels have: x, y and z,
  /// or w x, w y, w z and w. What forms the group needs follows behind them; all that is there has
  /// kBoundNets nets, and kBoundValues further registers.
  double* memory;
  SecondValues doubt; ///< what rounding may have taken from vectors
};
/// The patch, its second derivatives, three nets of scratch, and second derivatives of quarters.
inline constexpr std::size_t kBoundNets = 1 + 3 + 3 + 3 * 4;
/// A hull and two sizes for each zone; for each quarter and diagonal, three vectors of four.
inline constexpr std::size_t kBoundValues = kZoneCount * 7 + 4 * 2 * 3 * 4;

/// A box that holds a part of the surface, and the smallest of its weights. Distances from points
/// of a rational surface S = X / w are bounded by the vectors v of X - q w, with q in the box: with
/// its middle c and its half-diagonal R, |v_X - q v_w| <= |v_X - c v_w| + R |v_w|, which is the
/// size of v here. That of a polynomial patch's vectors, whose weights are 1, is |v_X|.
struct LaneHulls {
  LaneValues middle[3];
  LaneValues radius;
  LaneValues smallest_weight;
};

/// What is known of whole patches: the largest sizes of their vectors, and their hulls.
struct WholePatches {
  SecondValues largest;
  LaneHulls hull;
};

/// Segments of cells in u and v, whole numbers from 1 on.
struct LaneSegments {
  LaneValues nu;
  LaneValues nv;
};

/// Bounds on some zones of cells, of those that the cells have.
struct CellBounds {
  LaneValues bound;   ///< the largest, with the better diagonal in each zone
  LaneValues falling; ///< the sum of 2^k over zones k whose diagonal is better from (1,0) to (0,1)
  LaneValues rising;  ///< the largest bound where all diagonals run from (0,0) to (1,1)
};

/// All bounds are infinite where a size is nan. Products are rounded on every instruction set, so
/// that bounds are the same on all of them.
struct BoundKernels {
  std::size_t lanes;
  /// Forms the second derivatives over the quarters. It comes before the others.
  void (*form)(const BoundGroup& group, WholePatches& out);
  /// Bit k of `zones`: whether zone k is looked at.
  void (*bound)(const BoundGroup& group, const LaneSegments& cells, unsigned zones,
                CellBounds& out);
  /// The same for zones of one quarter each, all four; and finds the vectors that these bounds
  /// depend on, the largest along either diagonal of each quarter.
  void (*lead)(const BoundGroup& group, const LaneSegments& cells, CellBounds& out);
  /// What bound() would find if those that lead() found were the only vectors: no more, but for
  /// roundings.
  void (*leading)(const BoundGroup& group, const LaneSegments& cells, unsigned zones,
                  CellBounds& out);
  /// The bound on the cell in a corner of the patch, 2 * (at v = 1) + (at u = 1), with one of its
  /// diagonals.
  void (*corner)(const BoundGroup& group, const LaneSegments& cells, std::size_t corner,
                 bool falling, LaneValues& out);
};

} // namespace simdbezier::detail
