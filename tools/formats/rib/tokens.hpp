// Parts that requests of RIB files have in common.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tools/formats/input/lexer.hpp>

namespace simdbezier::tools {

/// Tokens of RIB files. Every function reads from the token behind the current one, or from where
/// its comment says; the last token that it took is the current one then.
class RibTokens : public Lexer {
public:
  /// Counts beyond this are no counts of points in a file.
  static constexpr std::size_t kMostPoints = std::size_t{1} << 31;

  explicit RibTokens(TextInput& input)
      : Lexer(input, {.comments = true, .brackets = true, .strings = true}) {}

  [[nodiscard]] bool at_number() const {
    return at(TokenKind::word) && parse_finite(text()).has_value();
  }

  /// Passes over an array whose opening bracket is the current token. Anything but numbers and
  /// strings means that the closing one is missing, and what follows could be geometry. Hands over
  /// the numbers where they are wanted.
  void pass_over_array(std::vector<double>* numbers = nullptr);
  /// Reads an array of numbers, or one number.
  [[nodiscard]] std::vector<double> numbers_of(const std::string& what);
  void expect_close(const std::string& what);
  [[nodiscard]] std::size_t next_count(const std::string& what, std::size_t least,
                                       std::size_t most = kMostPoints);
  /// Returns the string that is the current token as the name of a parameter, in front of which
  /// declarations may stand: "vertex point P".
  [[nodiscard]] std::string parameter_name() const;
  /// Passes over a number, a string, or an array of them, behind a parameter's name.
  void pass_over_value(const std::string& name);
};

} // namespace simdbezier::tools
