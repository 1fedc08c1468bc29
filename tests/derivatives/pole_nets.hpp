// Rational nets with a side that is one point, on every side, with every form of weights. Their
// values have few bits: as floats and in homogeneous form they are what they are in double.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <vector>

#include "tests/support/nets/shape_nets.hpp"

namespace simdbezier::tests {

/// Sides: v = 0, v = 1, u = 0, u = 1.
struct PoleCase {
  ShapeCase shape;
  int side;
  bool equal_weights; ///< all 2; else between 1/2 and 2
  double distance;    ///< from the origin, in every coordinate

  [[nodiscard]] bool along_u() const { return side < 2; }
  [[nodiscard]] bool on_side(int j, int i) const {
    const int end_u = side % 2 == 0 ? 0 : shape.degree_u;
    const int end_v = side % 2 == 0 ? 0 : shape.degree_v;
    return along_u() ? j == end_v : i == end_u;
  }
};

inline std::ostream& operator<<(std::ostream& out, const PoleCase& c) {
  return out << c.shape << ", side " << c.side << (c.equal_weights ? ", equal weights" : "")
             << ", distance " << c.distance;
}

/// One net, packed as ShapeCase says.
[[nodiscard]] inline std::vector<double> pole_values(const PoleCase& c, std::uint64_t seed) {
  Random random(seed);
  const auto components = static_cast<std::size_t>(c.shape.components);
  std::vector<double> pole;
  for (std::size_t k = 0; k < components; ++k) {
    pole.push_back(c.distance + random.integer(-8, 8) / 8.0);
  }
  std::vector<double> values;
  for (int j = 0; j <= c.shape.degree_v; ++j) {
    for (int i = 0; i <= c.shape.degree_u; ++i) {
      const double weight = c.equal_weights ? 2 : random.integer(32, 128) / 64.0;
      for (std::size_t k = 0; k < components; ++k) {
        const double other = c.distance + random.integer(-8, 8) / 8.0;
        const double point = c.on_side(j, i) ? pole[k] : other;
        values.push_back(c.shape.weights == Weights::homogeneous ? point * weight : point);
      }
      values.push_back(weight);
    }
  }
  return values;
}

/// Returns the net's values moved by -shift, which must not round.
[[nodiscard]] inline std::vector<double>
moved_values(const ShapeCase& c, std::vector<double> values, const double (&shift)[3]) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t channel = k % c.channels();
    if (channel < 3 && channel + 1 < c.channels()) {
      const double weight = values[k - channel + c.channels() - 1];
      values[k] -= c.weights == Weights::homogeneous ? shift[channel] * weight : shift[channel];
    }
  }
  return values;
}

} // namespace simdbezier::tests
