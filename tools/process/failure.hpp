// The program's own errors on their way to main(), which prints each as one line.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace simdbezier::tools {

/// An error with the exit code that it means: 1 bad input or failed write, 2 bad usage.
class Failure : public std::runtime_error {
public:
  Failure(int exit_code, const std::string& message)
      : std::runtime_error(message), exit_code_(exit_code) {}
  [[nodiscard]] int exit_code() const noexcept { return exit_code_; }

private:
  int exit_code_;
};

[[noreturn]] inline void bad_input(const std::string& message) { throw Failure(1, message); }
[[noreturn]] inline void bad_usage(const std::string& message) { throw Failure(2, message); }

/// Returns the word in quotes, short and printable, whatever it holds.
[[nodiscard]] std::string in_quotes(std::string_view word);

/// Returns "obj, ply or stl".
[[nodiscard]] std::string alternatives(std::span<const std::string> words);

/// Throws "FILE:LINE: expected …, found …".
[[noreturn]] inline void bad_input_at(const std::string& file, std::size_t line,
                                      const std::string& expected, const std::string& found) {
  bad_input(file + ":" + std::to_string(line) + ": expected " + expected + ", found " + found);
}

} // namespace simdbezier::tools
