// A progress bar for people: on stderr, when that is a terminal and the work takes long.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace simdbezier::tools {

/// What a bar of at most `columns` shows: as much of the work's name, a bar and a share as there is
/// room for, and the time that is left where it is known. Where the total is unknown (0), it shows
/// how much has been done, in `unit`.
[[nodiscard]] std::string progress_line(std::string_view work, std::string_view unit,
                                        std::uint64_t done, std::uint64_t total,
                                        std::size_t columns,
                                        std::optional<double> seconds_left = std::nullopt);

/// One piece of work. Its line is cleared at the end, whatever ends it.
class Progress {
public:
  /// A total of 0 means unknown. No bar is wanted where its terminal may be the one that shows
  /// data.
  Progress(std::string_view work, std::string_view unit, std::uint64_t total, bool wanted = true);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void advance(std::uint64_t amount) { reach(done_ + amount); }
  void reach(std::uint64_t done) {
    done_ = done;
    if (wanted_) {
      show_when_due();
    }
  }

private:
  using Clock = std::chrono::steady_clock;

  void show_when_due();
  /// As much again for every part that is missing.
  [[nodiscard]] std::optional<double> seconds_left(Clock::time_point now) const;

  std::string work_;
  std::string unit_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  bool wanted_;
  bool shown_ = false;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_ + std::chrono::seconds(1);
};

} // namespace simdbezier::tools
