// Patches of many shapes whose bits must not change; see workload.hpp.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "tests/support/nets/shaped_nets.hpp"
#include "tests/support/workload.hpp"

namespace simdbezier::tests {

struct WorkShape {
  Degrees degrees;
  bool rational = false;
  bool homogeneous = false;
};

/// Whole and cut directions, square and not, with and without weights, bicubic ones among them.
inline constexpr WorkShape kWorkShapes[] = {
    {{3, 3}},        {{1, 1}},  {{2, 2}},       {{3, 3}, true}, {{5, 4}},  {{3, 1}},
    {{7, 3}},        {{2, 6}},  {{2, 2}, true}, {{9, 9}},       {{15, 2}}, {{4, 6}, true, true},
    {{8, 12}, true}, {{1, 15}}, {{3, 3}}};

/// The k-th net of a shape: a height field, far from the origin, or with a side that is a point.
[[nodiscard]] inline Net work_net(const WorkShape& shape, std::size_t k, Random& random) {
  Net net = k % 3 == 1 ? shaped_offset_net(shape.degrees, random, 1e4)
                       : shaped_wave_net(shape.degrees, random);
  for (int i = 1; k % 3 == 2 && i <= net.degree_u; ++i) {
    net.at(0, i) = net.at(0, 0);
  }
  if (shape.rational) {
    net = weighted(std::move(net), 4, random);
  }
  return shape.homogeneous ? homogeneous(std::move(net)) : net;
}

[[nodiscard]] inline std::vector<Net> shape_nets(const WorkShape& shape, std::size_t count) {
  Random random(41);
  std::vector<Net> nets;
  for (std::size_t k = 0; k < count; ++k) {
    nets.push_back(work_net(shape, k, random));
  }
  return nets;
}

/// Shapes in irregular order: runs of one, two and three nets.
[[nodiscard]] inline std::vector<Net> mixed_shape_nets(std::size_t count) {
  Random random(42);
  std::vector<Net> nets;
  while (nets.size() < count) {
    const WorkShape& shape = kWorkShapes[random.below(std::size(kWorkShapes))];
    for (std::size_t run = 1 + random.below(3); run > 0 && nets.size() < count; --run) {
      nets.push_back(work_net(shape, nets.size(), random));
    }
  }
  return nets;
}

inline constexpr Wanted kAllOutputs{.second = true, .curvature = true};

} // namespace simdbezier::tests
