// A mesh on its way to a GPU by way of meshoptimizer: triangles in an order that suits the cache of
// vertices, vertices in the order of their use, meshlets; and the clusters that come without it.
#include <cstdio>
#include <vector>

#include <meshoptimizer.h>
#include <simdbezier/simdbezier.hpp>

#include "seed/wavy_sheet.hpp"

using namespace simdbezier;

namespace {

constexpr unsigned kCacheSize = 16;

float misses(const std::vector<unsigned>& triangles, std::size_t vertices) {
  return meshopt_analyzeVertexCache(triangles.data(), triangles.size(), vertices, kCacheSize, 0, 0)
      .acmr;
}

/// Triangles of all meshlets of up to 64 vertices and 124 triangles.
std::size_t meshlet_triangles(const std::vector<unsigned>& triangles,
                              const std::vector<std::array<float, 3>>& positions) {
  constexpr std::size_t kVertices = 64;
  constexpr std::size_t kTriangles = 124;
  std::vector<meshopt_Meshlet> meshlets(
      meshopt_buildMeshletsBound(triangles.size(), kVertices, kTriangles));
  std::vector<unsigned> vertices(meshlets.size() * kVertices);
  std::vector<unsigned char> corners(meshlets.size() * kTriangles * 3);
  meshlets.resize(meshopt_buildMeshlets(
      meshlets.data(), vertices.data(), corners.data(), triangles.data(), triangles.size(),
      positions.front().data(), positions.size(), sizeof(positions[0]), kVertices, kTriangles, 0));
  std::size_t sum = 0;
  for (const meshopt_Meshlet& meshlet : meshlets) {
    sum += meshlet.triangle_count;
  }
  return sum;
}

} // namespace

int main() {
  const auto points = seed::wavy_sheet(8);
  MeshOptions options;
  options.rates.tolerance = 1e-3;
  const auto nets = ControlNets<float>::packed(points);
  const MeshPlan<float> plan = plan_mesh<float>(nets, options);
  const Mesh<float> mesh = tessellate<float>(nets, options);
  ClusterSize clusters;
  if (!plan || !mesh || !cluster_size(plan.layout, clusters)) {
    return std::puts(to_string(mesh.report.status).data());
  }
  const std::size_t vertices = mesh.positions.size();
  const std::size_t count = mesh.triangles.size();
  std::vector<unsigned> triangles(mesh.triangles.front().data(),
                                  mesh.triangles.front().data() + 3 * count);
  const float before = misses(triangles, vertices);
  meshopt_optimizeVertexCache(triangles.data(), triangles.data(), triangles.size(), vertices);
  std::vector<unsigned> moved(vertices);
  const std::size_t used =
      meshopt_optimizeVertexFetchRemap(moved.data(), triangles.data(), triangles.size(), vertices);
  std::printf("cache of %u vertices: %s misses a triangle after reordering\n", kCacheSize,
              misses(triangles, vertices) < before ? "fewer" : "not fewer");
  std::printf("%s vertices are used, %s triangles are in meshlets, %s in clusters\n",
              used == vertices ? "all" : "not all",
              meshlet_triangles(triangles, mesh.positions) == count ? "all" : "not all",
              clusters.triangles == count ? "all" : "not all");
}
