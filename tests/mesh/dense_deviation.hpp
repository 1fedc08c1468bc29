// How far a mesh is from its patches, by dense samples and formulas of the tests' own.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/mesh_models.hpp"
#include "tests/mesh/mesh_oracle.hpp"
#include "tests/support/nets/data_files.hpp"

namespace simdbezier::tests {

inline std::vector<PatchPoints> patches_of(const std::vector<Net>& nets) {
  std::vector<PatchPoints> patches;
  for (const Net& net : nets) {
    PatchPoints& patch = patches.emplace_back();
    for (std::size_t k = 0; k < 16; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        patch[k / 4][k % 4][c] = static_cast<double>(net.points[k][c]);
      }
    }
  }
  return patches;
}

template <typename T>
Point corner(const Mesh<T>& mesh, std::size_t triangle, std::size_t k) {
  const auto& p = mesh.positions[mesh.triangles[triangle][k]];
  return {p[0], p[1], p[2]};
}

/// The largest distance of dense samples of patch p, surface(u, v), from its triangles.
template <typename T, typename Surface>
double farthest_sample(const MeshPlan<T>& plan, const Mesh<T>& mesh, const Surface& surface,
                       std::size_t p, std::uint32_t in_cell) {
  std::vector<std::array<Point, 3>> triangles;
  for (std::size_t t = plan.layout.first_triangle(p); t < plan.layout.first_triangle(p + 1); ++t) {
    triangles.push_back({corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)});
  }
  double worst = 0;
  std::size_t nearest = 0; // of the sample before: the search begins there
  const std::uint32_t nu = in_cell * plan.nu[p];
  const std::uint32_t nv = in_cell * plan.nv[p];
  for (std::uint32_t k = 0; k < (nu + 1) * (nv + 1); ++k) {
    const Point x =
        surface(static_cast<double>(k % (nu + 1)) / nu, static_cast<double>(k / (nu + 1)) / nv);
    double least = std::numeric_limits<double>::infinity();
    const std::size_t begin = nearest + triangles.size();
    for (std::size_t t = 0; t < triangles.size() && least > worst; ++t) {
      // Forwards and backwards: triangles follow each other row by row, and so do samples.
      const std::size_t step = (t + 1) / 2;
      const std::size_t at = (t % 2 == 0 ? begin + step : begin - step) % triangles.size();
      const double square = squared_distance(x, triangles[at]);
      if (square < least) {
        least = square;
        nearest = at;
      }
    }
    worst = std::max(worst, least);
  }
  return std::sqrt(worst);
}

/// The same for a bicubic patch.
template <typename T>
double found_deviation(const MeshPlan<T>& plan, const Mesh<T>& mesh, const PatchPoints& patch,
                       std::size_t p, std::uint32_t in_cell) {
  return farthest_sample(
      plan, mesh, [&](double u, double v) { return surface(patch, u, v); }, p, in_cell);
}

} // namespace simdbezier::tests
