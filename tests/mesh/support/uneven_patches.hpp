// Patches whose parameters run unevenly along their surface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/mesh/support/sampled_patch.hpp"

namespace simdbezier::tests {

inline constexpr double kDoubled[] = {0, 0, 1, 1};
inline constexpr double kPower[] = {0, 0, 0, 1};
inline constexpr double kEven[] = {0, 1 / 3.0, 2 / 3.0, 1};
inline constexpr double kArc[3][2] = {{1, 0}, {1, 1}, {0, 1}};

/// A net of formulas: point(i, j) has x, y, z and, where `weights` says so, w.
template <typename PointAt>
TestPatch net_of(std::string name, int degree_u, int degree_v, Weights weights,
                 const PointAt& point) {
  TestPatch patch{std::move(name), degree_u, degree_v, weights, {}};
  for (int j = 0; j <= degree_v; ++j) {
    for (int i = 0; i <= degree_u; ++i) {
      const std::array<double, 4> p = point(i, j);
      patch.values.insert(patch.values.end(), p.begin(), p.begin() + patch.channels());
    }
  }
  return patch;
}

inline TestPatch cone(double top, double weight) {
  return net_of("cone", 2, 1, Weights::cartesian, [&](int i, int j) {
    const double r = j == 0 ? 1 : top;
    return std::array{r * kArc[i][0], r * kArc[i][1], 1.0 * j, i == 1 ? weight : 1};
  });
}
inline TestPatch octant(double u, double v) {
  return net_of("octant", 2, 2, Weights::cartesian, [&](int i, int j) {
    return std::array{kArc[i][0] * kArc[j][0], kArc[i][1] * kArc[j][0], kArc[j][1],
                      (i == 1 ? u : 1) * (j == 1 ? v : 1)};
  });
}
inline TestPatch bicubic_cone() {
  constexpr double kCubic[4][2] = {{1, 0}, {1, 0.5523}, {0.5523, 1}, {0, 1}};
  return net_of("bicubic cone", 3, 3, Weights::none, [&](int i, int j) {
    const double r = 1 - j / 3.0;
    return std::array{r * kCubic[i][0], r * kCubic[i][1], j / 3.0, 1.0};
  });
}
/// A part of a hull through sections whose outermost points stand double, or nearly.
inline TestPatch hull() {
  return net_of("hull", 3, 3, Weights::none, [](int i, int j) {
    constexpr double kAlong[] = {0, 0.05, 0.9, 1.4};
    constexpr double kWide[] = {0, 0.02, 0.25, 0.3};
    return std::array{kAlong[i], kWide[i] * (j > 0 ? 1.0 : 0.3), 0.2 * kDoubled[j] * j, 1.0};
  });
}
inline TestPatch bend(const double (&along)[4], const double (&across)[4]) {
  return net_of(&across[0] == &kDoubled[0] && &along[0] == &kEven[0] ? "bend" : "other bend", 3, 3,
                Weights::none, [&](int i, int j) {
                  return std::array{along[i], across[j], i == 1 || i == 2 ? 0.2 : 0.0, 1.0};
                });
}
inline TestPatch flat(const double (&along)[4]) {
  return net_of("flat square", 3, 3, Weights::none, [&](int i, int j) {
    return std::array{along[i], along[j], 0.0, 1.0};
  });
}

/// Rows and columns that are nearly double.
inline TestPatch nearly_doubled() {
  return net_of("nearly doubled", 3, 3, Weights::none, [](int i, int j) {
    constexpr double kAlong[] = {0, 0.02, 0.4, 1};
    constexpr double kHeight[4][4] = {{0.02, 0.1, 0.14, 0.05},
                                      {0.05, 0.3, 0.31, 0.12},
                                      {0.06, 0.28, 0.35, 0.09},
                                      {0.01, 0.13, 0.1, 0.03}};
    return std::array{kAlong[i], kAlong[j], kHeight[j][i], 1.0};
  });
}

inline const double kRoot = std::sqrt(0.5);

inline std::vector<TestPatch> uneven_patches() {
  return {flat(kDoubled),
          flat(kPower),
          cone(0.3, kRoot),
          cone(0, kRoot),
          cone(0, 1e3),
          bicubic_cone(),
          octant(kRoot, kRoot),
          octant(3, 3),
          octant(10, kRoot),
          octant(1e3, 1e3),
          bend(kEven, kDoubled),
          bend(kPower, kEven),
          hull(),
          nearly_doubled(),
          bend(kDoubled, kPower)};
}

/// A bicubic patch over uneven rows and columns, or one with weights.
inline TestPatch random_patch(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  double along[4] = {0, uniform(random), uniform(random), 1};
  double across[4] = {0, uniform(random), uniform(random), 1};
  std::sort(along, along + 4);
  std::sort(across, across + 4);
  return net_of("random patch " + std::to_string(seed), 3, 3,
                seed % 3 == 0 ? Weights::cartesian : Weights::none, [&](int i, int j) {
                  const double w = std::pow(10, seed % 2 * 3 * uniform(random));
                  const double skew = 0.1 * uniform(random);
                  return std::array{along[i] + skew, across[j] - skew, 0.3 * uniform(random), w};
                });
}

inline std::vector<TestPatch> uneven_and_random_patches(unsigned count) {
  std::vector<TestPatch> all = uneven_patches();
  for (unsigned seed = 0; seed < count; ++seed) {
    all.push_back(random_patch(seed));
  }
  return all;
}

} // namespace simdbezier::tests
