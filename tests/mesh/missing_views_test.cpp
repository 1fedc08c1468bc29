// Lists of views that are null are refused by every call that takes nets.
#include <gtest/gtest.h>

#include <vector>

#include <simdbezier/simdbezier.hpp>

namespace simdbezier::tests::missing_views_test {
namespace {

using Views = std::span<const ControlNets<double>>;

TEST(MissingViews, are_refused) {
  const std::vector<double> values(48, 0);
  const auto net = ControlNets<double>::packed(std::span<const double>(values));
  Topology topology;
  ASSERT_EQ(find_topology(net, topology), Status::ok);
  const Views null(static_cast<const ControlNets<double>*>(nullptr), 2);
  std::vector<std::uint32_t> nu(1, 1), nv(1, 1);
  std::vector<std::uint16_t> diagonals(1);
  std::vector<double> deviations(1);
  const CertifiedRates rates{nu, nv, diagonals, deviations};
  RateOptions options;
  options.tolerance = 1;
  Camera camera;
  camera.direction[0] = 1;
  std::vector<EdgeLink> links(4);
  PatchSet<float> set;
  DistinctNets<double> distinct;
  QuantisationBox box;
  MeshOptions mesh;
  mesh.rates.tolerance = 1;
  EXPECT_EQ(find_topology(null, topology), Status::null_input);
  EXPECT_EQ(find_adjacency(null, links.data()), Status::null_input);
  EXPECT_EQ(find_distinct_nets(null, topology, distinct), Status::null_input);
  EXPECT_EQ(choose_rates(null, topology, options, rates).status, Status::null_input);
  EXPECT_EQ(certify_rates(null, topology, {}, rates).status, Status::null_input);
  EXPECT_EQ(certify_grids(null, 1, 1, {}, deviations).status, Status::null_input);
  EXPECT_EQ(pixel_tolerances(null, camera, 1, deviations), Status::null_input);
  EXPECT_EQ(quantisation_box(null, VertexFormat::unorm16, box), Status::null_input);
  EXPECT_EQ(pack(null, set).status, Status::null_input);
  EXPECT_EQ(plan_mesh<float>(null, mesh).report.status, Status::null_input);
  EXPECT_EQ(tessellate<float>(null, mesh).report.status, Status::null_input);
  EXPECT_EQ(topology.counts().patches, 1U);
  const std::span<const SplineSurface<double>> splines(
      static_cast<const SplineSurface<double>*>(nullptr), 2);
  EXPECT_EQ(to_bezier(splines, MutableNets<double>()).status, Status::null_input);
  EXPECT_EQ(pack(splines, set).status, Status::null_input);
  EXPECT_EQ(plan_mesh<float>(splines, mesh).report.status, Status::null_input);
  EXPECT_EQ(tessellate<float>(splines, mesh).report.status, Status::null_input);
}

} // namespace
} // namespace simdbezier::tests::missing_views_test
