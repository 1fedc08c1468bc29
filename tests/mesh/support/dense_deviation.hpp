// How far a mesh is from its patches, by dense samples and formulas of the tests' own.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/mesh_models.hpp"
#include "tests/mesh/support/mesh_oracle.hpp"
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
  const std::uint32_t nu = in_cell * plan.cells_u[p];
  const std::uint32_t nv = in_cell * plan.cells_v[p];
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

/// The largest distance of points of all triangles of patch p from a surface, of which a fine mesh
/// is taken: twice as fine at the ends of each cell as in its middle.
template <typename T, typename Surface>
double farthest_from_surface(const MeshPlan<T>& plan, const Mesh<T>& mesh, const Surface& surface,
                             std::size_t p) {
  constexpr std::uint32_t kInCell = 24;
  struct Piece {
    std::array<Point, 4> at;
    double size; ///< no point is farther from the first one
  };
  const auto parameter = [](std::uint32_t k, std::uint32_t n) {
    const double t = static_cast<double>(k % kInCell) / kInCell;
    return (k / kInCell + t * t * (3 - 2 * t)) / n;
  };
  std::vector<Piece> pieces;
  for (std::uint32_t j = 0; j < kInCell * plan.cells_v[p]; ++j) {
    for (std::uint32_t i = 0; i < kInCell * plan.cells_u[p]; ++i) {
      Piece piece{{}, 0};
      for (std::uint32_t k = 0; k < 4; ++k) {
        piece.at[k] =
            surface(parameter(i + k % 2, plan.cells_u[p]), parameter(j + k / 2, plan.cells_v[p]));
        piece.size = std::max(
            piece.size,
            std::sqrt(squared_distance(piece.at[k], {piece.at[0], piece.at[0], piece.at[0]})));
      }
      pieces.push_back(piece);
    }
  }
  double worst = 0;
  for (std::size_t t = plan.layout.first_triangle(p); t < plan.layout.first_triangle(p + 1); ++t) {
    const Point corners[] = {corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)};
    for (std::uint32_t k = 0; k < 25; ++k) {
      const double a = (k % 5) / 4.0;
      const double b = (1 - a) * (k / 5) / 4.0;
      Point x;
      for (std::size_t c = 0; c < 3; ++c) {
        x[c] = corners[0][c] + a * (corners[1][c] - corners[0][c]) +
               b * (corners[2][c] - corners[0][c]);
      }
      double least = std::numeric_limits<double>::infinity();
      for (const Piece& piece : pieces) {
        const double far = std::sqrt(squared_distance(x, {piece.at[0], piece.at[0], piece.at[0]}));
        if (far - piece.size < least) {
          least = std::min(
              {least, std::sqrt(squared_distance(x, {piece.at[0], piece.at[1], piece.at[2]})),
               std::sqrt(squared_distance(x, {piece.at[1], piece.at[3], piece.at[2]}))});
        }
      }
      worst = std::max(worst, least);
    }
  }
  return std::max(0.0, worst - 1e-9); // squares of distances are rounded
}

/// farthest_sample() of a bicubic patch.
template <typename T>
double found_deviation(const MeshPlan<T>& plan, const Mesh<T>& mesh, const PatchPoints& patch,
                       std::size_t p, std::uint32_t in_cell) {
  return farthest_sample(
      plan, mesh, [&](double u, double v) { return surface(patch, u, v); }, p, in_cell);
}

} // namespace simdbezier::tests
