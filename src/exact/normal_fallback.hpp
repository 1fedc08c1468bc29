// Normals where |du x dv| is too small for the kernels' own test.
#pragma once

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// Second look at one sample, from its patch's control points as given, the same on every machine.
///
/// The normal is the first Taylor coefficient of du x dv that is not zero (normal_series.hpp): the
/// very first is SampleStatus::regular, a later one limit, none degenerate. Doubles with error
/// bounds find it in most cases, and arithmetic modulo primes in the others (leading_term.hpp). A
/// sample outside of the patch is degenerate as well if numbers would have more than 100 000 binary
/// digits, or if the sign of a weight is not certain. If a parameter is not finite, the normal is
/// nan. That a patch has no normals is found once for all of its samples (zero_everywhere.hpp), as
/// long as the thread asks about no other patch in between.
template <typename T>
SampleStatus resolve_normal(const NormalQuery<T>& query, T normal[3]) noexcept;

/// The same in a corner of a patch whose sides there count as points, however long they are:
/// 1 << PatchEdge for each of them.
template <typename T>
SampleStatus resolve_corner_normal(const NormalQuery<T>& query, unsigned sides,
                                   T normal[3]) noexcept;

} // namespace simdbezier::detail
