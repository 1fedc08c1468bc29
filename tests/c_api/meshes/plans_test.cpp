// Certificates of grids, and plans of meshes, through simdbezier.h: the values of the C++ calls.
#include "tests/c_api/support/c_model.hpp"

namespace simdbezier::tests::plans_test {
namespace {

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CMesh, Scalars);

TYPED_TEST(CMesh, HasCertifiedGrids) {
  const auto nets = ControlNets<TypeParam>::packed(this->values_);
  const std::vector<double> errors(20, 1e-3);
  auto alone = sized<simdbezier_options>();
  alone.threads = 1;
  std::vector<double> without;
  for (const std::size_t given : {0U, 20U}) {
    const std::span<const double> known(errors.data(), given);
    std::vector<double> expected(20);
    std::vector<double> deviation(20);
    ASSERT_TRUE(certify_grids(std::span(&nets, 1), 3, 5, known, std::span(expected)));
    EXPECT_C_OK(simdbezier_certify_grids(&this->c_nets_, 1, 3, 5, known.data(), known.size(),
                                         deviation.data(), 20, nullptr));
    expect_same_bits(deviation, expected, "deviation");
    EXPECT_NE(deviation, without) << "errors could be missed";
    without = deviation;
    EXPECT_C_OK(simdbezier_certify_grids(&this->c_nets_, 1, 5, 3, known.data(), known.size(),
                                         deviation.data(), 20, &alone));
    EXPECT_NE(deviation, expected) << "nu and nv could be exchanged";
  }
}

/// A plan in C++ and in C, of two models of which the second one has the patches of the first.
template <typename T>
struct Plans {
  Plans(const simdbezier_nets& given, std::span<const T> values, bool drop) {
    const std::vector<ControlNets<T>> nets(2, ControlNets<T>::packed(values));
    MeshOptions options;
    options.rates.tolerance = 1e-3;
    options.drop_repeated = drop;
    plan = plan_mesh<T>(std::span<const ControlNets<T>>(nets), options);
    mesh = tessellate<T>(std::span<const ControlNets<T>>(nets), options);
    const simdbezier_nets c_nets[] = {given, given};
    auto c_options = sized<simdbezier_mesh_options>();
    c_options.tolerance = 1e-3;
    c_options.drop_repeated = drop ? 1 : 0;
    EXPECT_C_OK(simdbezier_plan_mesh(c_nets, 2, kCScalar<T>, &c_options, &c_plan));
    EXPECT_C_OK(simdbezier_mesh_plan_look(c_plan, &parts));
  }
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;
  ~Plans() { simdbezier_mesh_plan_free(c_plan); }

  MeshPlan<T> plan;
  Mesh<T> mesh;
  simdbezier_mesh_plan* c_plan = nullptr;
  simdbezier_mesh_plan_parts parts = sized<simdbezier_mesh_plan_parts>();
};

TYPED_TEST(CMesh, HasAPlan) {
  using T = TypeParam;
  for (const bool drop : {false, true}) {
    const Plans<T> of(this->c_nets_, this->values_, drop);
    ASSERT_TRUE(of.plan);
    const std::size_t patches = drop ? 20 : 40;
    ASSERT_EQ(of.parts.patch_count, patches);
    EXPECT_EQ(simdbezier_patch_set_size(of.parts.set), patches);
    EXPECT_EQ(simdbezier_patch_set_scalar(of.parts.set), kCScalar<T>);
    const auto same = [&](const auto* got, const auto& expected) {
      return got != nullptr && std::equal(expected.begin(), expected.end(), got);
    };
    EXPECT_TRUE(same(of.parts.cells_u, of.plan.cells_u));
    EXPECT_TRUE(same(of.parts.cells_v, of.plan.cells_v));
    EXPECT_TRUE(same(of.parts.deviations, of.plan.deviations));
    EXPECT_EQ(of.parts.patches != nullptr, drop);
    EXPECT_TRUE(!drop || same(of.parts.patches, of.plan.patches));
    EXPECT_EQ(of.parts.deviation, of.plan.deviation);
    EXPECT_EQ(of.parts.diagonal, of.plan.diagonal);
    auto counts = sized<simdbezier_topology_counts>();
    EXPECT_C_OK(simdbezier_mesh_plan_count(of.c_plan, &counts));
    EXPECT_EQ(counts.repeated_patches, 20U);
    EXPECT_C_OK(simdbezier_topology_count(of.parts.topology, &counts));
    EXPECT_EQ(counts.patches, patches);
  }
}

TYPED_TEST(CMesh, IsMadeOfItsPlan) {
  using T = TypeParam;
  const Plans<T> of(this->c_nets_, this->values_, false);
  ASSERT_TRUE(of.mesh);
  const std::size_t vertices = simdbezier_mesh_layout_vertices(of.parts.layout);
  const std::size_t triangles = simdbezier_mesh_layout_triangles(of.parts.layout);
  ASSERT_EQ(vertices, of.mesh.positions.size());
  ASSERT_EQ(triangles, of.mesh.triangles.size());
  std::vector<T> positions(3 * vertices);
  auto out = sized<simdbezier_mesh_outputs>();
  out.position = c_triples(positions);
  EXPECT_C_OK(simdbezier_evaluate_mesh(of.parts.set, of.parts.layout, &out, nullptr, 0, 0));
  EXPECT_EQ(std::memcmp(positions.data(), of.mesh.positions.data(), positions.size() * sizeof(T)),
            0);
  std::vector<std::uint32_t> indices(3 * triangles);
  EXPECT_C_OK(
      simdbezier_write_triangles_u32(of.parts.layout, indices.data(), indices.size(), nullptr));
  EXPECT_EQ(std::memcmp(indices.data(), of.mesh.triangles.data(), indices.size() * 4), 0);
}

TEST(CMeshPlans, OfNothingAreEmpty) {
  auto options = sized<simdbezier_mesh_options>();
  options.tolerance = 1;
  simdbezier_mesh_plan* plan = nullptr;
  EXPECT_C_OK(simdbezier_plan_mesh(nullptr, 0, SIMDBEZIER_F32, &options, &plan));
  auto parts = sized<simdbezier_mesh_plan_parts>();
  EXPECT_C_OK(simdbezier_mesh_plan_look(plan, &parts));
  EXPECT_EQ(parts.patch_count, 0U);
  EXPECT_EQ(parts.patches, nullptr);
  EXPECT_EQ(simdbezier_patch_set_size(parts.set), 0U);
  EXPECT_EQ(simdbezier_mesh_layout_vertices(parts.layout), 0U);
  simdbezier_mesh_plan_free(plan);
  simdbezier_mesh_plan_free(nullptr);
}

} // namespace
} // namespace simdbezier::tests::plans_test
