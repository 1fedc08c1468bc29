// Meshes through simdbezier.h: the values of the C++ calls.
#include "tests/c_api/support/c_model.hpp"

namespace simdbezier::tests::meshes_test {
namespace {

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CMesh, Scalars);

TYPED_TEST(CMesh, KeepsRatesOfTheFrameBefore) {
  auto options = sized<simdbezier_rate_options>();
  options.tolerance = 1.2e-3; // fewer cells would do
  const std::vector<std::uint32_t> nu = this->nu_;
  const std::vector<std::uint32_t> nv = this->nv_;
  for (const double keep : {2.0, 0.0}) {
    options.keep = keep;
    EXPECT_C_OK(
        simdbezier_choose_rates(&this->c_nets_, 1, this->c_topology_, &options, &this->rates_));
    EXPECT_EQ(this->nu_ == nu && this->nv_ == nv, keep != 0) << keep;
  }
}

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
  EXPECT_C_OK(simdbezier_certify_rates(&this->c_nets_, 1, this->c_topology_, nullptr, 0,
                                       &this->rates_, nullptr));
  expect_same_bits(this->deviation_, deviation, "certified deviation");
  std::size_t raised = 0;
  std::size_t c_raised = 7;
  ASSERT_TRUE(separate_vertices(this->topology_, nu, nv, raised));
  EXPECT_C_OK(simdbezier_separate_vertices(this->c_topology_, this->nu_.data(), 20,
                                           this->nv_.data(), 20, &c_raised));
  EXPECT_EQ(c_raised, raised);
}

TYPED_TEST(CMesh, HasVertices) {
  using T = TypeParam;
  const std::size_t vertices = this->layout_.size().vertices;
  PatchSet<T> set;
  ASSERT_TRUE(pack(ControlNets<T>::packed(this->values_), set));
  const CPatchSet c_set = c_pack<T>(this->c_nets_);
  std::vector<T> expected(6 * vertices);
  std::vector<T> got(expected.size());
  std::vector<std::uint32_t> patch(vertices);
  std::vector<std::uint32_t> c_patch(vertices);
  MeshOutputs<T> out;
  out.position = Vectors<T>::xyz(expected, 6);
  out.normal = Vectors<T>::xyz(std::span(expected).subspan(3), 6);
  std::vector<T> uv(2 * vertices);
  std::vector<T> c_uv(2 * vertices);
  out.parameters = Vectors<T>::pairs(std::span(uv));
  out.patch = patch;
  ASSERT_TRUE(evaluate_mesh(set, this->layout_, out));
  auto c_out = sized<simdbezier_mesh_outputs>();
  c_out.position = c_triples(got, 6);
  c_out.normal = c_out.position;
  for (void** const member : {&c_out.normal.x, &c_out.normal.y, &c_out.normal.z}) {
    *member = static_cast<T*>(*member) + 3;
  }
  c_out.parameters = c_pairs(c_uv);
  c_out.patch = c_patch.data();
  c_out.patch_length = c_patch.size();
  EXPECT_C_OK(simdbezier_evaluate_mesh(c_set.get(), this->c_layout_, &c_out, nullptr, 0, 0));
  expect_same_bits(got, expected, "vertices");
  expect_same_bits(c_patch, patch, "patches");
  expect_same_bits(c_uv, uv, "parameters");
  c_uv.resize(2 * vertices - 1);
  c_out.parameters = c_pairs(c_uv); // half of the last pair is missing
  EXPECT_EQ(simdbezier_evaluate_mesh(c_set.get(), this->c_layout_, &c_out, nullptr, 0, 0),
            SIMDBEZIER_OUTPUT_TOO_SMALL);
  EXPECT_EQ(simdbezier_mesh_layout_first_vertex(this->c_layout_, 3), this->layout_.first_vertex(3));

  const std::size_t first = this->layout_.first_vertex(3);
  std::vector<T> z(vertices - first);
  simdbezier_vectors attribute{};
  attribute.x = z.data();
  attribute.stride = 1;
  attribute.capacity = z.size();
  attribute.scalar = kCScalar<T>;
  EXPECT_EQ(simdbezier_evaluate_mesh_attributes(c_set.get(), this->c_layout_, &attribute, 2,
                                                nullptr, 3, 0),
            SIMDBEZIER_OK)
      << simdbezier_last_message();
  EXPECT_EQ(z[0], expected[6 * first + 2]);

  MeshLayout split;
  simdbezier_mesh_layout* c_split = nullptr;
  ASSERT_TRUE(split_creases(set, this->layout_, 0, split));
  EXPECT_C_OK(simdbezier_split_creases(c_set.get(), this->c_layout_, 0, nullptr, &c_split));
  EXPECT_EQ(simdbezier_mesh_layout_vertices(c_split), split.size().vertices);
  EXPECT_GT(split.size().vertices, vertices);
  simdbezier_mesh_layout_free(c_split);
  ASSERT_TRUE(split_parameters(this->layout_, split));
  EXPECT_C_OK(simdbezier_split_parameters(this->c_layout_, &c_split));
  EXPECT_EQ(simdbezier_mesh_layout_vertices(c_split), split.size().vertices);
  EXPECT_GT(split.size().vertices, vertices);
  simdbezier_mesh_layout_free(c_split);
}

TYPED_TEST(CMesh, IsMadeInOneCall) {
  using T = TypeParam;
  const auto nets = ControlNets<T>::packed(this->values_);
  MeshOptions wanted;
  wanted.relative_tolerance = 1e-3;
  wanted.parameters = true;
  const Mesh<T> expected = tessellate<T>(nets, wanted);
  ASSERT_TRUE(expected);
  auto options = sized<simdbezier_mesh_options>();
  options.relative_tolerance = 1e-3;
  options.parameters = 1;
  simdbezier_mesh* mesh = nullptr;
  EXPECT_C_OK(simdbezier_tessellate(&this->c_nets_, 1, kCScalar<T>, &options, &mesh));
  auto arrays = sized<simdbezier_mesh_arrays>();
  EXPECT_C_OK(simdbezier_mesh_look(mesh, &arrays));
  ASSERT_EQ(arrays.vertices, expected.positions.size());
  ASSERT_EQ(arrays.triangles, expected.triangles.size());
  EXPECT_EQ(arrays.scalar, kCScalar<T>);
  EXPECT_EQ(arrays.deviation, expected.deviation);
  EXPECT_EQ(arrays.short_indices, nullptr);
  const auto same = [](const void* got, const auto& values) {
    return std::memcmp(got, values.data(), values.size() * sizeof values[0]) == 0;
  };
  EXPECT_TRUE(same(arrays.positions, expected.positions));
  EXPECT_TRUE(same(arrays.normals, expected.normals));
  EXPECT_TRUE(same(arrays.parameters, expected.parameters));
  EXPECT_TRUE(same(arrays.patches, expected.patches));
  EXPECT_TRUE(same(arrays.indices, expected.triangles));
  EXPECT_TRUE(same(arrays.deviations, expected.deviations));
  auto counts = sized<simdbezier_topology_counts>();
  EXPECT_C_OK(simdbezier_mesh_count(mesh, &counts));
  EXPECT_EQ(counts.corners, expected.counts.corners);
  simdbezier_mesh_free(mesh);
}

TYPED_TEST(CMesh, MeetsACamera) {
  auto camera = sized<simdbezier_camera>();
  camera.eye[2] = 10;
  Camera seen_by;
  seen_by.eye = {0, 0, 10};
  std::vector<double> tolerances(20);
  std::vector<double> expected(20);
  const auto nets = ControlNets<TypeParam>::packed(this->values_);
  ASSERT_TRUE(pixel_tolerances(std::span(&nets, 1), seen_by, 0.5, std::span(expected)));
  EXPECT_C_OK(simdbezier_pixel_tolerances(&this->c_nets_, 1, &camera, 0.5, tolerances.data(),
                                          tolerances.size()));
  expect_same_bits(tolerances, expected, "tolerances of pixels");
}

} // namespace
} // namespace simdbezier::tests::meshes_test
