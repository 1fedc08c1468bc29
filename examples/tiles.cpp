// 20 million samples are consumed in the cache, and no memory holds them. Every thread gets its
// finished tiles one by one and keeps what it wants, here a bounding box and the steepest place. At
// the end, what the threads found is put together.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "seed/sample_patch.hpp"

using namespace simdbezier;

namespace {

constexpr std::size_t kPatches = 20000;
constexpr std::size_t n = 32;
constexpr int kThreads = 4;

/// What one thread found, in cache lines of its own.
struct alignas(128) Findings {
  std::size_t samples = 0;
  float steepest = 1; ///< the smallest |z| of a normal: 1 is level, 0 upright
  float low[3] = {HUGE_VALF, HUGE_VALF, HUGE_VALF};
  float high[3] = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};

  void add(const Tile<float>& tile) {
    samples += tile.samples;
    const float* const planes[3] = {tile.out.position.x, tile.out.position.y, tile.out.position.z};
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < tile.samples; ++k) {
        low[c] = std::min(low[c], planes[c][k]);
        high[c] = std::max(high[c], planes[c][k]);
      }
    }
    for (std::size_t k = 0; k < tile.samples; ++k) {
      steepest = std::min(steepest, std::abs(tile.out.normal.z[k]));
    }
  }

  void add(const Findings& other) {
    samples += other.samples;
    steepest = std::min(steepest, other.steepest);
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], other.low[c]);
      high[c] = std::max(high[c], other.high[c]);
    }
  }
};

/// The sample patch again and again, each four units further along x than the one before.
std::vector<float> row_of_patches() {
  const std::vector<float> one = seed::coordinates<float>(seed::sample_patch().points);
  std::vector<float> points;
  for (std::size_t patch = 0; patch < kPatches; ++patch) {
    for (std::size_t k = 0; k < one.size(); ++k) {
      points.push_back(one[k] + (k % 3 == 0 ? static_cast<float>(4 * patch) : 0.0F));
    }
  }
  return points;
}

} // namespace

int main() {
  const std::vector<float> points = row_of_patches();
  PatchSet<float> patches;
  if (!pack(ControlNets<float>{points.data(), kPatches}, patches)) {
    return 1;
  }

  TileFormat format;
  format.outputs = {Output::position, Output::normal};
  std::vector<Findings> findings(kThreads);
  Options options;
  options.threads = kThreads;
  const auto consume = [&](const Tile<float>& tile) {
    findings[static_cast<std::size_t>(tile.worker)].add(tile);
  };
  const Status status =
      evaluate_tiles(patches, Grid<float>::uniform(n, n), format, consume, options);
  if (status != Status::ok) {
    std::fprintf(stderr, "%s\n", to_string(status).data());
    return 1;
  }

  Findings all;
  for (const Findings& found : findings) {
    all.add(found);
  }
  std::printf("%zu samples, the steepest normal has |z| = %.3f\n", all.samples, all.steepest);
  std::printf("low  %9.2f %6.3f %6.3f\nhigh %9.2f %6.3f %6.3f\n", all.low[0], all.low[1],
              all.low[2], all.high[0], all.high[1], all.high[2]);
  return all.samples == kPatches * n * n ? 0 : 1;
}
