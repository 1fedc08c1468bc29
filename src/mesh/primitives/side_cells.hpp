// The cells at one side of a patch, one after the other.
#pragma once

#include "src/mesh/primitives/fan_writer.hpp"
#include "src/mesh/primitives/linear_sides.hpp"

namespace simdbezier::detail {

/// Cells of side kSide but those in the patch's corners.
template <PatchEdge kSide, typename Index, bool kTurned>
class SideCells {
public:
  /// From inner vertex `inner` on, with `inner_step` to the next one.
  SideCells(const LinearSide& side, std::uint32_t inner, std::uint32_t inner_step)
      : counts_(side.counts), step_(side.step), rung_{side.at(counts_[0]), inner},
        inner_step_(inner_step) {}

  /// Writes cell k, which comes after cell k - 1.
  void put(std::uint32_t k, bool falling, FanWriter<Index, kTurned>& out) {
    const std::uint32_t n = counts_[k];
    const Rung next{rung_.side + n * step_, rung_.inner + inner_step_};
    constexpr bool kHigh = kSide == PatchEdge::v1 || kSide == PatchEdge::u1;
    constexpr bool kRunsInU = kSide == PatchEdge::v0 || kSide == PatchEdge::v1;
    // The fan is in the half that has its right angle at the side; halves come in the order of
    // CellCutter.
    falling ? put_between<kRunsInU, !kHigh, !kHigh>(next, n, out)
            : put_between<!kRunsInU, kHigh, kRunsInU != kHigh>(next, n, out);
    rung_ = next;
  }

private:
  template <bool kSideFirst, bool kForwards, bool kFanFirst>
  void put_between(const Rung& next, std::uint32_t n, FanWriter<Index, kTurned>& out) const {
    out.template cell<kSideFirst, kFanFirst>(kForwards ? rung_ : next, kForwards ? next : rung_,
                                             kForwards ? step_ : 0 - step_, n);
  }

  const std::uint8_t* counts_;
  std::uint32_t step_;
  Rung rung_;
  std::uint32_t inner_step_;
};

} // namespace simdbezier::detail
