// The certificates of many positions at once: error_bounds() of patches and curves without their
// derivatives, by what is the same for all members of one shape.
#pragma once

#include <array>
#include <cstddef>

#include <simdbezier/curves.hpp>
#include <simdbezier/patch_set.hpp>

namespace simdbezier::detail {

/// One member's bounds by component; what is behind the set's components is not written.
using PositionBound = std::array<double, kMostComponents>;

/// Writes the bounds of members [begin, end) to out[0], …; they are those of error_bounds(). To be
/// called in the library's floating-point environment.
template <typename T>
void find_position_bounds(const PatchSet<T>& set, Isa isa, std::size_t begin, std::size_t end,
                          PositionBound* out) noexcept;
template <typename T>
void find_position_bounds(const CurveSet<T>& set, Isa isa, std::size_t begin, std::size_t end,
                          PositionBound* out) noexcept;

} // namespace simdbezier::detail
