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
  /// What the system says to it; nothing where none was open.
  std::error_code close() noexcept;

private:
  int number_;
};

/// Files get a random name in the folder of the one that they are to become. Whatever ends the
/// program, but for SIGKILL and a crash of the system, removes them.
class TemporaryFile {
public:
  /// Creates one for `target`, a path without a link at its end. Throws std::system_error.
  explicit TemporaryFile(const std::string& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] int descriptor() const noexcept { return file_.number(); }
  /// Gives it the name of its target, and what the target had of owner, group and mode, as far as
  /// that is permitted; the data are on the disk before. Throws std::system_error.
  void replace_target();

private:
  void create(mode_t mode);
  void take_over(const struct stat& target) const;

  Descriptor folder_;
  Descriptor file_;
  std::string target_; // in the folder
  std::string name_;   // in the folder; empty: there is no such file any more
};

} // namespace simdbezier::tools
