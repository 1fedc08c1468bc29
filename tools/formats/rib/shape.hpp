// A surface of a RIB file on its way to its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <tools/formats/patch_file.hpp>
#include <tools/formats/rib/bases.hpp>
#include <tools/formats/surfaces/affine_map.hpp>
#include <tools/formats/surfaces/file_spline.hpp>

namespace simdbezier::tools {

struct RibDirection {
  MeshDirection mesh;                                   ///< of Patch and PatchMesh
  RibBasis basis;                                       ///< of bicubic ones
  std::optional<SplineDirection> spline = std::nullopt; ///< of NuPatch
};

/// A surface, less its points.
struct RibShape {
  std::size_t line = 0; ///< of its request
  int degree = 3;       ///< of Patch and PatchMesh
  Weights weights = Weights::none;
  RibDirection u;
  RibDirection v;
  AffineMap map;           ///< to the space of the world, or of its object
  bool is_inside = false;  ///< whether its normals are to point to the other side
  bool is_widened = false; ///< whether a TrimCurve is ignored

  [[nodiscard]] bool is_spline() const noexcept { return u.spline.has_value(); }
  [[nodiscard]] bool has_bezier_points() const noexcept {
    return !is_spline() && !u.basis.matrix && !v.basis.matrix;
  }
  [[nodiscard]] std::size_t points() const noexcept {
    return is_spline() ? u.spline->points * v.spline->points : u.mesh.points * v.mesh.points;
  }
};

/// Makes patches of a shape, of which the file has the points already, as they stand in the RIB
/// file: they are its last ones. Where the map mirrors, the normals' side is kept; where the other
/// side is asked for, u and v are exchanged.
void close_rib_shape(PatchFile& file, const RibShape& shape);

/// The shapes of an object, with their points.
class RibObject {
public:
  /// Takes the file's last points.
  void take(PatchFile& file, RibShape shape);
  [[nodiscard]] std::size_t points() const noexcept { return lines_.size(); }
  /// Calls visit(shape) for each shape in its place, whose points are the file's last ones then.
  template <typename Visit>
  void show(PatchFile& file, const AffineMap& map, bool is_inside, const Visit& visit) const {
    auto point = points_.begin();
    auto line = lines_.begin();
    for (RibShape shape : shapes_) {
      const auto count = static_cast<std::ptrdiff_t>(shape.points());
      const std::ptrdiff_t values = count * (shape.weights == Weights::none ? 3 : 4);
      file.points.insert(file.points.end(), point, point + values);
      file.lines.insert(file.lines.end(), line, line + count);
      point += values;
      line += count;
      shape.map = shape.map * map;
      shape.is_inside = shape.is_inside != is_inside;
      visit(shape);
    }
  }

private:
  std::vector<RibShape> shapes_;
  std::vector<double> points_;
  std::vector<std::uint32_t> lines_;
};

} // namespace simdbezier::tools
