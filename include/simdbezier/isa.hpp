// Instruction sets: which exist, which this machine has, which one runs.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <simdbezier/instruction_set.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier {

/// The name used by SIMDBEZIER_ISA and in benchmark names: "scalar", "sse2", …
[[nodiscard]] SIMDBEZIER_API std::string_view to_string(Isa isa) noexcept;

/// The instruction set of that name, or nothing. "automatic" is a name too.
[[nodiscard]] SIMDBEZIER_API std::optional<Isa> isa_from_name(std::string_view name) noexcept;

/// What this build contains (SIMDBEZIER_ISAS when it was configured) and this machine can run,
/// narrowest first. Empty only where the build leaves out what every machine has: all calls then
/// return unsupported_isa. Probed once, thread-safe, static lifetime.
[[nodiscard]] SIMDBEZIER_API std::span<const Isa> available_isas() noexcept;

/// True for the instruction sets that round once per multiply-add (the FMA class of results).
[[nodiscard]] SIMDBEZIER_API bool fuses_multiply_add(Isa isa) noexcept;

/// What a call with `requested` will run on. Isa::automatic reads the environment variable
/// SIMDBEZIER_ISA at the first use in the process and keeps that answer.
///
/// Where nobody names an instruction set and the next narrower one gives equal bits (avx2 beside
/// avx512), evaluate() on a Grid may take that one for outputs that stay in the caches, since
/// processors that split wide registers are faster with it on small grids. The first such call of
/// its kind (shape, size of the grid, outputs and their layout) with 1024 samples or more, and no
/// more than 4096 of a patch, evaluates some 2000 of them, or one patch, on both, a few times,
/// which takes some 20 microseconds, and two milliseconds at most where samples take long; the
/// process keeps the answer. Options::executed tells which one ran.
///
/// Returns ok | unknown_isa | unsupported_isa; `chosen` is written on ok only.
[[nodiscard]] SIMDBEZIER_API Status resolve_isa(Isa requested, Isa& chosen) noexcept;

} // namespace simdbezier
