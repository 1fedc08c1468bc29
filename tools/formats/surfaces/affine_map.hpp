// Transformations of points that keep straight lines parallel, with proof of what rounding adds.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace simdbezier::tools {

/// p' = p M, with points as rows: the first three rows of M are where x, y and z go, the last one
/// is where 0 goes. Every number has a bound of what it differs from what was asked for, so that
/// any number of maps can be joined. The numbers are the same on every machine.
class AffineMap {
public:
  using Vector = std::array<double, 3>;
  using Rows = std::array<Vector, 4>;

  /// Leaves points where they are.
  AffineMap() = default;
  explicit AffineMap(const Rows& rows);
  [[nodiscard]] static AffineMap translation(const Vector& by);
  [[nodiscard]] static AffineMap scaling(const Vector& by);
  /// Turns x to y by positive degrees about the axis z. It is nothing where the axis has no
  /// direction.
  [[nodiscard]] static std::optional<AffineMap> rotation(double degrees, const Vector& axis);
  /// Moves points along `to`, so that `from` is turned towards it by so many degrees and points
  /// that are orthogonal to both, or in the direction of `to`, stay. It is nothing where the angle
  /// between the vectors is not larger, or one has no direction.
  [[nodiscard]] static std::optional<AffineMap> skew(double degrees, const Vector& from,
                                                     const Vector& to);

  /// Returns what applies `first` to points, and then `second`.
  friend AffineMap operator*(const AffineMap& first, const AffineMap& second);

  /// Whether all points stay where they are, exactly.
  [[nodiscard]] bool is_identity() const;
  /// Whether it makes left hands of right ones. No promise is made of maps into a plane.
  [[nodiscard]] bool mirrors() const noexcept { return mirrors_; }
  /// Whether doubles can hold its numbers.
  [[nodiscard]] bool is_finite() const;
  /// Returns a bound on how much longer distances become.
  [[nodiscard]] double stretch() const;
  /// Moves a point x y z, or wx wy wz of the weight w. Returns a bound on how far it is from where
  /// it should be; it may be infinite or nan where the point is.
  double move(double* point, double weight) const;

private:
  AffineMap(const Rows& rows, double error, bool mirrors);

  Rows rows_ = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};
  Rows errors_ = {}; // of each number, at most
  bool mirrors_ = false;
};

} // namespace simdbezier::tools
