// Files for the readers, and what is in them: three patches whose control points are all different,
// so that no exchange of u and v, rows and columns, or weights goes unnoticed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tests {

/// One control point with its weight.
struct WeightedPoint {
  double x, y, z, w;
  bool operator==(const WeightedPoint&) const = default;
};

/// A patch as a test expects it: point(i, j), i in u, j in v, in Cartesian coordinates.
struct ExpectedPatch {
  int degree_u;
  int degree_v;
  bool rational;
  WeightedPoint (*point)(int i, int j);
};

/// The points of the sample files.
[[nodiscard]] inline WeightedPoint tall_point(int i, int j) {
  return {10.0 * i + j, i - 7.0 * j, i * j + 0.25 * i * i, 1};
}
[[nodiscard]] inline WeightedPoint weighted_point(int i, int j) {
  const double weight = (i == 0 ? 1.0 : 2.0) / (1 << j);
  return {i + 0.5 * j, 3.0 * j - i, 2.0 * i * j + 1, weight};
}
[[nodiscard]] inline WeightedPoint plain_point(int i, int j) {
  return {1.0 * i, 100.0 * j, 5.0 * i - 3.0 * j, 1};
}
/// Column i + 3 of the first: the second patch of a mesh.
[[nodiscard]] inline WeightedPoint next_tall_point(int i, int j) { return tall_point(i + 3, j); }

/// What sample.NAME holds, patch by patch.
[[nodiscard]] inline std::vector<ExpectedPatch> sample_patches(const std::string& name) {
  if (name == "rib") { // knows degrees 1 and 3 only
    return {{3, 3, false, tall_point},
            {3, 3, false, next_tall_point},
            {1, 1, true, weighted_point},
            {1, 1, false, plain_point}};
  }
  return {
      {3, 2, false, tall_point}, {1, 2, name != "bpt", weighted_point}, {1, 1, false, plain_point}};
}

[[nodiscard]] inline std::string sample_path(const std::string& name) {
  return std::string(SIMDBEZIER_TEST_DATA) + "/sample." + name;
}

inline constexpr const char* kSampleFormats[] = {"bpt", "bv", "iges", "itd", "obj", "rib"};

/// The control points that a file's nets describe, Cartesian: row after row, patch by patch.
[[nodiscard]] std::vector<WeightedPoint> patch_points(const tools::PatchFile& file,
                                                      std::size_t patch);
[[nodiscard]] std::vector<WeightedPoint> expected_points(const ExpectedPatch& patch);

/// Reads text in a format, through a file.
[[nodiscard]] tools::PatchFile read_text(const std::string& format, const std::string& text);
/// The message with which a reader refuses text, less the file's name; empty where it takes it.
[[nodiscard]] std::string refusal(const std::string& format, const std::string& text);

/// The text with one part of it, which must be there, replaced.
[[nodiscard]] std::string replaced(std::string text, const std::string& from,
                                   const std::string& to);
/// The text with other line ends than \n.
[[nodiscard]] std::string with_line_ends(const std::string& text, const std::string& end);

} // namespace simdbezier::tests
