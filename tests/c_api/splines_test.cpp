// Splines through simdbezier.h: the bits of the C++ calls, and what a caller may get wrong.
#include <cmath>
#include <limits>

#include "tests/c_api/support/c_refusal.hpp"
#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests::splines_test {
namespace {

const std::vector<double> kKnotsU = {0, 0, 0, 0, 1, 1, 2.5, 4, 4, 4, 4};
const std::vector<double> kKnotsV = {-1, -1, -0.5, 0, 1, 2, 3};

/// A surface of degrees 3 x 2 with 7 x 4 control points, in C and in C++: knots, one of them
/// double, on v clamped nowhere, a part of the domain, weights.
template <typename T>
class CSplines : public ::testing::Test {
protected:
  static constexpr std::size_t kSamples = 3;

  CSplines() {
    surface_.knots_u = kKnotsU.data();
    surface_.knots_u_length = kKnotsU.size();
    surface_.knots_v = kKnotsV.data();
    surface_.knots_v_length = kKnotsV.size();
    surface_.u_begin = same_.u_range.begin = 0.5;
    surface_.u_end = same_.u_range.end = 3.5;
    same_.components = 3;
    same_.weights = Weights::cartesian;
    same_.degree_v = 2;
    same_.knots_u = kKnotsU;
    same_.knots_v = kKnotsV;
    curve_.knots = kKnotsU.data();
    curve_.knots_length = kKnotsU.size();
    same_curve_.weights = Weights::cartesian;
    same_curve_.knots = kKnotsU;
  }

  std::vector<T> values_ = random_values<T>(4 * 7 * 4, 31);
  simdbezier_spline_surface surface_ = simdbezier_packed_spline_surface_of(
      values_.data(), values_.size(), 4, 7, 3, 2, 3, SIMDBEZIER_CARTESIAN, kCScalar<T>);
  SplineSurface<T> same_{values_.data(), 4, 7, 28, 4};
  simdbezier_spline_curve curve_ = simdbezier_packed_spline_curve_of(
      values_.data(), values_.size(), 7, 3, 3, SIMDBEZIER_CARTESIAN, kCScalar<T>);
  SplineCurve<T> same_curve_{values_.data(), 7, 4};
  const double u_[kSamples] = {0.5, 1.0, 3.25};
  const double v_[kSamples] = {0.25, -0.5, 1.0};
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CSplines, Scalars);

void expect_same(std::span<const simdbezier_patch_interval> found,
                 std::span<const PatchInterval> expected) {
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(found[k].u_begin, expected[k].u.begin);
    EXPECT_EQ(found[k].u_end, expected[k].u.end);
    EXPECT_EQ(found[k].v_begin, expected[k].v.begin);
    EXPECT_EQ(found[k].v_end, expected[k].v.end);
  }
}

TYPED_TEST(CSplines, BecomeNets) {
  using T = TypeParam;
  std::size_t spans_u = 0;
  std::size_t spans_v = 0;
  EXPECT_C_OK(simdbezier_spline_span_count(&this->surface_, &spans_u, &spans_v));
  EXPECT_EQ(spans_u, 3U);
  EXPECT_EQ(spans_v, 2U);
  // Twice, so that it is an array.
  const simdbezier_spline_surface surfaces[] = {this->surface_, this->surface_};
  const SplineSurface<T> same[] = {this->same_, this->same_};
  std::vector<T> found(12 * 12 * 4);
  std::vector<T> expected(found.size());
  const auto out = c_room(found, 3, 2, SIMDBEZIER_HOMOGENEOUS);
  std::vector<simdbezier_patch_interval> intervals(12);
  std::vector<PatchInterval> expected_intervals(12);
  EXPECT_C_OK(simdbezier_spline_to_bezier(surfaces, 2, &out, intervals.data(), 12, nullptr));
  ASSERT_TRUE(to_bezier(std::span<const SplineSurface<T>>(same),
                        MutableNets<T>::packed(expected.data(), 12, 3, 2, 3, Weights::homogeneous),
                        expected_intervals));
  expect_same_bits(found, expected, "nets");
  expect_same(intervals, expected_intervals);
  EXPECT_EQ(intervals[0].u_begin, 0.5);
  // No splines have the numbers of what they become.
  std::vector<T> nothing(1);
  auto none = c_room(nothing, 3, 2, SIMDBEZIER_HOMOGENEOUS);
  none.count = 0;
  EXPECT_C_OK(simdbezier_spline_to_bezier(nullptr, 0, &none, nullptr, 0, nullptr));
}

TYPED_TEST(CSplines, AreLocatedAndEvaluated) {
  using T = TypeParam;
  simdbezier_patch_set* set = nullptr;
  std::vector<simdbezier_patch_interval> intervals(6);
  std::vector<PatchInterval> expected_intervals(6);
  EXPECT_C_OK(
      simdbezier_spline_pack(&this->surface_, 1, kCScalar<T>, intervals.data(), 6, nullptr, &set));
  const CPatchSet owner(set);
  PatchSet<T> same_set;
  ASSERT_TRUE(pack(this->same_, same_set, expected_intervals));
  expect_same(intervals, expected_intervals);

  constexpr std::size_t kCount = TestFixture::kSamples;
  std::uint32_t patch[2][kCount];
  std::vector<double> places[2] = {std::vector<double>(6 * kCount),
                                   std::vector<double>(6 * kCount)};
  auto c_places = sized<simdbezier_spline_places>();
  c_places.length = kCount;
  c_places.patch = patch[0];
  double* const at = places[0].data();
  c_places.u = at;
  c_places.v = at + kCount;
  c_places.length_u = at + 2 * kCount;
  c_places.length_v = at + 3 * kCount;
  c_places.centred_u = at + 4 * kCount;
  c_places.centred_v = at + 5 * kCount;
  EXPECT_C_OK(
      simdbezier_spline_locate(&this->surface_, this->u_, kCount, this->v_, kCount, &c_places));
  double* const to = places[1].data();
  ASSERT_TRUE(locate(this->same_, kCount, this->u_, this->v_,
                     {patch[1], to, to + kCount, to + 2 * kCount, to + 3 * kCount, to + 4 * kCount,
                      to + 5 * kCount}));
  EXPECT_TRUE(std::equal(patch[0], patch[0] + kCount, patch[1]));
  expect_same_bits(places[0], places[1], "places");

  for (const bool grid : {true, false}) {
    const std::size_t samples = grid ? kCount * kCount : kCount;
    std::vector<T> found(3 * samples);
    std::vector<T> slopes(3 * samples);
    std::vector<T> expected(3 * samples);
    std::vector<T> expected_slopes(3 * samples);
    auto out = sized<simdbezier_outputs>();
    out.position = c_triples(found);
    out.duv = c_triples(slopes);
    Outputs<T> same_out;
    same_out.position = Vectors<T>::xyz(expected);
    same_out.duv = Vectors<T>::xyz(expected_slopes);
    const auto call = grid ? &simdbezier_spline_evaluate_grid : &simdbezier_spline_evaluate_samples;
    EXPECT_C_OK(call(set, &this->surface_, this->u_, kCount, this->v_, kCount, &out, nullptr, 0));
    const std::span<const double> u(this->u_);
    const std::span<const double> v(this->v_);
    ASSERT_TRUE(grid ? evaluate_grid(same_set, this->same_, u, v, same_out)
                     : evaluate_samples(same_set, this->same_, u, v, same_out));
    expect_same_bits(found, expected, "positions");
    expect_same_bits(slopes, expected_slopes, "derivatives");
  }
}

TYPED_TEST(CSplines, MayBeCurves) {
  using T = TypeParam;
  std::size_t spans = 0;
  EXPECT_C_OK(simdbezier_spline_curve_span_count(&this->curve_, &spans));
  ASSERT_EQ(spans, 3U);
  std::vector<T> found(3 * 4 * 4);
  std::vector<T> expected(found.size());
  simdbezier_interval intervals[3] = {};
  Interval expected_intervals[3];
  EXPECT_C_OK(
      simdbezier_spline_curve_to_bezier(&this->curve_, c_values(found), intervals, 3, nullptr));
  ASSERT_TRUE(to_bezier(this->same_curve_, Values<T>(expected), expected_intervals));
  expect_same_bits(found, expected, "pieces");
  EXPECT_EQ(intervals[2].begin, 2.5);
  EXPECT_EQ(intervals[2].end, 4.0);
  const double t[] = {4.0, 1.0};
  std::uint32_t piece[2] = {};
  double local[4] = {};
  auto places = sized<simdbezier_spline_places>();
  places.length = 2;
  places.patch = piece;
  places.u = local;
  places.length_u = local + 2;
  EXPECT_C_OK(simdbezier_spline_curve_locate(&this->curve_, t, 2, &places));
  EXPECT_EQ(piece[0], 2U);
  EXPECT_EQ(local[0], 1.0);
  EXPECT_EQ(local[2], 1.5);
  EXPECT_EQ(piece[1], 1U); // the right side of a knot
  EXPECT_EQ(local[1], 0.0);
}

TYPED_TEST(CSplines, BecomeMeshes) {
  using T = TypeParam;
  auto options = sized<simdbezier_mesh_options>();
  options.tolerance = 1e-3;
  simdbezier_mesh* mesh = nullptr;
  simdbezier_mesh_plan* plan = nullptr;
  EXPECT_C_OK(simdbezier_spline_tessellate(&this->surface_, 1, kCScalar<T>, &options, &mesh));
  EXPECT_C_OK(simdbezier_spline_plan_mesh(&this->surface_, 1, kCScalar<T>, &options, &plan));
  auto arrays = sized<simdbezier_mesh_arrays>();
  auto parts = sized<simdbezier_mesh_plan_parts>();
  EXPECT_C_OK(simdbezier_mesh_look(mesh, &arrays));
  EXPECT_C_OK(simdbezier_mesh_plan_look(plan, &parts));
  const Mesh<T> same = tessellate<T>(this->same_, {.rates = {.tolerance = 1e-3}});
  ASSERT_TRUE(same);
  ASSERT_EQ(arrays.vertices, same.positions.size());
  EXPECT_EQ(std::memcmp(arrays.positions, same.positions.data(), 3 * arrays.vertices * sizeof(T)),
            0);
  EXPECT_EQ(arrays.patches_given, 6U);
  EXPECT_EQ(arrays.deviation, same.deviation);
  EXPECT_EQ(parts.deviation, same.deviation);
  simdbezier_mesh_free(mesh);
  simdbezier_mesh_plan_free(plan);
}

/// The arguments of all calls, valid at first.
struct World {
  World() {
    for (simdbezier_spline_surface& one : surfaces) {
      one = simdbezier_packed_spline_surface_f64(values.data(), values.size(), 4, 7, 3, 2, 3, 0);
      one.knots_u = knots_u.data();
      one.knots_u_length = knots_u.size();
    }
    curve.knots = knots_u.data();
    curve.knots_length = knots_u.size();
    out.position = c_triples(positions);
    places.length = 2;
    places.patch = patch;
    options.tolerance = 0.5;
    EXPECT_C_OK(simdbezier_spline_pack(surfaces, 3, SIMDBEZIER_F64, nullptr, 0, nullptr, &set));
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    simdbezier_patch_set_free(set);
    simdbezier_patch_set_free(made);
    simdbezier_mesh_free(mesh);
  }

  std::vector<double> values = random_values<double>(4 * 7 * 3, 41);
  std::vector<double> knots_u = kKnotsU;
  simdbezier_spline_surface surfaces[3];
  simdbezier_spline_curve curve =
      simdbezier_packed_spline_curve_f64(values.data(), values.size(), 7, 3, 3, 0);
  std::vector<double> room = std::vector<double>(18 * 36, -7.0);
  std::vector<double> positions = std::vector<double>(12, -7.0);
  simdbezier_mutable_nets nets = c_room(room, 3, 2);
  simdbezier_patch_interval intervals[18] = {};
  std::size_t intervals_length = 18;
  double u[2] = {0, 4};
  double v[2] = {0.5, 2};
  std::uint32_t patch[2] = {7, 7};
  simdbezier_spline_places places = sized<simdbezier_spline_places>();
  simdbezier_outputs out = sized<simdbezier_outputs>();
  simdbezier_pack_options pack_options = sized<simdbezier_pack_options>();
  simdbezier_mesh_options options = sized<simdbezier_mesh_options>();
  simdbezier_patch_set* set = nullptr;
  simdbezier_patch_set* made = nullptr;
  simdbezier_mesh* mesh = nullptr;

  simdbezier_status cut() {
    return simdbezier_spline_to_bezier(surfaces, 3, &nets, intervals, intervals_length, nullptr);
  }
  simdbezier_status pack() {
    return simdbezier_spline_pack(surfaces, 3, SIMDBEZIER_F64, intervals, intervals_length,
                                  &pack_options, &made);
  }
  simdbezier_status count() {
    std::size_t counts[2];
    return simdbezier_spline_span_count(surfaces, &counts[0], &counts[1]);
  }
  simdbezier_status locate() { return simdbezier_spline_locate(surfaces, u, 2, v, 2, &places); }
  simdbezier_status evaluate(std::size_t first_patch = 0) {
    return simdbezier_spline_evaluate_grid(set, surfaces, u, 2, v, 2, &out, nullptr, first_patch);
  }
  simdbezier_status cut_curve() {
    return simdbezier_spline_curve_to_bezier(&curve, c_values(room), nullptr, 0, nullptr);
  }
  simdbezier_status tessellate() {
    return simdbezier_spline_tessellate(surfaces, 3, SIMDBEZIER_F32, &options, &mesh);
  }
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Refusal<World> kRefusals[] = {
    // Structs of zeros.
    {SIMDBEZIER_BAD_DEGREE, "surface->degree_v",
     [](World& w) { return w.surfaces[0] = sized<simdbezier_spline_surface>(), w.count(); }},
    {SIMDBEZIER_BAD_SCALAR, "surfaces[0].scalar",
     [](World& w) {
       w.surfaces[0] = w.surfaces[1] = w.surfaces[2] = sized<simdbezier_spline_surface>();
       return w.cut();
     }},
    {SIMDBEZIER_BAD_SCALAR, "curve->scalar",
     [](World& w) { return w.curve = sized<simdbezier_spline_curve>(), w.cut_curve(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "surfaces[0].components",
     [](World& w) { return w.surfaces[0].components = 0, w.cut(); }},
    {SIMDBEZIER_BAD_DEGREE, "surfaces[0].degree_v",
     [](World& w) { return w.surfaces[0].degree_v = 0, w.cut(); }},
    {SIMDBEZIER_BAD_DEGREE, "surfaces[1].degree_u",
     [](World& w) { return w.surfaces[1].degree_u = 16, w.pack(); }},
    {SIMDBEZIER_BAD_STRIDE, "surfaces[0]",
     [](World& w) { return w.surfaces[0].component_stride = 0, w.cut(); }},
    {SIMDBEZIER_BAD_DEGREE, "curve->degree",
     [](World& w) { return w.curve.degree = 0, w.cut_curve(); }},

    // Knots and ranges.
    {SIMDBEZIER_BAD_KNOTS, "surfaces[2].knots_u",
     [](World& w) { return w.surfaces[2].knots_u_length = 9, w.pack(); }},
    {SIMDBEZIER_BAD_KNOTS, "surfaces[1].knots_v",
     [](World& w) {
       w.surfaces[1].knots_v = w.knots_u.data(), w.surfaces[1].knots_v_length = 7;
       return w.knots_u[1] = 5, w.surfaces[0].knots_u_length = 0, w.surfaces[1].knots_u_length = 0,
              w.cut();
     }},
    {SIMDBEZIER_BAD_KNOTS, "surface->knots_u",
     [](World& w) { return w.knots_u[6] = kNan, w.evaluate(); }},
    {SIMDBEZIER_BAD_KNOTS, "surfaces[0].knots_u",
     [](World& w) { return w.knots_u[4] = 0, w.tessellate(); }},
    {SIMDBEZIER_NULL_INPUT, "surface->knots_u",
     [](World& w) { return w.surfaces[0].knots_u = nullptr, w.count(); }},
    {SIMDBEZIER_BAD_KNOTS, "curve->knots",
     [](World& w) { return w.curve.knots_length = 3, w.cut_curve(); }},
    {SIMDBEZIER_BAD_ALIGNMENT, "surface->knots_u",
     [](World& w) {
       w.surfaces[0].knots_u = reinterpret_cast<const double*>(
           reinterpret_cast<const char*>(w.surfaces[0].knots_u) + 4);
       return w.count();
     }},
    {SIMDBEZIER_BAD_RANGE, "surfaces[2].v_begin or v_end",
     [](World& w) { return w.surfaces[2].v_end = 9, w.cut(); }},
    {SIMDBEZIER_BAD_RANGE, "surface->u_begin or u_end",
     [](World& w) { return w.surfaces[0].u_begin = 3, w.surfaces[0].u_end = 1, w.locate(); }},
    {SIMDBEZIER_BAD_RANGE, "curve->begin or end",
     [](World& w) { return w.curve.end = kNan, w.cut_curve(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "surface->knot_tolerance",
     [](World& w) { return w.surfaces[0].knot_tolerance = -1, w.count(); }},
    {SIMDBEZIER_BAD_GRID, "surface->rows",
     [](World& w) { return w.surfaces[0].rows = 2, w.count(); }},
    {SIMDBEZIER_BAD_GRID, "surface->columns",
     [](World& w) { return w.surfaces[0].columns = 0, w.count(); }},

    // Points.
    {SIMDBEZIER_NULL_INPUT, "surfaces[1].points",
     [](World& w) { return w.surfaces[1].points = nullptr, w.cut(); }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "surfaces[1].length",
     [](World& w) { return w.surfaces[1].length -= 1, w.cut(); }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "surfaces[0].first",
     [](World& w) { return w.surfaces[0].first = -1, w.pack(); }},
    {SIMDBEZIER_NON_FINITE_INPUT, "surfaces[0].points",
     [](World& w) { return w.values[22] = kNan, w.cut(); }},
    {SIMDBEZIER_BAD_WEIGHT, "surfaces[1].weights",
     [](World& w) {
       w.surfaces[1].weights = SIMDBEZIER_CARTESIAN;
       w.surfaces[1].components = 2;
       for (std::size_t k = 0; k < 3; ++k) {
         w.surfaces[k].components = 2;
       }
       return w.values[5] = 0, w.pack();
     }},
    {SIMDBEZIER_BAD_VALUE, "surfaces[0].weights",
     [](World& w) { return w.surfaces[0].weights = 3, w.cut(); }},
    {SIMDBEZIER_BAD_SCALAR, "surfaces[2].scalar",
     [](World& w) { return w.surfaces[2].scalar = SIMDBEZIER_F32, w.cut(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "surfaces[2].struct_size",
     [](World& w) { return w.surfaces[2].struct_size = 8, w.cut(); }},
    {SIMDBEZIER_NULL_INPUT, "surfaces",
     [](World& w) {
       return simdbezier_spline_to_bezier(nullptr, 1, &w.nets, nullptr, 0, nullptr);
     }},
    {SIMDBEZIER_BAD_COMPONENTS, "surfaces[1].components or weights",
     [](World& w) { return w.surfaces[1].components = 2, w.pack(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "surfaces[0].components",
     [](World& w) { return w.surfaces[0].components = 2, w.tessellate(); }},
    {SIMDBEZIER_BAD_DEGREE, "surfaces[1].degree_u or degree_v",
     [](World& w) { return w.surfaces[1].degree_v = 3, w.cut(); }},

    // Results.
    {SIMDBEZIER_NULL_OUTPUT, "out",
     [](World& w) {
       return simdbezier_spline_to_bezier(w.surfaces, 3, nullptr, nullptr, 0, nullptr);
     }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "out->count", [](World& w) { return w.nets.count = 17, w.cut(); }},
    {SIMDBEZIER_BAD_DEGREE, "out->degree_u or degree_v",
     [](World& w) { return w.nets.degree_u = 2, w.cut(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "out->components or weights",
     [](World& w) { return w.nets.weights = SIMDBEZIER_HOMOGENEOUS, w.cut(); }},
    {SIMDBEZIER_BAD_STRIDE, "out", [](World& w) { return w.nets.row_stride = 3, w.cut(); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->length",
     [](World& w) { return w.nets.length -= 1, w.cut(); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "intervals_length",
     [](World& w) { return w.intervals_length = 17, w.cut(); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "intervals_length",
     [](World& w) { return w.intervals_length = 17, w.pack(); }},
    {SIMDBEZIER_NULL_OUTPUT, "set",
     [](World& w) {
       return simdbezier_spline_pack(w.surfaces, 1, SIMDBEZIER_F32, nullptr, 0, nullptr, nullptr);
     }},
    {SIMDBEZIER_NON_FINITE_INPUT, "options->relative_to",
     [](World& w) { return w.pack_options.relative_to[1] = kNan, w.pack(); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "points",
     [](World& w) { return w.room.resize(35), w.cut_curve(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->tolerance",
     [](World& w) { return w.options.tolerance = 1e-17, w.tessellate(); }},

    // Parameters.
    {SIMDBEZIER_BAD_RANGE, "u", [](World& w) { return w.u[1] = 4.5, w.locate(); }},
    {SIMDBEZIER_BAD_RANGE, "v", [](World& w) { return w.v[1] = -0.5, w.evaluate(); }},
    {SIMDBEZIER_NON_FINITE_INPUT, "v", [](World& w) { return w.v[1] = kNan, w.locate(); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "v_length",
     [](World& w) { return simdbezier_spline_locate(w.surfaces, w.u, 2, w.v, 1, &w.places); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "v_length",
     [](World& w) {
       return simdbezier_spline_evaluate_samples(w.set, w.surfaces, w.u, 2, w.v, 1, &w.out, nullptr,
                                                 0);
     }},
    {SIMDBEZIER_NULL_INPUT, "u",
     [](World& w) { return simdbezier_spline_locate(w.surfaces, nullptr, 2, w.v, 2, &w.places); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "places->length",
     [](World& w) { return w.places.length = 1, w.locate(); }},
    {SIMDBEZIER_BAD_RANGE, "t",
     [](World& w) {
       w.u[0] = 5;
       return simdbezier_spline_curve_locate(&w.curve, w.u, 2, &w.places);
     }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "first_patch", [](World& w) { return w.evaluate(15); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->position",
     [](World& w) { return w.out.position.capacity = 3, w.evaluate(); }},
    {SIMDBEZIER_NULL_INPUT, "set",
     [](World& w) {
       return simdbezier_spline_evaluate_grid(nullptr, w.surfaces, w.u, 2, w.v, 2, &w.out, nullptr,
                                              0);
     }},
};

TEST(CSplineBadInput, IsRefusedByName) {
  for (const Refusal<World>& one : kRefusals) {
    World world;
    expect_refused(one, world);
    EXPECT_EQ(world.made, nullptr) << one.argument;
    EXPECT_EQ(world.mesh, nullptr) << one.argument;
    EXPECT_EQ(world.patch[0], 7U) << one.argument;
    EXPECT_EQ(world.intervals[0].u_end, 0) << one.argument;
    for (const auto* const memory : {&world.room, &world.positions}) {
      EXPECT_EQ(std::ranges::count(*memory, -7.0), std::ssize(*memory)) << one.argument;
    }
  }
}

/// What simdbezier_last_fault() and the message say besides.
TEST(CSplineBadInput, HasNumbers) {
  const struct {
    std::function<simdbezier_status(World&)> call;
    std::size_t spline;
    int point;
    int component;
    std::string_view end;
  } cases[] = {
      {[](World& w) { return w.knots_u[5] = 0.5, w.surfaces[0].knots_u_length = 0, w.pack(); }, 1,
       5, 0, "(knot 5)"},
      {[](World& w) { return w.values[22] = kNan, w.cut(); }, 0, 7, 1,
       "(spline 0, point 7, component 1)"},
      {[](World& w) {
         for (auto& surface : w.surfaces) {
           surface.weights = SIMDBEZIER_CARTESIAN;
           surface.components = 2;
         }
         return w.values[22] = w.values[23] = 1e200, w.pack();
       },
       0, 7, 1, "(spline 0, point 7, component 1)"},
      {[](World& w) { return w.v[1] = 2.5, w.locate(); }, 0, 1, 1, "(parameter 1)"},
      {[](World& w) { return w.surfaces[2].u_end = 9, w.cut(); }, 2, -1, 0, "its domain"},
  };
  for (const auto& one : cases) {
    World world;
    EXPECT_NE(one.call(world), SIMDBEZIER_OK);
    auto fault = sized<simdbezier_fault>();
    EXPECT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
    EXPECT_EQ(fault.patch, one.spline) << one.end;
    EXPECT_EQ(fault.point, one.point) << one.end;
    EXPECT_EQ(fault.component, one.component) << one.end;
    EXPECT_TRUE(std::string_view(simdbezier_last_message()).ends_with(one.end))
        << simdbezier_last_message();
  }
}

} // namespace
} // namespace simdbezier::tests::splines_test
