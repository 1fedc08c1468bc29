// How far a piece of a rational curve is from the segment between its ends, as point sets, and what
// that has in common with cells of surfaces: docs/tessellation.md has the proofs.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <simdbezier/control_nets.hpp>

namespace simdbezier::detail {

/// Weights up to here do not count as far apart, and beyond the other one not as usable.
inline constexpr double kLeastSpread = 4.5;
inline constexpr double kMostSpread = 0x1p40;

/// A bound may be above what points of a curve ask for by this factor.
inline constexpr double kCloseEnough = 1.125;

/// Of all roundings, some 4000 at most, in units of the largest value.
inline constexpr double kPointSetDoubt = 0x1p-38;

/// A Bézier curve: homogeneous control points, x, y, … and a weight above zero each.
struct CurveNet {
  std::size_t degree = 0;
  std::size_t components = 3; ///< of a point, without the weight
  std::vector<double> at;

  void resize(std::size_t new_degree, std::size_t new_components);
  [[nodiscard]] double* point(std::size_t i) { return at.data() + i * (components + 1); }
  [[nodiscard]] const double* point(std::size_t i) const {
    return at.data() + i * (components + 1);
  }
};

/// The segment between a curve's ends.
class Chord {
public:
  explicit Chord(const CurveNet& net);
  /// An upper bound on the distance of a homogeneous point, exact but for rounding.
  [[nodiscard]] double distance(const double* point) const;

private:
  std::size_t components_;
  std::array<double, kMostComponents> origin_{};
  std::array<double, kMostComponents> along_{};
  double square_ = 0; ///< of its length
};

/// Measures pieces, and halves them as often as that takes.
class ChordDistance {
public:
  static constexpr std::size_t kDeepest = 64;

  /// A bound on the distance of any point of the curve from a chord: no more than `enough`, or by a
  /// small share above the real one, or by as much as is left after so many levels of halvings, or
  /// many of them. Infinite where a point is farther than `stop`.
  double bound(const CurveNet& net, const Chord& chord, double enough, double stop);

private:
  double bound_piece(const CurveNet& piece, std::size_t level);

  const Chord* chord_ = nullptr;
  double enough_ = 0;
  double stop_ = 0;
  double found_ = 0; ///< the largest distance of a point of the curve
  std::size_t halvings_ = 0;
  std::array<CurveNet[2], kDeepest> halves_;
};

/// Halves `count` rows of `width` values, which are `step` apart, as those of a Bézier curve: they
/// become the second half, and `first` the first one.
void halve_rows(double* rows, double* first, std::size_t count, std::size_t step,
                std::size_t width);

/// Takes the piece from a to b of a Bézier curve, in place: `count` homogeneous points of
/// `channels` values, which are `step` values apart.
void cut_curve(double* points, std::size_t count, std::size_t step, std::size_t channels, double a,
               double b);

/// A net of homogeneous points, and how far from its corner at (0,0) the surface is at most within
/// [0,s] x [0,t], with s and t far below 1. Points are `steps` values apart, which may be negative.
struct NetCorner {
  const double* corner;
  std::size_t columns;
  std::size_t rows;
  std::ptrdiff_t steps[2];
  std::size_t components;

  [[nodiscard]] double motion(double s, double t) const;
};

} // namespace simdbezier::detail
