// The certificate of one patch's cells.
#pragma once

#include <array>
#include <cstdint>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/derivative_nets.hpp"

namespace simdbezier::detail {

/// Bounds for any rates, in double, for patches of any degree and weights.
class PatchBound {
public:
  /// False where a control point is not finite or a weight not positive.
  template <typename S>
  [[nodiscard]] bool read(const ControlNets<S>& nets, std::size_t patch, std::uint8_t flags);

  /// The bound for rates; diagonals: those that it holds for, where wanted.
  [[nodiscard]] double bound(const CellCounts& cells, std::uint16_t* diagonals = nullptr) const;

  /// The least cells whose bound is at most t > 0; more than `most` a direction where there are
  /// none.
  [[nodiscard]] CellCounts choose(double t, std::uint32_t most) const;

  /// The most that rows and columns of control points measure in u and in v.
  [[nodiscard]] std::array<double, 2> lengths() const;

private:
  /// One of the four quarters, number 2 * (half of v) + (half of u).
  struct Quarter {
    SecondNets raised; ///< all three to the patch's degrees
    SecondBounds largest;
  };
  using QuarterSet = unsigned; ///< a bit each
  static constexpr QuarterSet kAll = 15;

  void measure(const SecondNets& nets, SecondBounds& largest) const;
  /// The largest of uu S_uu + uv S_uv + vv S_vv.
  [[nodiscard]] double largest_form(const SecondNets& raised, double uu, double uv,
                                    double vv) const;
  [[nodiscard]] double diagonal_bound(QuarterSet quarters, const CellCounts& cells,
                                      bool falling) const;
  [[nodiscard]] double corner_bound(std::size_t corner, const CellCounts& cells) const;
  [[nodiscard]] CellCounts filip(double t, std::uint32_t most) const;

  VectorPatch patch_;
  std::uint8_t flags_ = 0;
  SecondNets nets_;      ///< of the whole patch
  SecondBounds whole_{}; ///< their largest vectors
  SecondBounds doubt_{}; ///< what rounding may have taken from the largest vectors
  std::array<Quarter, 4> quarters_;
};

} // namespace simdbezier::detail
