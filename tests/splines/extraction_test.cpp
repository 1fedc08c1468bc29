// Control points of spline surfaces and curves against knot insertion in fractions: every kind of
// knots x degree x part of the domain x weights x type, on every instruction set.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/splines/spline_oracle.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests {
namespace {

AxisModel with_knots_times(AxisModel axis, double factor) {
  for (double& knot : axis.knots) {
    knot *= factor;
  }
  axis.range = {axis.range.begin * factor, axis.range.end * factor};
  return axis;
}

/// Every kind of knots x part of the domain x degree in one direction, others in the other one; and
/// knots at both ends of the range of doubles.
template <typename T>
std::vector<ExactCase<T>> make_cases(std::span<const int> degrees, std::uint64_t seed) {
  std::vector<ExactCase<T>> cases;
  Random random(seed);
  const Weights forms[] = {Weights::none, Weights::cartesian, Weights::homogeneous};
  for (const KnotKind kind : kKnotKinds) {
    for (const bool part : {false, true}) {
      for (const int degree : degrees) {
        const AxisModel axis = random_axis(random, kind, degree, part);
        const KnotKind other_kind = kKnotKinds[random.below(std::size(kKnotKinds))];
        const AxisModel other =
            random_axis(random, other_kind, random.integer(1, 4), random.below(4) == 0);
        const bool exchanged = cases.size() % 2 == 1;
        cases.push_back(exact_case(
            name_of(kind) + " of degree " + std::to_string(degree) + (part ? ", a part" : ""),
            random_surface<T>(random, exchanged ? other : axis, exchanged ? axis : other,
                              random.integer(1, 2), forms[cases.size() % 3])));
      }
    }
  }
  for (const double factor : {0x1p995, 0x1p-900}) {
    for (const KnotKind kind : {KnotKind::multiple, KnotKind::distant, KnotKind::periodic}) {
      for (const int degree : {2, 5}) {
        const AxisModel u = random_axis(random, kind, degree, degree == 5);
        const AxisModel v = random_axis(random, KnotKind::uniform, 2, false);
        cases.push_back(exact_case(
            name_of(kind) + " times " + std::to_string(std::ilogb(factor)) + " bits",
            random_surface<T>(random, with_knots_times(u, factor), v, 2, Weights::none)));
      }
    }
  }
  return cases;
}

template <typename T>
const std::vector<ExactCase<T>>& all_cases() {
  static constexpr int kDegrees[] = {1, 2, 3, 4, 5, 8, 15};
  static const std::vector<ExactCase<T>> cases =
      make_cases<T>(std::span(kDegrees, sizeof(T) == sizeof(float) ? 5 : 7), sizeof(T));
  return cases;
}

template <typename T>
void expect_near(const CutSurface<T>& cut, const ExactCase<T>& item) {
  ASSERT_EQ(to_string(cut.report.status), to_string(Status::ok));
  const std::size_t channels = item.model.channels();
  for (std::size_t c = 0; c < channels; ++c) {
    ASSERT_EQ(cut.values.size(), item.exact[c].size() * channels);
    for (std::size_t k = 0; k < item.exact[c].size(); ++k) {
      const Rational& exact = item.exact[c][k];
      const auto value = static_cast<double>(cut.values[k * channels + c]);
      ASSERT_TRUE(std::isfinite(value)) << "value " << k << " of channel " << c;
      const Rational apart = abs(Rational(value) - exact);
      const Rational rounding =
          sizeof(T) == sizeof(float) ? Rational(abs(exact) * Rational(0x1.0001p-24)) : Rational(0);
      ASSERT_LE(apart, item.bound[c] + rounding) << "value " << k << " of channel " << c;
    }
  }
}

class SplineTest : public IsaTest {
protected:
  template <typename T>
  void meets_its_bound() {
    for (const ExactCase<T>& item : all_cases<T>()) {
      SCOPED_TRACE(item.name);
      const SplineSurface<T> surface = item.model.view();
      run(Options{}, [&](const Options& options) {
        const CutSurface<T> cut(surface, options);
        expect_near(cut, item);
        return cut.report.status;
      });
      if (HasFatalFailure()) {
        return;
      }
    }
  }
};

TEST_P(SplineTest, DoubleMeetsItsBound) { meets_its_bound<double>(); }
TEST_P(SplineTest, FloatMeetsItsBound) { meets_its_bound<float>(); }

INSTANTIATE_FOR_EVERY_ISA(SplineTest);

} // namespace
} // namespace simdbezier::tests
