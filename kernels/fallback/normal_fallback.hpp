// Normals where |du x dv| is too small to trust.
#pragma once

#include "kernels/kernel_table.hpp"

namespace simdbezier::detail {

/// Second look at one sample, in double, the same on every instruction set. In order:
///   1. the plain cross product, scaled by powers of two, where it stands clear of the rounding
///      errors of du and dv: |N| > c (|du|' |dv| + |dv|' |du|), primes being hodograph bounds;
///   2. the same with du and dv recomputed from the control points (float only);
///   3. the limit from inside the patch to first order, N + K/8, K the derivative of du x dv
///      towards the centre;
///   4. the cross product at a parameter pulled 2^-12 towards the centre;
///   5. zero: the patch is a point or a line there.
/// Outside of [0,1] only the cross product in double, where du and dv are not nearly parallel.
template <typename T>
SampleStatus resolve_normal(const NormalQuery<T>& query, T normal[3]) noexcept;

} // namespace simdbezier::detail
