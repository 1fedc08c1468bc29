// One patch, as far as bounds on its triangles are concerned.
#pragma once

#include <cstddef>
#include <vector>

#include <simdbezier/control_nets.hpp>

#include "src/mesh/bounds/power_of_two.hpp"

namespace simdbezier::detail {

/// A control vector: x, y, z and 1 of a polynomial patch, or w x, w y, w z and w of a rational one.
struct ControlVector {
  double x[4];

  friend ControlVector operator-(const ControlVector& a, const ControlVector& b) {
    return {{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2], a.x[3] - b.x[3]}};
  }
};

/// A net of control vectors, [j][i] as in ControlNets.
struct VectorNet {
  std::size_t columns = 0; ///< degree in u, plus 1
  std::size_t rows = 0;
  std::vector<ControlVector> at;

  /// Takes the sizes of a net; values are undefined.
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

/// Control points around the middle of their box, weighted where the patch is rational.
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

  /// Takes the place of a patch that could not be read.
  void shrink_to_point();

  /// A bound in the patch's own scale as one in space, rounded up.
  [[nodiscard]] double in_space(double bound) const;
};

} // namespace simdbezier::detail
