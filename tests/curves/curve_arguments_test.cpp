// Bad arguments: the status, and that nothing was written.
#include <limits>

#include "tests/curves/curve_results.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::curve_arguments_test {
namespace {

constexpr std::size_t kCurves = 3;
constexpr auto kHuge = std::numeric_limits<std::size_t>::max();

class CurveArguments : public ::testing::Test {
protected:
  CurveArguments() { EXPECT_TRUE(pack(random_curves<float>(kCurves, 3, 3, 0, 1).view(), set_)); }

  template <typename Samples>
  void refuse(Status expected, const Samples& samples, const CurveOutputs<float>& out,
              const CallOptions& options = {}) {
    EXPECT_EQ(to_string(evaluate(set_, samples, out, options)), to_string(expected));
    for (const float value : results_.values) {
      ASSERT_EQ(value, CurveResults<float>::kUntouched);
    }
  }

  static constexpr std::size_t kSamples = kCurves * 4;
  CurveGrid<float> grid_ = CurveGrid<float>::uniform(4);
  CurveSet<float> set_;
  CurveResults<float> results_{kSamples, 3};
};

TEST_F(CurveArguments, GridSizes) {
  refuse(Status::bad_grid, CurveGrid<float>::uniform(0), results_.outputs());
  refuse(Status::bad_grid, CurveGrid<float>::uniform(1), results_.outputs());
  refuse(Status::size_overflow, CurveGrid<float>::uniform(kHuge), results_.outputs());
  refuse(Status::size_overflow, CurveGrid<float>::uniform(kHuge / 8), results_.outputs());
  const float t = 0.5F;
  EXPECT_EQ(evaluate(set_, CurveGrid<float>{1, &t}, results_.outputs()), Status::ok);
}

TEST_F(CurveArguments, Outputs) {
  refuse(Status::null_output, grid_, CurveOutputs<float>{});
  const Status statuses[] = {Status::null_output, Status::missing_y, Status::missing_z};
  for (int missing = 0; missing < 3; ++missing) {
    auto out = results_.outputs();
    (missing == 0 ? out.d1.x : missing == 1 ? out.position.y : out.tangent.z) = nullptr;
    refuse(statuses[missing], grid_, out);
  }
  auto out = results_.outputs();
  out.d2.stride = 0;
  refuse(Status::bad_stride, grid_, out);
  out = results_.outputs();
  out.d1 = Vectors<float>::xyz(results_.plane(3), 2);
  refuse(Status::bad_stride, grid_, out);
}

TEST_F(CurveArguments, Overlaps) {
  auto out = results_.outputs();
  out.d1.x = out.position.x + 1;
  refuse(Status::overlapping_outputs, grid_, out);
  out = results_.outputs();
  out.curvature = out.tangent.z + 5;
  refuse(Status::overlapping_outputs, grid_, out);
  out = results_.outputs();
  out.status = reinterpret_cast<SampleStatus*>(out.curvature.first + 1);
  refuse(Status::overlapping_outputs, grid_, out);
  out = CurveOutputs<float>{};
  out.curvature = results_.plane(12);
  out.status = reinterpret_cast<SampleStatus*>(out.curvature.first + 1);
  refuse(Status::overlapping_outputs, grid_, out);
  refuse(Status::overlapping_outputs, CurveGrid<float>{4, results_.plane(12)}, results_.outputs());
  out.status = nullptr;
  refuse(Status::overlapping_outputs, CurveGrid<float>{4, results_.plane(12)}, out);
}

TEST_F(CurveArguments, RangesAndIndices) {
  CallOptions options;
  options.first_patch = 4;
  refuse(Status::bad_patch_range, grid_, results_.outputs(), options);
  options.first_patch = 1;
  options.patch_count = 3;
  refuse(Status::bad_patch_range, grid_, results_.outputs(), options);

  const std::uint32_t curve[] = {0, 3};
  const float t[] = {0, 1};
  refuse(Status::bad_patch_index, CurveSamples<float>{curve, t}, results_.outputs());
  refuse(Status::null_input, CurveSamples<float>{{static_cast<std::uint32_t*>(nullptr), 2}, t},
         results_.outputs());
  refuse(Status::null_input, CurveSamples<float>{curve, {static_cast<float*>(nullptr), 2}},
         results_.outputs());
  EXPECT_EQ(evaluate(CurveSet<float>{}, CurveSamples<float>{}, results_.outputs()), Status::ok);
}

TEST_F(CurveArguments, Counts) {
  refuse(Status::ok, CurveGrids{}, results_.outputs()); // no curves
  refuse(Status::null_input, CurveGrids{{static_cast<std::uint32_t*>(nullptr), 3}},
         results_.outputs());
  const std::uint32_t n[] = {4, 1, 4};
  refuse(Status::bad_grid, CurveGrids{n}, results_.outputs());
  const std::uint32_t good[] = {4, 4, 4};
  for (const std::size_t count : {0U, 2U, 4U}) {
    refuse(Status::unequal_lengths, CurveGrids{good, {}, {0, count}}, results_.outputs());
  }
  const std::size_t close[] = {0, 3, 8};
  refuse(Status::bad_offsets, CurveGrids{good, close}, results_.outputs());
  const std::size_t far[] = {0, 4, kHuge - 2};
  refuse(Status::size_overflow, CurveGrids{good, far}, results_.outputs());
}

TEST_F(CurveArguments, Components) {
  CallOptions options;
  for (const int first : {-1, 3}) {
    options.first_component = first;
    refuse(Status::bad_components, grid_, results_.outputs(), options);
  }
  options.first_component = 1; // tangents are of all components
  refuse(Status::bad_components, grid_, results_.outputs(), options);
  for (const int components : {1, 4}) {
    ASSERT_TRUE(pack(random_curves<float>(kCurves, 3, components, 0, 1).view(), set_));
    auto out = CurveOutputs<float>{};
    out.curvature = results_.plane(12);
    refuse(Status::bad_components, grid_, out);
  }
  // A plane that has no component.
  ASSERT_TRUE(pack(random_curves<float>(kCurves, 3, 2, 0, 1).view(), set_));
  refuse(Status::extra_z, grid_, results_.outputs());
}

TEST_F(CurveArguments, CurvatureAlone) {
  CurveOutputs<float> out;
  out.curvature = results_.plane(12);
  for (const Destination destination :
       {Destination::automatic, Destination::cache, Destination::memory}) {
    CallOptions options;
    options.destination = destination;
    EXPECT_EQ(evaluate(set_, grid_, out, options), Status::ok);
  }
  CurveResults<float> all(kSamples, 3);
  ASSERT_EQ(evaluate(set_, grid_, all.outputs()), Status::ok);
  for (std::size_t k = 0; k < kSamples; ++k) {
    EXPECT_EQ(results_.curvature(k), all.curvature(k));
  }
}

TEST(CurvePacking, RefusesWhatItCannotPack) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto good = random_curves<float>(40, 3, 3, 5, 1);
  const auto other = random_curves<float>(1, 2, 2, 0, 1);
  CurveSet<float> set;
  ASSERT_TRUE(pack(other.view(), set));
  const auto refused = [&](const CurveBatch<float>& batch, Report expected, auto change) {
    auto view = batch.view();
    change(view);
    const Report report = pack(view, set);
    EXPECT_EQ(to_string(report.status), to_string(expected.status));
    EXPECT_EQ(report.item, expected.item);
    EXPECT_EQ(report.point, expected.point);
    EXPECT_EQ(report.component, expected.component);
    EXPECT_EQ(set.degree(), 2) << "the set was changed";
  };
  using View = ControlCurves<float>;
  refused(good, {Status::bad_degree}, [](View& view) { view.degree = 0; });
  refused(good, {Status::bad_degree}, [](View& view) { view.degree = 16; });
  refused(good, {Status::bad_components}, [](View& view) { view.components = 0; });
  refused(good, {Status::bad_components}, [](View& view) { view.components = 17; });
  refused(good, {Status::null_input}, [](View& view) { view.points = nullptr; });
  refused(good, {Status::bad_stride}, [](View& view) { view.point_stride = 0; });
  refused(good, {Status::bad_stride}, [](View& view) { view.component_stride = 0; });
  refused(good, {Status::size_overflow}, [](View& view) { view.count = kHuge / 64; });

  const auto with = [&](std::size_t curve, std::size_t point, std::size_t c, float value) {
    auto batch = good;
    batch.at(curve, point, c) = value;
    return batch;
  };
  const auto as_it_is = [](View&) {};
  refused(with(21, 2, 1, nan), {Status::non_finite_input, 21, 2, 1}, as_it_is);
  refused(with(39, 3, 0, INFINITY), {Status::non_finite_input, 39, 3, 0}, as_it_is);
  for (const float weight : {0.0F, -1.0F, nan, INFINITY, 1e-39F}) {
    refused(with(17, 1, 3, weight), {Status::bad_weight, 17, 1, 3}, as_it_is);
  }
  refused(with(5, 1, 2, std::numeric_limits<float>::max()), {Status::coefficient_overflow, 5, 0, 2},
          as_it_is);
  auto two = with(30, 1, 1, nan);
  two.at(8, 0, 3) = -2;
  refused(two, {Status::bad_weight, 8, 0, 3}, as_it_is);

  // A weight that is positive in double and zero in float.
  auto tiny = random_curves<double>(2, 3, 3, 5, 1);
  tiny.at(1, 2, 3) = 1e-60;
  const Report report = pack(tiny.view(), set);
  EXPECT_EQ(to_string(report.status), to_string(Status::bad_weight));
  EXPECT_EQ(report.item, 1U);
  PackOptions moved;
  moved.relative_to[1] = INFINITY;
  EXPECT_EQ(pack(good.view(), set, moved).component, 1);
}

TEST(CurvePacking, LargeAndSmallValuesThatFitAreTaken) {
  for (const double scale : {1e-30, 1e30}) {
    auto batch = random_curves<float>(3, 5, 3, 0, 1);
    for (float& value : batch.points) {
      value = static_cast<float>(static_cast<double>(value) * scale);
    }
    CurveSet<float> set;
    ASSERT_TRUE(pack(batch.view(), set));
    CurveResults<float> results(3 * 5, 3);
    ASSERT_EQ(evaluate(set, CurveGrid<float>::uniform(5), results.outputs()), Status::ok);
    for (std::size_t k = 0; k < 15; ++k) {
      double length = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        length += std::pow(static_cast<double>(results.at(3, c, k)), 2);
      }
      EXPECT_NEAR(length, 1, 1e-6);
      EXPECT_TRUE(results.status[k] == SampleStatus::regular);
    }
  }
}

TEST(CurvePacking, StridesOfAnyKind) {
  const auto batch = random_curves<float>(20, 4, 3, 3, 1);
  // Components in planes, points backwards, curves with gaps.
  constexpr std::size_t kPlane = 20 * 7;
  std::vector<float> memory(4 * kPlane, NAN);
  for (std::size_t k = 0; k < 20; ++k) {
    for (std::size_t i = 0; i < 5; ++i) {
      for (std::size_t c = 0; c < 4; ++c) {
        memory[c * kPlane + k * 7 + 4 - i] = batch.at(k, i, c);
      }
    }
  }
  CurveSet<float> one;
  CurveSet<float> other;
  ASSERT_TRUE(pack(batch.view(), one));
  ASSERT_TRUE(pack(
      ControlCurves<float>{memory.data() + 4, 20, 4, 7, -1, kPlane, 3, Weights::cartesian}, other));
  CurveResults<float> a(20 * 6, 3);
  CurveResults<float> b(20 * 6, 3);
  ASSERT_EQ(evaluate(one, CurveGrid<float>::uniform(6), a.outputs()), Status::ok);
  ASSERT_EQ(evaluate(other, CurveGrid<float>::uniform(6), b.outputs()), Status::ok);
  EXPECT_EQ(a.hash(), b.hash());
}

TEST(CurveBoundsOf, UnknownCurvesAndInstructionSets) {
  CurveSet<float> set;
  EXPECT_EQ(error_bounds(set, 0).position[0], 0);
  ASSERT_TRUE(pack(random_curves<float>(2, 3, 3, 0, 1).view(), set));
  EXPECT_EQ(error_bounds(set, 2).d1[0], 0);
  EXPECT_GT(error_bounds(set, 1).d1[0], 0);
  EXPECT_TRUE(std::isinf(error_bounds(set, 0, absent_isa()).position[2]));
}

} // namespace
} // namespace simdbezier::tests::curve_arguments_test
