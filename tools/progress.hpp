// A progress bar for people: on stderr, when that is a terminal and the work takes long.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

#include <unistd.h>

namespace simdbezier::tools {

class Progress {
public:
  /// total 0: unknown, so only what is done is shown.
  explicit Progress(std::uint64_t total, bool wanted = true)
      : total_(total), wanted_(wanted && isatty(STDERR_FILENO) != 0) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (shown_) {
      std::fputs("\r\x1b[K", stderr);
    }
  }

  void advance(std::uint64_t amount) {
    done_ += amount;
    if (const auto now = Clock::now(); wanted_ && now >= next_) {
      next_ = now + std::chrono::milliseconds(100);
      show();
    }
  }

private:
  using Clock = std::chrono::steady_clock;

  void show() {
    constexpr std::uint64_t kWidth = 40;
    shown_ = true;
    if (total_ == 0) {
      std::fprintf(stderr, "\r%s samples", std::to_string(done_).c_str());
      return;
    }
    const auto part = static_cast<double>(done_) / static_cast<double>(total_);
    std::string bar(static_cast<std::size_t>(part * kWidth), '#');
    bar.resize(kWidth, ' ');
    std::fprintf(stderr, "\r[%s] %3.0f %%", bar.c_str(), part * 100);
  }

  std::uint64_t total_;
  std::uint64_t done_ = 0;
  bool wanted_;
  bool shown_ = false;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(1);
};

} // namespace simdbezier::tools
