#include <tools/patches/edge_counts.hpp>

#include <span>

#include <tools/patches/library_status.hpp>

namespace simdbezier::tools {

TopologyCounts joined_counts(const PatchFile& file) {
  const PatchNets<double> in = file.nets<double>();
  Topology topology;
  check(find_topology(std::span<const ControlNets<double>>(in.nets), topology));
  return topology.counts();
}

EdgeCounts::EdgeCounts(const TopologyCounts& joined)
    : shared(2 * (joined.edges - joined.open_edges - joined.non_manifold_edges)),
      non_manifold(kPatchEdges * joined.patches - joined.collapsed_sides - joined.open_edges -
                   shared),
      boundary(joined.open_edges), collapsed(joined.collapsed_sides) {}

} // namespace simdbezier::tools
