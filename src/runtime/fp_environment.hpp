// The floating-point environment of a call: round to nearest, denormals kept, whatever the caller
// or a worker thread had set. Results would otherwise depend on it.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#else
#include <cfenv>
#endif

namespace simdbezier::detail {

#if defined(__x86_64__)
// MXCSR directly: fesetenv would also reload the x87 state, which costs as much as a small patch.
class FpState {
public:
  FpState() noexcept : control_(_mm_getcsr()) {}
  [[nodiscard]] bool is_default() const noexcept { return (control_ & kControl) == kDefault; }
  static void set_default() noexcept { _mm_setcsr(kDefault); }
  /// Sets it unless it is there, since a write takes as long as twenty additions.
  void restore() const noexcept {
    if (_mm_getcsr() != control_) {
      _mm_setcsr(control_);
    }
  }

private:
  static constexpr unsigned kDefault = 0x1f80; // nearest, FTZ and DAZ off, exceptions masked
  static constexpr unsigned kControl = 0xffc0; // all but the flags
  unsigned control_;
};
#else
class FpState {
public:
  FpState() noexcept { std::fegetenv(&state_); }
  [[nodiscard]] static bool is_default() noexcept { return false; } // nobody knows
  static void set_default() noexcept { std::fesetenv(FE_DFL_ENV); }
  void restore() const noexcept { std::fesetenv(&state_); }

private:
  std::fenv_t state_;
};
#endif

/// The library's environment for a scope. The caller's flags of exceptions are restored as well.
class DefaultFpEnvironment {
public:
  DefaultFpEnvironment() noexcept {
    if (!callers_.is_default()) {
      enter();
    }
  }
  ~DefaultFpEnvironment() {
    callers_.restore();
    if (!callers_.is_default()) {
      leave();
    }
  }
  DefaultFpEnvironment(const DefaultFpEnvironment&) = delete;
  DefaultFpEnvironment& operator=(const DefaultFpEnvironment&) = delete;

private:
  friend class CallersFpEnvironment;

  void enter() noexcept;
  void leave() const noexcept;

  FpState callers_;
  const DefaultFpEnvironment* outer_ = nullptr; ///< of this thread, if it changed something
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
  const DefaultFpEnvironment* changed_;
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
