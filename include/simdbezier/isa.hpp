// Instruction sets: which exist, which this machine can run, which one a call will use.
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

/// The instruction sets that this build contains (SIMDBEZIER_ISAS when it was configured) and this
/// machine can run, narrowest first. Empty only if the build leaves out what every machine has; all
/// calls then return unsupported_isa. Probed once, thread-safe, static lifetime.
[[nodiscard]] SIMDBEZIER_API std::span<const Isa> available_isas() noexcept;

/// True for the instruction sets that round once per multiply-add (the FMA class of results).
[[nodiscard]] SIMDBEZIER_API bool fuses_multiply_add(Isa isa) noexcept;

/// What a call with `requested` will run on. Isa::automatic reads the environment variable
/// SIMDBEZIER_ISA at the first use in the process and keeps that answer.
///
/// If nobody names an instruction set, evaluate() on a Grid may use the next narrower one of the
/// same class (avx2 instead of avx512) for outputs that stay in the caches, because some processors
/// are faster with it on small grids. The first such call of a kind (shape, size of the grid,
/// outputs and their layout) with 1024 samples or more measures both, in 20 microseconds to two
/// milliseconds; the process keeps the answer. The bits are equal; Options::executed tells which
/// one ran.
///
/// Returns ok | unknown_isa | unsupported_isa; `chosen` is written on ok only.
[[nodiscard]] SIMDBEZIER_API Status resolve_isa(Isa requested, Isa& chosen) noexcept;

} // namespace simdbezier
