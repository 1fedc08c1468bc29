// All instruction sets, whether this build has them or not: one row for each.
#include <simdbezier/isa.hpp>

#include "src/runtime/dispatch.hpp"

namespace simdbezier {
namespace {

using Probe = bool (*)() noexcept;

bool never() noexcept { return false; }
bool always() noexcept { return true; }

#if defined(__x86_64__)
// The compiler's built-in honours what the operating system saves (XCR0), which xsimd 8.1's own
// probe does not.
bool has_avx2() noexcept {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
}
bool has_avx512() noexcept {
  return has_avx2() && __builtin_cpu_supports("avx512f") != 0 &&
         __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512vl") != 0;
}
constexpr Probe has_sse2 = always; // the baseline
constexpr Probe has_neon64 = never;
#else
constexpr Probe has_sse2 = never;
constexpr Probe has_avx2 = never;
constexpr Probe has_avx512 = never;
#if defined(__aarch64__)
constexpr Probe has_neon64 = always; // the baseline
#else
constexpr Probe has_neon64 = never;
#endif
#endif

struct InstructionSet {
  Isa isa;
  std::string_view name;
  bool fuses;      ///< a multiplication and an addition with one rounding
  Probe runs_here; ///< on this machine and its operating system
};

constexpr InstructionSet kSets[] = {
    {Isa::automatic, "automatic", false, never}, {Isa::scalar, "scalar", false, always},
    {Isa::sse2, "sse2", false, has_sse2},        {Isa::avx2, "avx2", true, has_avx2},
    {Isa::avx512, "avx512", true, has_avx512},   {Isa::neon64, "neon64", true, has_neon64},
};

const InstructionSet* find(Isa isa) noexcept {
  for (const InstructionSet& set : kSets) {
    if (set.isa == isa) {
      return &set;
    }
  }
  return nullptr;
}

} // namespace

std::string_view to_string(Isa isa) noexcept {
  const InstructionSet* const set = find(isa);
  return set == nullptr ? "unknown" : set->name;
}

std::optional<Isa> isa_from_name(std::string_view name) noexcept {
  for (const InstructionSet& set : kSets) {
    if (set.name == name) {
      return set.isa;
    }
  }
  return std::nullopt;
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
