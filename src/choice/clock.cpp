#include "src/choice/clock.hpp"

#include "src/runtime/useful_threads.hpp"

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace simdbezier::detail {

std::int64_t clock_now() noexcept {
#if defined(__wasm__)
  return 0; // browsers' clocks are coarse, or stop: whatever is measured is taken to be equal
#else
  return elapsed_time();
#endif
}

std::int64_t page_faults() noexcept {
#if defined(__linux__)
  rusage usage = {};
  return getrusage(RUSAGE_THREAD, &usage) == 0 ? usage.ru_minflt : 0;
#else
  return 0;
#endif
}

} // namespace simdbezier::detail
