// What calls with Destination::automatic have found out: whether to write through the caches or
// past them.
#pragma once

#include <simdbezier/options.hpp>

#include "src/runtime/call_notes.hpp"

namespace simdbezier::detail {

/// What SIMDBEZIER_DESTINATION says, "cache" or "memory"; automatic for every other word. It is
/// read at the first use in the process.
Destination environment_destination() noexcept;

using DestinationNotes = CallNotes<Destination>;
static_assert(Destination::automatic == Destination{} && static_cast<int>(Destination::memory) < 3);

/// The notes of the process.
DestinationNotes& destination_notes() noexcept;

} // namespace simdbezier::detail
