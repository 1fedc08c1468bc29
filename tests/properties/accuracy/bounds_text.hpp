// The table of bounds as docs/accuracy.md has it.
#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/properties/accuracy/judge/shape_bounds.hpp"

#ifndef SIMDBEZIER_ACCURACY_PAGE
#error "the build defines SIMDBEZIER_ACCURACY_PAGE, the file docs/accuracy.md"
#endif

namespace simdbezier::tests {

[[nodiscard]] inline std::string rounded_up(double bound) {
  char text[16];
  std::snprintf(text, sizeof text, "%.0f", std::ceil(bound));
  return text;
}

/// | first | and a bound in each further column.
[[nodiscard]] inline std::string table_line(std::string first,
                                            std::initializer_list<double> bounds) {
  std::string line = "| ";
  line += first;
  for (const double bound : bounds) {
    line += " | ";
    line += rounded_up(bound);
  }
  line += " |\n";
  return line;
}

/// All quantities of n x n, then positions of m x n.
[[nodiscard]] inline std::string bounds_text() {
  std::string text = "| n × n | P | du | dv | duu | duv | dvv | P, no FMA | du | dv |\n"
                     "|---|---|---|---|---|---|---|---|---|---|\n";
  for (int n = 1; n <= 15; ++n) {
    const ShapeBounds a = shape_bounds(n, n, true);
    const ShapeBounds b = shape_bounds(n, n, false);
    text += table_line(std::to_string(n),
                       {a.position, a.du, a.dv, a.duu, a.duv, a.dvv, b.position, b.du, b.dv});
  }
  text += "\nPositions of m × n, m along a row (u), with FMA:\n\n| m \\ n |";
  std::string line = "|---|";
  for (int n = 1; n <= 15; ++n) {
    text += " ";
    text += std::to_string(n);
    text += " |";
    line += "---|";
  }
  text += "\n";
  text += line;
  text += "\n";
  for (int m = 1; m <= 15; ++m) {
    text += "| **";
    text += std::to_string(m);
    text += "**";
    for (int n = 1; n <= 15; ++n) {
      text += " | ";
      text += rounded_up(shape_bounds(m, n, true).position);
    }
    text += " |\n";
  }
  return text;
}

[[nodiscard]] inline std::string documentation() {
  std::ifstream file(SIMDBEZIER_ACCURACY_PAGE, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace simdbezier::tests
