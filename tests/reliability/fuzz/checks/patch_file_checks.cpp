#include "tests/reliability/fuzz/checks/patch_file_checks.hpp"
#include "tests/support/call_options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include <tools/patches/pack_patches.hpp>
#include <tools/process/failure.hpp>

#include "tests/reliability/fuzz/checks/promised_patches.hpp"
#include "tests/reliability/fuzz/checks/require.hpp"

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

/// A direction of a run: its patches stay within its points, or close around their end.
void require_direction(const tools::MeshDirection& direction, int degree) {
  const auto order = static_cast<std::size_t>(degree) + 1;
  require(degree >= 1 && degree <= kMostDegree, "a degree is out of range");
  require(direction.patches > 0 && direction.step > 0, "a direction of a mesh is empty");
  const std::size_t last = (direction.patches - 1) * direction.step;
  require(last + order <= direction.points ||
              direction.patches * direction.step == direction.points,
          "the points of a mesh are not those of its patches");
}

/// Follows the runs through the file: their points or vertices follow each other without a gap.
/// Points that are named by numbers come before all others.
class RunsInSequence {
public:
  RunsInSequence(const PatchFile& file, bool may_name) : file_(file), named_(file.lines.size()) {
    for (const PatchRun& run : file.runs) {
      named_ -= run.first_vertex || file.lines.empty() ? 0 : run.u.points * run.v.points;
    }
    require(may_name || named_ == 0, "there are points of no patch");
  }

  void require_next(const PatchRun& run) {
    require_direction(run.u, run.degree_u);
    require_direction(run.v, run.degree_v);
    require(run.count > 0 && run.first_patch == patches_ &&
                run.count == run.u.patches * run.v.patches,
            "runs do not follow each other");
    patches_ += run.count;
    const std::size_t mesh = run.u.points * run.v.points;
    if (run.first_vertex) {
      require(*run.first_vertex == vertices_ && run.first_point == 0 && run.first_value == 0 &&
                  run.stride == 4,
              "vertices of runs do not follow each other");
      vertices_ += mesh;
    } else if (run.floats != nullptr || run.doubles != nullptr) {
      require(run.stride == run.values_per_point() && file_.lines.empty(),
              "stored points are not those of patches");
    } else {
      const bool has_lines = !file_.lines.empty(); // binary files have none
      require((!has_lines || run.first_point == named_ + points_) &&
                  run.first_value == 4 * named_ + values_ && run.stride == run.values_per_point(),
              "points of runs do not follow each other");
      points_ += mesh;
      values_ += mesh * run.stride;
    }
  }

  /// Points that vertices name need not be named; they have four values each.
  void require_end() const {
    require(patches_ == file_.count && vertices_ == file_.vertices.size(),
            "patches and runs do not belong together");
    const bool has_lines = !file_.lines.empty();
    require((!has_lines || named_ + points_ == file_.lines.size()) &&
                4 * named_ + values_ == file_.points.size(),
            "points and lines do not belong together");
    require(std::ranges::all_of(file_.vertices, [&](std::uint32_t k) { return k < named_; }),
            "a vertex is not in the file");
  }

private:
  const PatchFile& file_;
  std::size_t named_;
  std::size_t patches_ = 0;
  std::size_t points_ = 0;
  std::size_t values_ = 0;
  std::size_t vertices_ = 0;
};

void require_consistent(const PatchFile& file, PatchFormat format) {
  require(file.count > 0 && !file.runs.empty(), "a file without patches is taken");
  RunsInSequence runs(file, format == PatchFormat::obj);
  for (const PatchRun& run : file.runs) {
    runs.require_next(run);
  }
  runs.require_end();
  file.visit_all_values([](const auto values) {
    require(std::ranges::all_of(values, [](double value) { return std::isfinite(value); }),
            "a value is not finite");
  });
  require(std::ranges::find(file.lines, 0U) == file.lines.end(), "lines begin with 1");
  for (const PatchRun& run : file.runs) {
    const std::size_t all = run.u.points * run.v.points;
    for (std::size_t k = 0; run.rational() && k < all; ++k) {
      const std::size_t index = run.first_vertex ? file.vertices[*run.first_vertex + k] : k;
      file.visit_values(run, [&](const auto* values) {
        require(values[index * run.stride + 3] > 0, "a weight is not positive");
      });
    }
  }
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
    for (std::size_t p = 0; p < run.count; ++p) {
      text += run.rational() ? "8\n" : "5\n";
      text += std::to_string(run.degree_v) + " " + std::to_string(run.degree_u) + "\n";
      for (std::size_t k = 0; k < run.points_per_patch(); ++k) {
        for (const double value : file.point(run.first_patch + p, k)) {
          append(text, value);
        }
      }
      text.push_back('\n');
    }
  }
  return text;
}

/// Whether the patches can be written as .bv: it divides by weights, and quotients may overflow.
bool fits_bv(const PatchFile& file) {
  for (std::size_t p = 0; p < file.count; ++p) {
    const PatchRun& run = file.run_of(p);
    for (std::size_t k = 0; run.weights == Weights::cartesian && k < run.points_per_patch(); ++k) {
      const std::vector<double> point = file.point(p, k);
      for (const double coordinate : std::span(point).first(3)) {
        if (!std::isfinite(coordinate / point[3])) {
          return false;
        }
      }
    }
  }
  return true;
}

void require_round_trip(const PatchFile& file) {
  static MemoryFile copy;
  const std::string text = as_bv(file);
  copy.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  const std::optional<PatchFile> again = read(copy, PatchFormat::bv);
  require(again && again->count == file.count, "a copy as .bv is refused");
  for (std::size_t p = 0; p < file.count; ++p) {
    const PatchRun& a = again->run_of(p);
    const PatchRun& b = file.run_of(p);
    require(a.degree_u == b.degree_u && a.degree_v == b.degree_v && a.rational() == b.rational(),
            "a copy as .bv has other degrees");
    for (std::size_t k = 0; k < b.points_per_patch(); ++k) {
      require_equal(again->point(p, k), file.point(p, k), "a copy as .bv has other values");
    }
  }
}

/// What the corner (iu, iv) of a patch has to be in T, up to two roundings.
template <typename T>
bool is_corner(const PatchFile& file, std::size_t patch, bool u1, bool v1, const T* position) {
  const PatchRun& run = file.run_of(patch);
  const auto row = static_cast<std::size_t>(run.degree_u);
  const std::size_t corner = (v1 ? run.points_per_patch() - row - 1 : 0) + (u1 ? row : 0);
  const std::vector<double> point = file.point(patch, corner);
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
  tests::CallOptions options;
  options.threads = 1;
  require_status(evaluate(set, Grid<T>::uniform(kGrid, kGrid), out, options), {Status::ok},
                 "evaluate, grid");
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
  require_consistent(*patches, format);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  require(patches->count >= promised_patches(text, format), "geometry of the file is lost");
  if (patches->count <= kMostPatches) {
    if (fits_bv(*patches)) {
      require_round_trip(*patches);
    }
    evaluate<float>(*patches, file);
    evaluate<double>(*patches, file);
  }
}

} // namespace simdbezier::fuzz
