// Control nets of a patch's second derivatives, over its quarters.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <simdbezier/control_nets.hpp>

#include "src/mesh/rates/chord_bound.hpp"

namespace simdbezier::detail {

/// A control vector: of a polynomial patch, or of w (P - c) and w of a rational one.
struct ControlVector {
  double x[4];

  friend ControlVector operator+(const ControlVector& a, const ControlVector& b) {
    return {a.x[0] + b.x[0], a.x[1] + b.x[1], a.x[2] + b.x[2], a.x[3] + b.x[3]};
  }
  friend ControlVector operator-(const ControlVector& a, const ControlVector& b) {
    return {a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2], a.x[3] - b.x[3]};
  }
  friend ControlVector operator*(double s, const ControlVector& a) {
    return {s * a.x[0], s * a.x[1], s * a.x[2], s * a.x[3]};
  }
};

/// A net of control vectors, [j][i] as in ControlNets.
struct VectorNet {
  std::size_t columns = 0; ///< degree in u, plus 1
  std::size_t rows = 0;
  std::vector<ControlVector> at;

  void resize(std::size_t new_columns, std::size_t new_rows) {
    columns = new_columns;
    rows = new_rows;
    at.resize(columns * rows);
  }
  [[nodiscard]] ControlVector& operator()(std::size_t i, std::size_t j) {
    return at[j * columns + i];
  }
  [[nodiscard]] const ControlVector& operator()(std::size_t i, std::size_t j) const {
    return at[j * columns + i];
  }
};

/// A box that holds a part of the surface, and the smallest of its weights. Distances from points
/// of a rational surface S = X / w are bounded by the vectors v of X - q w, with q in the box: with
/// its middle c and its half-diagonal R, |v_X - q v_w| <= |v_X - c v_w| + R |v_w|.
struct Hull {
  double middle[3] = {0, 0, 0};
  double radius = 0;
  double smallest_weight = 1;

  [[nodiscard]] double size(const ControlVector& v) const {
    const double x = v.x[0] - middle[0] * v.x[3];
    const double y = v.x[1] - middle[1] * v.x[3];
    const double z = v.x[2] - middle[2] * v.x[3];
    return std::sqrt(x * x + y * y + z * z) + radius * std::fabs(v.x[3]);
  }
};

/// Grows around points, and then is a Hull.
class HullBox {
public:
  /// The projected points and the weights of a net.
  void include(const VectorNet& net);
  void include(const HullBox& other);
  [[nodiscard]] Hull hull() const;

private:
  double low_[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high_[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  double smallest_weight_ = HUGE_VAL;
};

/// One patch, as far as bounds on its triangles are concerned: control points around the middle of
/// their box, weighted where it is rational.
struct VectorPatch {
  VectorNet net;
  bool rational = false;
  double largest = 0; ///< of all values, for rounding
  /// Values are those given over two to this power: the largest is between 1 and 2, so that squares
  /// neither overflow nor vanish. So is the largest weight, by a power that need not be known.
  int exponent = 0;

  /// Reads a patch: false where a value is not finite, or a weight not positive.
  template <typename S>
  [[nodiscard]] bool read(const ControlNets<S>& nets, std::size_t patch);
};

/// The three second derivatives.
struct SecondNets {
  VectorNet uu;
  VectorNet uv;
  VectorNet vv;
};

/// The second derivatives of a net of any degrees: a net of one zero where a derivative vanishes.
void form_second_nets(const VectorNet& net, SecondNets& to);

/// The part of a net over [t, 1] (keep_high) or [0, t] in one direction, by de Casteljau's
/// algorithm.
void cut_net(VectorNet& net, bool in_u, double t, bool keep_high);

/// Raises both degrees.
void raise_net(VectorNet& net, std::size_t columns, std::size_t rows);

} // namespace simdbezier::detail
