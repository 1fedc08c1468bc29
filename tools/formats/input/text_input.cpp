#include <tools/formats/input/text_input.hpp>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <tools/formats/input/from_chars.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 16;

// from_chars() takes no plus sign; one is allowed in our formats, "+-1" is not.
std::string_view without_plus(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return plus ? word.substr(1) : word;
}

struct ParsedNumber {
  bool is_number = false;
  double value = 0;
};

ParsedNumber parse_number(std::string_view word) {
  word = without_plus(word);
  double value = 0;
  const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) {
    return {};
  }
  if (error == std::errc::result_out_of_range) {
    // from_chars() does not say whether the number is too large or too small.
    value = std::strtod(std::string(word).c_str(), nullptr);
  }
  return {true, value};
}

} // namespace

TextInput::TextInput(const std::string& path)
    : name_(path == "-" ? "standard input" : path), source_(path), buffer_(kBufferSize) {}

TextInput::TextInput(std::string name, std::span<const char> memory)
    : name_(std::move(name)), source_(memory), buffer_(kBufferSize) {}

bool TextInput::fill() {
  do {
    next_ = 0;
    try {
      end_ = source_.read(buffer_.data(), buffer_.size());
    } catch (const DamagedInput& damage) {
      bad_input_at(name_, line_, damage.expected, damage.found);
    }
    if (end_ == 0) {
      return false;
    }
    skip_byte_order_mark();
    unify_line_ends();
  } while (next_ == end_);
  return true;
}

void TextInput::skip_byte_order_mark() {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (std::exchange(at_start_, false) &&
      std::string_view(buffer_.data(), end_).starts_with(kMark)) {
    next_ = kMark.size();
  }
}

// An LF behind a CR belongs to it, even where a block ends in between.
void TextInput::unify_line_ends() {
  if (!after_return_ && std::memchr(buffer_.data(), '\r', end_) == nullptr) {
    return;
  }
  std::size_t kept = next_;
  for (std::size_t k = next_; k < end_; ++k) {
    const bool goes_with = after_return_ && buffer_[k] == '\n';
    after_return_ = buffer_[k] == '\r';
    if (!goes_with) {
      buffer_[kept++] = after_return_ ? '\n' : buffer_[k];
    }
  }
  end_ = kept;
}

std::optional<double> parse_finite(std::string_view word) {
  const ParsedNumber number = parse_number(word);
  if (!number.is_number || !std::isfinite(number.value)) {
    return std::nullopt;
  }
  return number.value;
}

std::optional<std::uint64_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) {
    return std::nullopt;
  }
  return value;
}

bool is_number(std::string_view word) { return parse_number(word).is_number; }

std::string describe_non_number(std::string_view word) {
  const ParsedNumber number = parse_number(word);
  if (number.is_number && std::isnan(number.value)) { // with a payload or without: nan(1)
    return in_quotes(word) + ", which is not a number";
  }
  const bool too_large = number.is_number && std::isinf(number.value) &&
                         word.find_first_of("0123456789") != std::string_view::npos;
  return in_quotes(word) + (too_large ? ", which is too large for a double" : "");
}

} // namespace simdbezier::tools
