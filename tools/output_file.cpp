#include <tools/output_file.hpp>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <utility>

#include <unistd.h>

#include <tools/failure.hpp>
#include <tools/text_input.hpp>

namespace simdbezier::tools {

namespace fs = std::filesystem;

namespace {

// What a signal handler may look at: the name of the temporary file, if there is one.
std::array<char, 4096> temporary_name;
std::atomic<bool> temporary_exists{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void remember_temporary(const fs::path& path) {
  const std::string& name = path.native();
  if (name.size() < temporary_name.size()) {
    std::memcpy(temporary_name.data(), name.c_str(), name.size() + 1);
    temporary_exists = true;
  }
}

extern "C" void on_signal(int number) {
  if (temporary_exists) {
    unlink(temporary_name.data());
  }
  std::signal(number, SIG_DFL);
  std::raise(number);
}

std::string system_error_text() { return in_quotes(std::strerror(errno)); }

// These names lead to whatever the program was started with; the file behind them, if it is one,
// was opened and truncated by the shell.
bool names_open_descriptor(const fs::path& path) {
  const std::string& name = path.native();
  return name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") ||
         name.starts_with("/proc/");
}

// The file at the end of a chain of links, which need not exist.
fs::path follow_links(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code ignored;
  for (int i = 0; i < kMostLinks && !names_open_descriptor(path) && fs::is_symlink(path, ignored);
       ++i) {
    path = path.parent_path() / fs::read_symlink(path, ignored);
  }
  return path;
}

} // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)), buffer_(kBufferSize) {
  if (path_ == "-") {
    file_ = stdout;
    return;
  }
  target_ = follow_links(path_);
  std::error_code ignored;
  if (fs::is_directory(target_, ignored)) {
    fail("a file", "a directory");
  }
  if (is_written_directly(path_)) {
    open_directly();
  } else {
    open_temporary();
  }
}

void OutputFile::open_directly() {
  // Appending, so that what a shell's >> had kept stays.
  file_ = std::fopen(target_.c_str(), "ab");
  if (file_ == nullptr) {
    fail("a writable file", system_error_text());
  }
}

void OutputFile::open_temporary() {
  constexpr int kAttempts = 100;
  std::error_code ignored;
  const bool replaces = fs::exists(target_, ignored);
  if (replaces && access(target_.c_str(), W_OK) != 0) {
    fail("a writable file", system_error_text());
  }
  const std::string stem = ".simdbezier-" + std::to_string(getpid()) + "-";
  for (int i = 0; i < kAttempts && file_ == nullptr; ++i) {
    temporary_ = target_.parent_path() / (stem + std::to_string(i) + ".tmp");
    file_ = std::fopen(temporary_.c_str(), "wbx");
    if (file_ == nullptr && errno != EEXIST) {
      break;
    }
  }
  if (file_ == nullptr) {
    temporary_.clear();
    fail("a writable file", system_error_text());
  }
  remember_temporary(temporary_);
  if (replaces) {
    fs::permissions(temporary_, fs::status(target_, ignored).permissions(), ignored);
  }
}

OutputFile::~OutputFile() {
  if (file_ != nullptr && file_ != stdout) {
    std::fclose(file_);
  }
  if (!temporary_.empty()) {
    std::error_code ignored;
    fs::remove(temporary_, ignored);
    temporary_exists = false;
  }
}

void OutputFile::fail(const std::string& what, const std::string& found) const {
  bad_input((path_ == "-" ? "standard output" : path_) + ": expected " + what + ", found " + found);
}

void OutputFile::expect_room(std::uintmax_t bytes) const {
  if (temporary_.empty()) {
    return;
  }
  std::error_code error;
  const fs::space_info space = fs::space(temporary_, error);
  if (!error && space.available < bytes) {
    fail("room for " + std::to_string(bytes) + " bytes or more",
         std::to_string(space.available) + " bytes free");
  }
}

void OutputFile::bytes(const void* data, std::size_t size) {
  if (size > kBufferSize - used_) {
    flush();
  }
  if (size > kBufferSize) {
    if (std::fwrite(data, 1, size, file_) != size) {
      fail("room to write", system_error_text());
    }
    return;
  }
  std::memcpy(buffer_.data() + used_, data, size);
  used_ += size;
}

void OutputFile::flush() {
  if (std::fwrite(buffer_.data(), 1, used_, file_) != used_) {
    fail("room to write", system_error_text());
  }
  used_ = 0;
}

void OutputFile::commit() {
  flush();
  std::FILE* const file = std::exchange(file_, nullptr);
  if ((file == stdout ? std::fflush(file) : std::fclose(file)) != 0) {
    fail("room to write", system_error_text());
  }
  if (temporary_.empty()) {
    return;
  }
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) {
    fail("a writable file", in_quotes(error.message()));
  }
  temporary_exists = false;
  temporary_.clear();
}

void handle_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(number, on_signal) == SIG_IGN) {
      std::signal(number, SIG_IGN); // as nohup wants it
    }
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

bool is_written_directly(const std::string& path) {
  const fs::path target = follow_links(path);
  std::error_code ignored;
  const fs::file_status status = fs::status(target, ignored);
  return path == "-" || names_open_descriptor(target) || fs::is_other(status);
}

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  if (!extension.empty()) {
    extension.erase(0, 1);
  }
  for (char& c : extension) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return extension;
}

std::string shortest(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

} // namespace simdbezier::tools
