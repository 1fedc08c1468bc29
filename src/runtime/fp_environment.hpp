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
// It is written only where that changes something, since a write takes as long as twenty additions.
class DefaultFpEnvironment {
public:
  DefaultFpEnvironment() noexcept : saved_(_mm_getcsr()) {
    if ((saved_ & kControl) != kDefault) {
      _mm_setcsr(kDefault);
    }
  }
  /// The caller's flags of exceptions are restored as well.
  ~DefaultFpEnvironment() {
    if (_mm_getcsr() != saved_) {
      _mm_setcsr(saved_);
    }
  }
  DefaultFpEnvironment(const DefaultFpEnvironment&) = delete;
  DefaultFpEnvironment& operator=(const DefaultFpEnvironment&) = delete;

private:
  static constexpr unsigned kDefault = 0x1f80; // nearest, FTZ and DAZ off, exceptions masked
  static constexpr unsigned kControl = 0xffc0; // all but the flags
  unsigned saved_;
};
#else
class DefaultFpEnvironment {
public:
  DefaultFpEnvironment() noexcept {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFpEnvironment() { std::fesetenv(&saved_); }
  DefaultFpEnvironment(const DefaultFpEnvironment&) = delete;
  DefaultFpEnvironment& operator=(const DefaultFpEnvironment&) = delete;

private:
  std::fenv_t saved_;
};
#endif

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
