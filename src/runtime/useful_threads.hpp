// Whether the threads of a caller's calls get more done than one thread would. They do not where
// other processes use the cores: GNU's OpenMP lets threads spin while they wait, for longer than
// such a call takes, so that two threads on two busy cores take two to five times as long as one.
#pragma once

#include <cstdint>

namespace simdbezier::detail {

/// What is known of one caller's threads. All times are in nanoseconds.
class UsefulThreads {
public:
  /// Returns how many of `most` threads a call may take. now: a clock() that tells the time; it is
  /// not asked unless the number is limited.
  template <typename Clock>
  [[nodiscard]] int of(int most, const Clock& clock) noexcept {
    return limit_ < most && clock() < tried_again_ ? limit_ : most;
  }

  /// Notes that `threads` worked for `work` of processor time in all, while `elapsed` passed until
  /// `now`. They are worth it if they work for six tenths of that time or more. They are doubted
  /// twice before they are limited, because it takes time to start them.
  void note(int threads, std::int64_t work, std::int64_t elapsed, std::int64_t now) noexcept;

private:
  static constexpr std::int64_t kWindow = 2'000'000;          ///< what is judged at once
  static constexpr std::int64_t kShortestPause = 100'000'000; ///< until more are tried again
  static constexpr std::int64_t kLongestPause = 1'600'000'000;

  std::int64_t work_ = 0; ///< of the calls that are not judged yet
  std::int64_t elapsed_ = 0;
  std::int64_t most_work_ = 0; ///< what their threads could have done in this time
  std::int64_t pause_ = kShortestPause;
  std::int64_t tried_again_ = 0; ///< when
  int limit_ = kNoLimit;
  bool doubted_ = false;

  static constexpr int kNoLimit = 1 << 30;
};

/// Nanoseconds since some moment.
std::int64_t elapsed_time() noexcept;
/// The processor time of the calling thread, or elapsed_time() where the system does not say.
std::int64_t processor_time() noexcept;

} // namespace simdbezier::detail
