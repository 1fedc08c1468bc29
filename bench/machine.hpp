// Facts about the machine and the build, put into every report.
#pragma once

namespace simdbezier_bench {

/// Adds "cpu", "cores", "compiler", "flags", "baseline_flags", "isas" and "isa" to the context.
void add_machine_context();

} // namespace simdbezier_bench
