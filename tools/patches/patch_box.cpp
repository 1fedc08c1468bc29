#include <tools/patches/patch_box.hpp>

#include <algorithm>
#include <limits>

namespace simdbezier::tools {

namespace {

void extend(const ControlNets<double>& nets, MeshBox& box) {
  const std::ptrdiff_t values = nets.point_stride;
  const double* const end =
      nets.points + static_cast<std::ptrdiff_t>(nets.count) * nets.patch_stride;
  for (const double* point = nets.points; point != end; point += values) {
    const double divisor = nets.weights == Weights::homogeneous ? point[3] : 1;
    for (std::size_t c = 0; c < 3; ++c) {
      const double coordinate = point[c] / divisor + 0.0; // -0 becomes 0
      box.low[c] = std::min(box.low[c], coordinate);
      box.high[c] = std::max(box.high[c], coordinate);
    }
  }
}

} // namespace

MeshBox box_of(const PatchFile& file, std::size_t first, std::size_t patches) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  MeshBox box;
  box.low.fill(kInfinity);
  box.high.fill(-kInfinity);
  const std::size_t end = first + std::min(patches, file.count - first);
  constexpr std::size_t kPatches = 256; // so few that a copy of their points is in the cache
  for (; first < end; first += kPatches) {
    const PatchNets<double> block = file.nets<double>(first, std::min(kPatches, end - first));
    for (const ControlNets<double>& nets : block.nets) {
      extend(nets, box);
    }
  }
  return box;
}

bool is_far(const MeshBox& box) { return largest_coordinate(box) > 2 * diagonal_of(box); }

} // namespace simdbezier::tools
