// One set, one call, patches of several kinds: bilinear, bicubic, degree 4 x 2, and an octant of
// the unit sphere, which is a rational biquadratic. Results come in the order of the patches.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "seed/sample_patch.hpp"

using namespace simdbezier;

namespace {

// The quarter circle ((1-t^2), 2t) / (1+t^2), turned about the axis along another one of its kind.
const std::vector<double> kOctant = {
    1, 0, 0, 1, 1, 1, 0, 1, 0, 1, 0, 2, // x y z w, along the equator
    1, 0, 1, 1, 1, 1, 1, 1, 0, 1, 1, 2, //
    0, 0, 1, 2, 0, 0, 1, 2, 0, 0, 1, 4, // the pole, three times
};
const std::vector<double> kBilinear = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1};

/// A sheet of degree 4 x 2 over the unit square, whose middle is lifted.
std::vector<double> sheet() {
  std::vector<double> points;
  for (int j = 0; j <= 2; ++j) {
    for (int i = 0; i <= 4; ++i) {
      points.insert(points.end(), {i / 4.0, j / 2.0, i == 2 && j == 1 ? 1.0 : 0.0});
    }
  }
  return points;
}

} // namespace

int main() {
  const std::vector<double> bicubic = seed::coordinates<double>(seed::sample_patch().points);
  const std::vector<double> quartic = sheet();
  const std::vector<ControlNets<double>> nets = {
      ControlNets<double>::packed(kBilinear.data(), 1, 1, 1),
      ControlNets<double>::packed(bicubic.data(), 1, 3, 3),
      ControlNets<double>::packed(quartic.data(), 1, 4, 2),
      ControlNets<double>::packed(kOctant.data(), 1, 2, 2, 3, Weights::cartesian),
  };

  PatchSet<double> patches;
  const std::span<const ControlNets<double>> all(nets);
  if (const Report report = pack(all, patches); !report) {
    std::fprintf(stderr, "patch %zu: %s\n", report.item, to_string(report.status).data());
    return 1;
  }

  constexpr std::size_t n = 9;
  constexpr std::size_t kSamples = n * n;
  std::vector<double> position(3 * patches.size() * kSamples);
  std::vector<double> gaussian(patches.size() * kSamples);
  Outputs<double> out;
  out.position = Vectors<double>::xyz(position.data());
  out.curvature.gaussian = gaussian.data();
  const Status status = evaluate(patches, Grid<double>::uniform(n, n), out);
  if (status != Status::ok) {
    std::fprintf(stderr, "%s\n", to_string(status).data());
    return 1;
  }

  std::printf("patch  degree  rational   middle                    Gaussian curvature there\n");
  for (std::size_t patch = 0; patch < patches.size(); ++patch) {
    const PatchShape shape = patches.shape(patch);
    const std::size_t middle = patch * kSamples + kSamples / 2;
    const seed::Point p = seed::point_at(position, middle);
    std::printf("%5zu  %d x %d   %-8s %7.4f %7.4f %7.4f   %7.4f\n", patch, shape.degree_u,
                shape.degree_v, shape.rational ? "yes" : "no", p.x, p.y, p.z, gaussian[middle]);
  }

  double off_sphere = 0;
  for (std::size_t k = 3 * kSamples; k < 4 * kSamples; ++k) {
    off_sphere = std::max(off_sphere, std::abs(seed::length(seed::point_at(position, k)) - 1));
  }
  const bool round = off_sphere < 1e-14;
  std::printf("the octant's samples lie on the unit sphere within 1e-14: %s\n",
              round ? "yes" : "no");
  return round ? 0 : 1;
}
