// Models and their meshes through simdbezier.h: the values of the C++ calls.
#include "tests/c_api/c_values.hpp"

namespace simdbezier::tests {
namespace {

/// A closed model: a periodic B-spline mesh of 4 x 5 control points.
template <typename T>
class CModel : public ::testing::Test {
protected:
  void SetUp() override {
    auto mesh = sized<simdbezier_spline_mesh>();
    mesh.points = mesh_points_.data();
    mesh.length = mesh_points_.size();
    mesh.rows = 4;
    mesh.columns = 5;
    mesh.row_stride = 15;
    mesh.point_stride = 3;
    mesh.component_stride = 1;
    mesh.components = 3;
    mesh.scalar = kCScalar<T>;
    mesh.periodic_u = mesh.periodic_v = 1;
    values_.resize(20 * 48);
    const simdbezier_mutable_nets room = c_room(values_, 3, 3);
    ASSERT_EQ(simdbezier_spline_to_bezier(&mesh, &room, nullptr), SIMDBEZIER_OK)
        << simdbezier_last_message();
    std::vector<T> expected(values_.size());
    ASSERT_TRUE(spline_to_bezier(
        SplineMesh<T>{mesh_points_.data(), 4, 5, 15, 3, 1, 3, Weights::none, true, true},
        MutableNets<T>::packed(std::span(expected), 20, 3, 3)));
    expect_same_bits(values_, expected, "pieces of a spline");
    c_nets_ = c_nets(values_, 3, 3);
    ASSERT_EQ(simdbezier_find_topology(&c_nets_, 1, nullptr, &c_topology_), SIMDBEZIER_OK);
    ASSERT_TRUE(find_topology(ControlNets<T>::packed(values_), topology_));
  }
  void TearDown() override { simdbezier_topology_free(c_topology_); }

  std::vector<T> mesh_points_ = random_values<T>(4 * 5 * 3, 13);
  std::vector<T> values_;
  simdbezier_nets c_nets_{};
  Topology topology_;
  simdbezier_topology* c_topology_ = nullptr;
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CModel, Scalars);

TYPED_TEST(CModel, HasEdges) {
  using T = TypeParam;
  std::vector<EdgeLink> expected(80);
  ASSERT_TRUE(find_adjacency(ControlNets<T>::packed(this->values_), Values<EdgeLink>(expected)));
  std::vector<simdbezier_edge_link> links(80);
  EXPECT_C_OK(simdbezier_find_adjacency(&this->c_nets_, 1, links.data(), links.size(), nullptr));
  for (std::size_t k = 0; k < links.size(); ++k) {
    EXPECT_EQ(links[k].kind, static_cast<int>(expected[k].kind));
    EXPECT_EQ(links[k].edge, static_cast<int>(expected[k].edge));
    EXPECT_EQ(links[k].reversed != 0, expected[k].reversed);
    EXPECT_EQ(links[k].patch, expected[k].patch);
  }
  const TopologyCounts counts = this->topology_.counts();
  auto c_counts = sized<simdbezier_topology_counts>();
  EXPECT_C_OK(simdbezier_topology_count(this->c_topology_, &c_counts));
  EXPECT_EQ(c_counts.patches, 20U);
  EXPECT_EQ(c_counts.edges, 40U);
  EXPECT_EQ(c_counts.corners, counts.corners);
  EXPECT_EQ(c_counts.open_edges, 0U);
  EXPECT_EQ(c_counts.orientable, 1);
  EXPECT_EQ(simdbezier_topology_is_turned(this->c_topology_, 3), 0);
  EXPECT_EQ(simdbezier_topology_is_repeated(this->c_topology_, 99), 0);
}

/// The same model with its rates, and the numbering of its vertices.
template <typename T>
class CMesh : public CModel<T> {
protected:
  void SetUp() override {
    CModel<T>::SetUp();
    rates_.nu = nu_.data();
    rates_.nv = nv_.data();
    rates_.diagonals = diagonals_.data();
    rates_.deviation = deviation_.data();
    rates_.nu_length = rates_.nv_length = 20;
    rates_.diagonals_length = rates_.deviation_length = 20;
    auto options = sized<simdbezier_rate_options>();
    options.tolerance = 1e-3;
    EXPECT_C_OK(simdbezier_choose_rates(&this->c_nets_, 1, this->c_topology_, &options, &rates_));
    ASSERT_TRUE(lay_out_mesh(this->topology_, {nu_, nv_, diagonals_}, layout_));
    EXPECT_C_OK(simdbezier_lay_out_mesh(this->c_topology_, &rates_, &c_layout_));
    ASSERT_EQ(simdbezier_mesh_layout_vertices(c_layout_), layout_.size().vertices);
    ASSERT_EQ(simdbezier_mesh_layout_triangles(c_layout_), layout_.size().triangles);
  }
  void TearDown() override {
    simdbezier_mesh_layout_free(c_layout_);
    CModel<T>::TearDown();
  }

  std::vector<std::uint32_t> nu_ = std::vector<std::uint32_t>(20);
  std::vector<std::uint32_t> nv_ = std::vector<std::uint32_t>(20);
  std::vector<std::uint16_t> diagonals_ = std::vector<std::uint16_t>(20);
  std::vector<double> deviation_ = std::vector<double>(20);
  simdbezier_rates rates_ = sized<simdbezier_rates>();
  MeshLayout layout_;
  simdbezier_mesh_layout* c_layout_ = nullptr;
};
TYPED_TEST_SUITE(CMesh, Scalars);

TYPED_TEST(CMesh, HasCertifiedRates) {
  using T = TypeParam;
  std::vector<std::uint32_t> nu(20);
  std::vector<std::uint32_t> nv(20);
  std::vector<std::uint16_t> diagonals(20);
  std::vector<double> deviation(20);
  RateOptions wanted;
  wanted.tolerance = 1e-3;
  const auto nets = ControlNets<T>::packed(this->values_);
  ASSERT_TRUE(
      choose_rates(std::span(&nets, 1), this->topology_, wanted, {nu, nv, diagonals, deviation}));
  expect_same_bits(this->nu_, nu, "nu");
  expect_same_bits(this->nv_, nv, "nv");
  expect_same_bits(this->diagonals_, diagonals, "diagonals");
  expect_same_bits(this->deviation_, deviation, "deviation");
  std::fill(this->deviation_.begin(), this->deviation_.end(), 0.0);
  EXPECT_C_OK(
      simdbezier_certify_rates(&this->c_nets_, 1, this->c_topology_, nullptr, 0, &this->rates_, 0));
  expect_same_bits(this->deviation_, deviation, "certified deviation");
  std::size_t raised = 0;
  std::size_t c_raised = 7;
  ASSERT_TRUE(separate_vertices(this->topology_, nu, nv, raised));
  EXPECT_C_OK(simdbezier_separate_vertices(this->c_topology_, this->nu_.data(), 20,
                                           this->nv_.data(), 20, &c_raised));
  EXPECT_EQ(c_raised, raised);
}

TYPED_TEST(CMesh, HasTriangles) {
  EXPECT_EQ(simdbezier_mesh_layout_first_triangle(this->c_layout_, 7),
            this->layout_.first_triangle(7));
  std::vector<std::uint32_t> triangles(3 * this->layout_.size().triangles);
  std::vector<std::uint32_t> c_triangles(triangles.size());
  ASSERT_TRUE(write_triangles(this->layout_, std::span(triangles)));
  EXPECT_C_OK(
      simdbezier_write_triangles_u32(this->c_layout_, c_triangles.data(), c_triangles.size(), 0));
  expect_same_bits(c_triangles, triangles, "triangles");
  std::vector<std::uint16_t> small(triangles.size());
  EXPECT_C_OK(simdbezier_write_triangles_u16(this->c_layout_, small.data(), small.size(), 0));
  EXPECT_TRUE(std::equal(small.begin(), small.end(), triangles.begin()));
}

TYPED_TEST(CMesh, HasPolygonsAndStrips) {
  std::size_t polygons = 0;
  std::size_t indices = 0;
  EXPECT_C_OK(simdbezier_polygon_size(this->c_layout_, &polygons, &indices, 0));
  std::vector<std::uint8_t> sizes(polygons);
  std::vector<std::uint8_t> c_sizes(polygons);
  std::vector<std::uint16_t> expected(indices);
  std::vector<std::uint16_t> got(indices);
  ASSERT_TRUE(write_polygons(this->layout_, std::span(expected), std::span(sizes)));
  EXPECT_C_OK(simdbezier_write_polygons_u16(this->c_layout_, got.data(), indices, c_sizes.data(),
                                            polygons, 0));
  expect_same_bits(got, expected, "polygons");
  expect_same_bits(c_sizes, sizes, "sizes of polygons");

  EXPECT_C_OK(simdbezier_strip_size(this->c_layout_, &indices, 0));
  expected.resize(indices);
  got.resize(indices);
  ASSERT_TRUE(write_strips(this->layout_, std::span(expected)));
  EXPECT_C_OK(simdbezier_write_strips_u16(this->c_layout_, got.data(), indices, 0));
  expect_same_bits(got, expected, "strips");
}

TYPED_TEST(CMesh, HasClusters) {
  ClusterSize size;
  ASSERT_TRUE(cluster_size(this->layout_, size));
  std::size_t clusters = 0;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  EXPECT_C_OK(simdbezier_cluster_size(this->c_layout_, &clusters, &vertices, &triangles, 0));
  ASSERT_EQ(clusters, size.clusters);
  std::vector<MeshCluster> expected(clusters);
  std::vector<simdbezier_cluster> got(clusters);
  std::vector<std::uint32_t> numbers(vertices);
  std::vector<std::uint32_t> c_numbers(vertices);
  std::vector<std::uint8_t> corners(3 * triangles);
  std::vector<std::uint8_t> c_corners(3 * triangles);
  ASSERT_TRUE(write_clusters(this->layout_, {expected, numbers, corners}));
  EXPECT_C_OK(simdbezier_write_clusters(this->c_layout_, got.data(), clusters, c_numbers.data(),
                                        vertices, c_corners.data(), c_corners.size(), 0));
  expect_same_bits(c_numbers, numbers, "vertices of clusters");
  expect_same_bits(c_corners, corners, "corners of clusters");
  EXPECT_EQ(got.back().triangles, expected.back().triangles);
  EXPECT_EQ(got.back().patch, expected.back().patch);
}

} // namespace
} // namespace simdbezier::tests
