// Text in, piece by piece, with line numbers; nothing is read ahead of its use but one buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace simdbezier::tools {

/// A file or standard input ("-"), one character at a time.
class TextInput {
public:
  static constexpr int kEnd = -1;

  /// Throws Failure when the input cannot be read: missing, a directory, no permission.
  explicit TextInput(const std::string& path);

  /// The name for messages.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// The line of the character that get() returned last; at the end, the last line there is.
  [[nodiscard]] std::size_t line() const noexcept { return line_; }

  [[nodiscard]] int get() {
    if (next_ == end_ && !fill()) {
      return kEnd;
    }
    const char c = buffer_[next_++];
    line_ += line_break_pending_ ? 1 : 0;
    line_break_pending_ = c == '\n';
    return static_cast<unsigned char>(c);
  }

private:
  struct Close {
    void operator()(std::FILE* file) const noexcept;
  };
  bool fill();

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<char> buffer_;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::size_t line_ = 1;
  // A file's last line ends with its line break, so the count goes up with what follows it.
  bool line_break_pending_ = false;
};

/// Words separated by white space.
class Tokenizer {
public:
  explicit Tokenizer(TextInput& input) : input_(input) {}

  /// The next word, or nothing at the end of the input. A word of absurd length, as in binary
  /// files, comes back cut off and marked so that it is no number. Valid until the next call.
  [[nodiscard]] std::optional<std::string_view> next();
  /// The line of the word that came last, or the input's last line at the end.
  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  [[nodiscard]] const std::string& name() const noexcept { return input_.name(); }

  /// The next word as a finite number, or nothing at the end; Failure where it is another word.
  [[nodiscard]] std::optional<double> coordinate();
  /// The next word as a number of patches, 1 or more; Failure where it is anything else.
  [[nodiscard]] std::size_t patch_count();

private:
  TextInput& input_;
  std::string word_;
  std::size_t line_ = 1;
};

/// The whole word as a finite number; nothing where it is none. Numbers too small for a double
/// become 0 or subnormal, numbers too large are none.
[[nodiscard]] std::optional<double> parse_finite(std::string_view word);
/// The whole word as a non-negative integer.
[[nodiscard]] std::optional<std::uint64_t> parse_integer(std::string_view word);
/// The word in quotes, short and printable, whatever it holds.
[[nodiscard]] std::string in_quotes(std::string_view word);
/// What to say instead of a word that parse_finite() refused.
[[nodiscard]] std::string describe_non_number(std::string_view word);

} // namespace simdbezier::tools
