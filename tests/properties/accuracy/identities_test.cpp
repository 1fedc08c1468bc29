// What is true of surfaces whatever their numbers: a sphere has |P| = 1 and curvature 1, a net of
// one degree more is the same surface, affine maps may be applied before or after evaluation.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/sample_bounds.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/shape_families.hpp"

namespace simdbezier::tests::identities_test {
namespace {

constexpr int kCount = 13;

class IdentityTest : public IsaTest {
protected:
  template <typename T>
  [[nodiscard]] Planes<T> evaluate(const Net& net, const PackOptions& packing = {}) {
    Planes<T> planes(kCount * kCount, {.second = true, .curvature = true});
    grid(packed<T>(std::span(&net, 1), packing), Grid<T>::uniform(kCount, kCount),
         planes.outputs());
    return planes;
  }

  template <typename T>
  [[nodiscard]] static SampleErrors bounds(const Net& net, const Parameters2<T>& at,
                                           bool local_origin = false) {
    const OracleParameter u = OracleParameter::centred(static_cast<double>(at.x));
    const OracleParameter v = OracleParameter::centred(static_cast<double>(at.y));
    const BoundRule rule{kUnitRoundoff<T>, fuses_multiply_add(isa()), local_origin};
    return NetBounds(net, rule).at(oracle_sample(net, u, v), weight_sample(net, u, v));
  }

  template <typename T>
  void expect_sphere(const Net& net, const PackOptions& packing);
  template <typename T>
  void expect_same_surface(const Net& net, const Net& higher);
  template <typename T>
  void expect_affine(const Net& net, Random& random);
};

[[nodiscard]] double dot3(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <typename T>
[[nodiscard]] std::array<double, 3> vector_at(const Planes<T>& planes, std::size_t group,
                                              std::size_t k) {
  const auto value = planes.vector(group, k);
  return {static_cast<double>(value[0]), static_cast<double>(value[1]),
          static_cast<double>(value[2])};
}

template <typename T>
void IdentityTest::expect_sphere(const Net& net, const PackOptions& packing) {
  const Planes<T> planes = evaluate<T>(net, packing);
  const auto parameters = grid_parameters<T>(kCount, kCount);
  for (std::size_t k = 0; k < planes.count(); ++k) {
    const auto p = vector_at(planes, 0, k);
    const SampleErrors allowed = bounds(net, parameters[k], packing.local_origin);
    const double radial = allowed.position[0] + allowed.position[1] + allowed.position[2];
    // In float, |P| is formed in double without error worth the name; in double it costs 4 u.
    EXPECT_NEAR(std::sqrt(dot3(p, p)), 1, radial + 0x1p-50) << "sample " << k;
    // The normal is the position: away from the pole both are known to the tangents' errors.
    const auto normal = vector_at(planes, 3, k);
    const double conditioned = 200 * kUnitRoundoff<T>;
    if (k / kCount + 1 < kCount) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(normal[c], p[c], conditioned * (kCount - 1)) << "sample " << k;
      }
      EXPECT_NEAR(static_cast<double>(planes.curvature(0, k)), 1, conditioned * 4000);
      EXPECT_NEAR(static_cast<double>(planes.curvature(1, k)), -1, conditioned * 4000);
    } else { // the pole, whose normal is a limit
      EXPECT_EQ(planes.status()[k], SampleStatus::limit);
      EXPECT_NEAR(normal[2], 1, 1e-9);
      // du vanishes to the last bit around local origins; else h and w are rounded apart.
      const auto du = vector_at(planes, 1, k);
      const bool vanishes = dot3(du, du) == 0;
      EXPECT_TRUE(vanishes || !packing.local_origin);
      for (std::size_t which = 0; which < 4 && vanishes; ++which) {
        EXPECT_TRUE(std::isnan(planes.curvature(which, k))) << "curvature at the pole";
      }
    }
  }
}

TEST_P(IdentityTest, SphereOctantFloat) {
  expect_sphere<float>(sphere_octant(), {});
  expect_sphere<float>(homogeneous(sphere_octant()), {});
  expect_sphere<float>(sphere_octant(), {.local_origin = true});
}
TEST_P(IdentityTest, SphereOctantDouble) {
  expect_sphere<double>(sphere_octant(), {});
  expect_sphere<double>(homogeneous(sphere_octant()), {});
  expect_sphere<double>(sphere_octant(), {.local_origin = true});
}

/// Small integers, so that raising the degree twice and mapping by small integers is exact.
[[nodiscard]] Net integer_net(Degrees degrees, bool rational, Random& random) {
  const int unit = (degrees.u + 1) * (degrees.u + 2);
  Net net = shaped_net(degrees, [&](int, int) {
    Vector3 point;
    for (double& value : point) {
      value = unit * random.integer(-20, 20);
    }
    return point;
  });
  for (std::size_t k = 0; rational && k < net.points.size(); ++k) {
    net.weights.push_back(unit * random.integer(1, 4));
  }
  net.homogeneous = rational;
  return net;
}

constexpr Degrees kDegrees[] = {{1, 1}, {2, 2}, {2, 3}, {3, 3}, {4, 2},
                                {5, 5}, {4, 6}, {7, 3}, {9, 8}, {13, 13}};

template <typename T>
void IdentityTest::expect_same_surface(const Net& net, const Net& higher) {
  const Planes<T> a = evaluate<T>(net);
  const Planes<T> b = evaluate<T>(higher);
  const auto parameters = grid_parameters<T>(kCount, kCount);
  for (std::size_t k = 0; k < a.count(); ++k) {
    const SampleErrors low = bounds(net, parameters[k]);
    const SampleErrors high = bounds(higher, parameters[k]);
    const Vector3* const allowed[][2] = {
        {&low.position, &high.position}, {&low.du, &high.du},   {&low.dv, &high.dv},  {},
        {&low.duu, &high.duu},           {&low.duv, &high.duv}, {&low.dvv, &high.dvv}};
    for (const std::size_t group : {0U, 1U, 2U, 4U, 5U, 6U}) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double difference = static_cast<double>(a.at(group, c, k)) - // exact enough: both
                                  static_cast<double>(b.at(group, c, k));  // are near each other
        EXPECT_LE(std::abs(difference), (*allowed[group][0])[c] + (*allowed[group][1])[c])
            << "group " << group << ", degrees " << net.degree_u << " x " << net.degree_v;
      }
    }
  }
}

template <typename T>
void IdentityTest::expect_affine(const Net& net, Random& random) {
  int matrix[3][3];
  int offset[3];
  for (int r = 0; r < 3; ++r) {
    for (int& entry : matrix[r]) {
      entry = random.integer(-3, 3);
    }
    offset[r] = random.integer(-500, 500);
  }
  Net mapped = net;
  for (std::size_t p = 0; p < net.points.size(); ++p) {
    for (std::size_t r = 0; r < 3; ++r) {
      mapped.points[p][r] = offset[r] * (net.is_rational() ? net.weights[p] : 1);
      for (std::size_t c = 0; c < 3; ++c) {
        mapped.points[p][r] += matrix[r][c] * net.points[p][c];
      }
    }
  }
  const Planes<T> before = evaluate<T>(net);
  const Planes<T> after = evaluate<T>(mapped);
  const auto parameters = grid_parameters<T>(kCount, kCount);
  for (std::size_t k = 0; k < before.count(); ++k) {
    const SampleErrors own = bounds(net, parameters[k]);
    const SampleErrors image = bounds(mapped, parameters[k]);
    for (std::size_t r = 0; r < 3; ++r) {
      DoubleDouble expected = offset[r];
      double allowed = image.position[r];
      for (std::size_t c = 0; c < 3; ++c) {
        expected = expected + DoubleDouble(static_cast<double>(before.at(0, c, k))) *
                                  static_cast<double>(matrix[r][c]);
        allowed += std::abs(matrix[r][c]) * own.position[c];
      }
      const DoubleDouble difference = expected - static_cast<double>(after.at(0, r, k));
      EXPECT_LE(std::abs(difference.to_double()), allowed)
          << "degrees " << net.degree_u << " x " << net.degree_v;
    }
  }
}

TEST_P(IdentityTest, DegreeElevation) {
  Random random(90);
  for (const Degrees& degrees : kDegrees) {
    for (const bool rational : {false, true}) {
      const Net net = integer_net(degrees, rational, random);
      const Net higher = elevated_u(net);
      expect_same_surface<float>(net, higher);
      expect_same_surface<double>(net, elevated_u(higher));
      expect_same_surface<double>(transposed(net), transposed(higher));
    }
  }
}

TEST_P(IdentityTest, AffineMaps) {
  Random random(91);
  for (const Degrees& degrees : kDegrees) {
    for (const bool rational : {false, true}) {
      const Net net = integer_net(degrees, rational, random);
      expect_affine<float>(net, random);
      expect_affine<double>(net, random);
    }
  }
}

INSTANTIATE_FOR_EVERY_ISA(IdentityTest);

} // namespace
} // namespace simdbezier::tests::identities_test
