#include <tools/formats/obj/state.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>

namespace simdbezier::tools {

void expect_statement_end(Lexer& lexer) {
  lexer.next();
  if (!ends_statement(lexer)) {
    lexer.fail("the end of the line");
  }
}

bool ObjState::read(Lexer& lexer) {
  if (lexer.at_word("cstype")) {
    cstype(lexer);
  } else if (lexer.at_word("deg")) {
    deg(lexer);
  } else if (lexer.at_word("step")) {
    step(lexer);
  } else if (lexer.at_word("bmat")) {
    bmat(lexer);
  } else {
    return false;
  }
  return true;
}

void ObjState::cstype(Lexer& lexer) {
  rational_ = lexer.next().at_word("rat");
  if (rational_) {
    lexer.next();
  }
  const auto* const found = std::ranges::find(kObjTypes, lexer.text());
  if (found == std::end(kObjTypes)) {
    lexer.fail("cstype bezier, bmatrix, bspline, cardinal or taylor, or rat and one of these");
  }
  type_ = static_cast<ObjType>(found - std::begin(kObjTypes));
  expect_statement_end(lexer);
}

// Curves have one degree and one step.
void ObjState::deg(Lexer& lexer) {
  u_.degree = lexer.next().degree("in u");
  v_.degree = lexer.next().at(TokenKind::word) ? lexer.degree("in v") : 0;
  if (v_.degree != 0) {
    expect_statement_end(lexer);
  }
}

void ObjState::step(Lexer& lexer) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  const std::string what = "a step, 1 to " + std::to_string(kMost);
  u_.step = lexer.next().integer(what, 1, kMost);
  v_.step = lexer.next().at(TokenKind::word) ? lexer.integer(what, 1, kMost) : 0;
  if (v_.step != 0) {
    expect_statement_end(lexer);
  }
}

void ObjState::bmat(Lexer& lexer) {
  constexpr std::size_t kMost = (kMostDegree + 1) * (kMostDegree + 1);
  const bool is_u = lexer.next().at_word("u");
  if (!is_u && !lexer.at_word("v")) {
    lexer.fail("bmat u or bmat v");
  }
  std::vector<double>& matrix = (is_u ? u_ : v_).matrix;
  matrix.clear();
  for (lexer.next(); !ends_statement(lexer); lexer.next()) {
    if (matrix.size() == kMost) {
      lexer.fail("at most " + std::to_string(kMost) + " numbers of a matrix");
    }
    matrix.push_back(lexer.number());
  }
}

ObjDirection ObjState::direction(const Lexer& lexer, const ObjBasis& basis,
                                 const std::string& name) const {
  if (type_ == ObjType::cardinal && basis.degree != 3) {
    lexer.fail("degree 3 in " + name + " for cstype cardinal", std::to_string(basis.degree));
  }
  const auto order = static_cast<std::size_t>(basis.degree) + 1;
  if (type_ == ObjType::bmatrix && basis.step == 0) {
    lexer.fail("step in " + name + " before surf");
  }
  if (type_ == ObjType::bmatrix && basis.matrix.size() != order * order) {
    lexer.fail("bmat " + name + " of " + std::to_string(order * order) + " numbers before surf",
               std::to_string(basis.matrix.size()));
  }
  return obj_direction(*type_, basis);
}

ObjSurface ObjState::surface(const Lexer& lexer) const {
  if (!type_ || u_.degree == 0 || v_.degree == 0) {
    lexer.fail(type_ ? "deg of u and v before surf" : "cstype before surf");
  }
  ObjSurface surface;
  surface.line = lexer.line();
  surface.type = *type_;
  surface.rational = rational_;
  surface.u = direction(lexer, u_, "u");
  surface.v = direction(lexer, v_, "v");
  return surface;
}

} // namespace simdbezier::tools
