// See src/runtime/clock.hpp.
#include "src/runtime/clock.hpp"

#include <chrono>

namespace simdbezier::detail {

std::int64_t clock_now() noexcept {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

} // namespace simdbezier::detail
