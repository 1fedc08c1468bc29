// The certificate of one patch's cells.
#pragma once

#include <array>
#include <cstdint>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/rates/derivative_nets.hpp"

namespace simdbezier::detail {

/// Bounds for any rates, in double, for patches of any degree and weights.
class PatchBound {
public:
  /// False where a control point is not finite or a weight not positive.
  template <typename S>
  [[nodiscard]] bool read(const ControlNets<S>& nets, std::size_t patch, std::uint8_t flags);

  /// The bound for rates; diagonals: those that it holds for, where wanted.
  [[nodiscard]] double bound(const CellCounts& cells, std::uint16_t* diagonals = nullptr) const;

  /// The bound where all diagonals run from (0,0) to (1,1), even if others would be better.
  [[nodiscard]] double rising_bound(const CellCounts& cells) const;

  /// The fewest cells whose bound is at most t > 0; more than `most` in a direction where there are
  /// none.
  [[nodiscard]] CellCounts choose(double t, std::uint32_t most) const;

  /// Adds cells in both directions, as long as there may be more, until the bound is at most t;
  /// more than `most` in a direction where it never is, or where `cells` had more.
  [[nodiscard]] CellCounts raise(CellCounts cells, double t, std::uint32_t most) const;

  /// The longest rows and columns of control points, in u and in v.
  [[nodiscard]] std::array<double, 2> lengths() const;
  /// The most that normals of the control net turn along its rows and columns.
  [[nodiscard]] std::array<double, 2> normal_turns() const;

private:
  /// All roundings of a bound except those of second differences.
  static constexpr double kRounding = 1 + 1e-12;
  /// A bit for each of the four quarters, which have the numbers 2 * (half of v) + (half of u).
  using QuarterSet = unsigned;
  static constexpr QuarterSet kAll = 15;
  /// Quarters, halves, all: what a zone of cells lies in.
  static constexpr QuarterSet kZones[] = {1, 2, 4, 8, 3, 12, 5, 10, kAll};

  /// Calls visit(quarters, zone) for the zones that there are.
  template <typename Visit>
  static void for_zones(const CellCounts& cells, const Visit& visit);
  void find_hulls();
  [[nodiscard]] const Hull& hull_of(QuarterSet quarters) const {
    return hulls_[patch_.rational ? quarters : kAll];
  }
  [[nodiscard]] double zone_bound(QuarterSet quarters, const CellCounts& cells, bool falling) const;
  [[nodiscard]] double corner_bound(std::size_t corner, const CellCounts& cells) const;
  /// choose() by Filip's bound alone, which is coarser and has a formula for the counts.
  [[nodiscard]] CellCounts filip(double t, std::uint32_t most) const;
  /// A bound in the patch's own scale as one in space, rounded up.
  [[nodiscard]] double in_space(double bound) const;

  VectorPatch patch_;
  std::uint8_t flags_ = 0;
  SecondNets nets_;                  ///< of the whole patch
  SecondBounds whole_{};             ///< their largest vectors
  SecondBounds doubt_{};             ///< what rounding may have taken from the largest vectors
  std::array<SecondNets, 4> raised_; ///< of the quarters, all to the patch's degrees
  std::array<SecondBounds, kAll + 1> largest_; ///< of the sets in kZones
  std::array<Hull, kAll + 1> hulls_;           ///< of sets of quarters
};

} // namespace simdbezier::detail
