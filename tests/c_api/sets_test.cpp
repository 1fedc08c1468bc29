// What sets of simdbezier.h say of themselves, and the helpers that describe memory for them.
#include <set>

#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests::sets_test {
namespace {

template <typename T>
class CSets : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CSets, Scalars);

TYPED_TEST(CSets, HavePositionErrorsOfEveryInstructionSet) {
  using T = TypeParam;
  const std::vector<T> values = random_values<T>(6 * 48, 31);
  PatchSet<T> patches;
  CurveSet<T> curves;
  ASSERT_TRUE(pack(ControlNets<T>::packed(values), patches));
  ASSERT_TRUE(pack(ControlCurves<T>::packed(values), curves));
  const CPatchSet c_patches = c_pack<T>(c_nets(values, 3, 3));
  const CCurveSet c_curves =
      c_pack<T>(simdbezier_packed_curves_of(values.data(), values.size(), 3, 3, 0, kCScalar<T>));
  std::set<std::vector<double>> different;
  std::set<bool> classes;
  for (const Isa isa : available_isas()) {
    const auto c_isa = static_cast<simdbezier_isa>(isa);
    std::vector<double> expected(6);
    std::vector<double> errors(6);
    ASSERT_TRUE(position_errors(patches, std::span<double>(expected), {.isa = isa}));
    auto c_options = sized<simdbezier_options>();
    c_options.isa = c_isa;
    EXPECT_C_OK(simdbezier_position_errors(c_patches.get(), errors.data(), 6, &c_options));
    expect_same_bits(errors, expected, "errors of patches");
    different.insert(errors);
    classes.insert(fuses_multiply_add(isa));
    EXPECT_EQ(simdbezier_fuses_multiply_add(c_isa) != 0, fuses_multiply_add(isa));
    simdbezier_isa chosen = SIMDBEZIER_ISA_AUTOMATIC;
    EXPECT_C_OK(simdbezier_resolve_isa(c_isa, &chosen));
    EXPECT_EQ(chosen, c_isa);
    expected.resize(24);
    errors.resize(24);
    ASSERT_TRUE(position_errors(curves, std::span<double>(expected), {.isa = isa}));
    EXPECT_C_OK(simdbezier_curve_position_errors(c_curves.get(), errors.data(), 24, &c_options));
    expect_same_bits(errors, expected, "errors of curves");
  }
  EXPECT_EQ(different.size(), classes.size()) << "the instruction set could be missed";
}

TYPED_TEST(CSets, SayWhetherTheyHaveLocalOrigins) {
  using T = TypeParam;
  const std::vector<T> values = random_values<T>(48, 32);
  const simdbezier_nets nets = c_nets(values, 3, 3);
  const auto polygons =
      simdbezier_packed_curves_of(values.data(), values.size(), 3, 3, 0, kCScalar<T>);
  for (const int origins : {0, 1}) {
    auto options = sized<simdbezier_pack_options>();
    options.local_origin = origins;
    simdbezier_patch_set* patches = nullptr;
    simdbezier_curve_set* curves = nullptr;
    EXPECT_C_OK(simdbezier_pack(&nets, 1, kCScalar<T>, &options, &patches));
    EXPECT_C_OK(simdbezier_pack_curves(&polygons, kCScalar<T>, &options, &curves));
    EXPECT_EQ(simdbezier_patch_set_has_local_origins(patches), origins);
    EXPECT_EQ(simdbezier_curve_set_has_local_origins(curves), origins);
    simdbezier_patch_set_free(patches);
    simdbezier_curve_set_free(curves);
  }
  EXPECT_EQ(simdbezier_patch_set_has_local_origins(nullptr), 0);
  EXPECT_EQ(simdbezier_curve_set_has_local_origins(nullptr), 0);
}

simdbezier_vectors c_planes(std::vector<float>& x, std::vector<float>& y, std::vector<float>& z) {
  return simdbezier_planes_f32(x.data(), y.data(), z.data(), x.size());
}
simdbezier_vectors c_planes(std::vector<double>& x, std::vector<double>& y,
                            std::vector<double>& z) {
  return simdbezier_planes_f64(x.data(), y.data(), z.data(), x.size());
}
simdbezier_control_curves c_polygons(const std::vector<float>& values) {
  return simdbezier_packed_curves_f32(values.data(), values.size(), 4, 3, SIMDBEZIER_CARTESIAN);
}
simdbezier_control_curves c_polygons(const std::vector<double>& values) {
  return simdbezier_packed_curves_f64(values.data(), values.size(), 4, 3, SIMDBEZIER_CARTESIAN);
}

TYPED_TEST(CSets, OfPackedCurvesGoToPlanes) {
  using T = TypeParam;
  const std::vector<T> values = random_values<T>(3 * 5 * 4, 33); // three rational quartics
  CurveSet<T> set;
  ASSERT_TRUE(pack(ControlCurves<T>::packed(values, 4, 3, Weights::cartesian), set));
  const CCurveSet c_set = c_pack<T>(c_polygons(values));
  ASSERT_EQ(simdbezier_curve_set_size(c_set.get()), 3U);
  EXPECT_EQ(simdbezier_curve_set_degree(c_set.get()), 4);
  EXPECT_EQ(simdbezier_curve_set_rational(c_set.get()), 1);
  std::vector<T> expected[3] = {std::vector<T>(21), std::vector<T>(21), std::vector<T>(21)};
  std::vector<T> got[3] = {std::vector<T>(21), std::vector<T>(21), std::vector<T>(21)};
  CurveOutputs<T> out;
  out.position = Vectors<T>::planes(expected[0], expected[1], expected[2]);
  ASSERT_TRUE(evaluate(set, CurveGrid<T>::uniform(7), out));
  auto c_out = sized<simdbezier_curve_outputs>();
  c_out.position = c_planes(got[0], got[1], got[2]);
  const simdbezier_curve_grid grid = simdbezier_uniform_curve_grid(7);
  EXPECT_C_OK(simdbezier_evaluate_curve_grid(c_set.get(), &grid, &c_out, nullptr));
  for (std::size_t c = 0; c < 3; ++c) {
    expect_same_bits(got[c], expected[c], "a plane");
  }
  got[0].pop_back(); // one sample less than there are
  c_out.position = c_planes(got[0], got[1], got[2]);
  EXPECT_EQ(simdbezier_evaluate_curve_grid(c_set.get(), &grid, &c_out, nullptr),
            SIMDBEZIER_OUTPUT_TOO_SMALL);
}

} // namespace
} // namespace simdbezier::tests::sets_test
