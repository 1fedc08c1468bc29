#include <tools/formats/patch_file.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <type_traits>

#include <tools/formats/teapot.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>
#include <tools/process/progress.hpp>

namespace simdbezier::tools {

namespace {

struct Format {
  std::string_view name;
  PatchFormat format;
  PatchFile (*read)(TextInput&, const ReadOptions&);
};
#define SIMDBEZIER_PATCH_FORMAT_ROW(NAME) {#NAME, PatchFormat::NAME, read_##NAME},
constexpr Format kFormats[] = {SIMDBEZIER_EACH_PATCH_FORMAT(SIMDBEZIER_PATCH_FORMAT_ROW)};
#undef SIMDBEZIER_PATCH_FORMAT_ROW

// Later releases will read these; until then the answer names the format as not supported yet.
constexpr std::string_view kLaterFormats[] = {"step", "stp", "pov"};
constexpr const char* kInsteadOfStep =
    ", because faces of STEP files are nearly always trimmed: export untrimmed surfaces as IGES "
    "(entity 128)";

// Other extensions of these formats.
constexpr std::string_view without_alias(std::string_view name) {
  return name == "igs" ? "iges" : name;
}

// subject: what names the format, for the message.
const Format* find_format(const std::string& subject, const std::string& name) {
  const auto* const found = std::ranges::find(kFormats, without_alias(name), &Format::name);
  if (found == std::end(kFormats) &&
      std::ranges::find(kLaterFormats, name) != std::end(kLaterFormats)) {
    bad_usage(subject + ": reading ." + name + " files is not supported yet" +
              (name == "pov" ? "" : kInsteadOfStep));
  }
  return found == std::end(kFormats) ? nullptr : found;
}

PatchFormat format_of(const std::string& name) {
  std::string extension = extension_of(name);
  if (extension == "gz") { // model.bez.gz is a .bez file
    extension = extension_of(name.substr(0, name.size() - extension.size() - 1));
  }
  if (const Format* const format = find_format(name, extension)) {
    return format->format;
  }
  bad_usage(name + ": expected a name that ends in " + patch_format_names(".") + ", or --format");
}

PatchFile read_as(PatchFormat format, TextInput& input, const ReadOptions& options) {
  return std::ranges::find(kFormats, format, &Format::format)->read(input, options);
}

PatchFile read_builtin(const std::string& name) {
  if (name != "builtin:teapot") {
    bad_usage(name + ": expected builtin:teapot, found an unknown built-in");
  }
  return teapot();
}

} // namespace

void PatchFile::expect(std::uint64_t bytes) {
  constexpr std::size_t kUsualBytes = 6; // what a number takes
  constexpr std::uint64_t kMost = std::uint64_t{1} << 36;
  const auto numbers = static_cast<std::size_t>(std::min(bytes, kMost) / kUsualBytes);
  try {
    points.reserve(numbers);
    lines.reserve(numbers / 3);
  } catch (const std::bad_alloc&) { // there may be less in the file than its size promises
  }
}

void PatchFile::add_line(std::size_t line) {
  constexpr std::size_t kLast = std::numeric_limits<std::uint32_t>::max();
  lines.push_back(static_cast<std::uint32_t>(std::min(line, kLast)));
}

void PatchFile::check_quotients() const {
  const std::span<const double> point = std::span(points).last(4);
  for (const double coordinate : point.first(3)) {
    if (!std::isfinite(coordinate / point[3])) {
      bad_input(name + ":" + std::to_string(lines.back()) +
                ": expected coordinates that are finite when divided by their weight, found " +
                shortest(coordinate) + " / " + shortest(point[3]));
    }
  }
}

void PatchFile::close_patch(int degree_u, int degree_v, Weights weights) {
  const auto columns = static_cast<std::size_t>(degree_u) + 1;
  const auto rows = static_cast<std::size_t>(degree_v) + 1;
  close_mesh(degree_u, degree_v, weights, {columns, columns, 1}, {rows, rows, 1});
}

void PatchFile::close_mesh(int degree_u, int degree_v, Weights weights, const MeshDirection& u,
                           const MeshDirection& v) {
  PatchRun run{degree_u, degree_v, weights};
  run.stride = run.values_per_point();
  run.first_value = points.size() - u.points * v.points * run.stride;
  run.first_point = lines.empty() ? 0 : lines.size() - u.points * v.points;
  run.u = u;
  run.v = v;
  add(run);
}

void PatchFile::close_indexed_mesh(int degree_u, int degree_v, Weights weights,
                                   const MeshDirection& u, const MeshDirection& v) {
  PatchRun run{degree_u, degree_v, weights};
  run.stride = 4;
  run.first_vertex = vertices.size() - u.points * v.points;
  run.u = u;
  run.v = v;
  add(run);
}

template <typename S>
void PatchFile::close_stored(PatchRun shape, std::size_t patches, const S* values) {
  const std::size_t columns = static_cast<std::size_t>(shape.degree_u) + 1;
  const std::size_t rows = static_cast<std::size_t>(shape.degree_v) + 1;
  shape.stride = shape.values_per_point();
  shape.u = {columns, columns, 1};
  shape.v = {patches * rows, rows, patches};
  if constexpr (std::is_same_v<S, float>) {
    shape.floats = values;
  } else {
    shape.doubles = values;
  }
  add(shape);
}

template void PatchFile::close_stored(PatchRun, std::size_t, const float*);
template void PatchFile::close_stored(PatchRun, std::size_t, const double*);

void PatchFile::take_values() {
  for (PatchRun& run : runs) {
    if (run.floats != nullptr || run.doubles != nullptr) {
      run.first_value = points.size();
      visit_values(run, [&](const auto* values) {
        points.insert(points.end(), values, values + run.values());
      });
      run.floats = nullptr;
      run.doubles = nullptr;
    }
  }
  memory.clear();
}

void PatchFile::add(PatchRun run) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::size_t patches = run.u.patches * run.v.patches; // fewer than points
  if (!(Count(count) + patches).within(kMost)) {
    bad_input(name + ": expected at most " + std::to_string(kMost) + " patches, found more");
  }
  const auto rows = static_cast<std::size_t>(run.degree_v) + 1;
  if ((run.is_patch() || run.is_column()) && !runs.empty() && runs.back().is_column_like(run)) {
    runs.back().v.points += run.v.points;
    runs.back().v.patches += run.v.patches;
    runs.back().count += patches;
  } else {
    run.v.step = run.is_patch() ? rows : run.v.step; // another patch may follow
    run.first_patch = count;
    run.count = patches;
    runs.push_back(run);
  }
  count += patches;
}

bool PatchRun::is_patch() const noexcept {
  return u.patches == 1 && v.patches == 1 && u.points * v.points == points_per_patch();
}

bool PatchRun::is_column() const noexcept {
  return u.patches == 1 && u.points == static_cast<std::size_t>(degree_u) + 1 &&
         v.step == static_cast<std::size_t>(degree_v) + 1 && v.points == v.patches * v.step;
}

bool PatchRun::is_column_like(const PatchRun& patch) const noexcept {
  const auto follows = [&](const auto* before, const auto* next) {
    return (before == nullptr ? nullptr : before + values()) == next;
  };
  return is_column() && degree_u == patch.degree_u && degree_v == patch.degree_v &&
         weights == patch.weights && first_vertex.has_value() == patch.first_vertex.has_value() &&
         follows(floats, patch.floats) && follows(doubles, patch.doubles);
}

const PatchRun& PatchFile::run_of(std::size_t patch) const {
  const auto after = std::ranges::upper_bound(runs, patch, {}, &PatchRun::first_patch);
  return *std::prev(after);
}

PatchFile::RunPoint PatchFile::find(std::size_t patch, std::size_t point) const {
  const PatchRun& run = run_of(patch);
  const std::size_t columns = static_cast<std::size_t>(run.degree_u) + 1;
  const std::size_t k = run.mesh_point(patch - run.first_patch, point % columns, point / columns);
  return {run, point_index(run, k)};
}

std::vector<double> PatchFile::point(std::size_t patch, std::size_t point) const {
  const RunPoint at = find(patch, point);
  return visit_values(at.run, [&](const auto* values) {
    values += at.index * at.run.stride;
    return std::vector<double>(values, values + at.run.values_per_point());
  });
}

std::string PatchFile::place(std::size_t patch, std::size_t point) const {
  if (lines.empty()) {
    return name;
  }
  const auto [run, index] = find(patch, point);
  return name + ":" + std::to_string(lines[run.first_point + index]);
}

template <typename S>
void PatchFile::append(const PatchRun& run, std::size_t patch, LargeVector<S>& values) const {
  const auto columns = static_cast<std::size_t>(run.degree_u) + 1;
  const auto rows = static_cast<std::size_t>(run.degree_v) + 1;
  const std::size_t each = run.values_per_point();
  visit_values(run, [&](const auto* first) {
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        const auto* const value =
            first + point_index(run, run.mesh_point(patch, i, j)) * run.stride;
        for (std::size_t c = 0; c < each; ++c) {
          values.push_back(static_cast<S>(value[c]));
        }
      }
    }
  });
}

template <typename S>
const S* PatchFile::in_place(const PatchRun& run, std::size_t patch) const {
  if (!run.is_column() || run.first_vertex || run.stride != run.values_per_point()) {
    return nullptr;
  }
  return visit_values(run, [&](const auto* first) -> const S* {
    if constexpr (std::is_same_v<decltype(first), const S*>) {
      return first + (patch - run.first_patch) * run.points_per_patch() * run.stride;
    } else {
      return nullptr;
    }
  });
}

// Collects patches, of which number(k) is the k-th one's number.
template <typename S, typename Number>
PatchNets<S> PatchFile::gather(std::size_t patches, const Number& number) const {
  struct Part { // the patches that come from one run
    const PatchRun* run;
    std::size_t first;
    std::size_t count;
    const S* values; // null: they have to be copied
  };
  std::vector<Part> parts;
  std::size_t copied = 0;
  for (std::size_t k = 0; k < patches; ++k) {
    const std::size_t p = number(k);
    if (parts.empty() || p - parts.back().run->first_patch >= parts.back().run->count ||
        (parts.back().values != nullptr && p != parts.back().first + parts.back().count)) {
      const PatchRun& run = run_of(p);
      parts.push_back({&run, p, 0, in_place<S>(run, p)});
    }
    Part& part = parts.back();
    ++part.count;
    copied +=
        part.values != nullptr ? 0 : part.run->points_per_patch() * part.run->values_per_point();
  }
  PatchNets<S> result;
  result.values.reserve(copied); // pointers into it stay valid
  result.nets.reserve(parts.size());
  std::size_t next = 0;
  for (const Part& part : parts) {
    const S* const end = result.values.data() + result.values.size();
    result.in_file |= part.values != nullptr;
    result.nets.push_back(ControlNets<S>::packed(part.values != nullptr ? part.values : end,
                                                 part.count, part.run->degree_u, part.run->degree_v,
                                                 3, part.run->weights));
    for (std::size_t k = 0; k < part.count; ++k, ++next) {
      if (part.values == nullptr) {
        append(*part.run, number(next) - part.run->first_patch, result.values);
      }
    }
  }
  return result;
}

template <typename S>
PatchNets<S> PatchFile::nets(std::size_t first, std::size_t patches) const {
  return gather<S>(std::min(patches, count - first), [&](std::size_t k) { return first + k; });
}

template <typename S>
PatchNets<S> PatchFile::nets(std::span<const std::uint32_t> patches) const {
  return gather<S>(patches.size(), [&](std::size_t k) { return patches[k]; });
}

PatchFile PatchFile::of(std::span<const std::uint32_t> patches) const {
  PatchFile some;
  some.name = name;
  some.moved_error = moved_error;
  some.has_origin = has_origin;
  some.cut_error = cut_error;
  for (const std::uint32_t patch : patches) {
    const PatchRun& run = run_of(patch);
    append(run, patch - run.first_patch, some.points);
    for (std::size_t k = 0; k < run.points_per_patch() && !lines.empty(); ++k) {
      some.lines.push_back(lines[run.first_point + find(patch, k).index]);
    }
    some.close_patch(run.degree_u, run.degree_v, run.weights);
  }
  return some;
}

template PatchNets<float> PatchFile::nets<float>(std::size_t, std::size_t) const;
template PatchNets<double> PatchFile::nets<double>(std::size_t, std::size_t) const;
template PatchNets<float> PatchFile::nets<float>(std::span<const std::uint32_t>) const;
template PatchNets<double> PatchFile::nets<double>(std::span<const std::uint32_t>) const;

std::string patch_format_names(const std::string& prefix) {
  std::vector<std::string> names;
  for (const Format& format : kFormats) {
    names.push_back(prefix + std::string(format.name));
  }
  return alternatives(names);
}

PatchFormat parse_patch_format(const std::string& option, const std::string& name) {
  const Format* const format = find_format(option, name);
  if (format == nullptr) {
    bad_usage(option + ": expected " + patch_format_names("") + ", found " + in_quotes(name));
  }
  return format->format;
}

PatchFile read_patches(const std::string& in, PatchFormat format, const ReadOptions& options) {
  if (in.starts_with("builtin:")) {
    return read_builtin(in);
  }
  if (in == "-" && format == PatchFormat::by_name) {
    bad_usage("reading standard input needs --format " + patch_format_names(""));
  }
  // It is opened before its name is judged: what cannot be read is bad input, whatever its name.
  TextInput input(in);
  const PatchFormat found = format == PatchFormat::by_name ? format_of(in) : format;
  Progress progress("reading", "bytes", input.stored_size());
  input.show(progress);
  return read_as(found, input, options);
}

PatchFile read_patches(const std::string& name, std::span<const char> bytes,
                       const ReadOptions& options) {
  TextInput input(name, bytes);
  return read_as(format_of(name), input, options);
}

} // namespace simdbezier::tools
