// How far a piece of a rational curve or surface is from the segment or the triangle between its
// corners, as point sets: docs/tessellation.md has the proofs.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <simdbezier/control_nets.hpp>

namespace simdbezier::detail {

/// Weights up to here do not count as far apart, and beyond the other one not as usable.
inline constexpr double kLeastSpread = 4.5;
inline constexpr double kMostSpread = 0x1p40;

/// Of all roundings, some 4000 at most, in units of the largest value.
inline constexpr double kPointSetDoubt = 0x1p-38;

/// A Bézier curve, or a Bézier triangle of `degree`: homogeneous control points, x, y, … and a
/// weight above zero each. Row k has degree + 1 - k of them, and a curve has row 0 alone. Corners
/// are the ends of row 0 and the point of the last row.
struct SimplexNet {
  std::size_t degree = 0;
  std::size_t components = 3; ///< of a point, without the weight
  bool triangle = false;
  std::vector<double> at;

  void resize(std::size_t new_degree, std::size_t new_components, bool is_triangle);
  [[nodiscard]] double* point(std::size_t row, std::size_t i) {
    return at.data() + (row * (2 * degree + 3 - row) / 2 + i) * (components + 1);
  }
  [[nodiscard]] const double* point(std::size_t row, std::size_t i) const {
    return const_cast<SimplexNet*>(this)->point(row, i);
  }
};

/// The segment or the triangle between a net's corners.
class FlatSimplex {
public:
  explicit FlatSimplex(const SimplexNet& net);
  /// An upper bound on the distance of a homogeneous point, exact but for rounding.
  [[nodiscard]] double distance(const double* point) const;
  /// Of a segment.
  [[nodiscard]] double length() const { return std::sqrt(dot_[0]); }

private:
  std::size_t components_;
  std::array<double, kMostComponents> origin_{};
  std::array<std::array<double, kMostComponents>, 2> side_{};
  double dot_[3]; ///< of the sides: 00, 01, 11
};

/// Measures pieces, and halves them as often as that takes.
class SimplexDistance {
public:
  static constexpr std::size_t kDeepest = 64;

  /// A bound on the distance of any point of the net's curve or surface from a simplex: no more
  /// than `enough`, or by a small share above the real one, or by as much as is left after so many
  /// levels of halvings, or many of them. Infinite where a point is farther than `stop`.
  double bound(const SimplexNet& net, const FlatSimplex& flat, double enough, double stop,
               std::size_t levels = kDeepest);

private:
  double bound_piece(const SimplexNet& piece, std::size_t level);
  void halve(const SimplexNet& piece, SimplexNet (&halves)[2]);

  const FlatSimplex* flat_ = nullptr;
  double enough_ = 0;
  double stop_ = 0;
  std::size_t levels_ = 0;
  double found_ = 0; ///< the largest distance of a point of the surface
  std::size_t halvings_ = 0;
  std::vector<double> row_;
  std::array<SimplexNet[2], kDeepest> halves_;
};

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
