#include <tools/formats/counted_patches.hpp>

#include <array>
#include <limits>
#include <utility>

namespace simdbezier::tools {

CountedPatches::CountedPatches(TextInput& input, std::string each)
    : lexer_(input, {}), each_(std::move(each)) {
  lexer_.next();
  if (lexer_.at(TokenKind::end)) {
    lexer_.fail("the number of patches");
  }
  count_ = lexer_.integer("the number of patches (1 or more)", 1,
                          std::numeric_limits<std::size_t>::max());
  count_line_ = lexer_.line();
  file_.name = input.name();
  file_.expect(input.stored_size());
}

int CountedPatches::degree(const std::string& where) {
  lexer_.next();
  expect_more();
  return lexer_.degree(where);
}

void CountedPatches::patch(int degree_u, int degree_v) {
  const std::size_t all = static_cast<std::size_t>((degree_u + 1) * (degree_v + 1)) * 3;
  for (coordinates_ = 0; coordinates_ < all;) {
    std::array<double, 3> point;
    std::size_t line = 0;
    const std::size_t quick = lexer_.numbers(point, line);
    coordinates_ += quick;
    for (std::size_t c = quick; c < point.size(); ++c, ++coordinates_) {
      lexer_.next();
      expect_more();
      point[c] = lexer_.number();
      line = c == 0 ? lexer_.line() : line;
    }
    file_.points.insert(file_.points.end(), point.begin(), point.end());
    file_.add_line(line);
  }
  file_.close_patch(degree_u, degree_v, Weights::none);
  coordinates_ = 0;
}

PatchFile CountedPatches::finish() {
  if (!lexer_.next().at(TokenKind::end)) {
    lexer_.fail("the end of the file after " + declared());
  }
  return std::move(file_);
}

void CountedPatches::expect_more() {
  if (lexer_.at(TokenKind::end)) {
    lexer_.fail(declared(),
                "the end of the file after " + quantity(file_.count, "patch", "patches") +
                    (coordinates_ == 0
                         ? ""
                         : " and " + quantity(coordinates_, "coordinate", "coordinates")));
  }
}

std::string CountedPatches::declared() const {
  return quantity(count_, "patch", "patches") + each_ + " as declared in line " +
         std::to_string(count_line_);
}

} // namespace simdbezier::tools
