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
  MeshPlan<float> plan = plan_mesh<float>(net, mesh);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan_again(Views(null.data(), 1), mesh, plan).status, Status::null_input);
  EXPECT_EQ(plan_again(null, mesh, plan).status, Status::null_input);
  EXPECT_TRUE(plan_again(net, mesh, plan));
  EXPECT_EQ(topology.counts().patches, 1U);
  const std::span<const SplineSurface<double>> splines(
      static_cast<const SplineSurface<double>*>(nullptr), 2);
  EXPECT_EQ(to_bezier(splines, MutableNets<double>()).status, Status::null_input);
  EXPECT_EQ(pack(splines, set).status, Status::null_input);
  EXPECT_EQ(plan_mesh<float>(splines, mesh).report.status, Status::null_input);
  EXPECT_EQ(tessellate<float>(splines, mesh).report.status, Status::null_input);
}

// Nets may be one net many times over, so that the sum of their numbers may be beyond all integers,
// and be 0 or 1 again.
TEST(TooManyViews, are_refused) {
  const std::vector<double> values(48, 0);
  ControlNets<double> net = ControlNets<double>::packed(std::span<const double>(values));
  Topology of_one;
  ASSERT_EQ(find_topology(net, of_one), Status::ok);
  net.patch_stride = 0;
  net.count = std::size_t{1} << 60;
  std::vector<ControlNets<double>> nets(16, net);
  Camera camera;
  camera.direction[0] = 1;
  for (const std::size_t more : {0U, 1U}) {
    nets.resize(16 + more, net);
    nets.back().count = more == 0 ? net.count : 1;
    const Views all(nets);
    std::vector<std::uint32_t> nu(more, 1), nv(more, 1);
    std::vector<std::uint16_t> diagonals(more);
    std::vector<double> deviations(more);
    const CertifiedRates rates{nu, nv, diagonals, deviations};
    const Topology topology = more == 0 ? Topology() : of_one;
    RateOptions options;
    options.tolerance = 1;
    Topology found;
    DistinctNets<double> distinct;
    QuantisationBox box;
    EXPECT_EQ(find_topology(all, found), Status::size_overflow);
    EXPECT_FALSE(fits(topology, all));
    EXPECT_EQ(find_distinct_nets(all, topology, distinct), Status::size_overflow);
    EXPECT_EQ(choose_rates(all, topology, options, rates).status, Status::size_overflow);
    EXPECT_EQ(certify_rates(all, topology, {}, rates).status, Status::size_overflow);
    EXPECT_EQ(certify_grids(all, 1, 1, {}, deviations).status, Status::size_overflow);
    EXPECT_EQ(pixel_tolerances(all, camera, 1, deviations), Status::size_overflow);
    EXPECT_EQ(quantisation_box(all, VertexFormat::unorm16, box), Status::size_overflow);
  }
}

} // namespace
} // namespace simdbezier::tests::missing_views_test
