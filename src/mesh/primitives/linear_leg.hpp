// Legs of cells on sides whose vertices follow each other.
#pragma once

#include <cstdint>

#include "src/mesh/primitives/linear_sides.hpp"

namespace simdbezier::detail {

/// A leg of a cell in a corner of the patch, from the corner on.
struct CornerLeg {
  std::uint32_t corner;
  std::uint32_t zero; ///< the number that the corner would have as a point of the row
  std::uint32_t step;
  std::uint32_t segments;

  /// The leg's other end.
  [[nodiscard]] std::uint32_t far() const { return zero + segments * step; }
};

/// A leg of any cell, as cut_half() takes it: both ends may be corners of the patch.
class LinearLeg {
public:
  explicit LinearLeg(const CornerLeg& leg)
      : ends_{leg.corner, leg.far()}, zero_(leg.zero), step_(leg.step), segments_(leg.segments) {}
  /// From one vertex to another one.
  LinearLeg(std::uint32_t from, std::uint32_t to)
      : ends_{from, to}, zero_(from), step_(0), segments_(1) {}
  /// So many segments of a side, from a place on.
  LinearLeg(const LinearSide& side, std::uint32_t place, std::uint32_t segments)
      : ends_{side.vertex(place), side.vertex(place + segments)}, zero_(side.at(place)),
        step_(side.step), segments_(segments) {}

  [[nodiscard]] LinearLeg reversed() const {
    LinearLeg leg = *this;
    leg.ends_[0] = ends_[1];
    leg.ends_[1] = ends_[0];
    leg.zero_ = zero_ + segments_ * step_;
    leg.step_ = 0 - step_;
    return leg;
  }
  [[nodiscard]] std::uint32_t segments() const { return segments_; }
  [[nodiscard]] std::uint32_t vertex(std::uint32_t k) const {
    return k == 0 ? ends_[0] : k == segments_ ? ends_[1] : zero_ + k * step_;
  }

private:
  std::uint32_t ends_[2];
  std::uint32_t zero_;
  std::uint32_t step_;
  std::uint32_t segments_;
};

} // namespace simdbezier::detail
