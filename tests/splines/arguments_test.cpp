// What splines are refused for, and what is named as the fault; nothing is written then.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/splines/spline_models.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A sound surface of 5 x 6 points, and memory for what becomes of it.
struct Given {
  std::vector<double> knots_u = {0, 0, 0, 1, 2, 3, 4, 4, 4};
  std::vector<double> knots_v = {0, 0, 0, 0, 1, 2, 2, 2, 2};
  std::vector<double> points = std::vector<double>(5 * 6 * 4, 1);
  std::vector<double> values = std::vector<double>(8 * 12 * 4, -77);
  std::vector<PatchInterval> intervals = std::vector<PatchInterval>(8);
  SplineSurface<double> surface;
  MutableNets<double> out =
      MutableNets<double>::packed(std::span(values), 8, 2, 3, 3, Weights::homogeneous);

  Given() {
    surface.points = points.data();
    surface.memory = points;
    surface.rows = 5;
    surface.columns = 6;
    surface.point_stride = 4;
    surface.row_stride = 24;
    surface.weights = Weights::homogeneous;
    surface.degree_u = 2;
    surface.degree_v = 3;
    surface.knots_u = knots_u;
    surface.knots_v = knots_v;
  }
  Given(const Given&) = delete;
  Given& operator=(const Given&) = delete;
};

struct BadInput {
  const char* name;
  std::function<void(Given&)> spoil;
  Status::Code status;
  std::size_t point = 0;
  int component = 0;
};

const std::vector<BadInput>& bad_inputs() {
  static const std::vector<BadInput> all = {
      {"NoPoints", [](Given& g) { g.surface.points = nullptr; }, Status::null_input},
      {"FewRows", [](Given& g) { g.surface.rows = 3; }, Status::bad_grid, 0, 1},
      {"DegreeZero", [](Given& g) { g.surface.degree_u = g.out.degree_u = 0; }, Status::bad_degree},
      {"DegreeSixteen", [](Given& g) { g.surface.degree_v = g.out.degree_v = 16; },
       Status::bad_degree, 0, 1},
      {"OtherDegree", [](Given& g) { g.out.degree_u = 3; }, Status::bad_degree},
      {"FewKnots", [](Given& g) { g.surface.knots_u = std::span(g.knots_u).first(8); },
       Status::bad_knots, 8},
      {"ManyKnots",
       [](Given& g) {
         g.knots_v.push_back(2);
         g.surface.knots_v = g.knots_v;
       },
       Status::bad_knots, 9, 1},
      {"NullKnots",
       [](Given& g) {
         g.surface.knots_u = std::span<const double>(static_cast<const double*>(nullptr), 9);
       },
       Status::null_input},
      {"DescendingKnots", [](Given& g) { g.knots_u[4] = 0.5; }, Status::bad_knots, 4},
      {"KnotIsNan", [](Given& g) { g.knots_v[4] = kNan; }, Status::bad_knots, 4, 1},
      {"KnotIsInfinite", [](Given& g) { g.knots_u[8] = HUGE_VAL; }, Status::bad_knots, 8},
      {"KnotTooOften", [](Given& g) { g.knots_u[3] = 0; }, Status::bad_knots, 3},
      {"KnotTooOftenByTolerance", [](Given& g) { g.surface.knot_tolerance = 1; }, Status::bad_knots,
       3},
      {"ToleranceIsNan", [](Given& g) { g.surface.knot_tolerance = kNan; }, Status::bad_tolerance},
      {"EmptyDomain", [](Given& g) { g.knots_v = {0, 0, 0, 0, 0, 0, 0, 0, 0}; }, Status::bad_knots,
       4, 1},
      {"RangeOutside",
       [](Given& g) {
         g.surface.u_range = {-1, 2};
       },
       Status::bad_range},
      {"RangeOfOneKnot",
       [](Given& g) {
         g.surface.knot_tolerance = 1e-6;
         g.surface.u_range = {2 - 1e-7, 2 + 1e-7};
       },
       Status::bad_range},
      {"RangeBackwards",
       [](Given& g) {
         g.surface.v_range = {2, 1};
       },
       Status::bad_range, 0, 1},
      {"RangeIsNan",
       [](Given& g) {
         g.surface.u_range = {0, kNan};
       },
       Status::bad_range},
      {"Components",
       [](Given& g) {
         g.surface.components = 17;
         g.out.components = 17;
       },
       Status::bad_components},
      {"OtherComponents", [](Given& g) { g.out.components = 2; }, Status::bad_components},
      {"OtherWeights", [](Given& g) { g.out.weights = Weights::none; }, Status::bad_components},
      {"Stride", [](Given& g) { g.surface.point_stride = 0; }, Status::bad_stride},
      {"HugeStride", [](Given& g) { g.surface.row_stride = PTRDIFF_MAX / 4; },
       Status::size_overflow},
      {"ShortMemory", [](Given& g) { g.surface.memory = std::span(g.points).first(119); },
       Status::input_too_small},
      {"ShortMemoryBeforeKnots", // whose tables could be large
       [](Given& g) {
         g.surface.memory = std::span(g.points).first(119);
         g.knots_u[4] = 0.5;
       },
       Status::input_too_small},
      {"NotFinite", [](Given& g) { g.points[4 * 7 + 1] = kNan; }, Status::non_finite_input, 7, 1},
      {"WeightZero", [](Given& g) { g.points[4 * 9 + 3] = 0; }, Status::bad_weight, 9, 3},
      {"WeightsVanishInMeans", [](Given& g) { g.points[4 * 9 + 3] = 5e-324; }, Status::bad_weight,
       9, 3},
      {"QuotientOverflows",
       [](Given& g) {
         g.out.weights = Weights::cartesian;
         g.points[4 * 8 + 2] = 1e200;
         g.points[4 * 8 + 3] = 1e-200;
       },
       Status::coefficient_overflow, 8, 2},
      {"ProductOverflows",
       [](Given& g) {
         g.surface.weights = g.out.weights = Weights::cartesian;
         g.points[4 * 8 + 2] = 1e200;
         g.points[4 * 8 + 3] = 1e200;
       },
       Status::coefficient_overflow, 8, 2},
      {"NoOutput", [](Given& g) { g.out.points = nullptr; }, Status::null_output},
      {"OtherCount", [](Given& g) { g.out.count = 7; }, Status::bad_patch_range},
      {"ShortOutput", [](Given& g) { g.out.memory = std::span(g.values).first(383); },
       Status::output_too_small},
      {"Overlap",
       [](Given& g) {
         g.out.points = g.points.data() - 380;
         g.out.memory = {};
       },
       Status::overlapping_outputs},
      {"Intervals", [](Given& g) { g.intervals.resize(7); }, Status::unequal_lengths}};
  return all;
}

TEST(SplineArguments, SoundOnesArePassed) {
  Given given;
  EXPECT_TRUE(to_bezier(given.surface, given.out, given.intervals));
  EXPECT_EQ(span_count(given.surface).u, 4U);
  EXPECT_EQ(span_count(given.surface).v, 2U);
}

TEST(SplineArguments, BadOnesAreRefused) {
  for (const BadInput& bad : bad_inputs()) {
    SCOPED_TRACE(bad.name);
    Given given;
    bad.spoil(given);
    const Report report = to_bezier(given.surface, given.out, given.intervals);
    EXPECT_EQ(to_string(report.status), to_string(bad.status));
    EXPECT_EQ(report.point, bad.point);
    EXPECT_EQ(report.component, bad.component);
    EXPECT_EQ(std::count(given.values.begin(), given.values.end(), -77.0),
              static_cast<std::ptrdiff_t>(given.values.size()));
  }
}

TEST(SplineArguments, TheSurfaceAtFaultIsNamed) {
  Given good;
  Given bad;
  bad.points[0] = kNan;
  const SplineSurface<double> surfaces[] = {good.surface, good.surface, bad.surface};
  PatchSet<double> set;
  const Report report = pack(std::span<const SplineSurface<double>>(surfaces), set);
  EXPECT_EQ(report.status, Status::non_finite_input);
  EXPECT_EQ(report.item, 2U);
  EXPECT_TRUE(set.empty());
}

// Knots of neighbours are compared, to build what follows from them once.
TEST(SplineArguments, NullKnotsAreFoundInEverySurface) {
  Given good;
  SplineSurface<double> bad = good.surface;
  bad.knots_u = std::span<const double>(static_cast<const double*>(nullptr), 9);
  const SplineSurface<double> surfaces[] = {good.surface, bad};
  PatchSet<double> set;
  const Report report = pack(std::span<const SplineSurface<double>>(surfaces), set);
  EXPECT_EQ(report.status, Status::null_input);
  EXPECT_EQ(report.item, 1U);
}

TEST(SplineArguments, OptionsAtFaultNameNoPoint) {
  Given given;
  PatchSet<double> set;
  PackOptions options;
  options.relative_to[1] = kNan;
  const Report report = pack(given.surface, set, {}, options);
  EXPECT_EQ(report.status, Status::non_finite_input);
  EXPECT_EQ(report.point, -1);
  EXPECT_EQ(report.component, 1);
}

// 70 000 spans in each direction are 4.9 * 10^9 patches.
TEST(SplineArguments, NumbersOfPatchesDoNotWrap) {
  SplineSurface<float> surface;
  surface.rows = surface.columns = 70001;
  surface.degree_u = surface.degree_v = 1;
  const double at = 69999.5;
  std::uint32_t patch = 7;
  double u = 7;
  EXPECT_EQ(locate(surface, 1, &at, &at, {&patch}).status, Status::size_overflow);
  EXPECT_EQ(patch, 7U);
  EXPECT_TRUE(locate(surface, 1, &at, &at, {nullptr, &u}));
  EXPECT_EQ(u, 0.5);
}

TEST(SplineArguments, PlacesAreInsideOfTheDomain) {
  Given given;
  std::uint32_t patch[3] = {7, 7, 7};
  double u[3];
  double v[3];
  const SplinePlaces places{patch, u, v};
  const double inside[] = {0, 1, 4};
  const double v_inside[] = {0, 1, 2};
  ASSERT_TRUE(locate(given.surface, 3, inside, v_inside, places));
  EXPECT_EQ(patch[0], 0U);
  EXPECT_EQ(patch[1], 5U); // right of both knots
  EXPECT_EQ(u[1], 0);
  EXPECT_EQ(v[1], 0);
  EXPECT_EQ(patch[2], 7U); // the end of the domain belongs to the last patch
  EXPECT_EQ(u[2], 1);
  EXPECT_EQ(v[2], 1);
  struct Outside {
    double parameter;
    Status::Code status;
  };
  for (const Outside& outside : {Outside{4.5, Status::bad_range}, Outside{-0.1, Status::bad_range},
                                 Outside{kNan, Status::non_finite_input}}) {
    const double at[] = {0, 1, outside.parameter};
    std::uint32_t untouched[3] = {9, 9, 9};
    const Report report = locate(given.surface, 3, at, v_inside, {untouched});
    EXPECT_EQ(report.status, outside.status);
    EXPECT_EQ(report.point, 2U);
    EXPECT_EQ(untouched[0], 9U);
  }
  EXPECT_EQ(locate(given.surface, 3, nullptr, v_inside, places).status, Status::null_input);
  EXPECT_EQ(locate(given.surface, 3, inside, nullptr, places).status, Status::null_input);
}

TEST(SplineArguments, PeriodicParametersAreMovedByPeriods) {
  SplineCurve<double> curve;
  std::vector<double> points(5 * 3, 1);
  curve.points = points.data();
  curve.count = 5;
  curve.periodic = true;
  std::uint32_t patch[4];
  double u[4];
  const double at[] = {-0.5, 5.25, 4.75, 5};
  ASSERT_TRUE(locate(curve, 4, at, {patch, u}));
  EXPECT_EQ(patch[0], 4U);
  EXPECT_EQ(u[0], 0.5);
  EXPECT_EQ(patch[1], 0U);
  EXPECT_EQ(u[1], 0.25);
  EXPECT_EQ(patch[2], 4U);
  EXPECT_EQ(patch[3], 4U);
  EXPECT_EQ(u[3], 1);
}

// Whole periods are taken away exactly, whatever their number.
TEST(SplineArguments, FarParametersAreMovedExactly) {
  SplineCurve<double> curve;
  std::vector<double> points(3 * 3, 1);
  curve.points = points.data();
  curve.count = 3;
  curve.periodic = true;
  std::uint32_t patch[3];
  double u[3];
  const double at[] = {1e16, -1e16, 0x1p60}; // 1, 2 and 1 modulo 3
  ASSERT_TRUE(locate(curve, 3, at, {patch, u}));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(patch[k] + u[k], k == 1 ? 2 : 1) << at[k];
  }
}

// A mirrored spline has its mirrored parameters in mirrored places, on the seam as well.
TEST(SplineArguments, MirroredParametersStayMirrored) {
  Random random(17);
  for (int round = 0; round < 2000; ++round) {
    std::vector<double> knots(5);
    std::ranges::generate(knots, [&] { return 3 * random.symmetric(); });
    std::ranges::sort(knots);
    std::vector<double> mirrored(knots.rbegin(), knots.rend());
    std::ranges::transform(mirrored, mirrored.begin(), std::negate<>());
    const double period = knots.back() - knots.front();
    const int periods = static_cast<int>(6 * random.symmetric());
    double at = knots[static_cast<std::size_t>(round % 5)] + periods * period;
    at = round % 2 == 0 ? at : std::nextafter(at, 100 * random.symmetric());
    const double opposite = -at;
    std::uint32_t patch[2];
    double x[2];
    for (int side = 0; side < 2; ++side) {
      SplineCurve<double> curve;
      curve.count = 4;
      curve.degree = 2;
      curve.periodic = true;
      curve.knots = side == 0 ? knots : mirrored;
      SplinePlaces places{&patch[side]};
      places.centred_u = &x[side];
      ASSERT_TRUE(locate(curve, 1, side == 0 ? &at : &opposite, places));
    }
    // An inner knot belongs to the patch on its right side.
    const bool inner = std::fabs(x[0]) == 1 && patch[0] + patch[1] != 3;
    EXPECT_EQ(patch[0] + patch[1], inner ? 4U : 3U) << round;
    EXPECT_EQ(x[0], inner ? x[1] : -x[1]) << round;
  }
}

// Knots may go on behind the domain.
TEST(SplineArguments, TheDomainEndsWhereItIsGivenTo) {
  const std::vector<double> knots = {0, 1, 2, 3, 4 - 1e-7, 4, 5, 6};
  SplineCurve<double> curve;
  curve.count = 5;
  curve.degree = 2;
  curve.knots = knots;
  curve.knot_tolerance = 1e-6;
  const double end = 4;
  std::uint32_t patch;
  double u;
  ASSERT_TRUE(locate(curve, 1, &end, {&patch, &u}));
  EXPECT_EQ(patch, 1U);
  EXPECT_EQ(u, 1);
  Given given;
  given.knots_u = {0, 1, 2, 3, 3.5, 4, 5 - 1e-7, 5, 6};
  given.surface.knots_u = given.knots_u;
  given.surface.knot_tolerance = 1e-6;
  std::vector<double> merged_u(9);
  std::vector<double> merged_v(given.surface.rows + 4);
  EXPECT_TRUE(merged_knots(given.surface, merged_u, merged_v));
  EXPECT_EQ(merged_u, (std::vector<double>{0, 1, 2, 3, 3.5, 4, 5, 5, 6}));
}

TEST(SplineArguments, KnotsWithinTheToleranceAreOne) {
  Given given;
  given.knots_u = {0, 0, 1e-12, 1, 2, 2 + 1e-12, 4 - 1e-12, 4, 4};
  given.surface.knots_u = given.knots_u;
  EXPECT_EQ(span_count(given.surface).u, 4U);
  given.surface.knot_tolerance = 1e-9;
  EXPECT_EQ(span_count(given.surface).u, 3U);
  std::vector<double> merged_u(9);
  std::vector<double> merged_v(given.surface.rows + 4);
  EXPECT_TRUE(merged_knots(given.surface, merged_u, merged_v));
  EXPECT_EQ(merged_u, (std::vector<double>{0, 0, 0, 1, 2, 2, 4, 4, 4}));
  const Report small = merged_knots(given.surface, merged_u, std::span(merged_v).first(6));
  EXPECT_EQ(small.status, Status::output_too_small);
  EXPECT_EQ(small.component, 1);
  ASSERT_TRUE(to_bezier(given.surface,
                        MutableNets<double>::packed(std::span(given.values).first(6 * 48), 6, 2, 3,
                                                    3, Weights::homogeneous),
                        std::span(given.intervals).first(6)));
  EXPECT_EQ(given.intervals[0].u.begin, 0); // the ends are those of the knots
  EXPECT_EQ(given.intervals[2].u.end, 4);
  // Ends of ranges near a knot are that knot: a whole domain stays whole, and nothing is cut off.
  const std::vector<double> whole = given.values;
  for (const Interval range : {Interval{1e-12, 4 - 1e-12}, {1e-10, 4 + 1e-10}}) {
    given.surface.u_range = range;
    EXPECT_EQ(span_count(given.surface).u, 3U);
    ASSERT_TRUE(to_bezier(given.surface,
                          MutableNets<double>::packed(std::span(given.values).first(6 * 48), 6, 2,
                                                      3, 3, Weights::homogeneous),
                          std::span(given.intervals).first(6)));
    EXPECT_TRUE(given.values == whole);
    EXPECT_EQ(given.intervals[0].u.begin, 0);
    EXPECT_EQ(given.intervals[2].u.end, 4);
  }
  given.surface.u_range = {1 - 1e-10, 2 + 1e-10};
  EXPECT_EQ(span_count(given.surface).u, 1U);
}

} // namespace
} // namespace simdbezier::tests
