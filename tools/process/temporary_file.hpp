// A file that is written beside its place and then put there.
#pragma once

#include <string>
#include <system_error>

#include <sys/stat.h>

namespace simdbezier::tools {

/// An open file descriptor, closed at the end of its life.
class Descriptor {
public:
  explicit Descriptor(int number = -1) noexcept : number_(number) {}
  ~Descriptor() { static_cast<void>(close()); }
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;

  [[nodiscard]] int number() const noexcept { return number_; }
  [[nodiscard]] bool is_open() const noexcept { return number_ >= 0; }
  int release() noexcept;
  /// Returns the system's answer; nothing where none was open.
  std::error_code close() noexcept;

private:
  int number_;
};

/// The folder takes no new file, whatever the rights of the target.
class FolderRefuses : public std::system_error {
public:
  using std::system_error::system_error;
};

/// A temporary file is `.TARGET.simdbezier-RANDOM.tmp` in the folder of its target. Whatever ends
/// the program removes it, except SIGKILL and a crash of the system: what these leave is removed
/// when the next one for the same target is created. Files that somebody still writes are locked,
/// and stay.
class TemporaryFile {
public:
  /// Creates one for `target`, a path without a link at its end. Throws std::system_error,
  /// FolderRefuses where the target itself could be written.
  explicit TemporaryFile(const std::string& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] int descriptor() const noexcept { return file_.number(); }
  /// Brings it to the disk, with the target's owner, group and mode as far as that is permitted.
  /// Nothing can be written any more. Throws std::system_error.
  void complete();
  /// Gives the complete file the name of its target. Throws std::system_error.
  void replace_target();

private:
  void create(mode_t mode, const std::string& prefix);
  [[nodiscard]] bool lock();
  void take_over(const struct stat& target) const;

  Descriptor folder_;
  Descriptor file_;
  Descriptor lock_;    // the same open file, until it has the name of its target
  std::string target_; // its name in the folder
  std::string name_;   // the temporary one; empty where there is none any more
};

} // namespace simdbezier::tools
