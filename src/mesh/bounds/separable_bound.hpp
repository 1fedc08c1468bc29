// Second derivatives of rational patches whose weights are products of one factor for each column
// and one for each row: all cylinders, cones, spheres and tori, and whatever else is turned or
// drawn along a curve.
#pragma once

#include "src/mesh/bounds/bound_parts.hpp"
#include "src/mesh/bounds/vector_patch.hpp"

namespace simdbezier::detail {

/// Bounds on the lengths of a patch's second derivatives in space, and on what its triangles are
/// off besides, since weights are products but for rounding. All are infinite where they are none.
///
/// The bound of group_bound.hpp compares a sample with the point of its triangle that has the same
/// place among weighted corners. Where weights vary along u and points move along v, that point
/// slides along v: by as much as 1 / (nu nv), on a cylinder, whose triangles are far closer to it.
/// Derivatives in space know nothing of such a slide.
struct SeparableBound {
  double uu;
  double uv;
  double vv;
  double off;

  /// A bound on the distance of all triangles in cells of these numbers, in the patch's own scale.
  [[nodiscard]] double at(const CellCounts& cells) const;
};

SeparableBound bound_separable(const VectorPatch& patch);

} // namespace simdbezier::detail
