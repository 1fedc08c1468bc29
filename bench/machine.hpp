// Facts about the machine and the build, which every report contains.
#pragma once

namespace simdbezier_bench {

/// Adds "cpu", "cores", "compiler", "flags", "baseline_flags", "isas" and "isa" to the context.
void add_machine_context();

} // namespace simdbezier_bench
