// Parameters far outside of the patch: results are numbers up to the magnitudes that patch_set.hpp
// names, and beyond them normals are still unit vectors or zero.
#include <cmath>
#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/shaped_nets.hpp"

namespace simdbezier::tests::far_parameters_test {
namespace {

constexpr Degrees kShapes[] = {{3, 3}, {4, 4}, {5, 5}, {2, 4}, {3, 5}, {5, 1}, {7, 3}};

/// Both signs of 2^exponent, and the middle, in both directions, for every patch.
template <typename T>
[[nodiscard]] SampleArrays<T> far_samples(std::size_t patches, int exponent, T middle = T(0)) {
  SampleArrays<T> samples;
  const T far = std::ldexp(T(1), exponent);
  for (std::size_t p = 0; p < patches; ++p) {
    for (const T x : {-far, middle, far}) {
      for (const T y : {-far, middle, far}) {
        samples.add(p, x, y);
      }
    }
  }
  return samples;
}

/// Planes with a linear parametrisation: all but two coefficients of a direction are zero, which is
/// nan times a square that is infinite.
[[nodiscard]] std::vector<Net> linear_nets() {
  std::vector<Net> nets;
  for (const Degrees& degrees : kShapes) {
    nets.push_back(shaped_net(degrees, [&](int j, int i) {
      return Vector3{2.0 * i - degrees.u, 2.0 * j - degrees.v, 0}; // exact, so that zeros are
    }));
  }
  return nets;
}

class FarParametersTest : public IsaTest {
protected:
  template <typename T>
  void expect_planes(int exponent) {
    const std::vector<Net> nets = linear_nets();
    const SampleArrays<T> samples = far_samples<T>(nets.size(), exponent);
    Planes<T> planes(samples.patch.size());
    scattered(packed_mixed<T>(nets), samples.view(Parameters::centred), planes.outputs());
    for (std::size_t k = 0; k < planes.count(); ++k) {
      const Degrees& degrees = kShapes[samples.patch[k]];
      EXPECT_EQ(planes.at(0, 0, k), samples.u[k] * static_cast<T>(degrees.u)) << "sample " << k;
      EXPECT_EQ(planes.at(0, 1, k), samples.v[k] * static_cast<T>(degrees.v)) << "sample " << k;
      EXPECT_EQ(planes.at(0, 2, k), 0) << "sample " << k;
    }
  }

  /// Their derivatives: second ones only where `second`, since those of degree 5 take a cube.
  template <typename T>
  void expect_derivatives(int exponent, Parameters kind, bool second) {
    const std::vector<Net> nets = linear_nets();
    const T middle = kind == Parameters::unit ? T(0.5) : T(0);
    const SampleArrays<T> samples = far_samples<T>(nets.size(), exponent, middle);
    Planes<T> planes(samples.patch.size(), {.second = second});
    scattered(packed_mixed<T>(nets), samples.view(kind), planes.outputs());
    for (std::size_t k = 0; k < planes.count(); ++k) {
      const Degrees& degrees = kShapes[samples.patch[k]];
      EXPECT_EQ(planes.at(1, 0, k), static_cast<T>(2 * degrees.u)) << "sample " << k;
      EXPECT_EQ(planes.at(2, 1, k), static_cast<T>(2 * degrees.v)) << "sample " << k;
      for (std::size_t group = 4; second && group < 7; ++group) {
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_EQ(planes.at(group, c, k), 0) << "sample " << k;
        }
      }
    }
  }

  template <typename T>
  void expect_normals(std::initializer_list<int> exponents) {
    Random random(44);
    std::vector<Net> nets;
    for (const Degrees& degrees : kShapes) {
      nets.push_back(shaped_random_net(degrees, random));
      nets.push_back(weighted(shaped_random_net(degrees, random), 2, random));
    }
    const PatchSet<T> set = packed_mixed<T>(nets);
    for (const int exponent : exponents) {
      const SampleArrays<T> samples = far_samples<T>(nets.size(), exponent);
      Planes<T> planes(samples.patch.size());
      scattered(set, samples.view(Parameters::centred), planes.outputs());
      for (std::size_t k = 0; k < planes.count(); ++k) {
        const auto n = planes.vector(3, k);
        const bool none = planes.status()[k] == SampleStatus::degenerate;
        EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), none ? 0 : 1, 1e-5)
            << "2^" << exponent << ", sample " << k << " of net " << samples.patch[k];
      }
    }
  }
};

TEST_P(FarParametersTest, LinearPatchesFloat) { expect_planes<float>(63); }
TEST_P(FarParametersTest, LinearPatchesDouble) { expect_planes<double>(511); }
// u of 2^62 is a centred parameter of 2^63.
TEST_P(FarParametersTest, DerivativesFloat) {
  expect_derivatives<float>(63, Parameters::centred, false);
  expect_derivatives<float>(62, Parameters::unit, false);
  expect_derivatives<float>(42, Parameters::centred, true);
  expect_derivatives<float>(41, Parameters::unit, true);
}
TEST_P(FarParametersTest, DerivativesDouble) {
  expect_derivatives<double>(511, Parameters::centred, false);
  expect_derivatives<double>(510, Parameters::unit, false);
  expect_derivatives<double>(341, Parameters::centred, true);
  expect_derivatives<double>(340, Parameters::unit, true);
}
TEST_P(FarParametersTest, NormalsFloat) { expect_normals<float>({63, 65, 127}); }
TEST_P(FarParametersTest, NormalsDouble) { expect_normals<double>({511, 513, 1023}); }

INSTANTIATE_FOR_EVERY_ISA(FarParametersTest);

} // namespace
} // namespace simdbezier::tests::far_parameters_test
