// Normals of small patches far from the origin, as exact as their control points were given: in
// double, in homogeneous form, relative to an origin. What a second look sees must be no coarser.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/shaped_nets.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests::far_normals_test {
namespace {

constexpr int kN = 5;
constexpr std::size_t kSamples = kN * kN;
constexpr double kDistance = 0x1p20;
constexpr double kFloatStep = 0x1p-3; ///< of floats there

struct FarCase {
  Degrees degrees;
  double size;  ///< of the patch, in steps of floats
  double angle; ///< between its parameter lines, 1: right
  bool rational;
  bool homogeneous;
  bool relative; ///< the set's origin is near the patch; else it has local ones
};

std::ostream& operator<<(std::ostream& out, const FarCase& c) {
  return out << c.degrees.u << " x " << c.degrees.v << ", size " << c.size << ", angle " << c.angle
             << (c.homogeneous ? ", homogeneous"
                 : c.rational  ? ", weights"
                               : "")
             << (c.relative ? ", relative" : "");
}

std::vector<FarCase> far_cases() {
  std::vector<FarCase> cases;
  for (const Degrees& degrees : {Degrees{3, 3}, Degrees{2, 3}, Degrees{7, 2}}) {
    for (const auto& [size, angle] :
         {std::pair{0.25, 1.0}, {1, 1}, {4, 1}, {256, 1}, {0x1p16, 0x1p-12}}) {
      for (const int weights : {0, 1, 2}) {
        for (const bool relative : {false, true}) {
          cases.push_back({degrees, size, angle, weights > 0, weights > 1, relative});
        }
      }
    }
  }
  return cases;
}

/// A dish of some float steps across, so that only its points in S are different. Where parameter
/// lines are nearly parallel, the differences that make its normals are as small.
template <typename S>
Net far_net(const FarCase& c, Random& random) {
  const double size = c.size * kFloatStep;
  Net net = shaped_net(c.degrees, [&](int j, int i) {
    const double x = 2.0 * i / c.degrees.u - 1;
    const double y = 2.0 * j / c.degrees.v - 1;
    const double height = 0.4 * x * x - 0.3 * y * y + 0.1 * random.symmetric();
    return Vector3{kDistance + size * (c.angle < 1 ? x + y : x), size * c.angle * y - kDistance,
                   kDistance + size * c.angle * height};
  });
  if (c.rational) {
    net = weighted(std::move(net), 2, random);
  }
  return rounded_to<S>(c.homogeneous ? homogeneous(std::move(net)) : std::move(net));
}

class FarNormals : public IsaTest {
protected:
  /// Normals by kernels, which are good where conditioning is, or by a second look in double. (What
  /// kernels decide in between may be 0.02 degree off.)
  static bool is_decided(double kappa) {
    return kappa > 0 && (kappa < 16 || (kappa > 0x1p11 && kappa < 0x1p16));
  }

  template <typename S>
  void check(const FarCase& c, const Net& net) {
    const std::vector<S> points = packed_points<S>(std::span(&net, 1));
    PackOptions options{.local_origin = !c.relative, .isa = isa()};
    if (c.relative) {
      options.relative_to[0] = options.relative_to[2] = kDistance;
      options.relative_to[1] = -kDistance;
    }
    PatchSet<float> set;
    expect_packed(pack(control_nets<S>(std::span(&net, 1), points), set, options));
    Planes<float> planes(kSamples);
    grid(set, Grid<float>::uniform(kN, kN), planes.outputs());
    for (std::size_t k = 0; k < kSamples; ++k) {
      const double x = 2.0 * static_cast<double>(k % kN) / (kN - 1) - 1;
      const double y = 2.0 * static_cast<double>(k / kN) / (kN - 1) - 1;
      const OracleNormal exact = oracle_normal(net, oracle_sample(net, x, y));
      if (!is_decided(exact.kappa)) {
        continue;
      }
      ++checked_;
      EXPECT_EQ(planes.status()[k], SampleStatus::regular) << c << ", sample " << k;
      double square = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        square += std::pow(static_cast<double>(planes.at(3, i, k)) - exact.direction[i], 2);
      }
      EXPECT_LE(std::sqrt(square) * 180 / std::numbers::pi, 1e-3) << c << ", sample " << k;
    }
  }

  std::size_t checked_ = 0;
};

TEST_P(FarNormals, of_double_points_in_float_sets) {
  Random random(61);
  for (const FarCase& c : far_cases()) {
    check<double>(c, far_net<double>(c, random));
  }
  EXPECT_GT(checked_, 500U) << "hardly any normals were well conditioned";
}

// Homogeneous floats say more than points of floats: h / w lies between them. Those that are nearer
// than the roundings of such floats are one point (src/storage/one_point.hpp).
TEST_P(FarNormals, of_homogeneous_floats) {
  Random random(62);
  for (const FarCase& c : far_cases()) {
    if (c.homogeneous && c.size > 16) {
      check<float>(c, far_net<float>(c, random));
    }
  }
  EXPECT_GT(checked_, 50U) << "hardly any normals were well conditioned";
}
INSTANTIATE_FOR_EVERY_ISA(FarNormals);

} // namespace
} // namespace simdbezier::tests::far_normals_test
