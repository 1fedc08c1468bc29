#include <tools/formats/iges/records.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::string_view kSections = "SGDPT";
enum Section : std::size_t { start, global, directory, parameter, terminate };
constexpr std::size_t kLetterColumn = 72; // counted from 0; the number of the line stands behind it
constexpr std::size_t kLineColumns = 80;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string_view::npos
             ? std::string_view()
             : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

class IgesRecordReader {
public:
  explicit IgesRecordReader(TextInput& input) : input_(input) { records_.name = input.name(); }

  IgesRecords read() {
    while (counts_[terminate] == 0) {
      next_line();
      take_section();
      take_line();
    }
    expect_end();
    return std::move(records_);
  }

private:
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
    bad_input_at(records_.name, input_.line(), expected, found);
  }

  /// Reads the columns of the next line. What follows them has to be blank.
  void next_line() {
    line_.clear();
    if (input_.peek() == TextInput::kEnd) {
      fail(std::string("section ") + kSections[next_section()], "the end of the file");
    }
    for (int c = input_.get(); c != TextInput::kEnd && c != '\n'; c = input_.get()) {
      if (line_.size() < kLineColumns) {
        line_.push_back(static_cast<char>(c));
      } else if (c != ' ') {
        fail("lines of 80 columns", "a longer one");
      }
    }
  }

  [[nodiscard]] std::size_t next_section() const {
    return section_ == kNone ? start : section_ + 1;
  }

  /// Finds the section of the line, which has to be the last line's or the next one.
  void take_section() {
    const char letter = line_.size() > kLetterColumn ? line_[kLetterColumn] : ' ';
    const std::size_t found = kSections.find(letter);
    if (section_ == kNone && (letter == 'C' || letter == 'B')) {
      fail("IGES in its fixed ASCII form",
           letter == 'C' ? "the compressed form (C in column 73)" : "the binary form");
    }
    if (found == std::string_view::npos || (found != section_ && found != next_section())) {
      const std::string same =
          section_ == kNone ? std::string() : std::string(1, kSections[section_]) + " or ";
      fail(same + kSections[next_section()] + " in column 73, as its section has",
           line_.size() > kLetterColumn ? in_quotes(std::string(1, letter))
                                        : quantity(line_.size(), "column", "columns"));
    }
    if (found != section_) {
      end_section();
      section_ = found;
    }
    const std::size_t number = ++counts_[section_];
    const std::string_view text = trimmed(std::string_view(line_).substr(kLetterColumn + 1));
    if (parse_integer(text) != number) {
      fail("line number " + std::to_string(number) + " of section " + kSections[section_] +
               " in columns 74 to 80",
           in_quotes(text));
    }
  }

  void end_section() {
    if (section_ == global) {
      delimiters();
    } else if (section_ == directory && counts_[directory] % 2 != 0) {
      fail("two lines of the directory for each entity", "an odd number of lines");
    }
  }

  void take_line() {
    const std::string_view line = line_;
    switch (section_) {
    case global:
      global_line_ = counts_[global] == 1 ? input_.line() : global_line_;
      global_ += counts_[global] <= 2 ? line.substr(0, kLetterColumn) : std::string_view();
      break;
    case directory:
      records_.directory_line = counts_[directory] == 1 ? input_.line() : records_.directory_line;
      counts_[directory] % 2 == 1 ? first_directory_line() : second_directory_line();
      break;
    case parameter:
      records_.parameter_line = counts_[parameter] == 1 ? input_.line() : records_.parameter_line;
      records_.parameters += line.substr(0, IgesRecords::kColumns);
      break;
    case terminate:
      check_counts();
      break;
    default:
      break;
    }
  }

  /// The first two parameters of the global section are the two delimiters as strings, 1H, and 1H;
  /// unless they are left out.
  void delimiters() {
    std::string_view text = global_;
    const auto next = [&](char standard, char separator) {
      if (text.starts_with("1H") && text.size() > 3) {
        standard = text[2];
        text.remove_prefix(3);
      }
      const char expected = separator == 0 ? standard : separator;
      const bool is_last = separator != 0 && text.starts_with(standard); // all others are left out
      if (text.empty() || (text[0] != expected && !is_last) ||
          std::string_view("0123456789+-.DEH \"'").find(standard) != std::string_view::npos) {
        bad_input_at(records_.name, global_line_,
                     "1H, and 1H; (or other delimiters) or nothing as the first two parameters",
                     in_quotes(trimmed(std::string_view(global_).substr(0, 12))));
      }
      text.remove_prefix(1);
      return standard;
    };
    records_.separator = next(',', 0);
    records_.terminator = next(';', records_.separator);
    if (records_.separator == records_.terminator) {
      bad_input_at(records_.name, global_line_, "two different delimiters",
                   in_quotes(std::string(1, records_.separator)) + " twice");
    }
  }

  /// Returns a field of eight columns, the first one being 0, as a number; 0 where it is blank.
  template <typename Integer>
  [[nodiscard]] Integer field(std::size_t number, const char* what) const {
    std::string_view text = trimmed(std::string_view(line_).substr(8 * number, 8));
    Integer value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (!text.empty() && (error != std::errc() || end != text.data() + text.size())) {
      fail(what, in_quotes(text));
    }
    return value;
  }

  void first_directory_line() {
    IgesEntity entity;
    entity.type = field<std::uint32_t>(0, "the type of an entity");
    entity.first_line = field<std::uint32_t>(1, "the line of an entity's parameters");
    entity.matrix = field<std::uint32_t>(6, "the number of a transformation");
    std::replace(line_.begin() + 64, line_.begin() + kLetterColumn, ' ', '0');
    entity.status = field<std::uint32_t>(8, "a status of eight digits");
    records_.entities.push_back(entity);
  }

  void second_directory_line() {
    IgesEntity& entity = records_.entities.back();
    if (field<std::uint32_t>(0, "the type of an entity") != entity.type) {
      fail("type " + std::to_string(entity.type) + " as in the line before",
           in_quotes(trimmed(std::string_view(line_).substr(0, 8))));
    }
    entity.lines = field<std::uint32_t>(3, "how many lines an entity's parameters have");
    entity.form = field<std::int32_t>(4, "the form of an entity");
  }

  /// The last line has the number of lines of each section.
  void check_counts() const {
    for (std::size_t section = start; section < terminate; ++section) {
      const std::string expected = kSections[section] + std::to_string(counts_[section]);
      const std::string_view text = trimmed(std::string_view(line_).substr(8 * section, 8));
      if (text.empty() || text[0] != kSections[section] ||
          parse_integer(trimmed(text.substr(1))) != counts_[section]) {
        fail(expected + " as the number of lines of that section", in_quotes(text));
      }
    }
  }

  void expect_end() {
    for (int c = input_.get(); c != TextInput::kEnd; c = input_.get()) {
      if (!is_space(c)) {
        fail("the end of the file behind section T",
             in_quotes(std::string(1, static_cast<char>(c))));
      }
    }
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  TextInput& input_;
  IgesRecords records_;
  std::string line_;
  std::string global_; // as much of it as has the delimiters
  std::size_t global_line_ = 0;
  std::size_t section_ = kNone;
  std::array<std::size_t, 5> counts_ = {};
};

} // namespace

void IgesRecords::fail(std::size_t entity, const std::string& expected,
                       const std::string& found) const {
  bad_input_at(name, line_of(entity), expected, found);
}

IgesRecords read_iges_records(TextInput& input) { return IgesRecordReader(input).read(); }

} // namespace simdbezier::tools
