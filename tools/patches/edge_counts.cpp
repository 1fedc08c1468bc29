#include <tools/patches/edge_counts.hpp>

#include <span>
#include <vector>

#include <tools/patches/library_status.hpp>

namespace simdbezier::tools {

EdgeCounts count_edges(const PatchFile& file) {
  std::vector<EdgeLink> edges(file.count * kPatchEdges);
  const PatchNets<double> in = file.nets<double>();
  check(find_adjacency(std::span<const ControlNets<double>>(in.nets), edges.data()));
  EdgeCounts counts;
  for (const EdgeLink& edge : edges) {
    switch (edge.kind) {
    case EdgeKind::shared:
      ++counts.shared;
      break;
    case EdgeKind::non_manifold:
      ++counts.non_manifold;
      break;
    case EdgeKind::boundary:
      ++counts.boundary;
      break;
    case EdgeKind::collapsed:
      ++counts.collapsed;
      break;
    }
  }
  return counts;
}

} // namespace simdbezier::tools
