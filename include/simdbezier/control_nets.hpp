// A view of the caller's control points.
#pragma once

#include <cstddef>

namespace simdbezier {

/// Non-owning description of `count` control nets with equal degrees and three components.
///
///     v ^  P[3][0] P[3][1] P[3][2] P[3][3]      row j runs in v, column i runs in u, u fastest
///       |  P[2][0]    …                         S(u,v) = sum_j sum_i P[j][i] B_i(u) B_j(v)
///       |  P[1][0]    …
///       |  P[0][0] P[0][1] P[0][2] P[0][3]
///       +--------------------------------> u
///
/// Component c of point P[j][i] of patch p is
///     points[p * patch_stride + j * row_stride + i * point_stride + c * component_stride]
/// with all strides in elements of S. The default describes x y z triples, packed, patch after
/// patch, which is the order of `.bez` and `.bpt` files. The memory is read during pack() only.
template <typename S>
struct ControlNets {
  const S* points = nullptr; ///< may be null only when count is 0
  std::size_t count = 0;     ///< number of patches
  int degree_u = 3;          ///< degree along a row
  int degree_v = 3;          ///< degree across rows
  std::ptrdiff_t patch_stride = 48;
  std::ptrdiff_t row_stride = 12;
  std::ptrdiff_t point_stride = 3;
  std::ptrdiff_t component_stride = 1;
};

} // namespace simdbezier
