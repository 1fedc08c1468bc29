#include <tools/patch_file.hpp>

#include <algorithm>
#include <iterator>
#include <limits>

#include <tools/failure.hpp>
#include <tools/output_file.hpp>
#include <tools/teapot.hpp>

namespace simdbezier::tools {

namespace {

struct Format {
  std::string_view name;
  PatchFormat format;
  PatchFile (*read)(TextInput&);
};
constexpr Format kFormats[] = {
    {"bez", PatchFormat::bez, read_bez}, {"bpt", PatchFormat::bpt, read_bpt},
    {"bv", PatchFormat::bv, read_bv},    {"itd", PatchFormat::itd, read_itd},
    {"obj", PatchFormat::obj, read_obj}, {"rib", PatchFormat::rib, read_rib}};

// What later releases read; until then the answer names the format instead of calling it unknown.
constexpr std::string_view kLaterFormats[] = {"iges", "igs", "step", "stp", "pov"};

const Format* find_format(const std::string& name) {
  const auto* const found = std::ranges::find(kFormats, name, &Format::name);
  if (found == std::end(kFormats) &&
      std::ranges::find(kLaterFormats, name) != std::end(kLaterFormats)) {
    bad_usage("reading ." + name + " files is not supported yet");
  }
  return found == std::end(kFormats) ? nullptr : found;
}

PatchFormat format_of(const std::string& name) {
  const std::string extension = extension_of(name);
  if (extension == "gz") {
    bad_input(name + ": expected a file of patches, found a compressed one; unpack it first");
  }
  if (const Format* const format = find_format(extension)) {
    return format->format;
  }
  bad_usage(name + ": expected a name that ends in " + patch_format_names(".") + ", or --format");
}

PatchFile read_builtin(const std::string& name) {
  if (name != "builtin:teapot") {
    bad_usage(name + ": expected builtin:teapot, found an unknown built-in");
  }
  return teapot();
}

} // namespace

void PatchFile::add_line(std::size_t line) {
  constexpr std::size_t kLast = std::numeric_limits<std::uint32_t>::max();
  lines.push_back(static_cast<std::uint32_t>(std::min(line, kLast)));
}

void PatchFile::close_patch(int degree_u, int degree_v, Weights weights) {
  PatchRun run{degree_u, degree_v, weights};
  if (!runs.empty()) {
    const PatchRun& last = runs.back();
    run.first_patch = count;
    run.first_point = last.first_point + last.count * last.points_per_patch();
    run.first_value =
        last.first_value + last.count * last.points_per_patch() * last.values_per_point();
  }
  if (runs.empty() || runs.back().degree_u != degree_u || runs.back().degree_v != degree_v ||
      runs.back().weights != weights) {
    runs.push_back(run);
  }
  ++runs.back().count;
  ++count;
}

const PatchRun& PatchFile::run_of(std::size_t patch) const {
  const auto after = std::ranges::upper_bound(runs, patch, {}, &PatchRun::first_patch);
  return *std::prev(after);
}

std::span<const double> PatchFile::point(std::size_t patch, std::size_t point) const {
  const PatchRun& run = run_of(patch);
  const std::size_t index = (patch - run.first_patch) * run.points_per_patch() + point;
  return std::span(points).subspan(run.first_value + index * run.values_per_point(),
                                   run.values_per_point());
}

std::string PatchFile::place(std::size_t patch, std::size_t point) const {
  if (lines.empty()) {
    return name;
  }
  const PatchRun& run = run_of(patch);
  const std::size_t index =
      run.first_point + (patch - run.first_patch) * run.points_per_patch() + point;
  return name + ":" + std::to_string(lines[index]);
}

template <typename S>
std::vector<ControlNets<S>> PatchFile::nets(std::span<const S> values) const {
  std::vector<ControlNets<S>> entries;
  entries.reserve(runs.size());
  for (const PatchRun& run : runs) {
    entries.push_back(ControlNets<S>::packed(values.data() + run.first_value, run.count,
                                             run.degree_u, run.degree_v, 3, run.weights));
  }
  return entries;
}

template std::vector<ControlNets<float>> PatchFile::nets(std::span<const float>) const;
template std::vector<ControlNets<double>> PatchFile::nets(std::span<const double>) const;

std::string patch_format_names(const std::string& prefix) {
  std::string names;
  for (const Format& format : kFormats) {
    const bool last = &format == std::end(kFormats) - 1;
    names += names.empty() ? "" : (last ? " or " : ", ");
    names += prefix + std::string(format.name);
  }
  return names;
}

PatchFormat parse_patch_format(const std::string& option, const std::string& name) {
  const Format* const format = find_format(name);
  if (format == nullptr) {
    bad_usage(option + ": expected " + patch_format_names("") + ", found " + in_quotes(name));
  }
  return format->format;
}

PatchFile read_patches(const std::string& in, PatchFormat format) {
  if (in.starts_with("builtin:")) {
    return read_builtin(in);
  }
  if (in == "-" && format == PatchFormat::by_name) {
    bad_usage("reading standard input needs --format " + patch_format_names(""));
  }
  // Opened before its name is judged: what cannot be read is bad input whatever it is called.
  TextInput input(in);
  const PatchFormat found = format == PatchFormat::by_name ? format_of(in) : format;
  return std::ranges::find(kFormats, found, &Format::format)->read(input);
}

} // namespace simdbezier::tools
