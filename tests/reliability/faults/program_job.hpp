// Small jobs for the program, and what must be true of them whatever happened on the way: the
// output is what was there before or what should be there now, and nothing else is left.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests {

struct Job {
  const char* name;
  std::vector<std::string> options; ///< without the input and the output
  const char* out;                  ///< its name in the folder; "-": standard output
};

/// One job for each way in which the program writes.
[[nodiscard]] const std::vector<Job>& jobs();
/// Returns the jobs as parameters of tests, whose names GoogleTest prints.
[[nodiscard]] std::vector<const Job*> job_pointers();

/// A folder with the job's input and, where asked for, an output from before.
class Scene {
public:
  Scene(const Job& job, bool replaces);

  /// The folder as it was at first.
  void reset();
  [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }
  [[nodiscard]] const std::vector<std::string>& arguments() const { return arguments_; }

  /// Expects that nothing was lost and nothing left, that success means the whole output, and that
  /// failure has exit code 1 and a message, or is `signal`, if there was one.
  void expect_sound(const Outcome& outcome, int signal = 0) const;

private:
  [[nodiscard]] bool writes_file() const;
  /// Whether standard output says what was written.
  [[nodiscard]] bool is_told() const;
  [[nodiscard]] std::optional<std::string> output() const;

  const Job& job_;
  TemporaryFolder folder_;
  std::vector<std::string> arguments_;
  std::optional<std::string> before_;
  std::optional<std::string> complete_;
};

/// Whether all places are asked for: SIMDBEZIER_FAULTS is "all".
[[nodiscard]] bool every_place();
/// 1, …, count; otherwise about `most` of them, the ends included.
[[nodiscard]] std::vector<long> places(long count, long most);

} // namespace simdbezier::tests
