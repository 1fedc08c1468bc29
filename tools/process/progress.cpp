#include <tools/process/progress.hpp>

#include <algorithm>
#include <cmath>

#include <sys/ioctl.h>
#include <unistd.h>

#include <tools/process/interruption.hpp>

namespace simdbezier::tools {

namespace {

// It is asked each time, because windows change their size.
std::size_t terminal_columns() {
  constexpr std::size_t kUsual = 80;
  winsize size = {};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsual;
}

// Returns "7 s", "3 min 20 s" or "2 h 5 min".
std::string duration(double seconds) {
  constexpr double kMost = 1e9;
  const auto whole = static_cast<std::uint64_t>(std::ceil(std::clamp(seconds, 0.0, kMost)));
  const auto text = [](std::uint64_t count, const char* unit) {
    return std::to_string(count) + " " + unit;
  };
  if (whole < 60) {
    return text(whole, "s");
  }
  return whole < 3600 ? text(whole / 60, "min") + " " + text(whole % 60, "s")
                      : text(whole / 3600, "h") + " " + text(whole % 3600 / 60, "min");
}

} // namespace

std::string progress_line(std::string_view work, std::string_view unit, std::uint64_t done,
                          std::uint64_t total, std::size_t columns,
                          std::optional<double> seconds_left) {
  constexpr std::size_t kWidest = 40;
  const std::string name(work);
  if (total == 0) {
    const std::string count = std::to_string(done) + " " + std::string(unit);
    const std::string line = name + " " + count;
    return line.size() <= columns ? line : (count.size() <= columns ? count : "");
  }
  // Files may grow while they are read.
  const double part = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
  std::string share = std::to_string(static_cast<int>(part * 100));
  share = std::string(3 - share.size(), ' ') + share + " %";
  if (share.size() > columns) {
    return "";
  }
  std::string line = name + " ";
  if (line.size() + share.size() > columns) {
    return share;
  }
  const std::string left = seconds_left ? ", " + duration(*seconds_left) + " left" : "";
  if (line.size() + share.size() + left.size() <= columns) {
    share += left;
  }
  constexpr std::size_t kFrame = 3; // [ ] and a space
  const std::size_t rest = columns - line.size() - share.size();
  if (rest > kFrame) {
    const std::size_t width = std::min(kWidest, rest - kFrame);
    std::string bar(static_cast<std::size_t>(part * static_cast<double>(width)), '#');
    bar.resize(width, ' ');
    line += "[" + bar + "] ";
  }
  return line + share;
}

Progress::Progress(std::string_view work, std::string_view unit, std::uint64_t total, bool wanted)
    : work_(work), unit_(unit), total_(total), wanted_(wanted && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_) {
    clear_bar();
    remember_bar(false);
  }
}

std::optional<double> Progress::seconds_left(Clock::time_point now) const {
  if (done_ == 0 || total_ == 0 || done_ > total_) {
    return std::nullopt;
  }
  const double part = static_cast<double>(done_) / static_cast<double>(total_);
  return std::chrono::duration<double>(now - begin_).count() * (1 - part) / part;
}

void Progress::show_when_due() {
  const auto now = Clock::now();
  if (now < next_) {
    return;
  }
  next_ = now + std::chrono::milliseconds(100);
  shown_ = true;
  remember_bar(true);
  // One column is left free, because some terminals go to the next line with the last one. What a
  // longer line left behind before the window became narrow is cleared.
  std::string line = "\r";
  line += progress_line(work_, unit_, done_, total_, terminal_columns() - 1, seconds_left(now));
  line += "\x1b[K";
  static_cast<void>(!write(STDERR_FILENO, line.data(), line.size()));
}

} // namespace simdbezier::tools
