// Models through simdbezier.h: the values of the C++ calls.
#include "tests/c_api/support/c_model.hpp"

namespace simdbezier::tests::models_test {
namespace {

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
  std::int32_t fits = 0;
  EXPECT_C_OK(simdbezier_topology_fits(this->c_topology_, &this->c_nets_, 1, 0, &fits));
  EXPECT_EQ(fits, 1);
  EXPECT_EQ(simdbezier_topology_fits(this->c_topology_, &this->c_nets_, 1, 0, nullptr),
            SIMDBEZIER_NULL_OUTPUT);
  EXPECT_EQ(simdbezier_topology_is_turned(this->c_topology_, 3), 0);
  EXPECT_EQ(simdbezier_topology_is_repeated(this->c_topology_, 99), 0);
}

} // namespace
} // namespace simdbezier::tests::models_test
