// Sides of rational patches and ends of rational curves that are one point up to the roundings of
// homogeneous numbers: 3/1 and 0.3/0.1. src/storage/one_point.hpp has what that means; the oracle
// is the curve beside the point (pole_shapes.hpp), in long double.
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/long_form.hpp"
#include "tests/support/nets/pole_shapes.hpp"

namespace simdbezier::tests::pole_normals_test {
namespace {

constexpr int kDegrees[][2] = {{1, 1}, {2, 1}, {2, 2}, {3, 3}, {3, 2}, {5, 4}, {7, 3}, {2, 8}};
constexpr double kRadii[] = {1, 3, 7, 10, 0.1, 1e6};
constexpr double kScales[] = {1, 3, 0.1, 1e-3};
constexpr std::size_t kN = 7;

/// The bound of docs/accuracy.md at poles is 10^-3 degree.
template <typename T>
constexpr long double kTurn = sizeof(T) == sizeof(float) ? 1.7e-5L : 1e-12L;
template <typename T>
constexpr long double kUnit = std::numeric_limits<T>::epsilon() / 2;

/// Turns a net of homogeneous points in their own type, by the angle that takes a coordinate of the
/// pole to where sums cancel.
template <typename T>
void turn(PoleNet<T>& net, std::size_t axis) {
  const std::size_t a = axis;
  const std::size_t b = (axis + 1) % 3;
  const Point3L pole = net.point(net.shape.at(0, 0));
  const double angle = std::atan2(static_cast<double>(pole[a]), static_cast<double>(pole[b]));
  const auto cosine = static_cast<T>(std::cos(angle));
  const auto sine = static_cast<T>(std::sin(angle));
  for (std::size_t k = 0; k < net.values.size(); k += 4) {
    const T x = net.values[k + a];
    const T y = net.values[k + b];
    net.values[k + a] = x * cosine - y * sine;
    net.values[k + b] = x * sine + y * cosine;
  }
}

class PoleNormals : public IsaTest {
protected:
  template <typename T>
  void expect_pole(const PoleNet<T>& net, bool origins) {
    const PoleShape& shape = net.shape;
    PatchSet<T> set;
    expect_packed(pack(net.nets(), set, {.local_origin = origins, .isa = isa()}));
    Planes<T> planes(kN * kN);
    grid(set, Grid<T>::uniform(kN, kN), planes.outputs());
    const std::size_t fixed = shape.at_end() ? kN - 1 : 0;
    const auto sample = [&](std::size_t i) {
      return shape.along_u() ? fixed * kN + i : i * kN + fixed;
    };
    for (std::size_t i = 0; i < kN; ++i) {
      const std::size_t k = sample(i);
      const auto found = planes.vector(3, k);
      const Point3L normal = net.normal(static_cast<long double>(i) / (kN - 1));
      EXPECT_LE(distance({found[0], found[1], found[2]}, normal), kTurn<T>) << "sample " << i;
      EXPECT_EQ(planes.status()[k], SampleStatus::limit) << "sample " << i;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(planes.at(shape.along_u() ? 1 : 2, c, k), 0) << "sample " << i;
        const bool at_corner = i == 0 || i + 1 == kN;
        const T first = planes.at(0, c, sample(0));
        const T last = planes.at(0, c, sample(kN - 1));
        const T here = planes.at(0, c, k);
        EXPECT_TRUE(at_corner || here == first || here == last) << "sample " << i;
        EXPECT_EQ(here, planes.at(0, c, at_corner ? k : sample(1))) << "sample " << i;
      }
    }
    // Corners stay what they are by themselves: another patch shares one of them, not the side.
    for (const int end : {0, shape.along()}) {
      const T* const corner = net.values.data() + 4 * shape.at(0, end);
      const double divisor =
          shape.form == Weights::homogeneous ? static_cast<double>(corner[3]) : 1;
      const std::size_t k = sample(end == 0 ? 0 : kN - 1);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(planes.at(0, c, k), static_cast<T>(static_cast<double>(corner[c]) / divisor));
      }
    }
  }

  template <typename T>
  void expect_poles(std::uint64_t seed, int count) {
    Random random(seed);
    for (int k = 0; k < count; ++k) {
      const auto& degrees = kDegrees[random.below(std::size(kDegrees))];
      const PoleShape shape{degrees[0], degrees[1], k % 4,
                            k / 4 % 4 == 0 ? Weights::cartesian : Weights::homogeneous};
      const double radius = kRadii[random.below(std::size(kRadii))];
      const double scale = kScales[random.below(std::size(kScales))];
      SCOPED_TRACE(testing::Message()
                   << "net " << k << ", " << degrees[0] << " x " << degrees[1] << ", side "
                   << shape.side << ", radius " << radius << ", weights times " << scale);
      PoleNet<T> net = pole_net<T>(shape, radius, scale, random);
      expect_pole(net, k / 16 % 2 != 0);
      if (shape.form == Weights::homogeneous) {
        turn(net, random.below(3));
        SCOPED_TRACE("turned");
        expect_pole(net, k / 16 % 2 != 0);
      }
    }
  }
};

TEST_P(PoleNormals, of_sides_that_are_points_up_to_roundings_float) {
  expect_poles<float>(71, long_form() ? 5000 : 400);
}
TEST_P(PoleNormals, of_sides_that_are_points_up_to_roundings_double) {
  expect_poles<double>(72, long_form() ? 5000 : 400);
}

/// Points that numbers of the input's type tell apart are different: 32 roundings, not 16.
TEST_P(PoleNormals, need_points_that_are_one) {
  for (const bool near : {true, false}) {
    const double step = (near ? 4 : 32) * 0x1p-52;
    const double x = 3 + 3 * step;
    std::vector<double> values = {3, 1, 2, 1, 2 * x, 2, 4, 2, 1, 4, 3, 1, 5, 5, 2, 1};
    PatchSet<double> set;
    expect_packed(pack(ControlNets<double>::packed(values.data(), 1, 1, 1, 3, Weights::homogeneous),
                       set, {}));
    Planes<double> planes(4);
    grid(set, Grid<double>::uniform(2, 2), planes.outputs());
    EXPECT_EQ(planes.status()[0] == SampleStatus::limit, near);
    EXPECT_EQ(planes.at(1, 0, 0) == 0, near);
  }
}

/// The first `equal` control points are one: the tangent there leads to the next one.
template <typename T>
void expect_end(int degree, int equal, bool reversed, Weights form, Random& random) {
  std::vector<T> values(static_cast<std::size_t>(4 * (degree + 1)));
  double pole[3];
  for (double& x : pole) {
    x = decimal(random, -100, 100);
  }
  for (int i = 0; i <= degree; ++i) {
    const auto weight = static_cast<T>(decimal(random, 1, 30));
    T* const to = values.data() + 4 * (reversed ? degree - i : i);
    for (int c = 0; c < 3; ++c) {
      const double x = pole[c] + (i < equal ? 0 : decimal(random, 1, 100));
      to[c] = static_cast<T>(form == Weights::homogeneous ? x * static_cast<double>(weight) : x);
    }
    to[3] = weight;
  }
  const auto point = [&](int i) {
    const T* const at = values.data() + 4 * (reversed ? degree - i : i);
    const long double divisor = form == Weights::homogeneous ? at[3] : 1;
    return Point3L{at[0] / divisor, at[1] / divisor, at[2] / divisor};
  };
  CurveSet<T> set;
  ASSERT_TRUE(pack(ControlCurves<T>::packed(values.data(), 1, degree, 3, form), set));
  T tangent[3];
  T curvature[1];
  SampleStatus status[1];
  const T x[1] = {reversed ? T(1) : T(0)};
  CurveOutputs<T> out;
  out.tangent = Vectors<T>::xyz(tangent);
  out.curvature = curvature;
  out.status = status;
  ASSERT_EQ(evaluate(set, CurveGrid<T>{1, x}, out), Status::ok);
  if (equal > degree) {
    EXPECT_EQ(status[0], SampleStatus::degenerate);
    return;
  }
  const Point3L from = point(0);
  const Point3L to = point(equal);
  const long double sign = reversed ? -1 : 1;
  const Point3L way =
      unit({sign * (to[0] - from[0]), sign * (to[1] - from[1]), sign * (to[2] - from[2])});
  EXPECT_LE(distance({tangent[0], tangent[1], tangent[2]}, way), kTurn<T>);
  EXPECT_EQ(status[0], equal > 1 ? SampleStatus::limit : SampleStatus::regular);
}

TEST(PoleTangents, of_ends_that_are_one_point_up_to_roundings) {
  Random random(73);
  for (int degree = 1; degree <= 9; ++degree) {
    for (int equal = 1; equal <= degree + 1; ++equal) {
      for (const bool reversed : {false, true}) {
        for (const Weights form : {Weights::cartesian, Weights::homogeneous}) {
          for (int k = 0; k < (long_form() ? 60 : 6); ++k) {
            SCOPED_TRACE(testing::Message() << "degree " << degree << ", " << equal << " equal"
                                            << (reversed ? ", reversed" : "") << ", net " << k);
            expect_end<float>(degree, equal, reversed, form, random);
            expect_end<double>(degree, equal, reversed, form, random);
          }
        }
      }
    }
  }
}

TEST(PoleTangents, of_a_line_that_begins_in_one_point) {
  const double values[] = {0, 0, 3, 1, 0, 0, 0.3, 0.1, 1, 2, 3, 1};
  CurveSet<double> set;
  ASSERT_TRUE(pack(ControlCurves<double>::packed(values, 1, 2, 3, Weights::homogeneous), set));
  double tangent[3];
  double curvature[1];
  const double x[1] = {0};
  CurveOutputs<double> out;
  out.tangent = Vectors<double>::xyz(tangent);
  out.curvature = curvature;
  ASSERT_EQ(evaluate(set, CurveGrid<double>{1, x}, out), Status::ok);
  EXPECT_NEAR(tangent[0], 1 / std::sqrt(5.0), 1e-15);
  EXPECT_NEAR(tangent[1], 2 / std::sqrt(5.0), 1e-15);
  EXPECT_NEAR(tangent[2], 0, 1e-15);
  EXPECT_EQ(curvature[0], 0);
}
INSTANTIATE_FOR_EVERY_ISA(PoleNormals);

} // namespace
} // namespace simdbezier::tests::pole_normals_test
