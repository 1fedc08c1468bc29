// Who starts threads. One of threads_openmp.cpp, threads_std.cpp and threads_none.cpp is built, as
// SIMDBEZIER_THREADS says; results never depend on which one.
#pragma once

namespace simdbezier::detail {

/// The threads of a call that does not say how many: 1 where the caller is one of several threads
/// of a parallel region.
int default_threads() noexcept;

/// The most threads that a call is given: more gain nothing, and the system may refuse them.
int most_threads() noexcept;

/// A borrowed callable.
template <typename... Arguments>
class Borrowed {
public:
  template <typename F>
  explicit Borrowed(F& body) noexcept
      : context_(&body), call_([](void* context, Arguments... arguments) {
          (*static_cast<F*>(context))(arguments...);
        }) {}
  void operator()(Arguments... arguments) const { call_(context_, arguments...); }

private:
  void* context_;
  void (*call_)(void*, Arguments...);
};

/// `void(int worker, int workers) noexcept`
using ThreadBody = Borrowed<int, int>;

/// Calls body(0, n) … body(n - 1, n), each once, on threads of their own as far as the system
/// grants them. n is `threads`, or fewer where OpenMP's runtime decides so. threads: 2 or more.
void run_on_threads(int threads, ThreadBody body) noexcept;

} // namespace simdbezier::detail
