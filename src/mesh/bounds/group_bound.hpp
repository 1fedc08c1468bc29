// The certificates of cells of a group of patches.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <simdbezier/options.hpp>

#include "src/mesh/bounds/bound_parts.hpp"
#include "src/mesh/bounds/normal_bends.hpp"
#include "src/mesh/bounds/separable_bound.hpp"
#include "src/mesh/bounds/space_bound.hpp"
#include "src/mesh/bounds/vector_patch.hpp"
#include "src/tables/bound_task.hpp"

namespace simdbezier::detail {

/// Bounds for any rates, in double, for patches of one shape: any degrees and weights. Kernels
/// bound all patches of a group at once, each in a lane; bounds of a patch do not depend on the
/// others.
class GroupBound {
public:
  template <typename Value>
  using Lanes = std::array<Value, kMostBoundLanes>;

  /// Kernels are those of an instruction set that is there; bounds are the same on all of them.
  /// thorough: whether bounds on point sets are asked for wherever they may be a little smaller.
  GroupBound(Isa isa, bool thorough) noexcept;

  /// The most patches of a group.
  [[nodiscard]] std::size_t lanes() const { return kernels_.lanes; }

  /// Begins a group.
  void begin() { count_ = 0; }
  /// Reads the next patch, of the same shape as those before it: false where a control point is not
  /// finite or a weight not positive. Bounds of such a patch have no meaning.
  template <typename S>
  [[nodiscard]] bool read(const ControlNets<S>& nets, std::size_t patch, RateFlags flags);
  /// Ends a group: makes the bounds of its patches known.
  void form();

  /// The certificates of cells, one number of cells a lane. Where one is at most `enough`, no
  /// closer one is looked for.
  [[nodiscard]] Lanes<CertifiedCells> certify(const Lanes<CellCounts>& cells,
                                              const Lanes<double>& enough) const;
  /// The bounds where all diagonals run from (0,0) to (1,1), even if others would be better.
  [[nodiscard]] Lanes<double> rising_bounds(const CellCounts& cells) const;
  /// The fewest cells whose bound is at most t > 0, one value a lane; more than `most` in a
  /// direction, and nothing certified, where there are none.
  [[nodiscard]] Lanes<CertifiedCells> choose(const Lanes<double>& t, std::uint32_t most) const;
  /// Fewer cells than those chosen, where point sets tell that they hold, but at least so many
  /// segments in each direction; or those chosen.
  [[nodiscard]] Lanes<CertifiedCells> fewer(const Lanes<CertifiedCells>& chosen,
                                            const Lanes<CellCounts>& least, const Lanes<double>& t,
                                            std::uint32_t most) const;
  /// Whether bounds on point sets have been asked for.
  [[nodiscard]] bool has_point_sets(std::size_t lane) const { return spaces_[lane] != nullptr; }
  /// Adds cells in both directions, as long as there may be more, until the bound is at most t;
  /// more than `most` in a direction, and nothing certified, where it never is, or where `cells`
  /// had more.
  [[nodiscard]] Lanes<CertifiedCells> raise(const Lanes<CellCounts>& cells, const Lanes<double>& t,
                                            std::uint32_t most) const;

  /// The longest rows and columns of control points, in u and in v.
  [[nodiscard]] std::array<double, 2> lengths(std::size_t lane) const;
  /// The most that normals of the control net turn along its rows and columns.
  [[nodiscard]] std::array<double, 2> normal_turns(std::size_t lane) const;

private:
  /// All roundings of a bound except those of second differences.
  static constexpr double kRounding = 1 + 1e-12;

  /// Bit k: whether something is said of lane k.
  using LaneSet = unsigned;
  class Search;

  [[nodiscard]] LaneSet all_lanes() const { return (1U << count_) - 1; }
  [[nodiscard]] LaneSegments segments_of(const Lanes<CellCounts>& cells) const;
  /// Raises the bounds of some lanes to those of cells in corners whose diagonal is forced.
  void include_corners(LaneSet lanes, const LaneSegments& segments, CellBounds& bounds) const;
  [[nodiscard]] double in_space(std::size_t lane, double bound) const {
    return patches_[lane].in_space(bound * kRounding);
  }
  /// The smaller one of a bound of the kernels' and that of a patch with separable weights, which
  /// holds for all diagonals.
  [[nodiscard]] double smaller_in_space(std::size_t lane, const CellCounts& cells,
                                        double bound) const {
    const double other = separable_[lane].at(cells);
    return in_space(lane, other < bound ? other : bound);
  }
  /// The bound of point sets, where it may be far below another one of these cells, and there are
  /// at least so many; or null.
  [[nodiscard]] SpaceBound* space_of(std::size_t lane, const CertifiedCells& usual,
                                     double least = 0) const;
  /// A certificate with the bound of point sets, if that is smaller and the other one
  /// above `enough`.
  [[nodiscard]] CertifiedCells smaller_as_sets(std::size_t lane, const CertifiedCells& certified,
                                               bool may_fall, double enough) const;
  /// A tolerance in the scale of a lane's patch.
  [[nodiscard]] double in_patch(std::size_t lane, double t) const {
    return t * patches_[lane].scale.inverse() / (kRounding * kRounding);
  }
  /// Takes a certificate of SpaceBound, unless it is infinite.
  void take_if_close(std::size_t lane, const CertifiedCells& found, CertifiedCells& to) const {
    if (found.bound < std::numeric_limits<double>::infinity()) {
      to = {found.cells, in_space(lane, found.bound), found.diagonals};
    }
  }
  /// choose() by Filip's bound alone, which is coarser and has a formula for the counts.
  [[nodiscard]] CellCounts filip(std::size_t lane, double tolerance, std::uint32_t most) const;

  const BoundKernels& kernels_;
  bool thorough_;
  BoundGroup group_{};
  WholePatches whole_{};
  Lanes<VectorPatch> patches_;
  Lanes<SeparableBound> separable_{};
  BendSamples samples_;
  mutable Lanes<std::optional<NormalBends>> bends_; ///< these two where they have been asked for
  mutable Lanes<std::unique_ptr<SpaceBound>> spaces_;
  Lanes<RateFlags> flags_{};
  std::size_t count_ = 0;
  std::vector<LaneValues> memory_; ///< kept from one group to the next
};

} // namespace simdbezier::detail
