// Text that is read piece by piece, with line numbers, and at most one buffer ahead of its use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tools/formats/input/byte_source.hpp>

namespace simdbezier::tools {

/// Whether the character is a space, tab, line break or their kin.
[[nodiscard]] constexpr bool is_space(int c) noexcept {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

/// A file, standard input ("-") or bytes in memory, one character at a time or as far as it is in
/// memory. All formats have in common that a UTF-8 byte-order mark is passed over and that LF, CR
/// LF and CR are line ends, which come as \n, and that the input may be compressed (ByteSource).
class TextInput {
public:
  static constexpr int kEnd = -1;

  /// Throws Failure where ByteSource does.
  explicit TextInput(const std::string& path);
  /// Takes bytes that are in memory, as ByteSource does, and a name for messages.
  TextInput(std::string name, std::span<const char> memory);

  /// Returns the name for messages.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::uint64_t stored_size() const { return source_.stored_size(); }
  void show(Progress& progress) noexcept { source_.show(progress); }
  /// Returns the bytes as they are, for a format that is no text and reads nothing else.
  [[nodiscard]] ByteSource& bytes() noexcept { return source_; }
  /// Returns the line of the character that get() returned last; at the end, the last line there
  /// is.
  [[nodiscard]] std::size_t line() const noexcept { return line_; }

  [[nodiscard]] int get() {
    if (next_ == end_ && !fill()) {
      return kEnd;
    }
    return take();
  }
  /// Returns what get() will return next.
  [[nodiscard]] int peek() {
    return next_ == end_ && !fill() ? kEnd : static_cast<unsigned char>(buffer_[next_]);
  }

  /// Returns what get() will return next, as far as it has been read already, which may be nothing.
  [[nodiscard]] std::string_view in_memory() const noexcept {
    return {buffer_.data() + next_, end_ - next_};
  }
  /// Passes over white space in memory, but over no line end where `lines` says so.
  void skip_space_in_memory(bool lines) noexcept {
    while (next_ != end_ && is_space(buffer_[next_]) && !(lines && buffer_[next_] == '\n')) {
      static_cast<void>(take());
    }
  }
  /// Passes over so many characters in memory, without a line end among them.
  void skip_in_line(std::size_t count) noexcept {
    line_ += line_break_pending_ ? 1 : 0;
    line_break_pending_ = false;
    next_ += count;
  }
  /// The same with so many line ends among them, none of which is the last character.
  void skip_lines(std::size_t count, std::size_t line_ends) noexcept {
    line_ += line_ends;
    skip_in_line(count);
  }

private:
  int take() noexcept {
    const char c = buffer_[next_++];
    line_ += line_break_pending_ ? 1 : 0;
    line_break_pending_ = c == '\n';
    return static_cast<unsigned char>(c);
  }
  bool fill();
  void skip_byte_order_mark();
  void unify_line_ends();

  std::string name_;
  ByteSource source_;
  std::vector<char> buffer_;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::size_t line_ = 1;
  bool at_start_ = true;
  bool after_return_ = false;
  // A file's last line ends with its line break, so the count goes up with what follows it.
  bool line_break_pending_ = false;
};

/// Reads the whole word as a finite number; nothing where it is none. Numbers that are too small
/// for a double become 0 or subnormal, and numbers that are too large count as none.
[[nodiscard]] std::optional<double> parse_finite(std::string_view word);
/// Reads the whole word as a non-negative integer; nothing where it is none.
[[nodiscard]] std::optional<std::uint64_t> parse_integer(std::string_view word);
/// Whether the whole word is a number for parse_finite(), or would be one if it were finite.
[[nodiscard]] bool is_number(std::string_view word);
/// Returns what to say instead of a word that parse_finite() refused.
[[nodiscard]] std::string describe_non_number(std::string_view word);

} // namespace simdbezier::tools
