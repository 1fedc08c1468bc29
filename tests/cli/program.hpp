// The installed program as its users meet it: started, fed, and judged by what it leaves behind.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace simdbezier::tests {

/// An empty folder that goes away with its contents.
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::string path(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;
  /// Names in alphabetical order.
  [[nodiscard]] std::vector<std::string> names() const;

private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string read_file(const std::string& path);

struct Outcome {
  int exit_code = -1; ///< -1: ended by a signal
  int signal = 0;
  std::string out;
  std::string err;
};

struct Circumstances {
  std::string input = {}; ///< standard input
  std::vector<std::pair<std::string, std::string>> environment = {};
  long file_size_limit = -1; ///< bytes; -1: none
};

/// A started program whose standard input is a pipe.
class Program {
public:
  explicit Program(const std::vector<std::string>& arguments,
                   const Circumstances& circumstances = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  [[nodiscard]] pid_t id() const { return id_; }
  void feed(const std::string& text);
  /// Closes standard input and waits.
  Outcome finish();

private:
  TemporaryFolder folder_;
  pid_t id_ = -1;
  int input_ = -1;
};

/// Runs the program from start to end.
[[nodiscard]] Outcome run(const std::vector<std::string>& arguments,
                          const Circumstances& circumstances = {});

/// Success means an exit code of 0 and not a word on either stream.
void expect_silent_success(const Outcome& outcome);
/// Failure means its exit code, nothing on stdout, and one line on stderr: "simdbezier: …", with
/// `part` in it.
void expect_failure(const Outcome& outcome, int exit_code, const std::string& part);

} // namespace simdbezier::tests
