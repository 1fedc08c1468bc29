// Normals where du x dv vanishes or nearly does: the limit, a status, and never NaN (gate G6).
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/bicubic_bounds.hpp"
#include "tests/properties/accuracy/judge/measure.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::normal_gates_test {
namespace {

/// A smooth dish over the unit square, not symmetric in anything.
[[nodiscard]] Net dish() {
  return bicubic([](int j, int i) {
    const double x = i / 3.0;
    const double y = j / 3.0;
    return Vector3{x + 0.05 * y * y, y - 0.07 * x * y, 0.3 * x * x + 0.2 * y * y + 0.1 * x * y};
  });
}

[[nodiscard]] Net with(Net net, const std::function<void(Net&)>& change) {
  change(net);
  return net;
}

/// A pole on each side in turn, turned and moved as `moved` says.
[[nodiscard]] Net pole(int side) {
  Random random(31 + static_cast<std::uint64_t>(side));
  return collapsed_net(random, side);
}

enum class Sampled { whole_side_v0, whole_side_u0, corner, everywhere };

struct DegenerateCase {
  const char* name;
  Net (*make)();
  Sampled where;
  SampleStatus status;
  double degrees; ///< allowed angle to the limit
};

// Degenerate nets that do not need the teapot.
const DegenerateCase kDegenerateCases[] = {
    {"first_edge_point_doubled",
     [] { return with(dish(), [](Net& n) { n.at(0, 1) = n.at(0, 0); }); }, Sampled::corner,
     SampleStatus::limit, kLimitDegrees},
    {"both_edge_points_doubled",
     [] { return with(dish(), [](Net& n) { n.at(0, 1) = n.at(1, 0) = n.at(0, 0); }); },
     Sampled::corner, SampleStatus::limit, kDegenerateDegrees},
    {"tangents_opposed_in_a_plane",
     [] {
       return with(dish(), [](Net& n) {
         for (Vector3& point : n.points) {
           point[2] = 0;
         }
         n.at(0, 0) = {0, 0, 0};
         n.at(0, 1) = {0.25, -0.5, 0};
         n.at(1, 0) = {-0.25, 0.5, 0};
       });
     },
     Sampled::corner, SampleStatus::limit, kLimitDegrees},
    {"cusp_ridge",
     [] {
       return with(dish(), [](Net& n) {
         for (int j = 0; j <= 3; ++j) {
           n.at(j, 1) = n.at(j, 0);
         }
       });
     },
     Sampled::whole_side_u0, SampleStatus::limit, kLimitDegrees},
    {"pole_on_v0", [] { return pole(0); }, Sampled::whole_side_v0, SampleStatus::limit,
     kLimitDegrees},
    {"two_rows_collapsed",
     [] {
       return with(dish(), [](Net& n) {
         for (int i = 0; i <= 3; ++i) {
           n.at(0, i) = n.at(1, i) = {0, 0, 0};
         }
       });
     },
     Sampled::whole_side_v0, SampleStatus::limit, kDegenerateDegrees},
    {"point", [] { return bicubic([](int, int) {
                     return Vector3{0.1, -0.7, 3};
                   }); },
     Sampled::everywhere, SampleStatus::degenerate, 0},
    {"line_in_u", [] { return bicubic([](int, int i) {
                         return Vector3{i * 0.3, i * 0.7, 1};
                       }); },
     Sampled::everywhere, SampleStatus::degenerate, 0},
    {"line_in_u_and_v",
     [] {
       return bicubic([](int j, int i) { return Vector3{i + 2.0 * j, 0, -2 * (i + 2.0 * j)}; });
     },
     Sampled::everywhere, SampleStatus::degenerate, 0},
    {"regular", dish, Sampled::everywhere, SampleStatus::regular, kLimitDegrees}};

template <typename T>
[[nodiscard]] SampleArrays<T> degenerate_samples(Sampled where) {
  SampleArrays<T> samples;
  for (int k = 0; k <= 32; ++k) {
    const T t = uniform_centred<T>(k, 32);
    const T s = uniform_centred<T>((7 * k + 3) % 33, 32);
    switch (where) {
    case Sampled::whole_side_v0:
      samples.add(0, t, T(-1));
      break;
    case Sampled::whole_side_u0:
      samples.add(0, T(-1), t);
      break;
    case Sampled::corner:
      samples.add(0, T(-1), T(-1));
      break;
    case Sampled::everywhere:
      samples.add(0, t, s);
    }
  }
  return samples;
}

template <typename T>
[[nodiscard]] double degrees_between(const std::array<T, 3>& a, const Vector3& b) {
  const double distance =
      std::hypot(static_cast<double>(a[0]) - b[0], static_cast<double>(a[1]) - b[1],
                 static_cast<double>(a[2]) - b[2]);
  return 2 * std::asin(std::min(1.0, distance / 2)) * 180 / std::numbers::pi;
}

/// The true normal: that of the surface where it has one, otherwise the limit.
[[nodiscard]] Vector3 true_normal(const Net& net, double x, double y) {
  const OracleNormal normal = oracle_normal(net, oracle_sample(net, x, y));
  return normal.relative_size < kVanishing ? oracle_limit_normal(net, x, y).direction
                                           : normal.direction;
}

class NormalTest : public IsaTest {
protected:
  template <typename T>
  void expect_case(const DegenerateCase& test) {
    const Net net = rounded_to<T>(test.make());
    const SampleArrays<T> samples = degenerate_samples<T>(test.where);
    Planes<T> planes(samples.patch.size());
    scattered(packed<T>(std::span(&net, 1)), samples.view(Parameters::centred), planes.outputs());
    for (std::size_t k = 0; k < planes.count(); ++k) {
      const std::array<T, 3> normal = planes.vector(3, k);
      EXPECT_EQ(planes.status()[k], test.status) << test.name << ", sample " << k;
      if (test.status == SampleStatus::degenerate) {
        EXPECT_EQ(normal, (std::array<T, 3>{})) << test.name << ", sample " << k;
      } else {
        const Vector3 truth = true_normal(net, samples.u[k], samples.v[k]);
        EXPECT_LE(degrees_between(normal, truth), test.degrees) << test.name << ", sample " << k;
      }
    }
  }

  /// Every side a pole, approached from 2^-1 to 2^-24: never far off, on any way.
  template <typename T>
  void expect_good_approach(const Net& net, const char* name) {
    SampleArrays<T> samples;
    for (int side = 0; side < 4; ++side) {
      for (int e = 1; e <= 25; ++e) {
        const double gap = e == 25 ? 0 : std::ldexp(1.0, -e);
        const auto near = static_cast<T>((side % 2 == 0 ? -1 : 1) * (1 - gap));
        for (int k = 0; k <= 32; ++k) {
          const T along = uniform_centred<T>(k, 32);
          side < 2 ? samples.add(0, along, near) : samples.add(0, near, along);
        }
      }
    }
    Planes<T> planes(samples.patch.size());
    scattered(packed<T>(std::span(&net, 1)), samples.view(Parameters::centred), planes.outputs());
    double worst = 0;
    for (std::size_t k = 0; k < planes.count(); ++k) {
      const std::array<T, 3> normal = planes.vector(3, k);
      if (planes.status()[k] != SampleStatus::degenerate) {
        const Vector3 truth = true_normal(net, samples.u[k], samples.v[k]);
        worst = std::max(worst, degrees_between(normal, truth));
      }
      EXPECT_NE(planes.status()[k], SampleStatus::degenerate) << name << ", sample " << k;
    }
    EXPECT_LE(worst, kDegenerateDegrees) << name;
  }

  template <typename T>
  void expect_graded_no_worse_than_plain();
};

/// The plain cross product of the tangents as evaluated, in double.
template <typename T>
[[nodiscard]] Vector3 plain_normal(const Planes<T>& planes, std::size_t k) {
  const std::array<T, 3> a = planes.vector(1, k);
  const std::array<T, 3> b = planes.vector(2, k);
  const Vector3 du{a[0], a[1], a[2]};
  const Vector3 dv{b[0], b[1], b[2]};
  const Vector3 n{du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                  du[0] * dv[1] - du[1] * dv[0]};
  const double size = std::hypot(n[0], n[1], n[2]);
  return {n[0] / size, n[1] / size, n[2] / size};
}

// Bunched parameter lines make du x dv small where the surface is regular. Whatever is done about
// small normals must not touch these: at most rounding (8 u) worse than the plain cross product.
template <typename T>
void NormalTest::expect_graded_no_worse_than_plain() {
  Random random(40);
  for (int exponent = -6; exponent >= -24; --exponent) {
    const Net net = rounded_to<T>(graded_net(random, std::ldexp(1.0, exponent)));
    SampleArrays<T> samples;
    for (int k = 0; k < 300; ++k) {
      const T x = boundary_centred<T>(random);
      samples.add(0, x, boundary_centred<T>(random));
    }
    Planes<T> planes(samples.patch.size());
    scattered(packed<T>(std::span(&net, 1)), samples.view(Parameters::centred), planes.outputs());
    for (std::size_t k = 0; k < planes.count(); ++k) {
      const Vector3 truth = true_normal(net, samples.u[k], samples.v[k]);
      const double ours = degrees_between(planes.vector(3, k), truth);
      const double plain = degrees_between(plain_normal(planes, k), truth);
      const double rounding = 8 * kUnitRoundoff<T> * 180 / std::numbers::pi;
      EXPECT_LE(ours, plain + rounding) << "2^" << exponent << ", sample " << k;
      EXPECT_LE(ours, kDegenerateDegrees) << "2^" << exponent << ", sample " << k;
    }
  }
}

TEST_P(NormalTest, DegenerateCasesFloat) {
  for (const DegenerateCase& test : kDegenerateCases) {
    expect_case<float>(test);
  }
}
TEST_P(NormalTest, DegenerateCasesDouble) {
  for (const DegenerateCase& test : kDegenerateCases) {
    expect_case<double>(test);
  }
}
TEST_P(NormalTest, PolesOnEverySideFloat) {
  for (int side = 0; side < 4; ++side) {
    expect_good_approach<float>(rounded_to<float>(pole(side)), "pole");
  }
}
TEST_P(NormalTest, PolesOnEverySideDouble) {
  for (int side = 0; side < 4; ++side) {
    expect_good_approach<double>(pole(side), "pole");
  }
}
TEST_P(NormalTest, GradedFloat) { expect_graded_no_worse_than_plain<float>(); }
TEST_P(NormalTest, GradedDouble) { expect_graded_no_worse_than_plain<double>(); }

TEST_P(NormalTest, TeapotPoles) {
  const std::vector<Net> teapot = data_nets("teapot.bpt");
  if (teapot.empty()) {
    GTEST_SKIP() << "no teapot.bpt in " << SIMDBEZIER_SHARED_DATA;
  }
  Random random(50);
  const Matrix3 rotation = random_rotation(random);
  for (const Net& net : teapot) {
    const Net moved = translated(rotated(net, rotation), {17, 17, 17});
    expect_good_approach<float>(rounded_to<float>(net), "teapot");
    expect_good_approach<float>(rounded_to<float>(moved), "teapot, moved");
    expect_good_approach<double>(moved, "teapot, moved");
  }
}
INSTANTIATE_FOR_EVERY_ISA(NormalTest);

} // namespace
} // namespace simdbezier::tests::normal_gates_test
