// The program in a system that fails: the n-th of some system calls fails, moves less than it was
// asked to, or returns just before a signal. The process is traced, so that calls that libraries
// make for themselves count like any other.
#pragma once

#include <string>
#include <vector>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests {

/// What happens at one system call. The one that opens the first file of the watched folder is
/// number 1 if it is among `calls`; what the dynamic linker did before is not counted.
struct SystemCallFault {
  std::vector<long> calls = {}; ///< numbers of system calls; empty: all of them
  long nth = 0;                 ///< which one of those, from 1; 0: none
  int error = 0;                ///< it is not made, and fails with this errno
  bool short_transfer = false;  ///< it moves half of its bytes
  int signal = 0;               ///< arrives when it has returned
};

struct TracedOutcome : Outcome {
  long calls = 0; ///< how many of the counted calls were made
};

/// Runs the program on a file in `folder`.
[[nodiscard]] TracedOutcome run_traced(const std::vector<std::string>& arguments,
                                       const TemporaryFolder& folder, const SystemCallFault& fault);

} // namespace simdbezier::tests
