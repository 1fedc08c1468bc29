// Normals where |du x dv| is too small for the kernels' own test.
#pragma once

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// Second look at one sample, from its patch's control points as given, the same on every machine.
///
/// The normal has the direction of the first Taylor coefficient of du x dv that is not zero, on the
/// line from the sample to the patch's middle (src/exact/normal_series.hpp); which one that is,
/// doubles with error bounds tell in most cases, and arithmetic modulo primes in the others
/// (src/exact/leading_term.hpp). The first coefficient is SampleStatus::regular, a later one limit;
/// where all are zero, so is the normal: degenerate. Outside of the patch, samples are degenerate,
/// too, where numbers would have more than 100 000 binary digits, or where a rational patch's
/// weight is too close to zero for its sign to be known. Where a parameter is not finite, the
/// normal is nan.
///
/// A patch without any normal is found to be one once for all of its samples (src/exact/
/// zero_everywhere.hpp), as long as a thread asks about no other patch in between: threads remember
/// the control points that they were asked about last, and what is known of them.
template <typename T>
SampleStatus resolve_normal(const NormalQuery<T>& query, T normal[3]) noexcept;

/// The same in a corner of a patch whose sides there count as points, however long they are:
/// 1 << PatchEdge for each of them.
template <typename T>
SampleStatus resolve_corner_normal(const NormalQuery<T>& query, unsigned sides,
                                   T normal[3]) noexcept;

} // namespace simdbezier::detail
