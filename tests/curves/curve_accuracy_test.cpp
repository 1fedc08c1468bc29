// Every sample of every kind of curve against its certificate.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/curves/curve_results.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::tests::curve_accuracy_test {
namespace {

struct Kind {
  const char* name;
  int components;
  double ratio; ///< of the weights; 0: none
  double offset = 0;
  bool local_origin = false;
  double relative_to = 0;
};

const Kind kKinds[] = {{"line", 1, 0},
                       {"plane", 2, 0},
                       {"space", 3, 0},
                       {"colour", 4, 0},
                       {"rational_1", 1, 4},
                       {"rational_2", 2, 100},
                       {"rational_3", 3, 4},
                       {"rational_1e4", 3, 1e4},
                       {"rational_4", 4, 4},
                       {"far", 3, 0, 1000},
                       {"far_origin", 3, 0, 1000, true},
                       {"far_rational_origin", 3, 4, 1000, true},
                       {"moved", 3, 0, 1000, false, 999.75},
                       {"moved_rational", 3, 4, 1000, false, 999.75}};

class CurveAccuracy : public CurveTest {
protected:
  template <typename T, typename S>
  void meets_its_bounds(const Kind& kind, int degree) {
    const CurveBatch<S> batch = random_curves<S>(kCurves, degree, kind.components, kind.ratio,
                                                 static_cast<std::uint64_t>(degree), kind.offset);
    PackOptions options;
    options.local_origin = kind.local_origin;
    std::fill_n(options.relative_to, 3, kind.relative_to);
    judge(batch, packed<T>(batch, options), kind, degree);
  }

  /// Points as large as T holds them, and somewhat smaller ones. Returns how many bounds there are.
  template <typename T>
  std::size_t bounds_near_overflow(const Kind& kind, int degree, int octaves) {
    CurveBatch<T> batch = random_curves<T>(kCurves, degree, kind.components, kind.ratio,
                                           static_cast<std::uint64_t>(degree));
    const auto components = static_cast<std::size_t>(kind.components);
    const T scale = std::ldexp(std::numeric_limits<T>::max(), -octaves);
    for (std::size_t curve = 0; curve < kCurves; ++curve) {
      for (std::size_t i = 0; i < batch.order(); ++i) {
        for (std::size_t c = 0; c < components; ++c) {
          batch.at(curve, i, c) *= scale;
        }
      }
    }
    PackOptions options;
    options.local_origin = kind.local_origin;
    CurveSet<T> set;
    if (!pack(batch.view(), set, options)) {
      return 0; // its coefficients overflow
    }
    judge(batch, set, kind, degree);
    std::size_t finite = 0;
    for (std::size_t curve = 0; curve < kCurves; ++curve) {
      const CurveErrorBounds bounds = error_bounds(set, curve, isa());
      for (const auto& of : {bounds.position, bounds.d1, bounds.d2}) {
        finite += static_cast<std::size_t>(
            std::count_if(of, of + components, [](double bound) { return std::isfinite(bound); }));
      }
    }
    return finite;
  }

  static constexpr std::size_t kCurves = 4;
  double worst_[3] = {0, 0, 0};

private:
  static constexpr std::size_t kSamples = 17;

  template <typename T, typename S>
  void judge(const CurveBatch<S>& batch, const CurveSet<T>& set, const Kind& kind, int degree) {
    for (int first = 0; first < kind.components; first += 3) {
      CallOptions where;
      where.first_component = first;
      const int planes = std::min(kind.components - first, 3);
      CurveResults<T> results(kCurves * kSamples, kind.components > 3 ? 1 : planes);
      results.planes = planes;
      evaluate(set, CurveGrid<T>::uniform(kSamples), results.outputs(), where);
      for (std::size_t curve = 0; curve < kCurves; ++curve) {
        const CurveErrorBounds bounds = error_bounds(set, curve, isa());
        for (std::size_t i = 0; i < kSamples; ++i) {
          const double x = uniform_x<T>(i, kSamples);
          for (int c = 0; c < planes; ++c) {
            const auto component = static_cast<std::size_t>(first + c);
            const double moved = component < 3 ? kind.relative_to : 0;
            const OracleCurve exact = oracle_curve(batch, curve, component, x, moved);
            const double limits[] = {bounds.position[component], bounds.d1[component],
                                     bounds.d2[component]};
            for (std::size_t d = 0; d < 3; ++d) {
              const T value = results.at(d, static_cast<std::size_t>(c), curve * kSamples + i);
              const double error = std::fabs((exact.d[d] - static_cast<double>(value)).to_double());
              ASSERT_TRUE(error <= limits[d] || std::isinf(limits[d]))
                  << kind.name << " degree " << degree << " curve " << curve << " sample " << i
                  << " component " << component << " derivative " << d;
              worst_[d] = std::max(worst_[d], limits[d] > 0 ? error / limits[d] : 0);
            }
          }
        }
      }
    }
  }
};

TEST_P(CurveAccuracy, ErrorsStayWithinTheirBounds) {
  for (const Kind& kind : kKinds) {
    std::fill_n(worst_, 3, 0.0);
    for (int degree = 1; degree <= kMostDegree; ++degree) {
      meets_its_bounds<float, float>(kind, degree);
      meets_its_bounds<double, double>(kind, degree);
      meets_its_bounds<float, double>(kind, degree);
    }
    // A bound that nothing comes near would pass this test as well.
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_GT(worst_[d], kind.ratio > 0 ? 1e-5 : 0.02) << kind.name << " derivative " << d;
    }
  }
}

TEST_P(CurveAccuracy, BoundsThatMightNotHoldAreInfinite) {
  for (const Kind& kind : {Kind{"space", 3, 0}, {"rational", 3, 4}, {"origin", 3, 0, 0, true}}) {
    std::size_t few = 0;
    for (int degree = 1; degree <= kMostDegree; ++degree) {
      constexpr std::size_t kAll = kCurves * 9;
      EXPECT_EQ(bounds_near_overflow<float>(kind, degree, 60), kAll) << kind.name << degree;
      EXPECT_EQ(bounds_near_overflow<double>(kind, degree, 60), kAll) << kind.name << degree;
      for (int octaves = 0; octaves < 30; ++octaves) {
        const std::size_t there = bounds_near_overflow<float>(kind, degree, octaves);
        few += there > 0 && there < kAll ? 1 : 0;
      }
    }
    EXPECT_GT(few, 10U) << kind.name;
  }
}

TEST_P(CurveAccuracy, EndsAreControlPoints) {
  for (int degree = 1; degree <= kMostDegree; ++degree) {
    for (const double ratio : {0.0, 10.0}) {
      for (const bool origins : {false, true}) {
        const auto batch = random_curves<float>(5, degree, 3, ratio, 77);
        PackOptions options;
        options.local_origin = origins;
        const CurveSet<float> set = packed<float>(batch, options);
        CurveResults<float> results(5 * 6, 3);
        evaluate(set, CurveGrid<float>::uniform(6), results.outputs());
        for (std::size_t curve = 0; curve < 5; ++curve) {
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(results.at(0, c, 6 * curve), batch.at(curve, 0, c));
            ASSERT_EQ(results.at(0, c, 6 * curve + 5), batch.at(curve, batch.order() - 1, c));
          }
        }
      }
    }
  }
}

TEST_P(CurveAccuracy, HomogeneousAndCartesianPointsAgree) {
  // Weights that are powers of two: both forms are exact.
  auto cartesian = random_curves<double>(9, 4, 3, 8, 5);
  auto homogeneous = cartesian;
  homogeneous.weights = Weights::homogeneous;
  for (std::size_t k = 0; k < cartesian.count; ++k) {
    for (std::size_t i = 0; i < cartesian.order(); ++i) {
      const double weight = std::exp2(static_cast<double>(i) - 2);
      cartesian.at(k, i, 3) = homogeneous.at(k, i, 3) = weight;
      for (std::size_t c = 0; c < 3; ++c) {
        homogeneous.at(k, i, c) = cartesian.at(k, i, c) * weight;
      }
    }
  }
  CurveResults<double> a(9 * 11, 3);
  CurveResults<double> b(9 * 11, 3);
  evaluate(packed<double>(cartesian), CurveGrid<double>::uniform(11), a.outputs());
  evaluate(packed<double>(homogeneous), CurveGrid<double>::uniform(11), b.outputs());
  EXPECT_EQ(a.hash(), b.hash());
}

INSTANTIATE_FOR_EVERY_ISA(CurveAccuracy);

} // namespace
} // namespace simdbezier::tests::curve_accuracy_test
