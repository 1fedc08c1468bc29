// The clock of the measurements by which calls choose between ways that give the same bits, and of
// PlanSeconds. It is a file of its own so that tests can put another one in its place.
#pragma once

#include <cstdint>

namespace simdbezier::detail {

/// Nanoseconds since some moment.
std::int64_t clock_now() noexcept;

} // namespace simdbezier::detail
