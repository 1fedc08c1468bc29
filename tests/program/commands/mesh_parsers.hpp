// Small parsers of what the program writes, independent of its writers.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/support/nets/net.hpp"

namespace simdbezier::tests {

struct ParsedMesh {
  std::vector<Vector3> positions;
  std::vector<Vector3> normals;                      ///< as many as positions, or none
  std::vector<std::array<std::size_t, 3>> triangles; ///< from 0
  std::string scalar;                                ///< PLY: the property type; OBJ: empty
};

/// A mesh with nothing in it, and a test failure, where the text is not what the format demands.
[[nodiscard]] ParsedMesh parse_obj(const std::string& text);
[[nodiscard]] ParsedMesh parse_ply(const std::string& bytes);

struct ParsedCsv {
  std::string header;
  std::vector<std::vector<double>> rows;
};

/// Every line must have as many fields as the header.
[[nodiscard]] ParsedCsv parse_csv(const std::string& text);

} // namespace simdbezier::tests
