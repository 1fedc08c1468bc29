#include <tools/patches/move_patches.hpp>

#include <algorithm>
#include <cmath>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

// Moves a point and returns how far at most it is from where it should be: a difference is rounded
// once, also where the point is multiplied by its weight.
double move_point(double* values, double weight, const std::array<double, 3>& origin) {
  double error = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    values[c] = std::fma(-weight, origin[c], values[c]) + 0.0;
    if (!std::isfinite(values[c] / weight)) {
      bad_input("--origin: expected an origin whose distance from all points a double can hold, "
                "found a point too far from it");
    }
    error = std::max(error, (std::abs(values[c]) * 0x1p-53 + 0x1p-1074) / weight);
  }
  return std::sqrt(3.0) * error * (1 + 0x1p-40);
}

} // namespace

std::array<double, 3> own_origin(const MeshBox& box) {
  const double step = std::exp2(std::floor(std::log2(diagonal_of(box))) - 3);
  std::array<double, 3> origin;
  for (std::size_t c = 0; c < 3; ++c) {
    const double middle = box.low[c] / 2 + box.high[c] / 2;
    const double rounded = std::nearbyint(middle / step) * step;
    origin[c] = std::isfinite(rounded) ? rounded + 0.0 : middle; // there may be no step
  }
  return origin;
}

void move_patches(PatchFile& file, const std::array<double, 3>& origin) {
  file.take_values();
  double rounded = 0;
  const auto move = [&](std::size_t first, std::size_t count, const PatchRun& run) {
    for (std::size_t k = 0; k < count; ++k) {
      double* const point = file.points.data() + first + k * run.stride;
      const double weight = run.weights == Weights::homogeneous ? point[3] : 1;
      rounded = std::max(rounded, move_point(point, weight, origin));
    }
  };
  // Points that are named by numbers may be those of several runs, and none of them is homogeneous;
  // they stand before, between and behind the others.
  const auto named = std::ranges::find_if(
      file.runs, [](const PatchRun& run) { return run.first_vertex.has_value(); });
  std::size_t behind = 0;
  for (const PatchRun& run : file.runs) {
    if (!run.first_vertex) {
      if (named != file.runs.end()) {
        move(behind, (run.first_value - behind) / named->stride, *named);
      }
      behind = run.first_value + run.u.points * run.v.points * run.stride;
      move(run.first_value, run.u.points * run.v.points, run);
    }
  }
  if (named != file.runs.end()) {
    move(behind, (file.points.size() - behind) / named->stride, *named);
  }
  file.moved_error += rounded;
  file.has_origin = true;
}

} // namespace simdbezier::tools
