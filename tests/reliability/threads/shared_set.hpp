// A packed set that many threads read at once, and what calls must give on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/evaluation.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests {

/// All patches on n x n samples. Nothing of GoogleTest runs in the calls, which threads make.
struct SharedSet {
  SharedSet(std::size_t patch_count, std::size_t samples)
      : n(samples), nets(mixed_nets(patch_count)), set(packed<float>(nets)),
        grid(Grid<float>::uniform(n, n)), reference(new_planes()) {
    EXPECT_EQ(evaluate(set, grid, reference.outputs(), {.threads = 1}), Status::ok);
  }

  [[nodiscard]] Planes<float> new_planes() const {
    return Planes<float>(nets.size() * n * n, {.second = true});
  }
  /// Values of a call that differ from the reference; 1 where the call fails.
  template <typename Call>
  [[nodiscard]] std::size_t errors(const Call& call) const {
    Planes<float> planes = new_planes();
    const Status status = call(planes.outputs());
    return status == Status::ok ? differing_values(planes, reference) : 1;
  }
  [[nodiscard]] std::size_t grid_errors(const Options& options) const {
    return errors([&](const auto& out) { return evaluate(set, grid, out, options); });
  }
  [[nodiscard]] std::size_t patch_grid_errors(const Options& options) const {
    const std::vector<std::uint32_t> sizes(nets.size(), static_cast<std::uint32_t>(n));
    return errors([&](const auto& out) {
      return evaluate(set, PatchGrids{sizes, sizes}, out, options);
    });
  }

  std::size_t n;
  std::vector<Net> nets;
  PatchSet<float> set;
  Grid<float> grid;
  Planes<float> reference;
};

} // namespace simdbezier::tests
