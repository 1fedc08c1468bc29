// Sizes of control vectors: what the base code asks kernels for when it bounds cells of patches of
// any degrees and weights. No xsimd in here.
#pragma once

#include <cstddef>

namespace simdbezier::detail {

/// A box that holds a part of the surface, and the smallest of its weights. Distances from points
/// of a rational surface S = X / w are bounded by the vectors v of X - q w, with q in the box: with
/// its middle c and its half-diagonal R, |v_X - q v_w| <= |v_X - c v_w| + R |v_w|, which is the
/// size of v here. That of a polynomial patch's vectors, whose weights are 1, is |v_X|.
struct Hull {
  double middle[3] = {0, 0, 0};
  double radius = 0;
  double smallest_weight = 1;
};

/// Control vectors as planes: all x, then all y, z, and w where there are weights.
struct VectorList {
  const double* first = nullptr;
  std::size_t stride = 0; ///< of planes: a multiple of kListStep
  std::size_t count = 0;  ///< a multiple of kListStep: vectors of 0 fill the last step
};
/// As many doubles as the widest register has.
inline constexpr std::size_t kListStep = 8;

/// The lists of a patch's three second derivatives, of equal lengths, and factors of them.
struct DiagonalTask {
  VectorList uu;
  VectorList uv;
  VectorList vv;
  double factor_uu;
  double factor_uv;
  double factor_vv;
};

/// The largest sizes along diagonals from (0,0) to (1,1), and along those from (1,0) to (0,1).
struct DiagonalSizes {
  double rising = 0;
  double falling = 0;
};

/// All are infinite where a size is nan. Products are rounded on every instruction set, so that
/// bounds are the same on all of them.
struct SizeKernels {
  /// The largest size in a list.
  double (*largest)(const VectorList& list, const Hull& hull, bool rational);
  /// The largest sizes of the vectors factor_uu uu +- factor_uv uv + factor_vv vv.
  DiagonalSizes (*diagonals)(const DiagonalTask& task, const Hull& hull, bool rational);
};

} // namespace simdbezier::detail
