// Angles are degrees in every interface, and radians inside.
#pragma once

#include <numbers>

namespace simdbezier::detail {

constexpr double radians(double degrees) noexcept { return degrees * (std::numbers::pi / 180); }

} // namespace simdbezier::detail
