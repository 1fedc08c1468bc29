#include "tests/fuzz/patch_file_checks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include <tools/failure.hpp>

#include "tests/fuzz/promised_patches.hpp"
#include "tests/fuzz/require.hpp"

namespace simdbezier::fuzz {

namespace {

using tools::PatchFile;
using tools::PatchFormat;
using tools::PatchRun;

/// Files with more patches than this are not evaluated: time should go into many inputs.
constexpr std::size_t kMostPatches = 64;
constexpr std::size_t kGrid = 3;

std::optional<PatchFile> read(const MemoryFile& file, PatchFormat format) {
  try {
    return tools::read_patches(file.path(), format);
  } catch (const tools::Failure& failure) {
    require(failure.exit_code() == 1, "bad input has another exit code than 1");
    require_message(failure.what(), file.path());
    return std::nullopt;
  }
}

void require_consistent(const PatchFile& file) {
  require(file.count > 0 && !file.runs.empty(), "a file without patches is taken");
  std::size_t patches = 0;
  std::size_t points = 0;
  std::size_t values = 0;
  for (const PatchRun& run : file.runs) {
    require(run.count > 0 && run.first_patch == patches && run.first_point == points &&
                run.first_value == values,
            "runs do not follow each other");
    require(run.degree_u >= 1 && run.degree_u <= kMostDegree && run.degree_v >= 1 &&
                run.degree_v <= kMostDegree,
            "a degree is out of range");
    patches += run.count;
    points += run.count * run.points_per_patch();
    values += run.count * run.points_per_patch() * run.values_per_point();
  }
  require(patches == file.count && points == file.lines.size() && values == file.points.size(),
          "patches, points and lines do not belong together");
  for (const PatchRun& run : file.runs) {
    const std::size_t each = run.values_per_point();
    for (std::size_t k = 0; k < run.count * run.points_per_patch() * each; ++k) {
      const double value = file.points[run.first_value + k];
      require(std::isfinite(value), "a value is not finite");
      require(k % each < 3 || value > 0, "a weight is not positive");
    }
  }
  require(std::ranges::find(file.lines, 0U) == file.lines.end(), "lines begin with 1");
}

void append(std::string& text, double value) {
  char digits[32];
  const auto result = std::to_chars(digits, std::end(digits), value);
  text.append(digits, result.ptr);
  text.push_back(' ');
}

/// The same patches as .bv, whose weights are homogeneous; Cartesian ones are written as if.
std::string as_bv(const PatchFile& file) {
  std::string text;
  for (const PatchRun& run : file.runs) {
    const std::size_t values = run.points_per_patch() * run.values_per_point();
    for (std::size_t p = 0; p < run.count; ++p) {
      text += run.rational() ? "8\n" : "5\n";
      text += std::to_string(run.degree_v) + " " + std::to_string(run.degree_u) + "\n";
      for (std::size_t k = 0; k < values; ++k) {
        append(text, file.points[run.first_value + p * values + k]);
      }
      text.push_back('\n');
    }
  }
  return text;
}

void require_round_trip(const PatchFile& file) {
  static MemoryFile copy;
  const std::string text = as_bv(file);
  copy.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  const std::optional<PatchFile> again = read(copy, PatchFormat::bv);
  require(again && again->count == file.count, "a copy as .bv is refused");
  require_equal(again->points, file.points, "a copy as .bv has other values");
  for (std::size_t p = 0; p < file.count; ++p) {
    const PatchRun& a = again->run_of(p);
    const PatchRun& b = file.run_of(p);
    require(a.degree_u == b.degree_u && a.degree_v == b.degree_v && a.rational() == b.rational(),
            "a copy as .bv has other degrees");
  }
}

/// What the corner (iu, iv) of a patch has to be in T, but for two roundings.
template <typename T>
bool is_corner(const PatchFile& file, std::size_t patch, bool u1, bool v1, const T* position) {
  const PatchRun& run = file.run_of(patch);
  const auto row = static_cast<std::size_t>(run.degree_u);
  const std::size_t corner = (v1 ? run.points_per_patch() - row - 1 : 0) + (u1 ? row : 0);
  const std::span<const double> point = file.point(patch, corner);
  bool same = true;
  for (std::size_t c = 0; c < 3; ++c) {
    // The program rounds to T first.
    const T numerator = static_cast<T>(point[c]);
    const T divisor = run.weights == Weights::homogeneous ? static_cast<T>(point[3]) : T(1);
    const T expected = static_cast<T>(static_cast<long double>(numerator) / divisor);
    const T near = std::nextafter(expected, position[c]);
    same = same && (position[c] == expected || (divisor != 1 && position[c] == near));
  }
  return same;
}

template <typename T>
void evaluate(const PatchFile& file, const MemoryFile& from) {
  PatchSet<T> set;
  try {
    set = tools::pack_patches<T>(file);
  } catch (const tools::Failure& failure) {
    require(failure.exit_code() == 1, "bad input has another exit code than 1");
    return require_message(failure.what(), from.path());
  }
  require(set.size() == file.count, "a set has another number of patches than the file");
  const std::size_t samples = set.size() * kGrid * kGrid;
  std::vector<T> position(3 * samples);
  std::vector<T> normal(3 * samples);
  std::vector<SampleStatus> status(samples);
  Outputs<T> out;
  out.position = Vectors<T>::xyz(position.data());
  out.normal = Vectors<T>::xyz(normal.data());
  out.status = status.data();
  Options options;
  options.threads = 1;
  require_status(evaluate_grid(set, Grid<T>::uniform(kGrid, kGrid), out, options), {Status::ok},
                 "evaluate_grid");
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t patch = k / (kGrid * kGrid);
    const std::size_t iu = k % kGrid;
    const std::size_t iv = k / kGrid % kGrid;
    require(status[k] <= SampleStatus::degenerate, "finite parameters have another status");
    const bool certified = std::isfinite(error_bounds(set, patch).position[0]);
    for (std::size_t c = 0; c < 3; ++c) {
      require(!std::isnan(normal[3 * k + c]), "a normal is nan");
      require(!certified || std::isfinite(position[3 * k + c]), "a position is not finite");
    }
    require(iu == 1 || iv == 1 ||
                is_corner<T>(file, patch, iu > 0, iv > 0, position.data() + 3 * k),
            "a corner is not the control point");
  }
}

} // namespace

MemoryFile::MemoryFile()
    : descriptor_(memfd_create("patches", 0)),
      path_("/proc/self/fd/" + std::to_string(descriptor_)) {
  require(descriptor_ >= 0, "no file in memory");
}

MemoryFile::~MemoryFile() { close(descriptor_); }

void MemoryFile::write(std::span<const std::uint8_t> bytes) {
  require(ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, bytes.data(), bytes.size(), 0) ==
                                                static_cast<ssize_t>(bytes.size()),
          "no file in memory");
}

void require_message(const std::string& message, const std::string& path) {
  require(message.starts_with(path), [&] { return "a message without the file: " + message; });
  require(std::ranges::none_of(message, [](char c) { return static_cast<unsigned char>(c) < ' '; }),
          [&] { return "a message with control characters: " + message; });
}

void check_patch_file(std::span<const std::uint8_t> bytes, PatchFormat format) {
  static MemoryFile file;
  file.write(bytes);
  const std::optional<PatchFile> patches = read(file, format);
  if (!patches) {
    return;
  }
  require_consistent(*patches);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  require(patches->count >= promised_patches(text, format), "geometry of the file is lost");
  if (patches->count <= kMostPatches) {
    require_round_trip(*patches);
    evaluate<float>(*patches, file);
    evaluate<double>(*patches, file);
  }
}

} // namespace simdbezier::fuzz
