// The entity types of IGES 5.3 by what the reader does with them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>

namespace simdbezier::tools {

enum IgesType : std::uint32_t {
  iges_circular_arc = 100,
  iges_composite_curve = 102,
  iges_path = 106,
  iges_plane = 108,
  iges_line = 110,
  iges_parametric_surface = 114,
  iges_matrix = 124,
  iges_spline_curve = 126,
  iges_spline_surface = 128,
  iges_boundary = 141,
  iges_curve_on_surface = 142,
  iges_bounded_surface = 143,
  iges_trimmed_surface = 144,
  iges_solid = 186,
  iges_subfigure = 308,
  iges_group = 402,
  iges_instance = 408,
  iges_loop = 508,
  iges_face = 510,
  iges_shell = 514
};

/// These are no surfaces: points, curves, annotations, definitions and properties.
inline constexpr std::uint32_t kIgesPassedOver[] = {
    0,   100, 102, 104, 106, 110, 112, 116, 123, 124, 125, 126, 130, 132, 141, 142,
    202, 204, 206, 208, 210, 212, 213, 214, 216, 218, 220, 222, 228, 230, 302, 304,
    308, 310, 312, 314, 316, 320, 322, 402, 404, 406, 410, 422, 502, 504, 508};

/// These are surfaces and solids, or bring some in.
struct IgesOther {
  std::uint32_t type;
  const char* what;
};
inline constexpr IgesOther kIgesOthers[] = {{108, "a plane"},
                                            {118, "a ruled surface"},
                                            {120, "a surface of revolution"},
                                            {122, "a tabulated cylinder"},
                                            {134, "a node"},
                                            {136, "a finite element"},
                                            {140, "an offset surface"},
                                            {143, "a bounded surface"},
                                            {144, "a trimmed surface"},
                                            {150, "a block"},
                                            {152, "a wedge"},
                                            {154, "a cylinder"},
                                            {156, "a cone"},
                                            {158, "a sphere"},
                                            {160, "a torus"},
                                            {162, "a solid of revolution"},
                                            {164, "a solid of extrusion"},
                                            {168, "an ellipsoid"},
                                            {180, "a Boolean tree"},
                                            {182, "a selected component"},
                                            {184, "an assembly of solids"},
                                            {186, "a solid"},
                                            {190, "a plane"},
                                            {192, "a cylinder"},
                                            {194, "a cone"},
                                            {196, "a sphere"},
                                            {198, "a torus"},
                                            {412, "a rectangular array"},
                                            {414, "a circular array"},
                                            {416, "another file"},
                                            {420, "a network"},
                                            {430, "a solid"},
                                            {510, "a face of a solid"},
                                            {514, "a shell of a solid"}};

/// Returns "entity 118 (a ruled surface)".
[[nodiscard]] inline std::string describe_iges_type(std::uint32_t type) {
  const auto* const found = std::ranges::find(kIgesOthers, type, &IgesOther::type);
  const std::string what =
      found == std::end(kIgesOthers) ? "" : " (" + std::string(found->what) + ")";
  return "entity " + std::to_string(type) + what;
}

} // namespace simdbezier::tools
