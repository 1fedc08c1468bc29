// One patch, as far as bounds on its triangles are concerned, and the one of its eight orientations
// in which it is looked at, so that results of a search do not depend on how it is given.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <simdbezier/control_nets.hpp>

#include "src/mesh/bounds/bound_parts.hpp"

namespace simdbezier::detail {

/// A power of two. Products are rounded only where they are below the smallest normal number, once.
class PowerOfTwo {
public:
  PowerOfTwo() = default;
  explicit PowerOfTwo(int exponent)
      : exponent_(exponent),
        factor_(exponent >= kLeast && exponent <= kMost ? std::scalbn(1.0, exponent) : 0) {}

  [[nodiscard]] PowerOfTwo inverse() const { return PowerOfTwo(-exponent_); }

  friend double operator*(double a, const PowerOfTwo& b) {
    return b.factor_ != 0 ? a * b.factor_ : std::scalbn(a, b.exponent_);
  }

private:
  static constexpr int kLeast = -1022; ///< of factors that are numbers of full precision
  static constexpr int kMost = 1023;

  int exponent_ = 0;
  double factor_ = 1; ///< 0 where it is none of those
};

/// The one at or below |x| > 0.
inline PowerOfTwo power_of_two_below(double x) { return PowerOfTwo(std::ilogb(x)); }

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

/// A patch's directions are reversed, and then exchanged.
struct PatchTurn {
  bool reversed_u = false;
  bool reversed_v = false;
  bool transposed = false;

  /// That of the smallest sequence of control vectors, among those of no more columns than rows.
  [[nodiscard]] static PatchTurn canonical(const VectorNet& net);

  /// Of the turned net, of the one that is given.
  [[nodiscard]] const ControlVector& at(const VectorNet& net, std::size_t i, std::size_t j) const {
    const std::size_t u = transposed ? j : i;
    const std::size_t v = transposed ? i : j;
    return net(reversed_u ? net.columns - 1 - u : u, reversed_v ? net.rows - 1 - v : v);
  }
  [[nodiscard]] VectorPatch turned(const VectorPatch& patch) const;
  [[nodiscard]] RateFlags turned(RateFlags flags) const;
  /// From the patch to the turned one, and back.
  [[nodiscard]] CellCounts turned(const CellCounts& cells) const {
    return transposed ? CellCounts{cells.nv, cells.nu} : cells;
  }
  /// Whether diagonals that rise in the patch fall in the turned one.
  [[nodiscard]] bool exchanges_diagonals() const { return reversed_u != reversed_v; }
  /// The patch's zone, as in Zone, of one of the turned patch.
  [[nodiscard]] unsigned zone_of(unsigned turned_zone) const;
};

} // namespace simdbezier::detail
