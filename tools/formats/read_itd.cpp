// IRIT .itd: lists in brackets. [OBJECT … NAME …] holds data, attributes such as [COLOR 4], and
// further objects; what stands outside of objects is a comment. A surface is
//     [SURFACE BEZIER {attributes} UORDER VORDER TYPE [x y z] …]       TYPE E3, or
//                                                     [w wx wy wz] …   P3,
// VORDER rows of UORDER points: u is fastest, as it is here.
#include <tools/formats/input/lexer.hpp>
#include <tools/formats/patch_file.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace simdbezier::tools {

namespace {

// Geometry that is no Bézier patch. Other lists are attributes, views and plain values.
constexpr std::string_view kOtherGeometry[] = {"CURVE",     "TRIMSRF",  "TRISRF",   "TRIVAR",
                                               "MULTIVAR",  "POLYGON",  "POLYLINE", "POINTLIST",
                                               "POLYSTRIP", "INSTANCE", "MODEL",    "VMODEL"};

class ItdReader {
public:
  explicit ItdReader(TextInput& input) : lexer_(input, {.brackets = true, .strings = true}) {
    file_.name = input.name();
  }

  PatchFile read() {
    for (lexer_.skip_to_bracket(); !lexer_.next().at(TokenKind::end); lexer_.skip_to_bracket()) {
      while (lexer_.next().at(TokenKind::open)) { // a list of lists
      }
      if (lexer_.at_word("OBJECT")) {
        object();
      } else if (at_geometry()) {
        lexer_.fail("[OBJECT around all geometry");
      }
    }
    if (file_.count == 0) {
      lexer_.fail("a SURFACE BEZIER");
    }
    return std::move(file_);
  }

private:
  [[nodiscard]] bool at_other_geometry() const {
    return lexer_.at(TokenKind::word) &&
           std::ranges::find(kOtherGeometry, lexer_.text()) != std::end(kOtherGeometry);
  }

  [[nodiscard]] bool at_geometry() const {
    return lexer_.at_word("SURFACE") || lexer_.at_word("OBJECT") || at_other_geometry();
  }

  /// Reads everything up to the object's closing bracket, with the objects inside of it.
  void object() {
    const std::size_t begin = lexer_.line();
    for (std::size_t depth = 1; depth > 0;) {
      lexer_.next();
      if (lexer_.at(TokenKind::end)) {
        lexer_.fail("']' for the object in line " + std::to_string(begin));
      }
      if (lexer_.at(TokenKind::close)) {
        --depth;
      } else if (lexer_.at(TokenKind::open)) {
        depth += lexer_.next().at_word("OBJECT") ? 1 : 0;
        item();
      }
    }
  }

  /// Reads a list in an object, whose first token has been read.
  void item() {
    if (at_other_geometry()) {
      lexer_.fail("a SURFACE BEZIER");
    }
    if (lexer_.at_word("SURFACE")) {
      surface();
    } else if (!lexer_.at_word("OBJECT")) {
      std::size_t depth = 1;
      for (; lexer_.at(TokenKind::open); ++depth) { // lists without names
        lexer_.next();
      }
      if (depth > 1 && at_geometry()) {
        lexer_.fail("one '[' before geometry");
      }
      lexer_.skip_list(lexer_.at(TokenKind::close) ? depth - 1 : depth);
    }
  }

  /// Reads a token that is no attribute.
  Lexer& next_behind_attributes() {
    while (lexer_.next().at(TokenKind::open)) {
      lexer_.skip_list();
    }
    return lexer_;
  }

  int degree(const std::string& direction) {
    const std::string what = "order 2 to 16 (degree 1 to 15) in " + direction;
    return static_cast<int>(lexer_.integer(what, 2, kMostDegree + 1)) - 1;
  }

  void surface() {
    if (!lexer_.next().at_word("BEZIER")) {
      lexer_.fail("SURFACE BEZIER");
    }
    next_behind_attributes();
    const int degree_u = degree("u");
    lexer_.next();
    const int degree_v = degree("v");
    const bool rational = lexer_.next().at_word("P3");
    if (!rational && !lexer_.at_word("E3")) {
      lexer_.fail("point type E3 or P3");
    }
    const auto count = static_cast<std::size_t>((degree_u + 1) * (degree_v + 1));
    for (std::size_t k = 0; k < count; ++k) {
      if (!lexer_.next().at(TokenKind::open)) {
        lexer_.fail(std::to_string(count) + " points in brackets",
                    lexer_.described() + " after " + std::to_string(k));
      }
      point(rational);
    }
    if (!lexer_.next().at(TokenKind::close)) {
      lexer_.fail("']' after " + std::to_string(count) + " points");
    }
    file_.close_patch(degree_u, degree_v, rational ? Weights::homogeneous : Weights::none);
  }

  void point(bool rational) {
    next_behind_attributes();
    file_.add_line(lexer_.line());
    const double weight = rational ? lexer_.weight() : 1;
    for (int c = 0; c < 3; ++c) {
      if (c > 0 || rational) {
        lexer_.next();
      }
      file_.points.push_back(lexer_.number());
    }
    if (rational) {
      file_.points.push_back(weight);
      file_.check_quotients();
    }
    if (!lexer_.next().at(TokenKind::close)) {
      lexer_.fail(rational ? "']' after w x y z" : "']' after x y z");
    }
  }

  Lexer lexer_;
  PatchFile file_;
};

} // namespace

PatchFile read_itd(TextInput& input, const ReadOptions& /*options*/) {
  return ItdReader(input).read();
}

} // namespace simdbezier::tools
