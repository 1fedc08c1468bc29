// Surfaces of OBJ files in all of the format's bases.
// Source: Wavefront, Advanced Visualizer, appendix B1, Object Files, version 3.0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tools/formats/patch_file.hpp>
#include <tools/formats/surfaces/basis_mesh.hpp>
#include <tools/process/counts.hpp>

namespace simdbezier::tools {

enum class ObjType : std::uint8_t { bezier, bmatrix, bspline, cardinal, taylor };
inline constexpr std::string_view kObjTypes[] = {"bezier", "bmatrix", "bspline", "cardinal",
                                                 "taylor"};

/// What holds for one direction of all surfaces until it is replaced.
struct ObjBasis {
  int degree = 0;             ///< 0 until it is given
  std::size_t step = 0;       ///< of bmatrix; 0 until it is given
  std::vector<double> matrix; ///< of bmatrix; row i has value i's factors of 1, t, t^2 …
};

/// One direction of a surface as its statements give it.
struct ObjDirection {
  int degree = 0;
  std::size_t step = 0; ///< from the first value of a piece to that of the next one; not of bspline
  std::shared_ptr<const BasisMatrix> basis; ///< null: bezier and bspline
  Interval range = {};
  std::vector<double> parameters; ///< of parm: break points, or knots of bspline; none before it

  /// Returns how many values there have to be.
  [[nodiscard]] Count points(ObjType type) const;
  /// Returns the direction as a spline with knots; of bezier and bspline.
  [[nodiscard]] SplineDirection spline(ObjType type) const;
  /// Returns whether the range is that of all parameters; not of bspline.
  [[nodiscard]] bool is_whole() const {
    return range == Interval{parameters.front(), parameters.back()};
  }
};

struct ObjSurface {
  std::size_t line = 0;
  ObjType type = ObjType::bezier;
  bool rational = false;
  ObjDirection u;
  ObjDirection v;
  std::vector<std::uint32_t> vertices;

  /// Whether its values are Bézier points, and all of them count.
  [[nodiscard]] bool has_bezier_points() const {
    return type == ObjType::bezier && u.is_whole() && v.is_whole();
  }
};

/// Returns the step and the basis of a direction, of which all has been given.
[[nodiscard]] ObjDirection obj_direction(ObjType type, const ObjBasis& basis);

/// Adds the patches of a surface, of which the file has all vertices. Throws Failure where they
/// are no patches.
void close_obj_surface(PatchFile& file, const ObjSurface& surface);

} // namespace simdbezier::tools
