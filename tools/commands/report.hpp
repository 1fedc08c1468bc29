// How errors are said.
#pragma once

#include <string_view>

namespace simdbezier::tools {

/// Prints one line on standard error, whatever a file name contains, and returns the exit code. It
/// takes no memory, because the message may be that there is none.
int report(std::string_view message, int exit_code);

} // namespace simdbezier::tools
