#include <tools/patch_file.hpp>

#include <algorithm>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include <tools/failure.hpp>
#include <tools/output_file.hpp>
#include <tools/teapot.hpp>

namespace simdbezier::tools {

namespace {

// What later releases read; until then the answer names the format instead of calling it unknown.
constexpr std::string_view kLaterFormats[] = {"bv",  "itd", "iges", "igs", "step",
                                              "stp", "rib", "pov",  "obj"};

PatchFormat format_of(const std::string& name) {
  const std::string extension = extension_of(name);
  if (extension == "bez") {
    return PatchFormat::bez;
  }
  if (extension == "bpt") {
    return PatchFormat::bpt;
  }
  if (extension == "gz") {
    bad_input(name + ": expected a .bez or .bpt file, found a compressed one; unpack it first");
  }
  if (std::ranges::find(kLaterFormats, extension) != std::end(kLaterFormats)) {
    bad_usage(name + ": reading ." + extension + " files is not supported yet");
  }
  bad_usage(name + ": expected a name that ends in .bez or .bpt, or --format");
}

PatchFile read_builtin(const std::string& name) {
  if (name != "builtin:teapot") {
    bad_usage(name + ": expected builtin:teapot, found an unknown built-in");
  }
  return teapot();
}

template <typename T>
[[noreturn]] void refuse(const PatchFile& file, const PackReport& report) {
  const auto point = static_cast<std::size_t>(report.point);
  const std::size_t index = report.patch * PatchFile::kCoordinates + point * 3 +
                            static_cast<std::size_t>(report.component);
  const std::string type = sizeof(T) == sizeof(float) ? "f32" : "f64";
  switch (report.status) {
  case Status::non_finite_input:
    bad_input(file.place(report.patch, point) + ": expected coordinates within the range of " +
              type + ", found " + shortest(file.points[index]));
  case Status::coefficient_overflow:
    bad_input(file.place(report.patch, 0) + ": expected a patch whose coefficients fit " + type +
              ", found coordinates too large for that");
  default:
    bad_input(file.name + ": " + std::string(to_string(report.status)));
  }
}

} // namespace

std::string PatchFile::place(std::size_t patch, std::size_t point) const {
  return lines.empty() ? name : name + ":" + std::to_string(lines[patch * kPoints + point]);
}

PatchFile read_patches(const std::string& in, PatchFormat format) {
  if (in.starts_with("builtin:")) {
    return read_builtin(in);
  }
  if (in == "-" && format == PatchFormat::by_name) {
    bad_usage("reading standard input needs --format bez or --format bpt");
  }
  // Opened before its name is judged: what cannot be read is bad input whatever it is called.
  TextInput input(in);
  const PatchFormat found = format == PatchFormat::by_name ? format_of(in) : format;
  return found == PatchFormat::bez ? read_bez(input) : read_bpt(input);
}

template <typename T>
PatchSet<T> pack_patches(const PatchFile& file) {
  PatchSet<T> set;
  std::vector<T> rounded;
  ControlNets<T> nets;
  nets.count = file.count;
  if constexpr (std::is_same_v<T, double>) {
    nets.points = file.points.data();
  } else {
    rounded.resize(file.points.size());
    std::ranges::transform(file.points, rounded.begin(),
                           [](double x) { return static_cast<T>(x); });
    nets.points = rounded.data();
  }
  if (const PackReport report = pack(nets, set); !report) {
    refuse<T>(file, report);
  }
  return set;
}

template PatchSet<float> pack_patches<float>(const PatchFile& file);
template PatchSet<double> pack_patches<double>(const PatchFile& file);

namespace detail {

PatchReader::PatchReader(TextInput& input)
    : tokens_(input), count_(tokens_.patch_count()), count_line_(tokens_.line()) {
  file_.name = input.name();
}

void PatchReader::coordinates() {
  constexpr std::size_t kLastLine = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t k = 0; k < PatchFile::kCoordinates; ++k) {
    const auto value = tokens_.coordinate();
    if (!value) {
      ended_early();
    }
    file_.points.push_back(*value);
    if (k % 3 == 0) {
      file_.lines.push_back(static_cast<std::uint32_t>(std::min(tokens_.line(), kLastLine)));
    }
  }
  ++file_.count;
}

std::string PatchReader::declared() const {
  return std::to_string(count_) + " patches of 48 coordinates as declared in line " +
         std::to_string(count_line_);
}

void PatchReader::ended_early() const {
  const std::size_t rest = file_.points.size() % PatchFile::kCoordinates;
  bad_input_at(tokens_.name(), tokens_.line(), declared(),
               "the end of the file after " + std::to_string(file_.count) + " patches" +
                   (rest == 0 ? "" : " and " + std::to_string(rest) + " coordinates"));
}

PatchFile PatchReader::finish() {
  if (const auto word = tokens_.next()) {
    bad_input_at(tokens_.name(), tokens_.line(), "the end of the file after " + declared(),
                 in_quotes(*word));
  }
  return std::move(file_);
}

} // namespace detail

} // namespace simdbezier::tools
