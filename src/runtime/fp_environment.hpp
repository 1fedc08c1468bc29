// The floating-point environment of a call: round to nearest, denormals kept, whatever the caller
// or a worker thread had set. Results would otherwise depend on it.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#elif !defined(__wasm__)
#include <cfenv>
#endif

namespace simdbezier::detail {

#if defined(__x86_64__)
// MXCSR directly: fesetenv would also reload the x87 state, which costs as much as a small patch.
using FpState = unsigned;
inline constexpr FpState kDefaultFpState = 0x1f80; // nearest, FTZ and DAZ off, exceptions masked

inline FpState fp_state() noexcept { return _mm_getcsr(); }
inline void set_fp_state(FpState state) noexcept { _mm_setcsr(state); }
inline void set_default_fp_state() noexcept { _mm_setcsr(kDefaultFpState); }
/// Sets it unless it is there, since a write takes as long as twenty additions.
inline void restore_fp_state(FpState state) noexcept {
  if (_mm_getcsr() != state) {
    _mm_setcsr(state);
  }
}
/// Whether all but the flags of exceptions are the library's.
inline bool is_default(FpState state) noexcept { return (state & 0xffc0) == kDefaultFpState; }
#elif defined(__wasm__)
// There is one environment: round to nearest, denormals kept, no flags.
struct FpState {};

inline FpState fp_state() noexcept { return {}; }
inline void set_fp_state(FpState) noexcept {}
inline void set_default_fp_state() noexcept {}
inline void restore_fp_state(FpState) noexcept {}
inline bool is_default(FpState) noexcept { return true; }
#else
using FpState = std::fenv_t;

inline FpState fp_state() noexcept {
  FpState state;
  std::fegetenv(&state);
  return state;
}
inline void set_fp_state(const FpState& state) noexcept { std::fesetenv(&state); }
inline void set_default_fp_state() noexcept { std::fesetenv(FE_DFL_ENV); }
inline void restore_fp_state(const FpState& state) noexcept { std::fesetenv(&state); }
inline bool is_default(const FpState&) noexcept { return false; } // nobody knows
#endif

/// What the innermost environment of a thread found that changed something.
struct ChangedFpState {
  bool any;
  FpState before;
};

/// The library's environment for a scope. The caller's flags of exceptions are restored as well.
class DefaultFpEnvironment {
public:
  DefaultFpEnvironment() noexcept : callers_(fp_state()) {
    if (!is_default(callers_)) [[unlikely]] {
      outer_ = enter(callers_);
    }
  }
  ~DefaultFpEnvironment() {
    restore_fp_state(callers_);
    if (!is_default(callers_)) [[unlikely]] {
      leave(outer_);
    }
  }
  DefaultFpEnvironment(const DefaultFpEnvironment&) = delete;
  DefaultFpEnvironment& operator=(const DefaultFpEnvironment&) = delete;

private:
  // Nobody is told this object's address, so that the state stays in a register.
  static ChangedFpState enter(FpState callers) noexcept;
  static void leave(ChangedFpState outer) noexcept;

  FpState callers_;
  ChangedFpState outer_{}; ///< where this one changed something
};

/// The caller's environment again, for a scope within the library's. Threads that are started have
/// the one of the thread that starts them, and OpenMP's runtime gives them to the caller later on.
class CallersFpEnvironment {
public:
  CallersFpEnvironment() noexcept;
  ~CallersFpEnvironment();
  CallersFpEnvironment(const CallersFpEnvironment&) = delete;
  CallersFpEnvironment& operator=(const CallersFpEnvironment&) = delete;

private:
  bool changed_;
};

/// Runs work() in the library's environment. The compiler does not know that arithmetic depends on
/// it, and may move what is inlined to either side of its change: this is no place to inline.
template <typename Work>
__attribute__((noinline)) void run_apart(const Work& work) noexcept {
  work();
}
template <typename Work>
void in_default_environment(const Work& work) noexcept {
  const DefaultFpEnvironment environment;
  run_apart(work);
}

} // namespace simdbezier::detail
