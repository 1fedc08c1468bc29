// The commands of the program. All of them throw Failure.
#pragma once

#include <tools/commands/arguments.hpp>

namespace simdbezier::tools {

void run_tessellate(const Arguments& arguments);
void run_evaluate(const Arguments& arguments);
void run_info(const Arguments& arguments);
void run_convert(const Arguments& arguments);
void run_plan(const Arguments& arguments);
void run_join(const Arguments& arguments);

/// Runs the one that was asked for.
inline void run_command(const Arguments& arguments) {
  switch (arguments.command) {
  case Command::tessellate:
    return run_tessellate(arguments);
  case Command::evaluate:
    return run_evaluate(arguments);
  case Command::info:
    return run_info(arguments);
  case Command::convert:
    return run_convert(arguments);
  case Command::plan:
    return run_plan(arguments);
  case Command::join:
    return run_join(arguments);
  }
}

} // namespace simdbezier::tools
