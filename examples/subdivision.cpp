// Uniform subdivision against one grid call: cutting a patch four times in each direction gives the
// vertices of a 17 x 17 mesh, which evaluate() computes straight away. split() cuts all patches of
// a batch once.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "seed/sample_patch.hpp"
#include "seed/subdivision.hpp"

using namespace simdbezier;

namespace {

/// The largest difference between a subdivision's vertices and the samples of a grid.
double difference_from_grid(const seed::Mesh& mesh, const std::vector<double>& points) {
  PatchSet<double> patches;
  std::vector<double> position(3 * mesh.vertices.size());
  Outputs<double> out;
  out.position = Vectors<double>::xyz(position.data());
  if (!pack(ControlNets<double>{points.data(), 1}, patches) ||
      evaluate(patches, Grid<double>::uniform(mesh.side, mesh.side), out) != Status::ok) {
    return HUGE_VAL;
  }
  double worst = 0;
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    worst = std::max(worst, seed::distance(seed::point_at(position, k), mesh.vertices[k]));
  }
  return worst;
}

/// The largest difference between four quarters cut here and those of split().
double difference_from_split(const seed::Net& net, const std::vector<double>& points) {
  std::vector<double> quarters(4 * points.size()); // quarter after quarter
  std::array<MutableNets<double>, 4> out;
  for (std::size_t k = 0; k < 4; ++k) {
    out[k] = MutableNets<double>::packed(&quarters[k * points.size()], 1, 3, 3);
  }
  if (!split(ControlNets<double>{points.data(), 1}, 0.5, 0.5, out)) {
    return HUGE_VAL;
  }
  const auto [low_u, high_u] = seed::halves_u(net);
  const auto [low_low, low_high] = seed::halves_v(low_u);
  const auto [high_low, high_high] = seed::halves_v(high_u);
  const seed::Net* const slow[4] = {&low_low, &high_low, &low_high, &high_high};
  double worst = 0;
  for (std::size_t k = 0; k < 64; ++k) {
    worst =
        std::max(worst, seed::distance(seed::point_at(quarters, k), slow[k / 16]->points[k % 16]));
  }
  return worst;
}

} // namespace

int main() {
  const seed::Net net = seed::sample_patch();
  const std::vector<double> points = seed::coordinates<double>(net.points);
  const seed::Mesh mesh = seed::subdivide(net, 4);
  std::printf("4 levels: %zu vertices, %zu quadrilaterals\n", mesh.vertices.size(),
              mesh.quads.size());

  const bool grid = difference_from_grid(mesh, points) < 1e-14;
  const bool quarters = difference_from_split(net, points) < 1e-15;
  std::printf("evaluate() gives the same vertices within 1e-14: %s\n", grid ? "yes" : "no");
  std::printf("split() gives the same quarters within 1e-15: %s\n", quarters ? "yes" : "no");
  return grid && quarters ? 0 : 1;
}
