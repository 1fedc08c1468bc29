// See src/choice/page_faults.hpp.
#include "src/choice/page_faults.hpp"

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace simdbezier::detail {

std::int64_t page_faults() noexcept {
#if defined(__linux__)
  rusage usage = {};
  return getrusage(RUSAGE_THREAD, &usage) == 0 ? usage.ru_minflt : 0;
#else
  return 0;
#endif
}

} // namespace simdbezier::detail
