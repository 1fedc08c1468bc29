// Names for the four edges of a patch.
#pragma once

#include <cstddef>
#include <cstdint>

namespace simdbezier {

/// The edges v = 0, v = 1, u = 0, u = 1, each in the direction in which its own parameter grows.
enum class PatchEdge : std::uint8_t { v0, v1, u0, u1 };
inline constexpr std::size_t kPatchEdges = 4;

} // namespace simdbezier
