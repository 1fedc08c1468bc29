#include <tools/patches/patch_rounding.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>

#include <tools/patches/library_status.hpp>
#include <tools/patches/pack_patches.hpp>

namespace simdbezier::tools {

namespace {

// Polynomial: a point of the surface is a mean of control points, so it moves no farther than they
// do. Rational: S = N / W with N = sum w_i P_i B_i moves to N' / W', and
//     N'/W' - N/W = ((N' - N) - S (W' - W)) / W',
// whose sums are means as well.
struct Moved {
  double point = 0;  // max |w' P' - w P|
  double weight = 0; // max |w' - w|
  double farthest = 0;
  double least_weight = 1;

  [[nodiscard]] double distance() const {
    constexpr double kRounding = 1 + 0x1p-40; // of this computation
    return (point + farthest * weight) / least_weight * kRounding;
  }
};

double length(const double* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

template <typename T>
void include(const double* value, Weights weights, Moved& moved) {
  const double w = weights == Weights::none ? 1 : value[3];
  const double rounded_w = weights == Weights::none ? 1 : static_cast<double>(static_cast<T>(w));
  double apart[3];
  double place[3];
  for (std::size_t c = 0; c < 3; ++c) {
    const auto rounded = static_cast<double>(static_cast<T>(value[c]));
    const bool cartesian = weights == Weights::cartesian;
    apart[c] = cartesian ? rounded_w * rounded - w * value[c] : rounded - value[c];
    place[c] = weights == Weights::homogeneous ? value[c] / w : value[c];
  }
  moved.point = std::max(moved.point, length(apart));
  moved.weight = std::max(moved.weight, std::abs(rounded_w - w));
  moved.farthest = std::max(moved.farthest, length(place));
  moved.least_weight = std::min(moved.least_weight, rounded_w);
}

template <typename T>
double moved_by_rounding(const ControlNets<double>& nets, std::size_t patch) {
  Moved moved;
  if (nets.weights != Weights::none) {
    moved.least_weight = HUGE_VAL;
  }
  const double* const first = nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride;
  for (std::ptrdiff_t k = 0; k < nets.patch_stride; k += nets.point_stride) {
    include<T>(first + k, nets.weights, moved);
  }
  return moved.distance();
}

// Adds what point_errors() are to the errors of these patches.
template <typename T>
void add_point_errors(const PatchFile& file, std::size_t first, std::span<double> errors) {
  for (double& error : errors) {
    error += file.moved_error + file.cut_error;
  }
  if constexpr (std::is_same_v<T, float>) { // and otherwise points are not rounded
    const PatchNets<double> block = file.nets<double>(first, errors.size());
    std::size_t k = 0;
    for (const ControlNets<double>& nets : block.nets) {
      for (std::size_t patch = 0; patch < nets.count; ++patch, ++k) {
        errors[k] += moved_by_rounding<T>(nets, patch);
      }
    }
  }
}

} // namespace

template <typename T>
std::vector<double> point_errors(const PatchFile& file) {
  std::vector<double> errors(file.count);
  for (std::size_t first = 0; first < file.count; first += kBlockPatches) {
    const auto block =
        std::span(errors).subspan(first, std::min(kBlockPatches, file.count - first));
    static_cast<void>(pack_patches<T>(file, first, block.size()));
    add_point_errors<T>(file, first, block);
  }
  return errors;
}

template <typename T>
std::vector<double> rounding_errors(const PatchFile& file, std::size_t first, std::size_t count) {
  std::vector<double> errors(count);
  check(position_errors(pack_patches<T>(file, first, count), errors));
  add_point_errors<T>(file, first, errors);
  return errors;
}

template std::vector<double> point_errors<float>(const PatchFile&);
template std::vector<double> point_errors<double>(const PatchFile&);
template std::vector<double> rounding_errors<float>(const PatchFile&, std::size_t, std::size_t);
template std::vector<double> rounding_errors<double>(const PatchFile&, std::size_t, std::size_t);

} // namespace simdbezier::tools
