// Outputs that lie in what the call reads are refused before anything is written.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/output/arena.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::tests::input_overlap_test {
namespace {

/// Three planes, the last of which begins at that place.
Set last_plane_at(std::ptrdiff_t place) {
  return [place](Arena& a, Outputs<float>& out) {
    out.position = V::planes(a.at(0), a.at(N), a.at(place));
  };
}

TEST(OverlapWithInputs, GridParameters) {
  for (const std::ptrdiff_t first : {3000, 3100}) {
    expect_status(kRefused, last_plane_at(first), run_grid);
    expect_status(kRefused, last_plane_at(first + kSideSamples - 1), run_grid);
    expect_status(kRefused, last_plane_at(first - N + 1), run_grid);
    expect_status(Status::ok, last_plane_at(first + kSideSamples), run_grid);
    expect_status(Status::ok, last_plane_at(first - N), run_grid);
  }
  const Set vertices = [](Arena& a, Outputs<float>& out) { out.du = V::xyz(a.at(2900), 40); };
  expect_status(kRefused, vertices, [](Arena& arena, const Outputs<float>& out) {
    return evaluate(patches(), arena.grid, out, CallOptions{.threads = 1, .patch_count = 1});
  });
}

TEST(OverlapWithInputs, Samples) {
  for (const std::ptrdiff_t first : {3200, 3300}) {
    expect_status(kRefused, last_plane_at(first), run_samples);
    expect_status(kRefused, last_plane_at(first + N - 1), run_samples);
    expect_status(kRefused, last_plane_at(first - N + 1), run_samples);
    expect_status(Status::ok, last_plane_at(first + N), run_samples);
    expect_status(Status::ok, last_plane_at(first - N), run_samples);
  }
  const Set on_patches = [](Arena& a, Outputs<float>& out) {
    out.position = V::planes(a.at(0), a.at(N), reinterpret_cast<float*>(a.patch + kSamples - 1));
  };
  expect_status(kRefused, on_patches, run_samples);
  const Set status_on_u = [](Arena& a, Outputs<float>& out) {
    out.position = V::xyz(a.at(0));
    out.status = a.status_at(a.at(3200));
  };
  expect_status(kRefused, status_on_u, run_samples);
}

TEST(OverlapWithInputs, EmptyOnesMeetNothing) {
  constexpr std::uint32_t kSides[kPatches] = {kSide, kSide, kSide};
  Arena arena;
  Outputs<float> out;
  out.duv = V::planes(arena.at(0), arena.at(N), arena.at(2 * N));
  const auto* const inside = reinterpret_cast<const std::size_t*>(arena.at(10));
  EXPECT_EQ(evaluate(patches(), PatchGrids{kSides, kSides, {inside, 0}}, out), Status::ok);
}

TEST(OverlapWithInputs, SizesAndOffsetsOfPatchGrids) {
  constexpr std::uint32_t kSides[kPatches] = {kSide, kSide, kSide};
  constexpr std::size_t kOffsets[kPatches] = {0, kSide * kSide, 2 * kSide * kSide};
  for (int input = 0; input < 3; ++input) {
    Arena arena;
    float* const nu = arena.at(input == 0 ? 10 : 2000);
    float* const nv = arena.at(input == 1 ? 10 : 2100);
    float* const offset = arena.at(input == 2 ? 10 : 2200);
    std::memcpy(nu, kSides, sizeof kSides);
    std::memcpy(nv, kSides, sizeof kSides);
    std::memcpy(offset, kOffsets, sizeof kOffsets);
    const Arena before = arena;
    Outputs<float> out;
    out.duv = V::planes(arena.at(0), arena.at(N), arena.at(2 * N));
    EXPECT_EQ(evaluate(patches(),
                       PatchGrids{{reinterpret_cast<const std::uint32_t*>(nu), kPatches},
                                  {reinterpret_cast<const std::uint32_t*>(nv), kPatches},
                                  {reinterpret_cast<const std::size_t*>(offset), kPatches}},
                       out),
              kRefused)
        << input;
    EXPECT_EQ(std::memcmp(arena.values, before.values, sizeof arena.values), 0);
  }
}

} // namespace
} // namespace simdbezier::tests::input_overlap_test
