// Sets of splines' patches, and evaluation in the splines' own parameters.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/splines/spline_models.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/oracle/exact_rational.hpp"

namespace simdbezier::tests {
namespace {

/// All vector outputs of a call, and statuses.
template <typename T>
struct AllOutputs {
  std::array<std::vector<T>, 7> values;
  std::vector<T> gaussian;
  std::vector<SampleStatus> statuses;
  Outputs<T> out;

  explicit AllOutputs(std::size_t samples, bool interleaved = false)
      : gaussian(samples, T(-77)), statuses(samples, SampleStatus::non_finite) {
    for (std::size_t g = 0; g < values.size(); ++g) {
      values[g].assign(3 * samples, T(-77));
      T* const first = values[g].data();
      out[static_cast<Output>(g)] = interleaved
                                        ? Vectors<T>::xyz(std::span<T>(values[g]))
                                        : Vectors<T>{first, first + samples, first + 2 * samples};
    }
    out.curvature.gaussian = std::span<T>(gaussian);
    out.status = std::span<SampleStatus>(statuses);
  }
  AllOutputs(const AllOutputs&) = delete;
  AllOutputs& operator=(const AllOutputs&) = delete;

  [[nodiscard]] T at(Output output, std::size_t sample, std::size_t c) const {
    const Vectors<T>& vectors = out[output];
    const T* const components[] = {vectors.x, vectors.y, vectors.z};
    return components[c][static_cast<std::ptrdiff_t>(sample) * vectors.stride];
  }
};

/// Ascending parameters of a direction with its ends, its knots and numbers in between.
std::vector<double> parameters_of(Random& random, const std::vector<PatchInterval>& intervals,
                                  bool in_u) {
  std::vector<double> all;
  for (const PatchInterval& interval : intervals) {
    const Interval& span = in_u ? interval.u : interval.v;
    for (const double t : {0.0, random.unit(), random.unit(), 1.0}) {
      all.push_back(t == 1 ? span.end : span.begin + t * span.length());
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

class SplineSetTest : public IsaTest {
protected:
  template <typename T, typename Test>
  void for_models(std::uint64_t seed, const Test& test) {
    Random random(seed);
    int number = 0;
    for (const KnotKind kind : kKnotKinds) {
      for (int degree = 1; degree <= 7; degree += 2, ++number) {
        const AxisModel u = random_axis(random, kind, degree, number % 3 == 1);
        const KnotKind other = kKnotKinds[random.below(std::size(kKnotKinds))];
        const AxisModel v = random_axis(random, other, number % 2 == 0 ? 3 : 2, number % 4 == 1);
        SCOPED_TRACE(name_of(kind) + " x " + name_of(other) + ", degree " + std::to_string(degree));
        test(random_surface<T>(random, u, v, 3, static_cast<Weights>(number % 3)), random);
        if (HasFatalFailure()) {
          return;
        }
      }
    }
  }

  /// A set packed at once gives what the nets in between would have given.
  template <typename S, typename T>
  void packs_as_nets_do() {
    for_models<S>(21, [&](const SurfaceModel<S>& model, Random&) {
      const CutSurface<S> cut(model.view());
      PatchSet<T> of_nets;
      ASSERT_TRUE(pack(ControlNets<S>(cut.nets), of_nets));
      PatchSet<T> at_once;
      std::vector<PatchInterval> intervals(cut.spans.patches());
      ASSERT_TRUE(pack(model.view(), at_once, intervals, {.threads = 2, .isa = isa()}));
      ASSERT_EQ(at_once.size(), of_nets.size());
      EXPECT_EQ(at_once.shape(0), of_nets.shape(0));
      EXPECT_EQ(intervals.back().u, cut.intervals.back().u);
      const std::size_t samples = 25 * of_nets.size();
      AllOutputs<T> expected(samples);
      AllOutputs<T> found(samples);
      this->grid(of_nets, Grid<T>::uniform(5, 5), expected.out);
      this->grid(at_once, Grid<T>::uniform(5, 5), found.out);
      EXPECT_TRUE(expected.values == found.values);
      EXPECT_TRUE(expected.statuses == found.statuses);
    });
  }

  /// Grids and samples in U and V are what locate() and evaluate() give, divided by the lengths.
  template <typename T>
  void evaluates_as_patches_do(bool interleaved) {
    for_models<T>(22, [&](const SurfaceModel<T>& model, Random& random) {
      const SplineSurface<T> surface = model.view();
      PatchSet<T> set;
      std::vector<PatchInterval> intervals(span_count(surface).patches());
      ASSERT_TRUE(pack(surface, set, intervals));
      const std::vector<double> U = parameters_of(random, intervals, true);
      const std::vector<double> V = parameters_of(random, intervals, false);
      const std::size_t samples = U.size() * V.size();
      std::vector<double> all_u;
      std::vector<double> all_v;
      for (std::size_t k = 0; k < samples; ++k) {
        all_u.push_back(U[k % U.size()]);
        all_v.push_back(V[k / U.size()]);
      }
      std::vector<std::uint32_t> patch(samples);
      std::vector<double> local[4];
      for (std::vector<double>& values : local) {
        values.resize(samples);
      }
      ASSERT_TRUE(locate(
          surface, samples, all_u.data(), all_v.data(),
          {patch.data(), local[0].data(), local[1].data(), local[2].data(), local[3].data()}));
      std::vector<T> x(samples);
      std::vector<T> y(samples);
      const auto centred = [](const Interval& in, double t) {
        return static_cast<T>(((t - in.begin) - (in.end - t)) / in.length());
      };
      for (std::size_t k = 0; k < samples; ++k) {
        x[k] = centred(intervals[patch[k]].u, all_u[k]);
        y[k] = centred(intervals[patch[k]].v, all_v[k]);
        ASSERT_NEAR(local[0][k], (x[k] + 1) / 2, std::numeric_limits<T>::epsilon());
        ASSERT_NEAR(local[1][k], (y[k] + 1) / 2, std::numeric_limits<T>::epsilon());
      }
      AllOutputs<T> expected(samples);
      this->scattered(set, Samples<T>{patch, x, y, Parameters::centred}, expected.out);
      AllOutputs<T> on_grid(samples, interleaved);
      AllOutputs<T> one_by_one(samples, interleaved);
      AllOutputs<T> in_one_call(samples, interleaved);
      this->run(Options{.threads = 2}, [&](const Options& how) {
        return evaluate_grid(set, surface, U, V, on_grid.out, how).status;
      });
      this->run(Options{}, [&](const Options& how) {
        return evaluate_samples(set, surface, all_u, all_v, one_by_one.out, how).status;
      });
      this->run(Options{}, [&](const Options& how) {
        return evaluate_grid(surface, U, V, in_one_call.out, how).status;
      });
      for (const AllOutputs<T>* const found : {&on_grid, &one_by_one, &in_one_call}) {
        EXPECT_TRUE(found->statuses == expected.statuses);
        for (std::size_t k = 0; k < samples; ++k) {
          for (std::size_t c = 0; c < 3; ++c) {
            const auto divided = [&](Output output, double by) {
              return expected.at(output, k, c) / static_cast<T>(by);
            };
            const double lu = local[2][k];
            const double lv = local[3][k];
            ASSERT_EQ(found->at(Output::position, k, c), divided(Output::position, 1));
            ASSERT_EQ(found->at(Output::normal, k, c), divided(Output::normal, 1));
            ASSERT_EQ(found->at(Output::du, k, c), divided(Output::du, lu));
            ASSERT_EQ(found->at(Output::dv, k, c), divided(Output::dv, lv));
            ASSERT_EQ(found->at(Output::duu, k, c), divided(Output::duu, lu * lu));
            ASSERT_EQ(found->at(Output::duv, k, c), divided(Output::duv, lu * lv));
            ASSERT_EQ(found->at(Output::dvv, k, c), divided(Output::dvv, lv * lv));
          }
        }
      }
    });
  }
};

TEST_P(SplineSetTest, FloatsPackAsNetsDo) { packs_as_nets_do<float, float>(); }
TEST_P(SplineSetTest, DoublesPackAsNetsDo) { packs_as_nets_do<double, double>(); }
TEST_P(SplineSetTest, DoublesPackToFloatsAsNetsDo) { packs_as_nets_do<double, float>(); }
TEST_P(SplineSetTest, DoublesEvaluateAsPatchesDo) { evaluates_as_patches_do<double>(false); }
TEST_P(SplineSetTest, FloatsEvaluateAsPatchesDo) { evaluates_as_patches_do<float>(true); }

/// Derivatives by U and V of a bilinear spline are quotients that can be told beforehand.
TEST_P(SplineSetTest, DerivativesAreByTheSplinesOwnParameters) {
  const std::vector<double> knots = {0, 0, 0.5, 2.5, 2.5};
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 5, 0, 0, 0, 8, 0, 1, 8, 0, 5, 8, 0};
  const std::vector<double> knots_v = {10, 10, 14, 14};
  SplineSurface<double> surface;
  surface.points = points.data();
  surface.rows = 2;
  surface.columns = 3;
  surface.row_stride = 9;
  surface.degree_u = surface.degree_v = 1;
  surface.knots_u = knots;
  surface.knots_v = knots_v;
  const std::vector<double> U = {0.25, 0.5, 2.5};
  const std::vector<double> V = {10, 13};
  AllOutputs<double> found(6);
  run(Options{},
      [&](const Options& how) { return evaluate_grid(surface, U, V, found.out, how).status; });
  const double du[] = {2, 2, 2}; // 1 over 0.5; at the knot the right side: 4 over 2
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(found.at(Output::du, k, 0), du[k % 3]);
    EXPECT_EQ(found.at(Output::dv, k, 1), 2);
    EXPECT_EQ(found.at(Output::normal, k, 2), 1);
  }
  EXPECT_EQ(found.at(Output::position, 3, 0), 0.5);
  EXPECT_EQ(found.at(Output::position, 3, 1), 6);
}

/// Splines of several degrees, some of them with weights, become one set.
TEST_P(SplineSetTest, SurfacesOfSeveralShapesBecomeOneSet) {
  Random random(23);
  std::vector<SurfaceModel<float>> models;
  for (int k = 0; k < 12; ++k) {
    models.push_back(random_surface<float>(random,
                                           random_axis(random, kKnotKinds[k % 8], 1 + k / 3, false),
                                           random_axis(random, KnotKind::clamped, 1 + k % 3, false),
                                           3, k % 4 == 2 ? Weights::homogeneous : Weights::none));
  }
  std::vector<SplineSurface<float>> views;
  for (const SurfaceModel<float>& model : models) {
    views.push_back(model.view());
  }
  PatchSet<float> set;
  ASSERT_TRUE(pack(std::span<const SplineSurface<float>>(views), set, {}, {.isa = isa()}));
  std::size_t first = 0;
  for (const SplineSurface<float>& view : views) {
    PatchSet<float> alone;
    ASSERT_TRUE(pack(view, alone));
    const std::size_t patches = alone.size();
    AllOutputs<float> expected(9 * patches);
    AllOutputs<float> found(9 * patches);
    grid(alone, Grid<float>::uniform(3, 3), expected.out);
    grid(set, Grid<float>::uniform(3, 3), found.out,
         CallOptions{.first_patch = first, .patch_count = patches});
    EXPECT_TRUE(expected.values == found.values);
    first += patches;
  }
  EXPECT_EQ(set.size(), first);
}

/// Samples in a curve's own parameter are those of its pieces, divided by powers of the lengths of
/// their intervals.
void expect_own_parameters(const SplineCurve<double>& curve, const std::vector<double>& values,
                           const std::vector<Interval>& intervals) {
  CurveSet<double> set;
  ASSERT_TRUE(pack(ControlCurves<double>::packed(std::span<const double>(values), curve.degree,
                                                 curve.components, curve.weights),
                   set));
  std::vector<double> t;
  std::vector<std::uint32_t> piece;
  std::vector<double> centred;
  for (std::size_t k = intervals.size(); k-- > 0;) {
    const Interval& in = intervals[k];
    for (const double at : {in.begin, in.begin + 0.3 * in.length(), in.begin + in.length() / 2}) {
      t.push_back(at);
      piece.push_back(static_cast<std::uint32_t>(k));
      centred.push_back(((at - in.begin) - (in.end - at)) / in.length());
    }
  }
  const auto evaluate_some = [&](const auto& run, std::vector<double>(&to)[3]) {
    CurveOutputs<double> out;
    for (std::size_t order = 0; order < 3; ++order) {
      to[order].assign(2 * t.size(), -77);
      out[static_cast<CurveOutput>(order)] =
          Vectors<double>{to[order].data(), to[order].data() + t.size(), nullptr};
    }
    ASSERT_EQ(run(out), Status::ok);
  };
  std::vector<double> expected[3];
  std::vector<double> found[3];
  evaluate_some(
      [&](const CurveOutputs<double>& out) {
        return evaluate(set, CurveSamples<double>{piece, centred, Parameters::centred}, out);
      },
      expected);
  evaluate_some(
      [&](const CurveOutputs<double>& out) { return evaluate_samples(set, curve, t, out).status; },
      found);
  for (std::size_t k = 0; k < 2 * t.size(); ++k) {
    const double length = intervals[piece[k % t.size()]].length();
    EXPECT_EQ(found[0][k], expected[0][k]);
    EXPECT_EQ(found[1][k], expected[1][k] / length);
    EXPECT_EQ(found[2][k], expected[2][k] / (length * length));
  }
  CurveOutputs<double> none;
  EXPECT_EQ(evaluate_samples(set, curve, t, none, {}, 1).status, Status::bad_patch_range);
  t[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(evaluate_samples(set, curve, t, none).status, Status::non_finite_input);
  EXPECT_EQ(evaluate_samples(set, curve, t, none).point, 1U);
}

/// Curves are cut as the rows of surfaces are, in both forms of weights.
TEST_P(SplineSetTest, CurvesAreCutAsSurfacesAre) {
  Random random(24);
  for (const KnotKind kind : kKnotKinds) {
    for (const Weights weights : {Weights::none, Weights::cartesian, Weights::homogeneous}) {
      const AxisModel along = random_axis(random, kind, random.integer(1, 9), false);
      const AxisModel across = random_axis(random, KnotKind::clamped, 1, false);
      const auto model = random_surface<double>(random, along, across, 2, weights);
      const SplineSurface<double> surface = model.view();
      SplineCurve<double> curve;
      curve.points = model.values.data();
      curve.count = along.points;
      curve.point_stride = surface.point_stride;
      curve.components = 2;
      curve.weights = weights;
      curve.periodic = along.periodic;
      curve.degree = along.degree;
      curve.knots = along.knots;
      const std::size_t pieces = span_count(curve).patches();
      ASSERT_EQ(pieces, span_count(surface).u);
      const std::size_t piece = along.order() * model.channels();
      std::vector<double> values(pieces * piece);
      std::vector<Interval> intervals(pieces);
      run(Options{}, [&](const Options& how) {
        return to_bezier(curve, std::span<double>(values), intervals, how).status;
      });
      const CutSurface<double> cut(surface);
      for (std::size_t k = 0; k < values.size(); ++k) {
        const std::size_t patch = k / piece;
        const std::size_t c = k % model.channels();
        const std::size_t i = k % piece / model.channels();
        const double weight = weights == Weights::cartesian && c < 2 ? cut.at(patch, 0, i, 2) : 1;
        const double expected = cut.at(patch, 0, i, c) / weight;
        const double slack = weight == 1 ? 0 : 2e-16 * std::abs(expected); // copies of ends
        ASSERT_NEAR(values[k], expected, slack) << name_of(kind);
        EXPECT_EQ(intervals[patch], cut.intervals[patch].u);
      }
      expect_own_parameters(curve, values, intervals);
    }
  }
}

INSTANTIATE_FOR_EVERY_ISA(SplineSetTest);

} // namespace
} // namespace simdbezier::tests
