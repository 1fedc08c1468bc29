// Points with Cartesian weights, as OBJ and IGES files have them.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

/// Throws Failure with that place unless the weight w of x y z w is above 0 and its products with
/// x, y and z are finite.
inline void check_cartesian_point(const std::string& name, std::size_t line,
                                  std::span<const double, 4> point) {
  if (point[3] <= 0) {
    bad_input_at(name, line, "a weight above 0", shortest(point[3]));
  }
  for (const double coordinate : point.first<3>()) {
    if (!std::isfinite(coordinate * point[3])) {
      bad_input_at(name, line, "coordinates that are finite when multiplied by their weight",
                   shortest(coordinate) + " * " + shortest(point[3]));
    }
  }
}

} // namespace simdbezier::tools
