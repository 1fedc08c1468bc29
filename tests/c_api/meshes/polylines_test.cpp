// Polylines through simdbezier.h: the values of the C++ calls.
#include <functional>
#include <limits>

#include "tests/c_api/support/c_refusal.hpp"

namespace simdbezier::tests::polylines_test {
namespace {

/// Seven rational quartics in space.
template <typename T>
class CPolylines : public ::testing::Test {
protected:
  std::vector<T> values_ = random_values<T>(7 * 5 * 4, 21);
  ControlCurves<T> curves_ = ControlCurves<T>::packed(values_, 4, 3, Weights::cartesian);
  simdbezier_control_curves c_curves_ = simdbezier_packed_curves_of(
      values_.data(), values_.size(), 4, 3, SIMDBEZIER_CARTESIAN, kCScalar<T>);
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CPolylines, Scalars);

TYPED_TEST(CPolylines, HaveTheSizesOfCpp) {
  const std::vector<double> tolerances = {1e-2, 2e-3, 1e-2, 1e-4, 1e-2, 1e-2, 0.5};
  const std::vector<double> errors = {0, 1e-4, 5e-4, 0, 2e-4, 9.9e-4, 0};
  struct Case {
    const char* name;
    std::function<void(FlattenOptions&)> set;
    std::function<void(simdbezier_flatten_options&)> c_set;
  };
  const Case cases[] = {
      {"tolerance", [](auto&) {}, [](auto&) {}},
      {"tolerances", [&](auto& o) { o.tolerances = tolerances; },
       [&](auto& o) { o.tolerances = tolerances.data(), o.tolerances_length = 7; }},
      {"tolerances alone", [&](auto& o) { o.tolerances = tolerances, o.tolerance = kUnlimited; },
       [&](auto& o) {
         o.tolerances = tolerances.data(), o.tolerances_length = 7, o.tolerance = 0;
       }},
      {"nothing", [](auto& o) { o.tolerance = kUnlimited; }, [](auto& o) { o.tolerance = 0; }},
      {"errors", [&](auto& o) { o.errors = errors; },
       [&](auto& o) { o.errors = errors.data(), o.errors_length = 7; }}};
  std::vector<std::vector<std::uint32_t>> different;
  for (const Case& one : cases) {
    FlattenOptions options;
    options.tolerance = 1e-3;
    one.set(options);
    auto c_options = sized<simdbezier_flatten_options>();
    c_options.tolerance = 1e-3;
    one.c_set(c_options);
    std::vector<std::uint32_t> expected(7);
    std::vector<std::uint32_t> points(7);
    std::vector<double> within(7);
    std::vector<double> deviation(7);
    ASSERT_TRUE(choose_polylines(this->curves_, options, expected, within)) << one.name;
    EXPECT_C_OK(simdbezier_choose_polylines(&this->c_curves_, &c_options, points.data(), 7,
                                            deviation.data(), 7));
    expect_same_bits(points, expected, one.name);
    expect_same_bits(deviation, within, one.name);
    EXPECT_EQ(std::count(different.begin(), different.end(), points), 0)
        << one.name << " changes nothing, so it could be missed";
    different.push_back(points);

    // One point less than the longest line needs.
    const std::uint32_t most = *std::max_element(points.begin(), points.end());
    c_options.most_points = most;
    EXPECT_C_OK(
        simdbezier_choose_polylines(&this->c_curves_, &c_options, points.data(), 7, nullptr, 0));
    c_options.most_points = most - 1;
    EXPECT_EQ(
        simdbezier_choose_polylines(&this->c_curves_, &c_options, points.data(), 7, nullptr, 0),
        SIMDBEZIER_BAD_TOLERANCE);
  }
}

/// flatten() into points of type To, and the same in two steps into the caller's memory.
template <typename To, typename From>
void expect_flattened(const ControlCurves<From>& curves,
                      const simdbezier_control_curves& c_curves) {
  const Polylines<To> expected = flatten<To>(curves, 1e-3);
  ASSERT_TRUE(expected);
  simdbezier_polylines* lines = nullptr;
  EXPECT_C_OK(simdbezier_flatten(&c_curves, kCScalar<To>, 1e-3, nullptr, &lines));
  auto arrays = sized<simdbezier_polyline_arrays>();
  EXPECT_C_OK(simdbezier_polylines_look(lines, &arrays));
  ASSERT_EQ(arrays.curves, curves.count);
  ASSERT_EQ(arrays.vertices, expected.points.size());
  EXPECT_EQ(arrays.scalar, kCScalar<To>);
  EXPECT_EQ(arrays.deviation, expected.deviation);
  EXPECT_TRUE(std::equal(expected.first.begin(), expected.first.end(), arrays.first));
  const std::size_t bytes = expected.points.size() * sizeof(std::array<To, 3>);
  EXPECT_EQ(std::memcmp(arrays.points, expected.points.data(), bytes), 0);

  const CCurveSet set = c_pack<To>(c_curves);
  std::vector<double> errors(curves.count);
  EXPECT_C_OK(simdbezier_curve_position_errors(set.get(), errors.data(), errors.size(), nullptr));
  auto options = sized<simdbezier_flatten_options>();
  options.tolerance = 1e-3;
  options.errors = errors.data();
  options.errors_length = errors.size();
  std::vector<std::uint32_t> points(curves.count);
  EXPECT_C_OK(
      simdbezier_choose_polylines(&c_curves, &options, points.data(), points.size(), nullptr, 0));
  auto grids = sized<simdbezier_curve_grids>();
  grids.n = points.data();
  grids.n_length = points.size();
  ASSERT_EQ(simdbezier_curve_grids_sample_count(set.get(), &grids), arrays.vertices);
  std::vector<To> mine(3 * arrays.vertices);
  auto out = sized<simdbezier_curve_outputs>();
  out.position = c_triples(mine);
  if (curves.components < 3) {
    out.position.z = nullptr;
  }
  EXPECT_C_OK(simdbezier_evaluate_curve_grids(set.get(), &grids, &out, nullptr));
  EXPECT_EQ(std::memcmp(mine.data(), expected.points.data(), bytes), 0);
  simdbezier_polylines_free(lines);
}

TYPED_TEST(CPolylines, HaveThePointsOfCpp) {
  expect_flattened<float>(this->curves_, this->c_curves_);
  expect_flattened<double>(this->curves_, this->c_curves_);
  // Plane curves: z is 0.
  const std::vector<TypeParam> plane = random_values<TypeParam>(5 * 4 * 2, 22);
  expect_flattened<TypeParam>(
      ControlCurves<TypeParam>::packed(plane, 3, 2),
      simdbezier_packed_curves_of(plane.data(), plane.size(), 3, 2, 0, kCScalar<TypeParam>));
}

TYPED_TEST(CPolylines, OfNoCurvesAreNone) {
  simdbezier_control_curves none = this->c_curves_;
  none.count = 0;
  simdbezier_polylines* lines = nullptr;
  EXPECT_C_OK(simdbezier_flatten(&none, SIMDBEZIER_F32, 1e-3, nullptr, &lines));
  auto arrays = sized<simdbezier_polyline_arrays>();
  EXPECT_C_OK(simdbezier_polylines_look(lines, &arrays));
  EXPECT_EQ(arrays.curves, 0U);
  EXPECT_EQ(arrays.vertices, 0U);
  EXPECT_EQ(arrays.points, nullptr);
  EXPECT_EQ(arrays.first[0], 0U);
  simdbezier_polylines_free(lines);
  simdbezier_polylines_free(nullptr);
}

/// The arguments of both calls, valid at first: four cubics.
struct World {
  std::vector<float> values = random_values<float>(4 * 12, 23);
  simdbezier_control_curves curves =
      simdbezier_packed_curves_f32(values.data(), values.size(), 3, 3, SIMDBEZIER_POLYNOMIAL);
  std::vector<double> numbers = std::vector<double>(5, 1e-3);
  std::vector<std::uint32_t> points = std::vector<std::uint32_t>(5);
  std::vector<double> deviation = std::vector<double>(5);
  std::size_t points_length = 4;
  std::size_t deviation_length = 4;
  simdbezier_flatten_options options = sized<simdbezier_flatten_options>();
  simdbezier_options how = sized<simdbezier_options>();
  simdbezier_polylines* made = nullptr;

  World() { options.tolerance = 1e-2; }
  simdbezier_status choose() {
    return simdbezier_choose_polylines(&curves, &options, points.data(), points_length,
                                       deviation.data(), deviation_length);
  }
  simdbezier_status flatten(double tolerance = 1e-2) {
    return simdbezier_flatten(&curves, SIMDBEZIER_F32, tolerance, &how, &made);
  }
};

const Refusal<World> kRefusals[] = {
    {SIMDBEZIER_OK, "", [](World& w) { return w.choose(); }},
    {SIMDBEZIER_NULL_INPUT, "curves",
     [](World& w) {
       return simdbezier_choose_polylines(nullptr, &w.options, w.points.data(), 4, nullptr, 0);
     }},
    {SIMDBEZIER_NULL_INPUT, "options",
     [](World& w) {
       return simdbezier_choose_polylines(&w.curves, nullptr, w.points.data(), 4, nullptr, 0);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "points",
     [](World& w) {
       return simdbezier_choose_polylines(&w.curves, &w.options, nullptr, 4, nullptr, 0);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "deviation",
     [](World& w) {
       return simdbezier_choose_polylines(&w.curves, &w.options, w.points.data(), 4, nullptr, 4);
     }},
    {SIMDBEZIER_NULL_INPUT, "options->tolerances",
     [](World& w) { return w.options.tolerances_length = 4, w.choose(); }},
    {SIMDBEZIER_NULL_INPUT, "options->errors",
     [](World& w) { return w.options.errors_length = 4, w.choose(); }},
    {SIMDBEZIER_NULL_INPUT, "curves->points",
     [](World& w) { return w.curves.points = nullptr, w.choose(); }},
    {SIMDBEZIER_NULL_OUTPUT, "polylines",
     [](World& w) { return simdbezier_flatten(&w.curves, SIMDBEZIER_F32, 1, nullptr, nullptr); }},
    {SIMDBEZIER_NULL_INPUT, "curves",
     [](World& w) { return simdbezier_flatten(nullptr, SIMDBEZIER_F32, 1, nullptr, &w.made); }},
    {SIMDBEZIER_NULL_INPUT, "polylines",
     [](World&) {
       auto arrays = sized<simdbezier_polyline_arrays>();
       return simdbezier_polylines_look(nullptr, &arrays);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "arrays",
     [](World&) { return simdbezier_polylines_look(nullptr, nullptr); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "arrays->struct_size",
     [](World&) {
       simdbezier_polyline_arrays arrays{};
       return simdbezier_polylines_look(nullptr, &arrays);
     }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "options->struct_size",
     [](World& w) { return w.options.struct_size -= 8, w.choose(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "options->struct_size",
     [](World& w) {
       const Later later(w.options);
       return simdbezier_choose_polylines(&w.curves, &later.known, w.points.data(), 4, nullptr, 0);
     }},
    {SIMDBEZIER_OK, "",
     [](World& w) {
       const Later later(w.options, 0);
       return simdbezier_choose_polylines(&w.curves, &later.known, w.points.data(), 4, nullptr, 0);
     }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "curves->struct_size",
     [](World& w) { return w.curves.struct_size = 0, w.flatten(); }},

    {SIMDBEZIER_UNEQUAL_LENGTHS, "points",
     [](World& w) { return w.points_length = 3, w.choose(); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "points",
     [](World& w) { return w.points_length = 5, w.choose(); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "deviation",
     [](World& w) { return w.deviation_length = 3, w.choose(); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "options->tolerances",
     [](World& w) {
       w.options.tolerances = w.numbers.data();
       return w.options.tolerances_length = 5, w.choose();
     }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "options->errors",
     [](World& w) {
       w.options.errors = w.numbers.data();
       return w.options.errors_length = 3, w.choose();
     }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "curves->length",
     [](World& w) { return w.curves.length -= 1, w.choose(); }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "curves->length",
     [](World& w) { return w.curves.point_stride = -3, w.flatten(); }},
    {SIMDBEZIER_SIZE_OVERFLOW, "curves->count",
     [](World& w) { return w.curves.curve_stride = std::ptrdiff_t(1) << 62, w.choose(); }},

    {SIMDBEZIER_BAD_ALIGNMENT, "curves->points",
     [](World& w) { return between(w.curves.points), w.choose(); }},
    {SIMDBEZIER_BAD_SCALAR, "curves->scalar",
     [](World& w) { return w.curves.scalar = 3, w.choose(); }},
    {SIMDBEZIER_BAD_SCALAR, "scalar",
     [](World& w) { return simdbezier_flatten(&w.curves, 0, 1, nullptr, &w.made); }},
    {SIMDBEZIER_BAD_VALUE, "curves->weights",
     [](World& w) { return w.curves.weights = -1, w.flatten(); }},
    {SIMDBEZIER_BAD_VALUE, "options->isa", [](World& w) { return w.how.isa = 99, w.flatten(); }},
    {SIMDBEZIER_BAD_DEGREE, "curves->degree",
     [](World& w) { return w.curves.degree = 16, w.flatten(); }},
    {SIMDBEZIER_BAD_DEGREE, "curves->degree",
     [](World& w) { return w.curves.degree = 0, w.choose(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "curves->components",
     [](World& w) {
       w.curves = simdbezier_packed_curves_f32(w.values.data(), 48, 3, 4, SIMDBEZIER_POLYNOMIAL);
       return w.flatten();
     }},
    {SIMDBEZIER_NON_FINITE_INPUT, "curves->points",
     [](World& w) { return w.values[30] = std::numeric_limits<float>::infinity(), w.choose(); }},
    {SIMDBEZIER_BAD_WEIGHT, "curves->weights",
     [](World& w) {
       w.curves = simdbezier_packed_curves_f32(w.values.data(), 48, 3, 2, SIMDBEZIER_CARTESIAN);
       return w.values[2] = -1, w.choose();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->tolerance",
     [](World& w) { return w.options.tolerance = -1, w.choose(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->tolerances",
     [](World& w) {
       w.options.tolerances = w.numbers.data();
       return w.options.tolerances_length = 4, w.numbers[2] = -1, w.choose();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->errors",
     [](World& w) {
       w.options.errors = w.numbers.data();
       return w.options.errors_length = 4, w.numbers[2] = -1, w.choose();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "tolerance",
     [](World& w) { return w.flatten(std::numeric_limits<double>::quiet_NaN()); }}};

TEST(CPolylinesOfBadInput, AreRefusedByName) {
  for (const Refusal<World>& one : kRefusals) {
    World world;
    expect_refused(one, world);
    EXPECT_EQ(world.made, nullptr) << one.argument;
  }
  // The curve at fault is named, too.
  World world;
  world.values[30] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(world.flatten(), SIMDBEZIER_NON_FINITE_INPUT);
  auto fault = sized<simdbezier_fault>();
  ASSERT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
  EXPECT_EQ(fault.patch, 2U);
  EXPECT_EQ(fault.point, -1);
}

} // namespace
} // namespace simdbezier::tests::polylines_test
