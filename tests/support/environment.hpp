// The caller's floating-point environment: rounding mode, flush-to-zero, denormals-are-zero.
#pragma once

#include <cfenv>
#include <cstdint>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace simdbezier::tests {

/// An environment that a caller may have set.
struct EnvironmentCase {
  const char* name;
  int rounding;
  bool flush;
};
inline constexpr EnvironmentCase kEnvironments[] = {{"upward", FE_UPWARD, false},
                                                    {"downward", FE_DOWNWARD, false},
                                                    {"toward_zero", FE_TOWARDZERO, false},
                                                    {"flush", FE_TONEAREST, true},
                                                    {"upward_flush", FE_UPWARD, true}};

/// The control register that holds rounding mode, FTZ and DAZ (x86: MXCSR, aarch64: FPCR).
[[nodiscard]] inline std::uint64_t control_register() {
#if defined(__SSE__)
  return _mm_getcsr() & 0xffc0u; // without the sticky exception flags
#elif defined(__aarch64__)
  std::uint64_t value = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(value));
  return value;
#else
  return static_cast<std::uint64_t>(std::fegetround());
#endif
}

inline void set_control_register(std::uint64_t value) {
#if defined(__SSE__)
  _mm_setcsr(static_cast<unsigned>(value));
#elif defined(__aarch64__)
  __asm__ volatile("msr fpcr, %0" : : "r"(value));
#else
  std::fesetround(static_cast<int>(value));
#endif
}

/// Bits that flush subnormal results and operands to zero; 0 where unknown.
[[nodiscard]] inline std::uint64_t flush_bits() {
#if defined(__SSE__)
  return 0x8040u; // FTZ and DAZ
#elif defined(__aarch64__)
  return std::uint64_t{1} << 24; // FZ
#else
  return 0;
#endif
}

/// Sets an environment for a scope and puts the old one back.
class ScopedEnvironment {
public:
  ScopedEnvironment(int rounding, bool flush) {
    std::fesetround(rounding);
    if (flush) {
      set_control_register(control_register() | flush_bits());
    }
    set_rounding_ = std::fegetround();
    set_register_ = control_register();
  }
  ~ScopedEnvironment() {
    std::fesetround(old_rounding_);
    set_control_register(old_register_);
  }
  ScopedEnvironment(const ScopedEnvironment&) = delete;
  ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;

  /// True while nobody has changed what the constructor set.
  [[nodiscard]] bool untouched() const {
    return control_register() == set_register_ && std::fegetround() == set_rounding_;
  }

private:
  int old_rounding_ = std::fegetround();
  std::uint64_t old_register_ = control_register();
  int set_rounding_ = 0;
  std::uint64_t set_register_ = 0;
};

} // namespace simdbezier::tests
