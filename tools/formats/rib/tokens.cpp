#include <tools/formats/rib/tokens.hpp>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {

void RibTokens::pass_over_array(std::vector<double>* numbers) {
  const std::string expected = "']' for the array in line " + std::to_string(line());
  while (!next().at(TokenKind::close)) {
    if (!at(TokenKind::string) && !at_number()) {
      fail(expected);
    }
    if (numbers != nullptr && at(TokenKind::word)) {
      numbers->push_back(number());
    }
  }
}

std::vector<double> RibTokens::numbers_of(const std::string& what) {
  if (next().at(TokenKind::open)) {
    const std::string expected = what + ", or ']' for the array in line " + std::to_string(line());
    std::vector<double> numbers;
    while (!next().at(TokenKind::close)) {
      if (!at_number()) {
        fail(expected);
      }
      numbers.push_back(number());
    }
    return numbers;
  }
  if (!at_number()) {
    fail(what);
  }
  return {number()};
}

void RibTokens::expect_close(const std::string& what) {
  if (!next().at(TokenKind::close)) {
    fail("']' after " + what);
  }
}

std::size_t RibTokens::next_count(const std::string& what, std::size_t least, std::size_t most) {
  const std::string range = std::to_string(least) + " to " + std::to_string(most);
  return next().integer(what + " (" + range + ")", least, most);
}

std::string RibTokens::parameter_name() const {
  constexpr std::string_view space = " \t\n\r\f\v";
  const std::string_view declared = text().substr(0, text().find_last_not_of(space) + 1);
  return std::string(declared.substr(declared.find_last_of(space) + 1));
}

void RibTokens::pass_over_value(const std::string& name) {
  if (next().at(TokenKind::open)) {
    pass_over_array();
  } else if (!at(TokenKind::string) && !at_number()) {
    fail("a value of the parameter " + in_quotes(name));
  }
}

} // namespace simdbezier::tools
