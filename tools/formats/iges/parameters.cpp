#include <tools/formats/iges/parameters.hpp>

#include <algorithm>

#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

// Entities may show each other again and again. A file may do so with each of its lines, on
// average, a hundred times, and small files as often as that matters little.
constexpr std::size_t kMostTimes = 100;
constexpr std::size_t kFewLines = 65536;

} // namespace

IgesParameters::IgesParameters(IgesRecords& records, std::size_t index)
    : records_(records), first_line_(records.entities[index].first_line) {
  const IgesEntity& entity = records.entities[index];
  const std::size_t all = records.parameters.size() / IgesRecords::kColumns;
  if (entity.lines == 0 || first_line_ == 0 || first_line_ > all ||
      entity.lines > all - first_line_ + 1) {
    records.fail(index, "parameters within the " + quantity(all, "line", "lines") + " of section P",
                 quantity(entity.lines, "line", "lines") + " from line " +
                     std::to_string(first_line_) + " on");
  }
  records.lines_read += entity.lines;
  if (records.lines_read > kFewLines + kMostTimes * all) {
    records.fail(index, "entities that show each other at most 100 times", "more");
  }
  data_ = std::string_view(records.parameters)
              .substr((first_line_ - 1) * IgesRecords::kColumns,
                      entity.lines * std::size_t{IgesRecords::kColumns});
  const std::string type = "type " + std::to_string(entity.type) + " as in line " +
                           std::to_string(records.line_of(index)) + " of the directory";
  next(type);
  if (parse_integer(text_) != entity.type) {
    fail(type);
  }
}

std::size_t IgesParameters::line() const noexcept {
  return records_.parameter_line + first_line_ - 1 +
         std::min(begin_, data_.size() - 1) / IgesRecords::kColumns;
}

// A string is a count, H and so many characters, which may be delimiters as well.
void IgesParameters::next(const std::string& what) {
  if (ended_) {
    text_ = {};
    fail(what, "the end of the entity's parameters");
  }
  begin_ = std::min(data_.find_first_not_of(' ', next_), data_.size());
  const char ends[] = {records_.separator, records_.terminator};
  const std::string_view delimiters(ends, 2);
  const std::size_t digits = std::min(data_.find_first_not_of("0123456789", begin_), data_.size());
  is_string_ = digits > begin_ && digits < data_.size() && data_[digits] == 'H';
  std::size_t end = 0;
  if (is_string_) {
    const auto length = parse_integer(data_.substr(begin_, digits - begin_));
    if (!length || *length > data_.size() - digits - 1) {
      fail("a string within the entity's lines",
           in_quotes(data_.substr(begin_, digits + 1 - begin_)));
    }
    text_ = data_.substr(digits + 1, *length);
    end = data_.find_first_not_of(' ', digits + 1 + *length);
  } else {
    end = data_.find_first_of(delimiters, begin_);
    text_ = data_.substr(begin_, end == std::string_view::npos ? end : end - begin_);
    text_ = text_.substr(0, text_.find_last_not_of(' ') + 1);
  }
  if (end == std::string_view::npos || delimiters.find(data_[end]) == std::string_view::npos) {
    fail(in_quotes(delimiters.substr(0, 1)) + " or " + in_quotes(delimiters.substr(1)) +
             " behind the parameter",
         end == std::string_view::npos ? "the end of the entity's lines"
                                       : in_quotes(data_.substr(end, 1)));
  }
  ended_ = data_[end] == records_.terminator;
  next_ = end + 1;
}

double IgesParameters::real(const char* what) {
  next(what);
  if (left_out()) {
    return 0;
  }
  auto value = is_string_ ? std::nullopt : parse_finite(text_);
  const std::size_t exponent = text_.find_first_of("Dd"); // those of double precision begin with D
  if (!value && !is_string_ && exponent != std::string_view::npos) {
    std::string word(text_);
    word[exponent] = 'E';
    value = parse_finite(word);
  }
  if (!value) {
    fail(std::string("a finite number (") + what + ")",
         is_string_ ? "a string" : describe_non_number(text_));
  }
  return *value;
}

double IgesParameters::weight() {
  const double weight = real("a weight");
  if (weight <= 0) {
    fail("a weight above 0", shortest(weight));
  }
  return weight;
}

std::size_t IgesParameters::integer(const std::string& what, std::size_t least, std::size_t most) {
  next(what);
  const auto value = is_string_ ? std::nullopt : left_out() ? 0 : parse_integer(text_);
  if (!value || *value < least || *value > most) {
    fail(what);
  }
  return *value;
}

std::optional<std::size_t> IgesParameters::pointer(const char* what) {
  const std::size_t entities = records_.entities.size();
  const std::size_t number =
      integer(what, 0, std::max(2 * entities, std::size_t{1}) - 1); // numbers are those of lines
  if (number == 0) {
    return std::nullopt;
  }
  if (number % 2 == 0) {
    fail(std::string(what) + ", an odd number");
  }
  return number / 2;
}

void IgesParameters::skip(std::size_t count, const char* what) {
  for (std::size_t k = 0; k < count; ++k) {
    next(what);
  }
}

void IgesParameters::finish() {
  constexpr std::size_t kMost = 1U << 20;
  for (const char* const what : {"a number of associativities", "a number of properties"}) {
    if (more()) {
      for (std::size_t left = integer(what, 0, kMost); left > 0; --left) {
        pointer("a pointer to an associativity or a property");
      }
    }
  }
  if (more()) {
    next("");
    fail("the end of the entity's parameters");
  }
}

void IgesParameters::fail(const std::string& expected) const {
  fail(expected, is_string_ ? "a string" : left_out() ? "none" : in_quotes(text_));
}

void IgesParameters::fail(const std::string& expected, const std::string& found) const {
  bad_input_at(records_.name, line(), expected, found);
}

} // namespace simdbezier::tools
