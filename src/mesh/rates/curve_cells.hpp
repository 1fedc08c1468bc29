// The bound of point sets on polylines of curves whose weights are far apart.
#pragma once

#include <cstdint>

#include "src/mesh/bounds/chord_distance.hpp"

namespace simdbezier::detail {

class CurveCells {
public:
  /// doubt: what all roundings together may be.
  CurveCells(CurveNet curve, double doubt) : curve_(std::move(curve)), doubt_(doubt) {}

  /// Few segments whose bound is at most `stop`, which becomes the bound; `usual` where fewer ones
  /// do not hold.
  std::uint32_t choose(std::uint32_t usual, double& stop);

private:
  double bound_segment(std::uint32_t i, std::uint32_t n, double enough, double stop);

  CurveNet curve_;
  double doubt_;
  CurveNet segment_;
  ChordDistance distance_;
};

} // namespace simdbezier::detail
