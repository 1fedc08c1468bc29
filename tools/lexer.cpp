#include <tools/lexer.hpp>

#include <simdbezier/control_nets.hpp>
#include <tools/failure.hpp>

namespace simdbezier::tools {

namespace {

// Words that are no numbers are cut off here. Names are shorter, and binary files have few spaces.
constexpr std::size_t kLongestWord = 512;

constexpr bool is_of_number(int c) noexcept {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
}

} // namespace

Lexer& Lexer::next() {
  do {
    text_.clear();
    if (skip_space()) {
      kind_ = TokenKind::line_end;
      line_ = input_.line();
      return *this;
    }
    const int c = input_.get();
    line_ = input_.line();
    if (c == TextInput::kEnd) {
      kind_ = TokenKind::end;
      return *this;
    }
    if (syntax_.brackets && (c == '[' || c == ']')) {
      kind_ = c == '[' ? TokenKind::open : TokenKind::close;
      text_.push_back(static_cast<char>(c));
    } else if (syntax_.strings && c == '"') {
      string();
    } else {
      word(c);
    }
  } while (at(TokenKind::word) && text_.empty()); // only a backslash that joins two lines
  return *this;
}

bool Lexer::skip_space() {
  for (;;) {
    const int c = input_.peek();
    if (syntax_.comments && c == '#') {
      skip_line();
    } else if (!is_space(c)) {
      return false;
    } else if (static_cast<void>(input_.get()); syntax_.lines && c == '\n') {
      if (!joins_lines_) {
        return true;
      }
      joins_lines_ = false;
    }
  }
}

void Lexer::word(int first) {
  kind_ = TokenKind::word;
  text_.push_back(static_cast<char>(first));
  bool number = is_of_number(first);
  int c = input_.peek();
  for (; c != TextInput::kEnd && !is_space(c); c = input_.peek()) {
    if ((syntax_.brackets && (c == '[' || c == ']')) || (syntax_.strings && c == '"')) {
      return;
    }
    number = number && (is_of_number(c) || (syntax_.lines && c == '\\'));
    if (text_.size() >= kLongestWord && !number) {
      text_.push_back('~');
      return;
    }
    text_.push_back(static_cast<char>(input_.get()));
  }
  if (syntax_.lines && text_.back() == '\\' && c == '\n') {
    text_.pop_back();
    joins_lines_ = true;
  }
}

void Lexer::string() {
  kind_ = TokenKind::string;
  for (int c = input_.get(); c != '"'; c = input_.get()) {
    c = c == '\\' ? input_.get() : c;
    if (c == TextInput::kEnd) {
      fail("a closing quote", "the end of the file");
    }
    if (text_.size() < kLongestWord) {
      text_.push_back(static_cast<char>(c));
    }
  }
}

void Lexer::skip_line() {
  for (int c = input_.peek(); c != TextInput::kEnd && c != '\n'; c = input_.peek()) {
    static_cast<void>(input_.get());
  }
}

void Lexer::skip_to_bracket() {
  for (int c = input_.peek(); c != TextInput::kEnd && c != '['; c = input_.peek()) {
    static_cast<void>(input_.get());
  }
}

void Lexer::skip_list() {
  const std::size_t begin = line();
  for (std::size_t depth = 1; depth > 0;) {
    next();
    if (at(TokenKind::end)) {
      fail("']' for the list in line " + std::to_string(begin));
    }
    depth += at(TokenKind::open) ? 1 : 0;
    depth -= at(TokenKind::close) ? 1 : 0;
  }
}

void Lexer::fail(const std::string& expected, const std::string& found) const {
  bad_input_at(name(), line(), expected, found);
}

std::string Lexer::described() const {
  switch (kind_) {
  case TokenKind::line_end:
    return "the end of the line";
  case TokenKind::end:
    return "the end of the file";
  default:
    return in_quotes(text_);
  }
}

double Lexer::number() const {
  const auto value = at(TokenKind::word) ? parse_finite(text_) : std::nullopt;
  if (!value) {
    fail("a finite number", at(TokenKind::word) ? describe_non_number(text_) : described());
  }
  return *value;
}

double Lexer::weight() const {
  const double weight = number();
  if (weight <= 0) {
    fail("a weight above 0");
  }
  return weight;
}

std::size_t Lexer::counted(Count count, const std::string& what) const {
  if (!count.value()) {
    fail("a number of " + what + " that can be counted", to_string(count));
  }
  return *count.value();
}

std::size_t Lexer::integer(const std::string& what, std::size_t least, std::size_t most) const {
  const auto value = at(TokenKind::word) ? parse_integer(text_) : std::nullopt;
  if (!value || *value < least || *value > most) {
    fail(what);
  }
  return *value;
}

int Lexer::degree(const std::string& where) const {
  return static_cast<int>(
      integer("degree 1 to " + std::to_string(kMostDegree) + " " + where, 1, kMostDegree));
}

} // namespace simdbezier::tools
