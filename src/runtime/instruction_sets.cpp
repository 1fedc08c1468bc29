// All instruction sets, whether this build has them or not. instruction_sets.inc is the table of
// cmake/isa.cmake: SIMDBEZIER_INSTRUCTION_SET(name, NAME, fuses, runs_here) for each of them.
#include <simdbezier/options.hpp>

#include <algorithm>
#include <iterator>

#include "src/runtime/dispatch.hpp"

namespace simdbezier {
namespace {

// The compiler's built-in honours what the operating system saves (XCR0), which xsimd 8.1's own
// probe does not.
#if defined(__wasm__)
#define SIMDBEZIER_CPU_HAS(feature) true // or the module would have been refused
#else
#define SIMDBEZIER_CPU_HAS(feature) (__builtin_cpu_supports(feature) != 0)
#endif

using Probe = bool (*)() noexcept;

struct InstructionSet {
  Isa isa;
  std::string_view name;
  bool fuses;      ///< a multiplication and an addition have one rounding
  Probe runs_here; ///< on this machine and its operating system
};

#define SIMDBEZIER_INSTRUCTION_SET(name, upper, fuses, runs_here)                                  \
  {Isa::name, #name, fuses, []() noexcept { return runs_here; }},
constexpr InstructionSet kSets[] = {
    {Isa::automatic, "automatic", false, []() noexcept { return false; }},
#include "instruction_sets.inc"
};
#undef SIMDBEZIER_INSTRUCTION_SET

const InstructionSet* find(Isa isa) noexcept {
  const InstructionSet* const set = std::ranges::find(kSets, isa, &InstructionSet::isa);
  return set == std::end(kSets) ? nullptr : set;
}

} // namespace

std::string_view to_string(Isa isa) noexcept {
  const InstructionSet* const set = find(isa);
  return set == nullptr ? "unknown" : set->name;
}

std::optional<Isa> isa_from_name(std::string_view name) noexcept {
  const InstructionSet* const set = std::ranges::find(kSets, name, &InstructionSet::name);
  return set == std::end(kSets) ? std::nullopt : std::optional(set->isa);
}

bool fuses_multiply_add(Isa isa) noexcept {
  const InstructionSet* const set = find(isa);
  return set != nullptr && set->fuses;
}

bool detail::cpu_supports(Isa isa) noexcept {
  const InstructionSet* const set = find(isa);
  return set != nullptr && set->runs_here();
}

} // namespace simdbezier
