#include "src/runtime/useful_threads.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace simdbezier::detail {

void UsefulThreads::note(int threads, std::int64_t work, std::int64_t elapsed,
                         std::int64_t now) noexcept {
  work_ += work;
  elapsed_ += elapsed;
  most_work_ += threads * elapsed;
  if (elapsed_ < kWindow) {
    return;
  }
  const bool useful = work_ * 10 >= most_work_ * 6;
  if (!useful && doubted_) {
    limit_ = std::max(1, static_cast<int>(work_ / elapsed_));
    tried_again_ = now + pause_;
    pause_ = std::min(2 * pause_, kLongestPause);
  } else if (!useful) {
    doubted_ = true;
  } else if (limit_ == kNoLimit || threads > limit_) {
    *this = UsefulThreads();
  }
  work_ = elapsed_ = most_work_ = 0;
}

std::int64_t elapsed_time() noexcept {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

std::int64_t processor_time() noexcept {
#if defined(CLOCK_THREAD_CPUTIME_ID)
  std::timespec time = {};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) == 0) {
    return time.tv_sec * 1'000'000'000LL + time.tv_nsec;
  }
#endif
  return elapsed_time();
}

} // namespace simdbezier::detail
