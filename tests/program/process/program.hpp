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
  long memory = 0; ///< the most that it had at once, in KiB
};

struct Circumstances {
  std::string input = {}; ///< standard input
  std::vector<std::pair<std::string, std::string>> environment = {};
  long file_size_limit = -1; ///< bytes; -1: none
  std::string fault = {};    ///< one of fault_preload.cpp
  std::vector<int> ignored_signals = {};
  std::string input_path = {};  ///< standard input is this file instead
  std::string append_path = {}; ///< standard output goes to the end of this file instead; or closed
  unsigned short columns = 0;   ///< standard error is a terminal this wide; 0: it is a file
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
  void close_input();
  /// Waits for this on a terminal that is standard error.
  void await_on_terminal(const std::string& part);
  /// Closes standard input and waits.
  Outcome finish();

private:
  TemporaryFolder folder_;
  pid_t id_ = -1;
  int input_ = -1;
  int terminal_ = -1;
  std::string shown_;
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
