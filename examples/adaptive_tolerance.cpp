// Subdivision to a tolerance: pieces that are flat enough are kept, the others are cut into four,
// and all pieces of a level are one call. flatness() gives a bound for the whole piece, so the two
// triangles of a kept piece are within the tolerance (and their own fold) everywhere.
//
// Neighbours of different levels meet in T-junctions, which a closed mesh would still have to join.
// Grids of their own (PatchGrids) are the other way to spend samples where they count.
#include <array>
#include <cstdio>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "seed/sample_patch.hpp"

using namespace simdbezier;

namespace {

constexpr std::size_t kNet = 48; ///< values of a bicubic net
constexpr double kTolerance = 0.01;

/// Moves the nets that are flat enough to the end of `kept`. Returns false on an error.
bool keep_flat_ones(std::vector<double>& nets, std::vector<double>& kept) {
  std::vector<double> bound(nets.size() / kNet);
  if (!flatness(ControlNets<double>{nets.data(), bound.size()}, bound.data())) {
    return false;
  }
  std::vector<double> rest;
  for (std::size_t k = 0; k < bound.size(); ++k) {
    const auto first = nets.begin() + static_cast<std::ptrdiff_t>(k * kNet);
    std::vector<double>& to = bound[k] <= kTolerance ? kept : rest;
    to.insert(to.end(), first, first + kNet);
  }
  nets = rest;
  return true;
}

/// Cuts every net into four, which follow each other. Returns false on an error.
bool quarter(std::vector<double>& nets) {
  const std::size_t count = nets.size() / kNet;
  std::vector<double> quarters(4 * nets.size());
  std::array<MutableNets<double>, 4> out;
  for (std::size_t k = 0; k < 4; ++k) {
    out[k] = {&quarters[k * kNet], count};
    out[k].patch_stride = 4 * kNet;
  }
  if (!split(ControlNets<double>{nets.data(), count}, 0.5, 0.5, out)) {
    return false;
  }
  nets = quarters;
  return true;
}

} // namespace

int main() {
  std::vector<double> nets = seed::coordinates<double>(seed::sample_patch().points);
  std::vector<double> kept;
  std::printf("level  pieces  flat enough\n");
  for (int level = 0; !nets.empty(); ++level) {
    const std::size_t pieces = nets.size() / kNet;
    const std::size_t before = kept.size();
    if (!keep_flat_ones(nets, kept)) {
      return 1;
    }
    std::printf("%5d  %6zu  %6zu\n", level, pieces, (kept.size() - before) / kNet);
    if (!nets.empty() && !quarter(nets)) {
      return 1;
    }
  }
  std::printf("%zu pieces within %g\n", kept.size() / kNet, kTolerance);

  // The packed set knows which precision will do, since its rounding errors are certified, too.
  PatchSet<float> patches;
  if (!pack(ControlNets<double>{kept.data(), kept.size() / kNet}, patches)) {
    return 1;
  }
  for (const double tolerance : {1e-2, 1e-5, 1e-8}) {
    std::printf("single precision positions are within %g: %s\n", tolerance,
                meets_tolerance(patches, tolerance) ? "certified" : "no");
  }
  return 0;
}
