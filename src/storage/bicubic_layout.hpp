// How bicubic patches in space are packed. Kernels include this file, so that it includes no
// containers.
//
// Parameters inside the library are half-centred: X = u - 1/2 in [-1/2, 1/2]. Coefficients are
// those of the centred form times 2^(k+l), so every intermediate is an exact power of two times
// the one in x = 2u-1, and derivatives with respect to u and v need no factor 2.
#pragma once

#include <cstddef>

#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {

// The constants below are those of bicubic patches in space; NetShape has them for all others.
inline constexpr std::size_t kComponents = 3;
inline constexpr std::size_t kOrder = 4; // degree 3

/// Per patch [component][power k of X][power l of Y]: for float one cache line a component, in
/// which 128 bits hold the powers of Y that belong to one power of X.
inline constexpr std::size_t kCoefficients = kComponents * kOrder * kOrder;

/// Edges and corners of a patch, read for boundary samples only.
/// [component][power][edge v=0, v=1, u=0, u=1], then [component][corner], then padding to 64.
inline constexpr std::size_t kEdgeBlock = 64;
inline constexpr std::size_t kEdges = 4;
inline constexpr std::size_t kCornersAt = kComponents * kOrder * kEdges;
enum Edge : std::size_t { kEdgeV0, kEdgeV1, kEdgeU0, kEdgeU1 };

/// Per patch [component][8]: the patch's own origin, a place unused, of rational patches the
/// origins of the edges u=0, u=1 relative to it, the origins of the four edges in their order.
/// Present in sets packed with local origins only.
inline constexpr std::size_t kOriginBlock = 24;
inline constexpr std::size_t kOriginsPerComponent = 8;
inline constexpr std::size_t kRelativeOriginsAt = 2;
inline constexpr std::size_t kEdgeOriginsAt = 4;

/// Corner (u,v) stands at corner[v * 2 + u].
inline constexpr std::size_t corner_index(std::size_t u, std::size_t v) { return v * 2 + u; }

static_assert(NetShape{}.is_bicubic() && NetShape{}.coefficients() == kCoefficients &&
              NetShape{}.edges() == kEdgeBlock && NetShape{}.corners_at() == kCornersAt &&
              NetShape{}.origins() == kOriginBlock && NetShape{}.control_values() == kCoefficients);

} // namespace simdbezier::detail
