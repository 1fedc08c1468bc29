// The surfaces of IGES files as splines with knots, and where transformations put them.
#pragma once

#include <cstddef>
#include <string>

#include <tools/formats/iges/records.hpp>
#include <tools/formats/surfaces/affine_map.hpp>
#include <tools/formats/surfaces/file_spline.hpp>

namespace simdbezier::tools {

struct IgesSurface {
  FileSpline spline;
  double error = 0; ///< how far its points may be from where the file says
};

/// Reads entity 128, a B-spline surface, or 114, a surface of bicubic polynomials. The latter is a
/// spline each of whose knots occurs four times.
[[nodiscard]] IgesSurface read_iges_surface(IgesRecords& records, std::size_t entity);

/// Returns where the entity's transformation puts its coordinates: that may have one itself.
[[nodiscard]] AffineMap iges_map(IgesRecords& records, std::size_t entity);

/// Moves a surface, and turns it around where `turned` says so. Where one of both mirrors it, u and
/// v are exchanged, so that normals point to the side that the file means. Throws Failure where a
/// point is not finite then.
void move_surface(IgesSurface& surface, const AffineMap& map, bool turned, const std::string& name);

} // namespace simdbezier::tools
