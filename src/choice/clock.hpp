// The clock of the measurements by which calls choose between ways that give the same bits, and of
// PlanSeconds; and how a measurement finds out that it is one of the system, which provides pages
// at their first use, rather than of the machine. It is a file of its own so that tests can put
// another one in its place.
#pragma once

#include <cstdint>

namespace simdbezier::detail {

/// Nanoseconds since some moment.
std::int64_t clock_now() noexcept;

/// How many pages of memory the system has provided to the calling thread so far; 0 where it does
/// not say (other systems than Linux).
std::int64_t page_faults() noexcept;

} // namespace simdbezier::detail
