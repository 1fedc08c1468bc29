// Boundaries of IGES surfaces in the plane of their parameters.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <simdbezier/splines.hpp>
#include <tools/formats/iges/records.hpp>

namespace simdbezier::tools {

/// A surface and the curves of its boundary in the plane of parameters.
struct IgesTrimmed {
  std::size_t surface = 0;
  bool known = true;               ///< the curves are the whole boundary
  std::vector<std::size_t> curves; ///< none: that of the whole surface
};

/// Reads entity 143, a bounded surface, 144, a trimmed one, or 510, a face of a solid.
[[nodiscard]] IgesTrimmed read_iges_trimmed(IgesRecords& records, std::size_t entity);

/// Returns the rectangle around which these curves run once, one after the other, along u and
/// along v; nothing where they run otherwise. They may miss it by a millionth of its side. Curves
/// are lines (110), paths (106), B-splines (126), and composites of these (102).
[[nodiscard]] std::optional<PatchInterval> iges_rectangle(IgesRecords& records,
                                                          const std::vector<std::size_t>& curves);

} // namespace simdbezier::tools
