// Hilbert's curve in three dimensions, by the exchanges and reflections of J. Skilling,
// "Programming the Hilbert curve", AIP Conference Proceedings 707 (2004).
#include <tools/patches/patch_order.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tools/patches/patch_box.hpp>

namespace simdbezier::tools {

namespace {

constexpr int kBits = 21; // of a coordinate, so that three of them fit 64

// Returns how far along the curve a cell is.
std::uint64_t place_on_curve(std::array<std::uint32_t, 3> x) {
  constexpr std::uint32_t kTop = 1U << (kBits - 1);
  for (std::uint32_t q = kTop; q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (std::uint32_t& coordinate : x) {
      if ((coordinate & q) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t t = (x[0] ^ coordinate) & below;
        x[0] ^= t;
        coordinate ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = kTop; q > 1; q >>= 1) {
    t ^= (x[2] & q) != 0 ? q - 1 : 0;
  }
  std::uint64_t place = 0;
  for (int bit = kBits - 1; bit >= 0; --bit) {
    for (const std::uint32_t coordinate : x) {
      place = place << 1 | ((coordinate ^ t) >> bit & 1);
    }
  }
  return place;
}

} // namespace

std::vector<std::uint32_t> curve_order(const PatchFile& file) {
  const MeshBox box = box_of(file);
  double size = 0; // of a cube, so that the curve is no longer in one direction than in others
  for (std::size_t c = 0; c < 3; ++c) {
    size = std::max(size, box.high[c] / 2 - box.low[c] / 2);
  }
  constexpr double kCells = double{1U << kBits};
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places(file.count);
  for (std::uint32_t patch = 0; patch < file.count; ++patch) {
    const MeshBox own = box_of(file, patch, 1);
    std::array<std::uint32_t, 3> cell = {};
    for (std::size_t c = 0; c < 3; ++c) {
      const double middle = own.low[c] / 2 + own.high[c] / 2;
      const double share = size > 0 ? (middle / 2 - box.low[c] / 2) / size : 0;
      cell[c] = static_cast<std::uint32_t>(std::clamp(share * kCells, 0.0, kCells - 1));
    }
    places[patch] = {place_on_curve(cell), patch};
  }
  std::ranges::sort(places);
  std::vector<std::uint32_t> order(file.count);
  std::ranges::transform(places, order.begin(), [](const auto& place) { return place.second; });
  return order;
}

} // namespace simdbezier::tools
