// What holds in an OBJ file for the surfaces and curves behind it: cstype, deg, step and bmat.
#pragma once

#include <optional>
#include <string>

#include <tools/formats/input/lexer.hpp>
#include <tools/formats/obj/surface.hpp>

namespace simdbezier::tools {

class ObjState {
public:
  /// Reads one of these statements; returns false where the current token begins another one.
  bool read(Lexer& lexer);
  /// Returns a surface of the type, degrees and bases that have been given, which has to be all of
  /// them; surf is the current token.
  [[nodiscard]] ObjSurface surface(const Lexer& lexer) const;

  [[nodiscard]] std::optional<ObjType> type() const noexcept { return type_; }
  [[nodiscard]] bool rational() const noexcept { return rational_; }
  /// Returns the degree of curves; 0 before it is given.
  [[nodiscard]] int curve_degree() const noexcept { return u_.degree; }

private:
  void cstype(Lexer& lexer);
  void deg(Lexer& lexer);
  void step(Lexer& lexer);
  void bmat(Lexer& lexer);
  [[nodiscard]] ObjDirection direction(const Lexer& lexer, const ObjBasis& basis,
                                       const std::string& name) const;

  std::optional<ObjType> type_;
  bool rational_ = false;
  ObjBasis u_;
  ObjBasis v_;
};

/// Whether the current token ends a statement.
[[nodiscard]] inline bool ends_statement(const Lexer& lexer) {
  return lexer.at(TokenKind::line_end) || lexer.at(TokenKind::end);
}
/// Reads the next token, which has to end the statement.
void expect_statement_end(Lexer& lexer);

} // namespace simdbezier::tools
