// A patch with its normals, written as the vertices that a renderer wants: x y z nx ny nz in single
// precision. The set itself gives the error bound, and de Casteljau's algorithm confirms it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "seed/patch.hpp"
#include "seed/sample_patch.hpp"

using namespace simdbezier;

struct Vertex {
  float position[3];
  float normal[3];
};

int main() {
  const seed::Net net = seed::sample_patch();
  const std::vector<float> points = seed::coordinates<float>(net.points);

  PatchSet<float> patches;
  if (const Report report = pack(ControlNets<float>{points.data(), 1}, patches); !report) {
    std::fprintf(stderr, "%s\n", to_string(report.status).data());
    return 1;
  }

  constexpr std::size_t n = 5;
  constexpr std::ptrdiff_t kStride = sizeof(Vertex) / sizeof(float);
  std::vector<Vertex> vertices(n * n);
  Outputs<float> out;
  out.position = Vectors<float>::xyz(vertices[0].position, kStride);
  out.normal = Vectors<float>::xyz(vertices[0].normal, kStride);
  const Status status = evaluate(patches, Grid<float>::uniform(n, n), out);
  if (status != Status::ok) {
    std::fprintf(stderr, "%s\n", to_string(status).data());
    return 1;
  }

  const ErrorBounds bounds = error_bounds(patches, 0);
  bool within = true;
  double worst_normal = 0;
  std::printf("   u    v   position                   normal\n");
  for (std::size_t k = 0; k < n * n; ++k) {
    const auto& [p, normal] = vertices[k];
    const double u = static_cast<double>(k % n) / (n - 1);
    const double v = static_cast<double>(k / n) / (n - 1);
    if (k % n == 1) { // one column will do
      std::printf("%.2f %.2f  %7.4f %7.4f %7.4f   %7.4f %7.4f %7.4f\n", u, v, p[0], p[1], p[2],
                  normal[0], normal[1], normal[2]);
    }
    const seed::PatchPoint slow = seed::patch_point(net, u, v);
    const seed::Point off = seed::Point{p[0], p[1], p[2]} - slow.position;
    within = within && std::abs(off.x) <= bounds.position[0] &&
             std::abs(off.y) <= bounds.position[1] && std::abs(off.z) <= bounds.position[2];
    worst_normal =
        std::max(worst_normal, seed::distance({normal[0], normal[1], normal[2]}, slow.normal));
  }
  std::printf("positions within their certified bound of de Casteljau's in double: %s\n",
              within ? "yes" : "no");
  std::printf("normals within 1e-6: %s\n", worst_normal < 1e-6 ? "yes" : "no");
  return within && worst_normal < 1e-6 ? 0 : 1;
}
