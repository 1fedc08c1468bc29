// BezierView .bv: segments of a kind, its degrees and its points, with lines "group COLOUR NAME"
// in between. Points stand in rows of deg_v + 1, rows in the order of the format's u: what it calls
// u runs across the rows and is our v. Kind 8 has points wx wy wz w.
#include <tools/formats/input/lexer.hpp>
#include <tools/formats/patch_file.hpp>

#include <utility>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kMostKind = 1000;

std::string name_of_kind(std::size_t kind) {
  switch (kind) {
  case 1:
    return "kind 1 (polyhedron)";
  case 3:
    return "kind 3 (triangular patch)";
  case 9:
    return "kind 9 (PN triangle)";
  case 10:
    return "kind 10 (PN quad)";
  default:
    return "kind " + std::to_string(kind);
  }
}

class BvReader {
public:
  explicit BvReader(TextInput& input) : lexer_(input, {}) { file_.name = input.name(); }

  PatchFile read() {
    for (lexer_.next(); !lexer_.at(TokenKind::end); lexer_.next()) {
      if (lexer_.at_word("group") || lexer_.at_word("Group")) {
        lexer_.skip_line();
      } else {
        segment();
      }
    }
    if (file_.count == 0) {
      lexer_.fail("a patch");
    }
    return std::move(file_);
  }

private:
  void segment() {
    const std::string expected = "kind 4, 5 or 8 (tensor-product patches)";
    const std::size_t kind = lexer_.integer(expected + " or group", 0, kMostKind);
    if (kind != 4 && kind != 5 && kind != 8) {
      lexer_.fail(expected, name_of_kind(kind));
    }
    begin_ = lexer_.line();
    const int degree_v = lexer_.next().degree("across the rows (deg_u)");
    const int degree_u = kind == 4 ? degree_v : lexer_.next().degree("along a row (deg_v)");
    const auto count = static_cast<std::size_t>((degree_u + 1) * (degree_v + 1));
    for (std::size_t k = 0; k < count; ++k) {
      point(kind == 8, k, count);
    }
    file_.close_patch(degree_u, degree_v, kind == 8 ? Weights::homogeneous : Weights::none);
  }

  void point(bool rational, std::size_t k, std::size_t count) {
    for (int c = 0; c < 3; ++c) {
      next(k, count);
      if (c == 0) {
        file_.add_line(lexer_.line());
      }
      file_.points.push_back(lexer_.number());
    }
    if (rational) {
      next(k, count);
      file_.points.push_back(lexer_.weight());
      file_.check_quotients();
    }
  }

  void next(std::size_t k, std::size_t count) {
    if (lexer_.next().at(TokenKind::end)) {
      lexer_.fail(std::to_string(count) + " points of the patch in line " + std::to_string(begin_),
                  "the end of the file in point " + std::to_string(k + 1));
    }
  }

  Lexer lexer_;
  PatchFile file_;
  std::size_t begin_ = 0;
};

} // namespace

PatchFile read_bv(TextInput& input, const ReadOptions& /*options*/) {
  return BvReader(input).read();
}

} // namespace simdbezier::tools
