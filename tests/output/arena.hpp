// Inputs and room for outputs in one array, so that anything can overlap anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>

#include <gtest/gtest.h>

#include "tests/support/canvas.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests {

inline constexpr std::size_t kPatches = 3;
inline constexpr std::size_t kSide = 4;
inline constexpr std::ptrdiff_t kSideSamples = kSide;
inline constexpr std::size_t kSamples = kPatches * kSide * kSide;
inline constexpr auto N = static_cast<std::ptrdiff_t>(kSamples);

struct Arena {
  static constexpr std::size_t kValues = 4096;
  alignas(64) float values[kValues];
  std::uint32_t patch[2 * kSamples];
  Grid<float> grid{kSide, kSide, at(3000), at(3100)};
  Samples<float> samples{{patch, kSamples}, {at(3200), kSamples}, {at(3300), kSamples}};

  Arena() {
    for (std::size_t k = 0; k < kValues; ++k) {
      values[k] = static_cast<float>(k % 64) / 64;
    }
    for (std::size_t k = 0; k < 2 * kSamples; ++k) {
      patch[k] = static_cast<std::uint32_t>(k % kPatches);
    }
  }
  [[nodiscard]] float* at(std::ptrdiff_t k) { return values + k; }
  [[nodiscard]] SampleStatus* status_at(float* place) {
    return reinterpret_cast<SampleStatus*>(place);
  }
};

/// Chooses a call's outputs.
using Set = std::function<void(Arena&, Outputs<float>&)>;
using V = Vectors<float>;
inline constexpr Status kRefused = Status::overlapping_outputs;

[[nodiscard]] inline const PatchSet<float>& patches() {
  static const PatchSet<float> set = packed<float>(mixed_nets(kPatches));
  return set;
}

/// Runs `call` on a fresh arena and tells whether anything in it was written.
template <typename Call>
void expect_status(Status expected, const Set& set, const Call& call) {
  Arena arena;
  const Arena before = arena;
  Outputs<float> out;
  set(arena, out);
  EXPECT_EQ(to_string(call(arena, out)), to_string(expected));
  const bool untouched = std::memcmp(arena.values, before.values, sizeof arena.values) == 0 &&
                         std::memcmp(arena.patch, before.patch, sizeof arena.patch) == 0;
  EXPECT_EQ(untouched, expected != Status::ok);
}

[[nodiscard]] inline Status run_grid(Arena& arena, const Outputs<float>& out) {
  return evaluate(patches(), arena.grid, out, {.threads = 1});
}
[[nodiscard]] inline Status run_samples(Arena& arena, const Outputs<float>& out) {
  return evaluate(patches(), arena.samples, out, {.threads = 1});
}
[[nodiscard]] inline Status run_patch_grids(Arena& /*arena*/, const Outputs<float>& out) {
  static constexpr std::uint32_t kSides[kPatches] = {kSide, kSide, kSide};
  return evaluate(patches(), PatchGrids{kSides, kSides}, out, {.threads = 1});
}

} // namespace simdbezier::tests
