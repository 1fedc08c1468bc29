// What readers that compute count their roundings with.
#pragma once

namespace simdbezier::tools {

inline constexpr double kUnit = 0x1p-53;         ///< u: what one rounding adds at most, relatively
inline constexpr double kRounding = 1 + 0x1p-40; ///< of a computation of bounds

} // namespace simdbezier::tools
