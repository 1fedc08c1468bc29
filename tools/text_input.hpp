// Text that is read piece by piece, with line numbers, and at most one buffer ahead of its use.
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

class Progress;

/// A file or standard input ("-"), one character at a time. All formats have in common that a
/// UTF-8 byte-order mark is passed over and that LF, CR LF and CR are line ends, which come as \n.
class TextInput {
public:
  static constexpr int kEnd = -1;

  /// Throws Failure when the input cannot be read: missing, a directory, no permission.
  explicit TextInput(const std::string& path);

  /// The name for messages.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// In bytes; 0 where that is unknown, as for pipes.
  [[nodiscard]] std::uint64_t size() const;
  /// Shows from now on how much has been read.
  void show(Progress& progress) noexcept { progress_ = &progress; }
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
  /// What get() will return next.
  [[nodiscard]] int peek() {
    return next_ == end_ && !fill() ? kEnd : static_cast<unsigned char>(buffer_[next_]);
  }

private:
  struct Close {
    void operator()(std::FILE* file) const noexcept;
  };
  bool fill();
  void skip_byte_order_mark();
  void unify_line_ends();

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  Progress* progress_ = nullptr;
  std::vector<char> buffer_;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::size_t line_ = 1;
  bool at_start_ = true;
  bool after_return_ = false;
  // A file's last line ends with its line break, so the count goes up with what follows it.
  bool line_break_pending_ = false;
};

/// The whole word as a finite number; nothing where it is none. Numbers that are too small for a
/// double become 0 or subnormal, and numbers that are too large count as none.
[[nodiscard]] std::optional<double> parse_finite(std::string_view word);
/// The whole word as a non-negative integer.
[[nodiscard]] std::optional<std::uint64_t> parse_integer(std::string_view word);
/// The word in quotes, short and printable, whatever it holds.
[[nodiscard]] std::string in_quotes(std::string_view word);
/// What to say instead of a word that parse_finite() refused.
[[nodiscard]] std::string describe_non_number(std::string_view word);
/// Space, tab, line break and their kin.
[[nodiscard]] constexpr bool is_space(int c) noexcept {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

} // namespace simdbezier::tools
