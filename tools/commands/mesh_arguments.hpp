// What the command line says about a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>

#include <simdbezier/simdbezier.hpp>
#include <tools/commands/command_line.hpp>
#include <tools/mesh_files/mesh_file.hpp>
#include <tools/patches/grid_blocks.hpp>

namespace simdbezier::tools {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

enum class StatsForm : std::uint8_t { none, text, json };

struct MeshArguments {
  MeshFormat format = MeshFormat::obj;
  VertexStorage storage = VertexStorage::full;
  bool weld = true;
  bool normals = true;
  bool parameters = false; ///< u, v of every vertex, and its patch in formats with point data
  bool curvature = false;
  bool bezier_cells = false; ///< the patches themselves instead of triangles
  bool flip = false;
  bool quads = false;
  bool orient = false;
  bool drop_repeated = false;
  double snap = 0;
  double point_size = 0;
  bool own_origin = false; ///< the file's middle becomes the origin
  std::optional<std::array<double, 3>> origin;
  bool can_move = true; ///< whether there is an --origin that messages can advise
  bool floats = false;  ///< see MeshContents
  bool split_edges = false;
  std::optional<double> crease; ///< in degrees
  StatsForm stats = StatsForm::none;

  /// These say how fine the mesh is. Without any of them, every patch has the samples of a grid.
  std::optional<double> tolerance;
  std::optional<double> relative;
  std::optional<double> pixels;
  std::optional<double> angle; ///< in degrees
  Camera camera;
  bool thorough = false; ///< a search for fewer triangles, see RateOptions

  [[nodiscard]] bool adaptive() const noexcept { return tolerance || relative || pixels || angle; }
};

/// Reads an option that is a number above 0, in its own unit.
[[nodiscard]] std::optional<double> positive(const Words& words, const char* option);

/// Throws Failure: exit code 2 where words are none of ours or contradict each other, and 1 where a
/// number cannot be what it is for.
[[nodiscard]] MeshArguments parse_mesh_arguments(const Words& words);

} // namespace simdbezier::tools
