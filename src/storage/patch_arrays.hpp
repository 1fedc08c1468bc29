// Packed patches as kernels read them.
#pragma once

#include "src/storage/given_points.hpp"
#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {

/// The arrays of patches of one shape (src/storage/patch_storage.hpp), from some patch on.
template <typename T>
struct PatchArrays {
  const NetShape* shape;
  const T* coefficients;
  const T* edges;
  GivenPoints given;
  const T* origins; ///< null where the set has none
  const T* normal_floor;
};

} // namespace simdbezier::detail
