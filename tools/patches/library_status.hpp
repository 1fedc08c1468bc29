// What the library's answers mean to a user.
#pragma once

#include <string>
#include <string_view>

#include <simdbezier/simdbezier.hpp>

namespace simdbezier::tools {

/// Does nothing for ok, and otherwise throws the Failure that the status means to a user.
void check(Status status);

/// Returns the instruction set that evaluate calls will run on. Throws Failure (bad usage) naming
/// the variable of the environment, SIMDBEZIER_ISA, SIMDBEZIER_DESTINATION or
/// SIMDBEZIER_SPLIT_STORES, that asks for what is not there.
Isa chosen_isa();

/// Returns "simdbezier 1.2.3".
[[nodiscard]] std::string program_version();

/// Returns the names of the available instruction sets, narrowest first.
[[nodiscard]] std::string available_isa_names(std::string_view separator);

} // namespace simdbezier::tools
