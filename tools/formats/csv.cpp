#include <tools/formats/csv.hpp>

#include <algorithm>
#include <array>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

using Names = std::array<std::string_view, 3>;
constexpr Names kUnitNames = {"patch", "u", "v"};
constexpr Names kCentredNames = {"patch", "x", "y"};
// Results have these names, because x, y and z are positions there. Samples may have them too, so
// that the first columns of results are samples again.
constexpr Names kCentredResultNames = {"patch", "centred_u", "centred_v"};

std::string header_of(const Names& names) {
  return std::string(names[0]) + "," + std::string(names[1]) + "," + std::string(names[2]);
}

constexpr std::size_t kLongestLine = std::size_t{1} << 20;

/// ",x,y,z", ",dux,duy,duz", … or ",nx,ny,nz".
std::string columns_of(Output output) {
  if (output == Output::curvature) {
    return ",gaussian,mean,kmin,kmax";
  }
  const std::string prefix = output == Output::position ? ""
                             : output == Output::normal ? "n"
                                                        : output_name(output);
  std::string columns;
  for (const char* const component : {"x", "y", "z"}) {
    columns += "," + prefix + component;
  }
  return columns;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t";
  const std::size_t first = text.find_first_not_of(kSpace);
  return first == std::string_view::npos
             ? std::string_view{}
             : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

// The trimmed fields of a line. There may be any number of them, of which the first ones are kept.
struct Fields {
  explicit Fields(std::string_view line) {
    for (bool more = true; more; ++count) {
      const std::size_t comma = line.find(',');
      more = comma != std::string_view::npos;
      if (count < value.size()) {
        value[count] = trimmed(line.substr(0, comma));
      }
      line.remove_prefix(more ? comma + 1 : line.size());
    }
  }
  [[nodiscard]] bool are(const Names& names) const {
    return count == names.size() && std::ranges::equal(names, std::span(value).first(names.size()));
  }
  /// The first field that another one repeats, or an empty one.
  [[nodiscard]] std::string_view repeated() const {
    const auto kept = std::span(value).first(std::min(count, value.size()));
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if (std::ranges::find(kept.subspan(k + 1), kept[k]) != kept.end()) {
        return kept[k];
      }
    }
    return {};
  }
  std::array<std::string_view, 8> value;
  std::size_t count = 0;
};

} // namespace

std::string output_names() {
  std::string names;
  for (std::size_t k = 0; k < kColumnOutputs; ++k) {
    names += (k == 0 ? "" : ", ") + std::string(output_name(static_cast<Output>(k)));
  }
  return names;
}

std::size_t column_count(std::span<const Output> outputs) {
  std::size_t count = 0;
  for (const Output output : outputs) {
    count += output == Output::curvature ? 4 : 3;
  }
  return count;
}

SampleReader::SampleReader(const std::string& path, std::size_t patches)
    : input_(path), patches_(patches) {
  const std::string expected = "the header " + header_of(kUnitNames) + ", " +
                               header_of(kCentredNames) + " or " + header_of(kCentredResultNames);
  if (!next_line()) {
    fail(expected, "the end of the file");
  }
  const Fields fields(line_);
  centred_ = fields.are(kCentredNames) || fields.are(kCentredResultNames);
  if (!centred_ && !fields.are(kUnitNames)) {
    const std::string_view repeated = fields.repeated();
    fail(expected,
         in_quotes(line_) + (repeated.empty() ? "" : " with " + in_quotes(repeated) + " twice"));
  }
}

std::optional<CsvSample> SampleReader::next() {
  if (!next_line()) {
    return std::nullopt;
  }
  const Fields fields(line_);
  if (fields.count != 3) {
    fail("3 fields", std::to_string(fields.count) + " in " + in_quotes(line_));
  }
  const auto patch = parse_integer(fields.value[0]);
  if (!patch || *patch >= patches_) {
    fail("a patch number from 0 to " + std::to_string(patches_ - 1), in_quotes(fields.value[0]));
  }
  return CsvSample{static_cast<std::uint32_t>(*patch), parameter(fields.value[1]),
                   parameter(fields.value[2])};
}

void SampleReader::refuse(double parameter, const std::string& precision) const {
  fail("a parameter within the range of " + precision, shortest(parameter));
}

double SampleReader::parameter(std::string_view field) const {
  const auto value = parse_finite(field);
  if (!value) {
    fail("a finite number", describe_non_number(field));
  }
  return *value;
}

bool SampleReader::next_line() {
  do {
    line_.clear();
    int c = input_.get();
    if (c == TextInput::kEnd) {
      return false;
    }
    for (; c != '\n' && c != TextInput::kEnd; c = input_.get()) {
      if (line_.size() == kLongestLine) {
        fail("a line of at most " + std::to_string(kLongestLine) + " characters", in_quotes(line_));
      }
      line_.push_back(static_cast<char>(c));
    }
  } while (trimmed(line_).empty());
  line_ = trimmed(line_);
  return true;
}

void SampleReader::fail(const std::string& expected, const std::string& found) const {
  bad_input_at(input_.name(), input_.line(), expected, found);
}

std::string result_header(bool centred, std::span<const Output> outputs) {
  const Names& names = centred ? kCentredResultNames : kUnitNames;
  std::string line(names[0]);
  for (const std::string_view name : std::span(names).subspan(1)) {
    line.append(",").append(name);
  }
  for (const Output output : outputs) {
    line += columns_of(output);
  }
  return line + "\n";
}

} // namespace simdbezier::tools
