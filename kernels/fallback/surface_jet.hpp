// A patch's derivatives in double, straight from its control points: for samples that deserve a
// second look. Unvectorised, and the same on every machine.
#pragma once

#include <cstddef>

#include "kernels/given_points.hpp"
#include "kernels/net_shape.hpp"

namespace simdbezier::detail {

struct Vector { // not initialised, because a frame has many
  double x;
  double y;
  double z;

  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};

Vector cross(Vector a, Vector b);
double squared_length(Vector a);
double length(Vector a);
double max_norm(Vector a);

/// A patch in space moved to its first control point and scaled by powers of two, so that it is of
/// size about 1 and that each hodograph is, too.
class SurfaceFrame {
public:
  SurfaceFrame(const NetShape& shape, const GivenNet& net);

  [[nodiscard]] bool rational() const { return rational_; }
  [[nodiscard]] std::size_t degree_u() const { return degree_u_; }
  [[nodiscard]] std::size_t degree_v() const { return degree_v_; }
  [[nodiscard]] const Vector& point(std::size_t j, std::size_t i) const {
    return points_[j * (degree_u_ + 1) + i];
  }
  [[nodiscard]] double weight(std::size_t j, std::size_t i) const {
    return weights_[j * (degree_u_ + 1) + i];
  }

  double scale = 1; ///< of the points
  /// What |du| and |dv| of the scaled points are like: for polynomials the largest of
  /// m |P[j][i+1] - P[j][i]|, which is a bound.
  double size_u = 0;
  double size_v = 0;
  double scale_u = 1; ///< 2^-ilogb(size_u)
  double scale_v = 1;

  /// What the errors of du, as a multiple of the unit roundoff, are relative to: of the kernels',
  /// whose numerators are as large as the patch is far from the origin and which sum weights up in
  /// powers (pack/shape_floor.hpp), or of jets, where all that is summed is weighted by Bernstein
  /// values and so relative to the weight at the sample. In units of 1 / scale_u.
  struct ErrorSizes {
    double u;
    double v;
  };
  [[nodiscard]] ErrorSizes kernel_errors(double weight) const {
    return errors(weight, 4 * distance_, heaviest_ / weight);
  }
  [[nodiscard]] ErrorSizes jet_errors(double weight) const {
    return errors(weight, 2 * extent_, 1);
  }

private:
  void measure();
  void measure_pair(std::size_t a, std::size_t b, double& size, double& step, double& turn) const;
  [[nodiscard]] ErrorSizes errors(double weight, double reach, double factor) const;

  std::size_t degree_u_;
  std::size_t degree_v_;
  bool rational_;
  double distance_ = 0; ///< largest |P|, scaled
  double extent_ = 0;   ///< largest |P - P[0][0]|, scaled
  double heaviest_ = 1; ///< weight, scaled
  // Of neighbours in rational nets: see pack/shape_floor.hpp.
  double step_u_ = 0; ///< largest max(w, w') |P' - P|
  double step_v_ = 0;
  double turn_u_ = 0; ///< largest |w' - w|
  double turn_v_ = 0;
  Vector points_[kMostOrder * kMostOrder];
  double weights_[kMostOrder * kMostOrder]; ///< scaled; rational nets only
};

/// First and second derivatives, scaled so that both hodographs have size 1..2: u and uu by
/// scale_u, v and vv by scale_v.
struct SurfaceJet {
  Vector u{};
  Vector v{};
  Vector uu{};
  Vector uv{};
  Vector vv{};
  double weight = 1;
};

/// At half-centred parameters. First derivatives are formed from differences of control points:
/// where these are equal, the tangent is exactly zero.
SurfaceJet surface_jet(const SurfaceFrame& frame, double x, double y);

/// The weight alone.
double surface_weight(const SurfaceFrame& frame, double x, double y);

} // namespace simdbezier::detail
