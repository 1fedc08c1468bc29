// Random control nets.
#pragma once

#include <cmath>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/curves/curve_oracle.hpp"

namespace simdbezier::tests {

/// Nets of any degrees, packed.
template <typename S>
struct NetBatch {
  std::size_t count;
  int degree_u;
  int degree_v;
  Weights weights;
  std::vector<S> points;

  NetBatch(std::size_t nets, int m, int n, double ratio, std::uint64_t seed)
      : count(nets), degree_u(m), degree_v(n),
        weights(ratio > 0 ? Weights::cartesian : Weights::none) {
    Random random(seed);
    for (std::size_t k = 0; k < nets * static_cast<std::size_t>((m + 1) * (n + 1)); ++k) {
      for (int c = 0; c < 3; ++c) {
        points.push_back(static_cast<S>(random.symmetric()));
      }
      if (ratio > 0) {
        points.push_back(static_cast<S>(std::pow(ratio, random.unit())));
      }
    }
  }
  [[nodiscard]] ControlNets<S> view() const {
    return ControlNets<S>::packed(points.data(), count, degree_u, degree_v, 3, weights);
  }
};

} // namespace simdbezier::tests
