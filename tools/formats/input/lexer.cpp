#include <tools/formats/input/lexer.hpp>

#include <algorithm>
#include <cmath>

#include <simdbezier/control_nets.hpp>
#include <tools/formats/input/from_chars.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

// Words that are no numbers are cut off here. Names are shorter, and binary files have few spaces.
constexpr std::size_t kLongestWord = 512;

constexpr bool is_of_number(int c) noexcept {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
}

} // namespace

Lexer::Lexer(TextInput& input, const Syntax& syntax) : input_(input), syntax_(syntax) {
  for (std::size_t c = 0; c < ends_word_.size(); ++c) {
    ends_word_[c] = is_space(static_cast<int>(c)) || (syntax.brackets && (c == '[' || c == ']')) ||
                    (syntax.strings && c == '"');
  }
}

Lexer& Lexer::next() {
  value_.reset();
  if (is_in_memory()) {
    return *this;
  }
  do {
    copy_.clear();
    text_ = {};
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
      copy_.push_back(static_cast<char>(c));
    } else if (syntax_.strings && c == '"') {
      string();
    } else {
      word(c);
    }
  } while (at(TokenKind::word) && copy_.empty()); // only a backslash that joins two lines
  text_ = copy_;
  return *this;
}

// Nearly all tokens take this way: no character is copied, and a number is converted while its end
// is looked for.
bool Lexer::is_in_memory() {
  if (joins_lines_) {
    return false;
  }
  input_.skip_space_in_memory(syntax_.lines);
  const std::string_view rest = input_.in_memory();
  if (rest.empty() || rest[0] == '\n' || (syntax_.comments && rest[0] == '#')) {
    return false;
  }
  std::size_t length = 1;
  if (!ends_word(rest[0])) {
    length = word_length(rest);
    // A word may go on behind what is in memory, or end with a backslash that joins lines.
    if (length >= std::min(rest.size(), kLongestWord) ||
        (syntax_.lines && rest[length - 1] == '\\')) {
      value_.reset();
      return false;
    }
    kind_ = TokenKind::word;
  } else if (rest[0] == '"') {
    return false;
  } else {
    kind_ = rest[0] == '[' ? TokenKind::open : TokenKind::close;
  }
  text_ = rest.substr(0, length);
  input_.skip_in_line(length);
  line_ = input_.line();
  return true;
}

inline const char* Lexer::number_end(const char* begin, const char* last, double& value) const {
  const auto [end, error] = from_chars(begin, last, value);
  const bool is_word = error == std::errc() && end != last && ends_word(*end);
  return is_word && std::isfinite(value) ? end : nullptr;
}

std::size_t Lexer::numbers(std::span<double> values, std::size_t& line) {
  const std::string_view memory = input_.in_memory();
  const char* const last = memory.data() + memory.size();
  const char* next = memory.data(); // behind the numbers that have been read
  std::size_t count = 0;
  for (; count < values.size(); ++count) {
    const char* begin = next;
    std::size_t line_ends = 0;
    for (; begin != last && is_space(*begin); ++begin) {
      line_ends += *begin == '\n' ? 1 : 0;
    }
    const char* const end = number_end(begin, last, values[count]);
    if (end == nullptr) {
      break;
    }
    input_.skip_lines(static_cast<std::size_t>(end - next), line_ends);
    line = count == 0 ? input_.line() : line;
    text_ = {begin, end};
    next = end;
  }
  if (count > 0) {
    kind_ = TokenKind::word;
    value_ = values[count - 1];
    line_ = input_.line();
  }
  return count;
}

std::size_t Lexer::word_length(std::string_view rest) {
  if (is_of_number(rest[0])) {
    double value = 0;
    if (const char* const end = number_end(rest.data(), rest.data() + rest.size(), value)) {
      value_ = value;
      return static_cast<std::size_t>(end - rest.data());
    }
  }
  rest = rest.substr(0, kLongestWord);
  const auto end = std::ranges::find_if(rest, [this](char c) { return ends_word(c); });
  return static_cast<std::size_t>(end - rest.begin());
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
  copy_.push_back(static_cast<char>(first));
  bool number = is_of_number(first);
  int c = input_.peek();
  for (; c != TextInput::kEnd && !ends_word(static_cast<char>(c)); c = input_.peek()) {
    number = number && (is_of_number(c) || (syntax_.lines && c == '\\'));
    if (copy_.size() >= kLongestWord && !number) {
      copy_.push_back('~');
      return;
    }
    copy_.push_back(static_cast<char>(input_.get()));
  }
  if (syntax_.lines && copy_.back() == '\\' && c == '\n') {
    copy_.pop_back();
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
    if (copy_.size() < kLongestWord) {
      copy_.push_back(static_cast<char>(c));
    } else if (copy_.size() == kLongestWord) {
      copy_.push_back('~'); // what was cut off is no name any more
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

void Lexer::skip_list(std::size_t depth) {
  const std::size_t begin = line();
  while (depth > 0) {
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
  if (value_) {
    return *value_;
  }
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
