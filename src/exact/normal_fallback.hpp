// Normals where |du x dv| is too small for the kernels' own test.
#pragma once

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// Second look at one sample, from its patch's control points as given, the same on every machine:
/// which coefficient SampleStatus is about (src/exact/normal_series.hpp), doubles with error bounds
/// tell in most cases, and arithmetic modulo primes in the others (src/exact/leading_term.hpp).
/// Outside of the patch, samples are degenerate, too, where numbers would have more than 100 000
/// binary digits, or where a rational patch's weight is too close to zero for its sign to be known.
/// Where a parameter is not finite, the normal is nan.
///
/// A patch without any normal is found to be one once for all of its samples (src/exact/
/// zero_everywhere.hpp), as long as a thread asks about no other patch in between, since threads
/// remember what they know of one patch.
template <typename T>
SampleStatus resolve_normal(const NormalQuery<T>& query, T normal[3]) noexcept;

/// The same in a corner of a patch whose sides there count as points, however long they are:
/// 1 << PatchEdge for each of them.
template <typename T>
SampleStatus resolve_corner_normal(const NormalQuery<T>& query, unsigned sides,
                                   T normal[3]) noexcept;

} // namespace simdbezier::detail
