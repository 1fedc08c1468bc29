// What take_executed_isa() answers.
#pragma once

#include <simdbezier/options.hpp>

namespace simdbezier::detail {

/// Keeps the instruction set that the calling thread's call ran on.
void note_executed(Isa isa) noexcept;

} // namespace simdbezier::detail
