// The bound of point sets on polylines of curves whose weights are far apart.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "src/mesh/bounds/chord_distance.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::detail {

class CurveCells {
public:
  /// doubt: what all roundings together may be.
  CurveCells(CurveNet curve, double doubt) : curve_(std::move(curve)), doubt_(doubt) {}

  /// Few segments whose bound is at most `stop`, which becomes the bound; `usual` where fewer ones
  /// do not hold.
  std::uint32_t choose(std::uint32_t usual, double& stop);

private:
  /// The distance of a piece from its chord, and how far roundings of parameters move its ends.
  double bound_segment(std::uint32_t i, std::uint32_t n, double enough, double stop);

  CurveNet curve_;
  double doubt_;
  CurveNet segment_;
  ChordDistance distance_;
};

inline double CurveCells::bound_segment(std::uint32_t i, std::uint32_t n, double enough,
                                        double stop) {
  const std::size_t points = curve_.degree + 1;
  const std::size_t channels = curve_.components + 1;
  segment_ = curve_;
  cut_curve(segment_.at.data(), points, channels, channels, static_cast<double>(i) / n,
            static_cast<double>(i + 1) / n);
  const auto step = static_cast<std::ptrdiff_t>(channels);
  const double rounding = kStepRounding / 2 * n;
  const NetCorner first{segment_.point(0), points, 1, {step, 0}, curve_.components};
  const NetCorner last{segment_.point(curve_.degree), points, 1, {-step, 0}, curve_.components};
  const double moved =
      std::max(i == 0 ? 0 : first.motion(rounding, 0), i + 1 == n ? 0 : last.motion(rounding, 0));
  const double far = distance_.bound(segment_, Chord(segment_), std::max(enough, doubt_), stop);
  return far + moved + doubt_;
}

inline std::uint32_t CurveCells::choose(std::uint32_t usual, double& stop) {
  double miss = 0; // where others have not held
  for (std::uint32_t n = 1; n < usual; n += std::max(1U, n / 16)) {
    const auto holds = [&](std::uint32_t i) {
      const bool held = bound_segment(i, n, stop, stop) <= stop;
      miss = held ? miss : (i + 0.5) / n;
      return held;
    };
    bool all = holds(static_cast<std::uint32_t>(miss * n));
    for (std::uint32_t i = 0; all && i < n; ++i) {
      all = holds(i);
    }
    if (all) {
      double most = 0; // by a small share above the real one
      for (std::uint32_t i = 0; i < n; ++i) {
        most = std::max(most, bound_segment(i, n, most, stop));
      }
      stop = std::min(stop, most);
      return n;
    }
  }
  return usual;
}

} // namespace simdbezier::detail
