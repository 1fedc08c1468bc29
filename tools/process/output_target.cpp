// Files, devices and pipes as targets of output.
#include <tools/process/output_file.hpp>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/temporary_file.hpp>

namespace simdbezier::tools {

namespace fs = std::filesystem;

namespace {

std::string error_text(int error) { return in_quotes(std::strerror(error)); }

// These names lead to whatever the program was started with. If there is a file behind them, the
// shell has opened and truncated it.
bool names_open_descriptor(const fs::path& path) {
  const std::string& name = path.native();
  return name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") ||
         name.starts_with("/proc/");
}

// The file at the end of a chain of links, which need not exist. A chain without an end stays a
// link, which the system refuses to open.
fs::path follow_links(fs::path path) {
  constexpr int kMostLinks = 40; // the system's own limit
  std::error_code error;
  for (int i = 0; i < kMostLinks && !names_open_descriptor(path) && fs::is_symlink(path, error);
       ++i) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path;
}

// What a name stands for, if there is such a file.
std::optional<struct stat> file_of(const std::string& name, int standard) {
  struct stat status = {};
  const bool exists =
      name == "-" ? fstat(standard, &status) == 0 : stat(name.c_str(), &status) == 0;
  return exists ? std::optional(status) : std::nullopt;
}

bool are_one(const std::optional<struct stat>& a, const std::optional<struct stat>& b) {
  return a && b && a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

class FileTarget final : public OutputTarget {
public:
  explicit FileTarget(const std::string& path);

  [[nodiscard]] bool is_terminal() const override { return isatty(descriptor_) != 0; }
  void expect_room(std::uintmax_t bytes) const override;
  [[nodiscard]] bool can_rewrite() const noexcept override { return temporary_.has_value(); }
  void rewrite(std::uint64_t at, std::string_view text) override;
  void complete() override;
  void commit() override;
  void append(const char* data, std::size_t size) override;

private:
  [[noreturn]] void fail(const std::string& what, const std::string& found) const;
  void open_directly(const std::string& target);

  std::string path_;
  std::optional<TemporaryFile> temporary_;
  Descriptor direct_;   // a device's or pipe's
  int descriptor_ = -1; // either one's; none when the file is complete
};

FileTarget::FileTarget(const std::string& path) : path_(path) {
  if (path_ == "-") {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  const fs::path target = follow_links(path_);
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) {
    fail("a file", "a directory");
  }
  if (fs::is_symlink(target, ignored) && !names_open_descriptor(target)) {
    fail("a writable file", error_text(ELOOP));
  }
  if (is_written_directly(path_)) {
    open_directly(target.native());
    return;
  }
  try {
    temporary_.emplace(target.native());
  } catch (const FolderRefuses& error) {
    fail("a folder where a temporary file can stand beside it", error_text(error.code().value()));
  } catch (const std::system_error& error) {
    fail("a writable file", error_text(error.code().value()));
  }
  descriptor_ = temporary_->descriptor();
}

void FileTarget::open_directly(const std::string& target) {
  // It is opened for appending, so that what a shell's >> has kept stays.
  direct_ =
      Descriptor(open(target.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOCTTY, 0666));
  if (!direct_.is_open()) {
    fail("a writable file", error_text(errno));
  }
  descriptor_ = direct_.number();
}

void FileTarget::fail(const std::string& what, const std::string& found) const {
  bad_input((path_ == "-" ? "standard output" : path_) + ": expected " + what + ", found " + found);
}

void FileTarget::expect_room(std::uintmax_t bytes) const {
  struct statvfs space = {};
  if (!temporary_ || fstatvfs(descriptor_, &space) != 0) {
    return;
  }
  const Count available = Count(space.f_bavail) * space.f_frsize;
  if (available.within(bytes) && available.value() != bytes) {
    fail("room for " + std::to_string(bytes) + " bytes or more",
         to_string(available) + " bytes free");
  }
}

// Pipes and full disks sometimes take a part only, and pipes of others may be set not to wait.
void FileTarget::append(const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(descriptor_, data, size);
    if (written > 0) {
      data += written;
      size -= static_cast<std::size_t>(written);
    } else if (written < 0 && errno == EAGAIN) {
      pollfd wait = {descriptor_, POLLOUT, 0};
      poll(&wait, 1, -1);
    } else if (written == 0 || errno != EINTR) {
      fail("room to write", error_text(written == 0 ? ENOSPC : errno));
    }
  }
}

void FileTarget::rewrite(std::uint64_t at, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = pwrite(descriptor_, text.data(), text.size(), static_cast<off_t>(at));
    if (written > 0) {
      at += static_cast<std::uint64_t>(written);
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0 || errno != EINTR) {
      fail("room to write", error_text(written == 0 ? ENOSPC : errno));
    }
  }
}

void FileTarget::complete() {
  descriptor_ = -1;
  try {
    if (temporary_) {
      temporary_->complete();
    } else if (const std::error_code error = direct_.close()) {
      throw std::system_error(error);
    }
  } catch (const std::system_error& error) {
    fail("room to write", error_text(error.code().value()));
  }
}

void FileTarget::commit() {
  if (!temporary_) {
    return;
  }
  try {
    temporary_->replace_target();
  } catch (const std::system_error& error) {
    fail("a place that the finished file can be moved to", error_text(error.code().value()));
  }
}

} // namespace

std::unique_ptr<OutputTarget> open_target(const std::string& path) {
  return std::make_unique<FileTarget>(path);
}

void refuse_input_as_output(const std::string& out, std::span<const std::string> inputs) {
  const auto written = file_of(out, STDOUT_FILENO);
  for (const std::string& input : inputs) {
    const auto read = file_of(input, STDIN_FILENO);
    // Devices, terminals and the like may well be both.
    if (are_one(written, read) && S_ISREG(written->st_mode)) {
      bad_input((out == "-" ? "standard output" : out) +
                ": expected an output that is no input, found the file that " +
                (input == "-" ? "standard input" : input) + " is read from");
    }
  }
}

bool mixes_with_standard_output(const std::string& path) {
  const auto standard = file_of("-", STDOUT_FILENO);
  return path == "-" || (are_one(file_of(path, STDOUT_FILENO), standard) &&
                         !are_one(file_of("/dev/null", STDOUT_FILENO), standard));
}

bool is_written_directly(const std::string& path) {
  const fs::path target = follow_links(path);
  std::error_code ignored;
  const fs::file_status status = fs::status(target, ignored);
  return path == "-" || names_open_descriptor(target) || fs::is_other(status);
}

std::string folder_of(const std::string& output) {
  const std::string folder = follow_links(output).parent_path().string();
  return folder.empty() ? "." : folder;
}

} // namespace simdbezier::tools
