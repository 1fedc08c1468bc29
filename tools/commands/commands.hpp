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

} // namespace simdbezier::tools
