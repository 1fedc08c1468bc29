// Uniform subdivision: a patch cut into four at its middle, again and again, until the corners of
// the pieces are a mesh. No parameter is ever evaluated, only midpoints are taken.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "patch.hpp"

namespace seed {

/// A curve's two halves: the left and the right side of de Casteljau's triangle at t = 1/2.
inline std::pair<std::vector<Point>, std::vector<Point>> halves(std::vector<Point> b) {
  std::vector<Point> low;
  std::vector<Point> high(b.size());
  for (std::size_t left = b.size(); left > 0; --left) {
    low.push_back(b[0]);
    high[left - 1] = b[left - 1];
    for (std::size_t i = 0; i + 1 < left; ++i) {
      b[i] = mix(b[i], b[i + 1], 0.5);
    }
  }
  return {low, high};
}

/// The patch over [0, 1/2] and [1/2, 1] in u.
inline std::pair<Net, Net> halves_u(const Net& net) {
  std::pair<Net, Net> parts{{net.degree_u, net.degree_v, {}}, {net.degree_u, net.degree_v, {}}};
  for (std::size_t j = 0; j <= net.degree_v; ++j) {
    const auto [low, high] = halves(net.row(j));
    parts.first.points.insert(parts.first.points.end(), low.begin(), low.end());
    parts.second.points.insert(parts.second.points.end(), high.begin(), high.end());
  }
  return parts;
}

inline Net transposed(const Net& net) {
  Net result{net.degree_v, net.degree_u, {}};
  for (std::size_t i = 0; i <= net.degree_u; ++i) {
    for (std::size_t j = 0; j <= net.degree_v; ++j) {
      result.points.push_back(net.points[j * (net.degree_u + 1) + i]);
    }
  }
  return result;
}

inline std::pair<Net, Net> halves_v(const Net& net) {
  const auto [low, high] = halves_u(transposed(net));
  return {transposed(low), transposed(high)};
}

/// (2^levels + 1)^2 vertices, u fastest, and the quadrilaterals between them, counter-clockwise
/// about the normal.
struct Mesh {
  std::size_t side = 0; ///< vertices along an edge
  std::vector<Point> vertices;
  std::vector<std::array<std::size_t, 4>> quads;
};

/// Cuts `net`, whose first corner is vertex (iu, iv), `levels` times more.
inline void subdivide_into(Mesh& mesh, const Net& net, int levels, std::size_t iu, std::size_t iv) {
  if (levels == 0) {
    const std::size_t k = iv * mesh.side + iu;
    const std::size_t top = net.degree_v * (net.degree_u + 1); // the last row's first point
    mesh.vertices[k] = net.points[0];
    mesh.vertices[k + 1] = net.points[net.degree_u];
    mesh.vertices[k + mesh.side] = net.points[top];
    mesh.vertices[k + mesh.side + 1] = net.points[top + net.degree_u];
    mesh.quads.push_back({k, k + 1, k + mesh.side + 1, k + mesh.side});
    return;
  }
  const std::size_t half = std::size_t{1} << (levels - 1);
  const auto [low_u, high_u] = halves_u(net);
  const auto [low_low, low_high] = halves_v(low_u);
  const auto [high_low, high_high] = halves_v(high_u);
  subdivide_into(mesh, low_low, levels - 1, iu, iv);
  subdivide_into(mesh, high_low, levels - 1, iu + half, iv);
  subdivide_into(mesh, low_high, levels - 1, iu, iv + half);
  subdivide_into(mesh, high_high, levels - 1, iu + half, iv + half);
}

inline Mesh subdivide(const Net& net, int levels) {
  Mesh mesh;
  mesh.side = (std::size_t{1} << levels) + 1;
  mesh.vertices.resize(mesh.side * mesh.side);
  subdivide_into(mesh, net, levels, 0, 0);
  return mesh;
}

} // namespace seed
