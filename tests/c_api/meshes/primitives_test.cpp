// Triangles, polygons, strips and clusters through simdbezier.h: the values of the C++ calls.
#include <limits>

#include "tests/c_api/support/c_model.hpp"

namespace simdbezier::tests::primitives_test {
namespace {

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CMesh, Scalars);

/// Some of the 20 patches; 0 of them: all from the first one on.
struct Range {
  std::size_t first;
  std::size_t count;

  [[nodiscard]] SetRange range() const { return {first, count == 0 ? SetRange::kToTheEnd : count}; }
  [[nodiscard]] simdbezier_primitive_options options() const {
    auto options = sized<simdbezier_primitive_options>();
    options.first_patch = first;
    options.patch_count = count;
    return options;
  }
};
constexpr Range kRanges[] = {{0, 0}, {0, 1}, {5, 0}, {5, 3}, {19, 1}, {20, 0}};

/// Triangles of C++, into memory of just their size.
template <typename Index>
std::vector<Index> triangles_of(const MeshLayout& layout, const Range& range) {
  const std::size_t end = range.count == 0 ? 20 : range.first + range.count;
  std::vector<Index> triangles(3 *
                               (layout.first_triangle(end) - layout.first_triangle(range.first)));
  EXPECT_TRUE(write_triangles(layout, std::span(triangles), {}, range.range()));
  return triangles;
}

simdbezier_status write(const simdbezier_mesh_layout* layout, std::vector<std::uint32_t>& to,
                        const simdbezier_primitive_options* options) {
  return simdbezier_write_triangles_u32(layout, to.data(), to.size(), options);
}
simdbezier_status write(const simdbezier_mesh_layout* layout, std::vector<std::uint16_t>& to,
                        const simdbezier_primitive_options* options) {
  return simdbezier_write_triangles_u16(layout, to.data(), to.size(), options);
}

template <typename Index>
void expect_triangles(const MeshLayout& layout, const simdbezier_mesh_layout* c_layout) {
  for (const Range& range : kRanges) {
    const std::vector<Index> expected = triangles_of<Index>(layout, range);
    for (const simdbezier_destination destination :
         {SIMDBEZIER_TO_AUTOMATIC, SIMDBEZIER_TO_CACHE, SIMDBEZIER_TO_MEMORY}) {
      simdbezier_primitive_options options = range.options();
      options.destination = destination;
      options.threads = destination;
      std::vector<Index> triangles(expected.size());
      EXPECT_C_OK(write(c_layout, triangles, &options));
      expect_same_bits(triangles, expected, "triangles");
    }
    if (!expected.empty()) {
      const simdbezier_primitive_options options = range.options();
      std::vector<Index> one_less(expected.size() - 1);
      EXPECT_EQ(write(c_layout, one_less, &options), SIMDBEZIER_OUTPUT_TOO_SMALL);
    }
  }
  std::vector<Index> all(3 * layout.size().triangles);
  EXPECT_C_OK(write(c_layout, all, nullptr));
  expect_same_bits(all, triangles_of<Index>(layout, {0, 0}), "all triangles");
}

TYPED_TEST(CMesh, HasTriangles) {
  EXPECT_EQ(simdbezier_mesh_layout_first_triangle(this->c_layout_, 7),
            this->layout_.first_triangle(7));
  expect_triangles<std::uint32_t>(this->layout_, this->c_layout_);
  expect_triangles<std::uint16_t>(this->layout_, this->c_layout_);
}

TYPED_TEST(CMesh, HasPolygons) {
  for (const Range& range : kRanges) {
    const simdbezier_primitive_options options = range.options();
    PolygonSize size;
    ASSERT_TRUE(polygon_size(this->layout_, size, {}, range.range()));
    std::size_t polygons = 7;
    std::size_t indices = 7;
    EXPECT_C_OK(simdbezier_polygon_size(this->c_layout_, &polygons, &indices, &options));
    ASSERT_EQ(polygons, size.polygons);
    ASSERT_EQ(indices, size.indices);
    std::vector<std::uint8_t> sizes(polygons);
    std::vector<std::uint8_t> c_sizes(polygons);
    std::vector<std::uint16_t> expected(indices);
    std::vector<std::uint16_t> got(indices);
    std::vector<std::uint32_t> wide(indices);
    ASSERT_TRUE(
        write_polygons(this->layout_, std::span(expected), std::span(sizes), {}, range.range()));
    EXPECT_C_OK(simdbezier_write_polygons_u16(this->c_layout_, got.data(), indices, c_sizes.data(),
                                              polygons, &options));
    expect_same_bits(got, expected, "polygons");
    expect_same_bits(c_sizes, sizes, "sizes of polygons");
    EXPECT_C_OK(simdbezier_write_polygons_u32(this->c_layout_, wide.data(), indices, c_sizes.data(),
                                              polygons, &options));
    EXPECT_TRUE(std::equal(wide.begin(), wide.end(), expected.begin()));
    if (polygons > 0) {
      EXPECT_EQ(simdbezier_write_polygons_u32(this->c_layout_, wide.data(), indices, c_sizes.data(),
                                              polygons - 1, &options),
                SIMDBEZIER_OUTPUT_TOO_SMALL);
      EXPECT_EQ(simdbezier_write_polygons_u32(this->c_layout_, wide.data(), indices - 1,
                                              c_sizes.data(), polygons, &options),
                SIMDBEZIER_OUTPUT_TOO_SMALL);
    }
  }
}

TYPED_TEST(CMesh, HasStrips) {
  std::size_t indices = 0;
  EXPECT_C_OK(simdbezier_strip_size(this->c_layout_, &indices, nullptr));
  std::vector<std::uint16_t> expected(indices);
  std::vector<std::uint16_t> got(indices);
  std::vector<std::uint32_t> wide(indices);
  ASSERT_TRUE(write_strips(this->layout_, std::span(expected)));
  EXPECT_C_OK(simdbezier_write_strips_u16(this->c_layout_, got.data(), indices, nullptr));
  expect_same_bits(got, expected, "strips");
  EXPECT_C_OK(simdbezier_write_strips_u32(this->c_layout_, wide.data(), indices, nullptr));
  for (std::size_t k = 0; k < indices; ++k) {
    const bool ends = expected[k] == std::numeric_limits<std::uint16_t>::max();
    ASSERT_EQ(wide[k], ends ? std::numeric_limits<std::uint32_t>::max() : expected[k]);
  }
}

TYPED_TEST(CMesh, HasClusters) {
  ClusterSize size;
  ASSERT_TRUE(cluster_size(this->layout_, size));
  std::size_t clusters = 0;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  EXPECT_C_OK(simdbezier_cluster_size(this->c_layout_, &clusters, &vertices, &triangles, nullptr));
  ASSERT_EQ(clusters, size.clusters);
  std::vector<MeshCluster> expected(clusters);
  std::vector<simdbezier_cluster> got(clusters);
  std::vector<std::uint32_t> numbers(vertices);
  std::vector<std::uint32_t> c_numbers(vertices);
  std::vector<std::uint8_t> corners(3 * triangles);
  std::vector<std::uint8_t> c_corners(3 * triangles);
  ASSERT_TRUE(write_clusters(this->layout_, {expected, numbers, corners}));
  EXPECT_C_OK(simdbezier_write_clusters(this->c_layout_, got.data(), clusters, c_numbers.data(),
                                        vertices, c_corners.data(), c_corners.size(), nullptr));
  expect_same_bits(c_numbers, numbers, "vertices of clusters");
  expect_same_bits(c_corners, corners, "corners of clusters");
  EXPECT_EQ(got.back().triangles, expected.back().triangles);
  EXPECT_EQ(got.back().patch, expected.back().patch);

  auto second = sized<simdbezier_primitive_options>();
  second.first_patch = second.patch_count = 1;
  ASSERT_TRUE(cluster_size(this->layout_, size, {}, {1, 1}));
  EXPECT_C_OK(simdbezier_cluster_size(this->c_layout_, &clusters, &vertices, &triangles, &second));
  EXPECT_EQ(clusters, size.clusters);
  EXPECT_C_OK(simdbezier_write_clusters(this->c_layout_, got.data(), clusters, c_numbers.data(),
                                        vertices, c_corners.data(), 3 * triangles, &second));
  EXPECT_EQ(got.front().patch, 1U);
  std::size_t strips = 0;
  std::size_t indices = 0;
  ASSERT_TRUE(strip_size(this->layout_, strips, {}, {1, 1}));
  EXPECT_C_OK(simdbezier_strip_size(this->c_layout_, &indices, &second));
  EXPECT_EQ(indices, strips);
}

} // namespace
} // namespace simdbezier::tests::primitives_test
