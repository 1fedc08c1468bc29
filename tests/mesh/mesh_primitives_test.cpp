// Polygons, strips and clusters are the mesh's triangles in other words.
#include <algorithm>
#include <array>
#include <random>

#include <gtest/gtest.h>

#include <simdbezier/mesh_layout.hpp>

#include "tests/mesh/support/mesh_models.hpp"

namespace simdbezier::tests::mesh_primitives_test {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// The same triangle whichever vertex is first.
Triangle turned_to_lowest(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

struct Case {
  std::string name;
  MeshLayout layout;
  std::vector<Triangle> triangles; ///< in the order in which they are written
};

std::vector<Triangle> triangles_of(const MeshLayout& layout) {
  std::vector<std::uint32_t> numbers(3 * layout.size().triangles);
  EXPECT_EQ(write_triangles(layout, std::span(numbers), {.threads = 1}), Status::ok);
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k < numbers.size(); k += 3) {
    triangles.push_back(turned_to_lowest({numbers[k], numbers[k + 1], numbers[k + 2]}));
  }
  return triangles;
}

struct Rates {
  std::uint32_t most;
  bool strips = false; ///< whether half of the patches have one row or column of cells
};
constexpr Rates kRates[] = {{1}, {3}, {9}, {40}, {12, true}, {63, true}, {300, true}};

std::vector<Case> cases() {
  std::vector<Case> result;
  std::mt19937 random(7);
  for (const MeshModel& original : mesh_models()) {
    const MeshModel model = original.orientable ? shuffled(original, 5) : original;
    const std::vector<double> values = model.values();
    Topology topology;
    TopologyOptions options;
    options.orient = model.orientable;
    EXPECT_EQ(find_topology(ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3),
                            topology, options),
              Status::ok);
    for (const auto& [most, strips] : kRates) {
      std::vector<std::uint32_t> nu;
      std::vector<std::uint32_t> nv;
      std::vector<std::uint16_t> diagonals;
      for (std::size_t p = 0; p < model.patches.size(); ++p) {
        nu.push_back(1 + static_cast<std::uint32_t>(random() % most));
        nv.push_back(1 + static_cast<std::uint32_t>(random() % most));
        if (strips && p % 2 == 0) {
          (random() % 2 == 0 ? nu : nv).back() = 1;
        }
        diagonals.push_back(static_cast<std::uint16_t>(random() % 512));
      }
      std::size_t raised = 0;
      EXPECT_EQ(separate_vertices(topology, nu, nv, raised), Status::ok);
      Case one{
          model.name + ", rates to " + std::to_string(most) + (strips ? ", strips" : ""), {}, {}};
      EXPECT_EQ(lay_out_mesh(topology, {nu, nv, diagonals}, one.layout), Status::ok);
      one.triangles = triangles_of(one.layout);
      result.push_back(one);
    }
  }
  return result;
}

void expect_same(const Case& expected, std::vector<Triangle> found) {
  std::vector<Triangle> triangles = expected.triangles;
  std::sort(triangles.begin(), triangles.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, triangles);
}

TEST(MeshPrimitives, quads_cut_from_first_to_third_vertex_are_the_triangles) {
  std::size_t quads = 0;
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    PolygonSize size;
    ASSERT_EQ(polygon_size(one.layout, size, {.threads = 1}), Status::ok);
    std::vector<std::uint32_t> indices(size.indices);
    std::vector<std::uint8_t> sizes(size.polygons);
    ASSERT_EQ(write_polygons(one.layout, std::span(indices), std::span(sizes), {.threads = 2}),
              Status::ok);
    std::vector<Triangle> found;
    std::size_t at = 0;
    for (const std::uint8_t corners : sizes) {
      ASSERT_TRUE(corners == 3 || corners == 4);
      const std::size_t cell = found.size();
      for (std::uint8_t k = 2; k < corners; ++k) {
        found.push_back(turned_to_lowest({indices[at], indices[at + k - 1U], indices[at + k]}));
      }
      // Cells come in one order, though usual patches have a writer of their own for triangles.
      ASSERT_LE(found.size(), one.triangles.size());
      ASSERT_TRUE(std::is_permutation(found.begin() + static_cast<std::ptrdiff_t>(cell),
                                      found.end(),
                                      one.triangles.begin() + static_cast<std::ptrdiff_t>(cell)))
          << "triangle " << cell;
      quads += corners == 4 ? 1 : 0;
      at += corners;
    }
    EXPECT_EQ(at, indices.size());
    expect_same(one, found);
    EXPECT_EQ(write_polygons(one.layout, std::span(indices).first(indices.size() - 1),
                             std::span(sizes), {.threads = 1}),
              Status::output_too_small);
    EXPECT_EQ(write_polygons(one.layout, std::span(indices),
                             std::span(sizes).first(sizes.size() - 1), {.threads = 1}),
              Status::output_too_small);
  }
  EXPECT_GT(quads, 1000U);
}

TEST(MeshPrimitives, polygons_of_some_patches_are_those_of_all) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    PolygonSize all;
    ASSERT_EQ(polygon_size(one.layout, all), Status::ok);
    std::vector<std::uint32_t> indices(all.indices);
    std::vector<std::uint8_t> sizes(all.polygons);
    ASSERT_EQ(write_polygons(one.layout, std::span(indices), std::span(sizes)), Status::ok);
    std::vector<std::uint32_t> found;
    std::vector<std::uint8_t> found_sizes;
    std::size_t patches = 0;
    for (; one.layout.first_triangle(patches) < one.layout.size().triangles; patches += 2) {
      const bool last = one.layout.first_triangle(patches + 1) == one.layout.size().triangles;
      const SetRange range{patches, last ? 1U : 2U};
      PolygonSize size;
      ASSERT_EQ(polygon_size(one.layout, size, {.threads = 2}, range), Status::ok);
      std::vector<std::uint32_t> part(size.indices);
      std::vector<std::uint8_t> part_sizes(size.polygons);
      ASSERT_EQ(
          write_polygons(one.layout, std::span(part), std::span(part_sizes), {.threads = 2}, range),
          Status::ok);
      found.insert(found.end(), part.begin(), part.end());
      found_sizes.insert(found_sizes.end(), part_sizes.begin(), part_sizes.end());
    }
    EXPECT_EQ(found, indices);
    EXPECT_EQ(found_sizes, sizes);
    EXPECT_EQ(polygon_size(one.layout, all, {.threads = 1}, {0, patches + 2}),
              Status::bad_patch_range);
    EXPECT_EQ(write_polygons(one.layout, std::span(indices), std::span(sizes), {.threads = 1},
                             {patches + 2, 1}),
              Status::bad_patch_range);
  }
}

TEST(MeshPrimitives, strips_and_clusters_of_some_patches_are_those_of_all) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    std::size_t all = 0;
    ASSERT_EQ(strip_size(one.layout, all), Status::ok);
    std::vector<std::uint32_t> strips(all);
    ASSERT_EQ(write_strips(one.layout, std::span(strips)), Status::ok);
    ClusterSize size;
    ASSERT_EQ(cluster_size(one.layout, size), Status::ok);
    std::vector<MeshCluster> clusters(size.clusters);
    std::vector<std::uint32_t> vertices(size.vertices);
    std::vector<std::uint8_t> corners(3 * size.triangles);
    ASSERT_EQ(write_clusters(one.layout, {clusters, vertices, corners}), Status::ok);
    std::vector<std::uint32_t> found;
    std::vector<std::uint32_t> found_vertices;
    std::vector<std::uint8_t> found_corners;
    std::size_t cluster = 0;
    std::size_t patch = 0;
    for (; one.layout.first_triangle(patch) < one.layout.size().triangles; ++patch) {
      const SetRange range{patch, 1};
      ASSERT_EQ(strip_size(one.layout, all, {.threads = 1}, range), Status::ok);
      std::vector<std::uint32_t> part(all);
      ASSERT_EQ(write_strips(one.layout, std::span(part), {.threads = 1}, range), Status::ok);
      found.insert(found.end(), part.begin(), part.end());
      ASSERT_EQ(cluster_size(one.layout, size, {.threads = 1}, range), Status::ok);
      std::vector<MeshCluster> some(size.clusters);
      std::vector<std::uint32_t> numbers(size.vertices);
      std::vector<std::uint8_t> places(3 * size.triangles);
      ASSERT_EQ(write_clusters(one.layout, {some, numbers, places}, {.threads = 1}, range),
                Status::ok);
      for (const MeshCluster& own : some) {
        ASSERT_EQ(own.patch, patch);
        ASSERT_EQ(own.first_vertex + found_vertices.size(), clusters.at(cluster).first_vertex);
        ASSERT_EQ(3 * own.first_triangle + found_corners.size(),
                  3 * clusters.at(cluster++).first_triangle);
      }
      found_vertices.insert(found_vertices.end(), numbers.begin(), numbers.end());
      found_corners.insert(found_corners.end(), places.begin(), places.end());
    }
    EXPECT_EQ(found, strips);
    EXPECT_EQ(found_vertices, vertices);
    EXPECT_EQ(found_corners, corners);
    const SetRange beyond{patch + 1, 1};
    EXPECT_EQ(strip_size(one.layout, all, {}, beyond), Status::bad_patch_range);
    EXPECT_EQ(write_strips(one.layout, std::span(strips), {}, beyond), Status::bad_patch_range);
    EXPECT_EQ(cluster_size(one.layout, size, {}, beyond), Status::bad_patch_range);
    EXPECT_EQ(write_clusters(one.layout, {clusters, vertices, corners}, {}, beyond),
              Status::bad_patch_range);
  }
}

TEST(MeshPrimitives, strips_are_the_triangles) {
  constexpr std::uint32_t kRestart = 0xffffffff;
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    std::size_t size = 0;
    ASSERT_EQ(strip_size(one.layout, size, {.threads = 1}), Status::ok);
    std::vector<std::uint32_t> indices(size);
    ASSERT_EQ(write_strips(one.layout, std::span(indices), {.threads = 2}), Status::ok);
    ASSERT_EQ(indices.back(), kRestart);
    std::vector<Triangle> found;
    std::size_t begin = 0;
    for (std::size_t k = 0; k < indices.size(); ++k) {
      if (indices[k] == kRestart) {
        begin = k + 1;
      } else if (k >= begin + 2) {
        const bool odd = (k - begin) % 2 != 0;
        const Triangle t = {indices[k - 2], indices[odd ? k : k - 1], indices[odd ? k - 1 : k]};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
          found.push_back(turned_to_lowest(t));
        }
      }
    }
    expect_same(one, found);
    EXPECT_EQ(write_strips(one.layout, std::span(indices).first(size - 1), {.threads = 1}),
              Status::output_too_small);
  }
}

TEST(MeshPrimitives, clusters_are_the_triangles) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    ClusterSize size;
    ASSERT_EQ(cluster_size(one.layout, size, {.threads = 1}), Status::ok);
    std::vector<MeshCluster> clusters(size.clusters);
    std::vector<std::uint32_t> vertices(size.vertices);
    std::vector<std::uint8_t> corners(3 * size.triangles);
    ASSERT_EQ(write_clusters(one.layout, {clusters, vertices, corners}, {.threads = 2}),
              Status::ok);
    std::vector<Triangle> found;
    std::uint32_t next_vertex = 0;
    std::uint32_t next_triangle = 0;
    for (const MeshCluster& cluster : clusters) {
      ASSERT_LE(cluster.triangles, kMostClusterTriangles);
      ASSERT_LE(cluster.vertices, kMostClusterVertices);
      ASSERT_EQ(cluster.first_vertex, next_vertex);
      ASSERT_EQ(cluster.first_triangle, next_triangle);
      for (std::size_t k = 0; k < 3 * cluster.triangles; k += 3) {
        Triangle t{};
        for (std::size_t c = 0; c < 3; ++c) {
          const std::uint8_t corner = corners[3 * cluster.first_triangle + k + c];
          ASSERT_LT(corner, cluster.vertices);
          t[c] = vertices[cluster.first_vertex + corner];
        }
        found.push_back(turned_to_lowest(t));
      }
      next_vertex += cluster.vertices;
      next_triangle += cluster.triangles;
    }
    EXPECT_EQ(next_vertex, vertices.size());
    expect_same(one, found);
    EXPECT_EQ(write_clusters(one.layout,
                             {clusters, vertices, std::span(corners).first(corners.size() - 1)},
                             {.threads = 1}),
              Status::output_too_small);
  }
}

TEST(MeshPrimitives, large_patches_fill_their_clusters) {
  const MeshModel model = mesh_models()[0];
  const std::vector<double> values = model.values();
  Topology topology;
  ASSERT_EQ(find_topology(ControlNets<double>::packed(values.data(), 1, 3, 3), topology),
            Status::ok);
  const std::vector<std::uint32_t> rate = {64};
  MeshLayout layout;
  ASSERT_EQ(lay_out_mesh(topology, {rate, rate, {}}, layout), Status::ok);
  ClusterSize size;
  ASSERT_EQ(cluster_size(layout, size), Status::ok);
  EXPECT_EQ(size.triangles, 2U * 64 * 64);
  EXPECT_LE(size.clusters, 70U);           // 64 of 128 triangles where they fit
  EXPECT_LE(size.vertices, 70U * 81 + 99); // 9 x 9 each
}

} // namespace
} // namespace simdbezier::tests::mesh_primitives_test
