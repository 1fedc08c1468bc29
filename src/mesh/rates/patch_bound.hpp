// The certificate of one patch's cells.
#pragma once

#include <array>
#include <cstdint>

#include <simdbezier/isa.hpp>
#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/rates/derivative_nets.hpp"

namespace simdbezier::detail {

/// Bounds for any rates, in double, for patches of any degree and weights.
class PatchBound {
public:
  /// Vectors are measured by the kernels of an instruction set that is there; bounds are the same
  /// on all of them.
  explicit PatchBound(Isa isa) noexcept;

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

  /// The second derivatives of a part of the patch, raised to the patch's degrees.
  struct RaisedPlanes {
    VectorPlanes uu;
    VectorPlanes uv;
    VectorPlanes vv;
  };
  /// Bounds for either diagonal.
  struct DiagonalBounds {
    double rising;
    double falling;
  };
  class Look;

  void find_hulls();
  void take_quarter(std::size_t quarter, SecondNets& nets);
  [[nodiscard]] const Hull& hull_of(QuarterSet quarters) const {
    return hulls_[patch_.rational ? quarters : kAll];
  }
  [[nodiscard]] double largest_of(const VectorNet& net, QuarterSet quarters);
  [[nodiscard]] double corner_bound(std::size_t corner, const CellCounts& cells) const;
  /// Whether the bound for rates is above t; `zone` is one that is likely to be, and becomes the
  /// first one found.
  [[nodiscard]] bool exceeds(const CellCounts& cells, double t, std::size_t& zone) const;
  /// choose() by Filip's bound alone, which is coarser and has a formula for the counts.
  [[nodiscard]] CellCounts filip(double t, std::uint32_t most) const;
  /// A bound in the patch's own scale as one in space, rounded up.
  [[nodiscard]] double in_space(double bound) const;

  const SizeKernels& sizes_;
  VectorPatch patch_;
  std::uint8_t flags_ = 0;
  SecondNets nets_;      ///< of the whole patch
  SecondBounds whole_{}; ///< their largest vectors
  SecondBounds doubt_{}; ///< what rounding may have taken from the largest vectors
  std::array<RaisedPlanes, 4> quarters_;
  std::array<SecondBounds, kAll + 1> largest_; ///< of the sets in kZones
  std::array<Hull, kAll + 1> hulls_;           ///< of sets of quarters

  // These keep their memory from one patch to the next.
  VectorPlanes planes_;
  SecondNets halves_[2];
  SecondNets parts_[2];
  VectorNet net_halves_[2];
  VectorNet net_parts_[2];
};

} // namespace simdbezier::detail
