// Control nets of a patch's second derivatives, over its quarters.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include <simdbezier/control_nets.hpp>

#include "src/mesh/rates/chord_bound.hpp"
#include "src/mesh/rates/power_of_two.hpp"
#include "src/tables/vector_sizes.hpp"

namespace simdbezier::detail {

/// A control vector: of a polynomial patch, or of w (P - c) and w of a rational one. Operations
/// name pairs of components, which g++ 12 does not find by itself.
struct ControlVector {
  alignas(16) double x[4];

  friend ControlVector operator+(const ControlVector& a, const ControlVector& b) {
    return {a.pair(0) + b.pair(0), a.pair(2) + b.pair(2)};
  }
  friend ControlVector operator-(const ControlVector& a, const ControlVector& b) {
    return {a.pair(0) - b.pair(0), a.pair(2) - b.pair(2)};
  }
  friend ControlVector operator*(double s, const ControlVector& a) {
    return {s * a.pair(0), s * a.pair(2)};
  }

  ControlVector() = default;

private:
  typedef double Pair __attribute__((vector_size(16)));

  ControlVector(Pair low, Pair high) {
    std::memcpy(x, &low, sizeof low);
    std::memcpy(x + 2, &high, sizeof high);
  }
  [[nodiscard]] Pair pair(std::size_t first) const {
    Pair two;
    std::memcpy(&two, x + first, sizeof two);
    return two;
  }
};

/// A net of control vectors, [j][i] as in ControlNets. Rows are as far apart as the patch's, so
/// that a net of less degree can be raised where it stands; what lies between them is undefined.
struct VectorNet {
  std::size_t columns = 0; ///< degree in u, plus 1
  std::size_t rows = 0;
  std::size_t stride = 0;
  std::vector<ControlVector> at;

  /// Takes the sizes of a net that fills its rows; values are undefined.
  void resize(std::size_t new_columns, std::size_t new_rows) {
    columns = new_columns;
    rows = new_rows;
    stride = new_columns;
    at.resize(columns * rows);
  }
  /// Takes the sizes of a net, and room for as many vectors as it has.
  void shape_like(const VectorNet& net) {
    columns = net.columns;
    rows = net.rows;
    stride = net.stride;
    at.resize(net.at.size());
  }
  [[nodiscard]] ControlVector& operator()(std::size_t i, std::size_t j) {
    return at[j * stride + i];
  }
  [[nodiscard]] const ControlVector& operator()(std::size_t i, std::size_t j) const {
    return at[j * stride + i];
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
  /// Values are those given over this: the largest is between 1 and 2, so that squares neither
  /// overflow nor vanish. So is the largest weight, by a power that need not be known.
  PowerOfTwo scale;

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

/// The parts over [0, 1/2] and [1/2, 1] in one direction, by the same algorithm.
void halve_net(const VectorNet& net, bool in_u, VectorNet& low, VectorNet& high);

/// Raises both degrees, to at most those of the patch.
void raise_net(VectorNet& net, std::size_t columns, std::size_t rows);

/// Raises the nets to the degrees of a patch.
void raise_all(SecondNets& nets, const VectorNet& like);

/// The vectors of a net as kernels read them.
class VectorPlanes {
public:
  void read(const VectorNet& net);
  [[nodiscard]] VectorList list() const { return {values_.data(), stride_, stride_}; }

private:
  std::vector<double> values_; ///< [component][vector]
  std::size_t stride_ = 0;
};

} // namespace simdbezier::detail
