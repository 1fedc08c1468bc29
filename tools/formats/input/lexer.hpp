// Text as tokens: words, and what else a format has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <tools/formats/input/text_input.hpp>
#include <tools/process/counts.hpp>

namespace simdbezier::tools {

/// What a format's text consists of besides words and white space.
struct Syntax {
  bool comments = false; ///< from # to the end of the line
  bool brackets = false; ///< [ and ]
  bool strings = false;  ///< "…", in which a backslash takes the next character as it is
  bool lines = false;    ///< line ends are tokens; a backslash at the end of one joins the next
};

enum class TokenKind : std::uint8_t { word, string, open, close, line_end, end };

/// Reads tokens one by one and never ahead. Where it refuses something, it throws a Failure that
/// names the file and the line of the current token.
class Lexer {
public:
  Lexer(TextInput& input, const Syntax& syntax);

  /// Reads the next token, which all other functions are about. Numbers may have any length.
  /// Another word of absurd length, as in binary files, is cut off and marked.
  Lexer& next();
  /// Reads the next tokens as long as they are finite numbers and in memory as a whole, at most as
  /// many as there are values, and returns how many these are. The last one is the current token;
  /// `line` becomes that of the first one. It may stop before a number, such as one with a plus
  /// sign or at the end of what is in memory: next() reads that one. This is what most of a file
  /// goes through, without a token for each number. It is not for formats in which line ends are
  /// tokens.
  std::size_t numbers(std::span<double> values, std::size_t& line);
  /// Returns the text of a word or string; it is valid until the next one is read.
  [[nodiscard]] std::string_view text() const noexcept { return text_; }
  /// Returns the line where the token begins; at the end, the last line there is.
  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  [[nodiscard]] bool at(TokenKind kind) const noexcept { return kind_ == kind; }
  [[nodiscard]] bool at_word(std::string_view word) const noexcept {
    return at(TokenKind::word) && text_ == word;
  }
  [[nodiscard]] const std::string& name() const noexcept { return input_.name(); }

  /// Passes over what is left of the line.
  void skip_line();
  /// Passes over everything up to the next opening bracket.
  void skip_to_bracket();
  /// Passes over a list whose opening bracket, or something behind it, is the current token; its
  /// closing bracket becomes the current one. With a depth, the token is inside of so many lists,
  /// and the outermost one is passed over.
  void skip_list(std::size_t depth = 1);

  /// Throws "FILE:LINE: expected …, found …" with the token, or with what else was found.
  [[noreturn]] void fail(const std::string& expected) const { fail(expected, described()); }
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const;

  /// Returns the token as messages show it.
  [[nodiscard]] std::string described() const;

  /// Each of these returns the token, which has to be a finite number.
  [[nodiscard]] double number() const;
  /// It has to be a number that can be a weight: more than 0.
  [[nodiscard]] double weight() const;
  /// It has to be an integer within limits; `what` names it in the message.
  [[nodiscard]] std::size_t integer(const std::string& what, std::size_t least,
                                    std::size_t most) const;
  /// Returns a count that was formed of such integers, which has to be one.
  [[nodiscard]] std::size_t counted(Count count, const std::string& what) const;
  /// It has to be a degree from 1 to kMostDegree; `where` names its direction in the message.
  [[nodiscard]] int degree(const std::string& where) const;

private:
  /// Whether the next token is in memory as a whole. It has been read then, and otherwise nothing
  /// of it.
  bool is_in_memory();
  /// Returns the end of the word that is a finite number and begins at `begin`, and its value; null
  /// where there is no such word, or where it may go on behind `last`.
  const char* number_end(const char* begin, const char* last, double& value) const;
  /// Returns the length of the word that `rest` begins with; finds its value where it is a number.
  std::size_t word_length(std::string_view rest);
  [[nodiscard]] bool ends_word(char c) const noexcept {
    return ends_word_[static_cast<unsigned char>(c)];
  }
  void word(int first);
  void string();
  /// Passes over white space. Returns whether that ends behind a line end that is a token.
  bool skip_space();

  TextInput& input_;
  Syntax syntax_;
  std::array<bool, 256> ends_word_ = {};
  TokenKind kind_ = TokenKind::end;
  std::string_view text_;
  std::string copy_;            // holds text_ where the input's memory has not all of it
  std::optional<double> value_; // the value of a finite number, where it has been found already
  std::size_t line_ = 1;
  bool joins_lines_ = false;
};

} // namespace simdbezier::tools
