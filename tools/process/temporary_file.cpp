#include <tools/process/temporary_file.hpp>

#include <cerrno>
#include <cstdint>
#include <string_view>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <unistd.h>

#include <tools/process/interruption.hpp>

namespace simdbezier::tools {

namespace {

[[noreturn]] void fail(int error) { throw std::system_error(error, std::generic_category()); }

// fsync() needs a folder that can be read; for everything else a path to it will do.
Descriptor open_folder(const std::string& path) {
  constexpr int kFlags = O_DIRECTORY | O_CLOEXEC;
  Descriptor folder(open(path.c_str(), O_RDONLY | kFlags));
  if (!folder.is_open() && errno == EACCES) {
    folder = Descriptor(open(path.c_str(), O_PATH | kFlags));
  }
  if (!folder.is_open()) {
    fail(errno);
  }
  return folder;
}

constexpr std::string_view kSuffix = ".tmp";
constexpr std::size_t kRandomDigits = 13;

// Of names of temporary files for a target. Of long names a part will do.
std::string prefix_for(std::string target) {
  constexpr std::string_view kMark = ".simdbezier-";
  constexpr std::size_t kMost = 255 - 1 - kMark.size() - kRandomDigits - kSuffix.size();
  if (target.size() > kMost) {
    std::size_t end = kMost;
    while (end > 0 && (static_cast<unsigned char>(target[end]) & 0xC0U) == 0x80U) {
      --end; // not within a character of UTF-8
    }
    target.resize(end);
  }
  return "." + target + std::string(kMark);
}

// No other process has this name, not even one with the same number in a container of its own.
std::string random_name(const std::string& prefix) {
  constexpr const char* kDigits = "0123456789abcdefghijklmnopqrstuv";
  std::uint64_t bits = 0;
  if (getrandom(&bits, sizeof bits, 0) != static_cast<ssize_t>(sizeof bits)) {
    fail(errno);
  }
  std::string name = prefix;
  for (std::size_t k = 0; k < kRandomDigits; ++k, bits >>= 5) {
    name += kDigits[bits & 31];
  }
  return name.append(kSuffix);
}

// Files that nobody writes any more. A failure means that they stay.
void remove_left(int folder, std::string_view prefix) {
  Descriptor again(openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  DIR* const names = again.is_open() ? fdopendir(again.number()) : nullptr;
  if (names == nullptr) {
    return;
  }
  again.release(); // closedir() closes it
  while (const dirent* const entry = readdir(names)) {
    const std::string_view name = entry->d_name;
    if (name.size() != prefix.size() + kRandomDigits + kSuffix.size() ||
        !name.starts_with(prefix) || !name.ends_with(kSuffix)) {
      continue;
    }
    const Descriptor left(
        openat(folder, entry->d_name, O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status = {};
    if (left.is_open() && fstat(left.number(), &status) == 0 && S_ISREG(status.st_mode) &&
        flock(left.number(), LOCK_EX | LOCK_NB) == 0) {
      unlinkat(folder, entry->d_name, 0);
    }
  }
  closedir(names);
}

// Some file systems have nothing to wait for, which is no failure.
bool can_be_synced(int error) { return error != EINVAL && error != ENOTSUP && error != ENOSYS; }

} // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    static_cast<void>(close());
    number_ = other.release();
  }
  return *this;
}

int Descriptor::release() noexcept { return std::exchange(number_, -1); }

std::error_code Descriptor::close() noexcept {
  const bool failed = is_open() && ::close(release()) != 0 && errno != EINTR;
  return failed ? std::error_code(errno, std::generic_category()) : std::error_code();
}

TemporaryFile::TemporaryFile(const std::string& target) {
  const std::size_t slash = target.find_last_of('/');
  const bool is_here = slash == std::string::npos;
  target_ = is_here ? target : target.substr(slash + 1);
  folder_ = open_folder(is_here ? "." : target.substr(0, slash + 1));
  struct stat before = {};
  const bool replaces =
      fstatat(folder_.number(), target_.c_str(), &before, AT_SYMLINK_NOFOLLOW) == 0;
  if (!replaces && errno != ENOENT) {
    fail(errno);
  }
  if (replaces && faccessat(folder_.number(), target_.c_str(), W_OK, AT_EACCESS) != 0) {
    fail(errno);
  }
  const std::string prefix = prefix_for(target_);
  remove_left(folder_.number(), prefix);
  // A file that replaces another may be secret and gets its mode later; others have the usual one.
  try {
    create(replaces ? 0600 : 0666, prefix);
  } catch (const std::system_error& error) {
    if (replaces) {
      throw FolderRefuses(error.code());
    }
    throw;
  }
}

void TemporaryFile::create(mode_t mode, const std::string& prefix) {
  do {
    forget_temporary(name_);
    name_ = random_name(prefix);
    begin_creation();
    if (!remember_temporary(folder_.number(), name_)) {
      end_creation();
      name_.clear();
      fail(EMFILE);
    }
    file_ = Descriptor(
        openat(folder_.number(), name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
    const int error = errno;
    end_creation();
    errno = error;
  } while (file_.is_open() ? !lock() : errno == EEXIST);
  if (!file_.is_open()) {
    const int error = errno;
    forget_temporary(name_);
    name_.clear();
    fail(error);
  }
}

// Returns false where another process has taken the new file for one that was left. Where files
// cannot be locked, no process removes any.
bool TemporaryFile::lock() {
  const int file = file_.number();
  struct stat status = {};
  if ((flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) ||
      (fstat(file, &status) == 0 && status.st_nlink == 0)) {
    return false;
  }
  // A lock ends with the last descriptor of an open file.
  lock_ = Descriptor(fcntl(file, F_DUPFD_CLOEXEC, 0));
  return true;
}

TemporaryFile::~TemporaryFile() {
  if (!name_.empty()) {
    unlinkat(folder_.number(), name_.c_str(), 0);
    forget_temporary(name_);
  }
}

void TemporaryFile::take_over(const struct stat& target) const {
  mode_t mode = target.st_mode & 0777; // without setuid and setgid
  const int file = file_.number();
  if (fchown(file, target.st_uid, target.st_gid) != 0 &&
      fchown(file, static_cast<uid_t>(-1), target.st_gid) != 0) {
    // Another group must not get the rights of the old one.
    mode &= 0707 | ((mode & 07) << 3);
  }
  static_cast<void>(!fchmod(file, mode));
}

void TemporaryFile::complete() {
  struct stat target = {};
  if (fstatat(folder_.number(), target_.c_str(), &target, AT_SYMLINK_NOFOLLOW) == 0) {
    take_over(target);
  }
  if (fsync(file_.number()) != 0 && can_be_synced(errno)) {
    fail(errno);
  }
  if (const std::error_code error = file_.close()) {
    throw std::system_error(error);
  }
}

void TemporaryFile::replace_target() {
  if (renameat(folder_.number(), name_.c_str(), folder_.number(), target_.c_str()) != 0) {
    fail(errno);
  }
  forget_temporary(name_);
  name_.clear();
  static_cast<void>(lock_.close());
  // The file is in its place already. Only the file system knows if its name survives a crash.
  static_cast<void>(!fsync(folder_.number()));
}

} // namespace simdbezier::tools
