#include <tools/commands/meshes/mesh_links.hpp>

#include <algorithm>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

// Which vertices before the own ones own patches have.
std::vector<bool> used_before(const MeshLayout& layout, SetRange own, std::uint32_t first) {
  std::vector<bool> used(first);
  for (std::size_t p = own.first; p < own.first + own.count && first > 0; ++p) {
    for (std::size_t side = 0; side < kPatchEdges; ++side) {
      const auto edge = static_cast<PatchEdge>(side);
      const std::uint32_t segments = layout.segments(p, edge);
      for (std::uint32_t k = 0; k <= segments; ++k) {
        const std::uint32_t vertex = layout.along(p, edge, k);
        if (vertex < first) {
          used[vertex] = true;
        } else if (k > 0) { // all inner points of an edge belong to one patch
          k = std::max(k, segments - 1);
        }
      }
    }
  }
  return used;
}

// Until the whole mesh is known, a vertex is named by its ghost's place in front of the own
// patches, by what it lies on, and by how many vertices are before it there.
constexpr unsigned kOffsetBits = 32;

std::vector<std::uint64_t> name_vertices_before(const MeshLayout& layout, std::size_t own) {
  std::vector<PatchVertices> ghosts(own);
  for (std::size_t ghost = 0; ghost < ghosts.size(); ++ghost) {
    for (std::size_t k = 0; k < 4; ++k) {
      ghosts[ghost].corners[k] = std::uint64_t{8 * ghost + k} << kOffsetBits;
      ghosts[ghost].edges[k] = std::uint64_t{8 * ghost + 4 + k} << kOffsetBits;
    }
  }
  std::vector<std::uint64_t> names(layout.first_vertex(own));
  check(number_part(layout, {own, 0}, 0, ghosts, names));
  return names;
}

} // namespace

MeshLinks find_mesh_links(const MeshLayout& layout, SetRange own,
                          std::span<const std::uint32_t> numbers,
                          std::span<const ModelPart::Lent> lent) {
  const std::vector<std::uint64_t> names = name_vertices_before(layout, own.first);
  const auto first = static_cast<std::uint32_t>(names.size());
  const auto own_vertices =
      static_cast<std::uint32_t>(layout.first_vertex(own.first + own.count) - first);
  MeshLinks found;
  PartLinks& links = found.links;
  found.before.assign(first, kNoVertex);
  const std::vector<bool> used = used_before(layout, own, first);
  for (std::uint32_t vertex = 0; vertex < first; ++vertex) {
    if (!used[vertex]) {
      continue;
    }
    if (names[vertex] == kUnknownVertex) {
      bad_input("expected ghosts that own what they share, found a vertex of none of them");
    }
    const std::uint64_t place = names[vertex] >> kOffsetBits;
    found.before[vertex] = own_vertices + static_cast<std::uint32_t>(links.foreign.size());
    links.foreign.push_back({numbers[place / 8], static_cast<std::uint32_t>(place % 8),
                             static_cast<std::uint32_t>(names[vertex])});
  }
  for (const ModelPart::Lent& each : lent) {
    if (!links.lent.empty() && links.lent.back().patch == each.patch) {
      continue;
    }
    const auto at = std::ranges::lower_bound(numbers, each.patch) - numbers.begin();
    const SetRange one{static_cast<std::size_t>(at), 1};
    PatchVertices vertices;
    const std::uint64_t before = layout.first_vertex(one.first) - first;
    check(owned_vertices(layout, one, before, std::span(&vertices, 1)));
    LentVertices& lends = links.lent.emplace_back(LentVertices{each.patch});
    for (std::size_t slot = 0; slot < lends.begins.size(); ++slot) {
      // kUnknownVertex becomes kNoVertex.
      lends.begins[slot] =
          static_cast<std::uint32_t>(slot < 4 ? vertices.corners[slot] : vertices.edges[slot - 4]);
    }
  }
  return found;
}

} // namespace simdbezier::tools
