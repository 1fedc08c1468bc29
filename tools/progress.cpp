#include <tools/progress.hpp>

#include <algorithm>

#include <sys/ioctl.h>
#include <unistd.h>

#include <tools/interruption.hpp>

namespace simdbezier::tools {

namespace {

// It is asked each time, because windows change their size.
std::size_t terminal_columns() {
  constexpr std::size_t kUsual = 80;
  winsize size = {};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsual;
}

} // namespace

std::string progress_line(std::string_view work, std::string_view unit, std::uint64_t done,
                          std::uint64_t total, std::size_t columns) {
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
  line += progress_line(work_, unit_, done_, total_, terminal_columns() - 1);
  line += "\x1b[K";
  static_cast<void>(!write(STDERR_FILENO, line.data(), line.size()));
}

} // namespace simdbezier::tools
