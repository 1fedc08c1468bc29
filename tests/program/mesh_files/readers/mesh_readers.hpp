// Readers of mesh files for tests: written from the formats' descriptions, without the writers.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace simdbezier::tests {

struct ReadMesh {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<double, 3>> normals;
  std::vector<std::array<double, 2>> uv;
  std::vector<double> patches;
  std::vector<std::vector<std::uint32_t>> faces;
  std::optional<double> deviation;
  std::string generator;
  std::string position_type; ///< as the format calls it
  std::string index_type;
  /// Where positions count from, as a comment or header says it.
  std::optional<std::array<double, 3>> origin;
  /// GLB: what the node says, and 1 and 0 where it says nothing.
  double scale = 1;
  std::array<double, 3> translation = {};
  bool quantised = false; ///< GLB: positions are whole numbers, 65535 stands for 1
  /// VTU: all other arrays by their names, their types and their numbers of components, what
  /// PointData and CellData say of them, and the types of the cells.
  std::map<std::string, std::vector<double>> data;
  std::map<std::string, std::string> data_types;
  std::map<std::string, std::size_t> data_components;
  std::map<std::string, std::string> attributes;
  std::vector<double> cell_types;
};

/// The three numbers behind a word in a text; nothing where it is not there.
[[nodiscard]] inline std::optional<std::array<double, 3>> origin_behind(const std::string& text,
                                                                        const std::string& word) {
  const std::size_t at = text.find(word);
  if (at == std::string::npos) {
    return std::nullopt;
  }
  std::array<double, 3> point{};
  const char* rest = text.c_str() + at + word.size();
  for (double& value : point) {
    char* end = nullptr;
    value = std::strtod(rest, &end);
    rest = end;
  }
  return point;
}

/// Test failures, and whatever was read before, where the file is not what the format demands.
[[nodiscard]] ReadMesh read_obj_mesh(const std::string& bytes);
[[nodiscard]] ReadMesh read_ply_mesh(const std::string& bytes);
/// Positions are the corners of the facets, three each, and normals one a facet.
[[nodiscard]] ReadMesh read_stl_mesh(const std::string& bytes);
[[nodiscard]] ReadMesh read_glb_mesh(const std::string& bytes);
[[nodiscard]] ReadMesh read_vtu_mesh(const std::string& bytes);
[[nodiscard]] ReadMesh read_raw_mesh(const std::string& bytes);
/// The one of these that a file's extension names.
[[nodiscard]] inline ReadMesh read_mesh(const std::string& extension, const std::string& bytes) {
  return extension == "obj"   ? read_obj_mesh(bytes)
         : extension == "ply" ? read_ply_mesh(bytes)
         : extension == "stl" ? read_stl_mesh(bytes)
         : extension == "vtu" ? read_vtu_mesh(bytes)
         : extension == "raw" ? read_raw_mesh(bytes)
                              : read_glb_mesh(bytes);
}

} // namespace simdbezier::tests
