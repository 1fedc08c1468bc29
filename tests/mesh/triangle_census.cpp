#include "tests/mesh/triangle_census.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace simdbezier::tests {
namespace {

struct EdgeUse {
  std::size_t forward = 0;
  std::size_t backward = 0;
};

/// Connected parts of the graph of open edges.
std::size_t count_loops(const std::vector<std::pair<std::size_t, std::size_t>>& edges,
                        std::size_t vertices) {
  std::vector<std::size_t> parent(vertices);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t v) {
    while (parent[v] != v) {
      v = parent[v] = parent[parent[v]];
    }
    return v;
  };
  std::set<std::size_t> touched;
  for (const auto& [a, b] : edges) {
    parent[find(a)] = find(b);
    touched.insert(a);
  }
  std::set<std::size_t> roots;
  for (const std::size_t v : touched) {
    roots.insert(find(v));
  }
  return roots.size();
}

} // namespace

template <typename Index>
TriangleCensus count_triangles(std::span<const Index> triangles, std::size_t vertices) {
  TriangleCensus census;
  std::map<std::pair<std::size_t, std::size_t>, EdgeUse> edges;
  std::vector<bool> used(vertices);
  std::set<std::array<std::size_t, 3>> seen;
  for (std::size_t k = 0; k + 2 < triangles.size(); k += 3) {
    std::array<std::size_t, 3> corners{triangles[k], triangles[k + 1], triangles[k + 2]};
    if (*std::max_element(corners.begin(), corners.end()) >= vertices) {
      ++census.out_of_range;
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t a = corners[c];
      const std::size_t b = corners[(c + 1) % 3];
      used[a] = true;
      EdgeUse& use = edges[{std::min(a, b), std::max(a, b)}];
      ++(a < b ? use.forward : use.backward);
    }
    std::sort(corners.begin(), corners.end());
    census.degenerate += corners[0] == corners[1] || corners[1] == corners[2] ? 1 : 0;
    census.repeated += seen.insert(corners).second ? 0 : 1;
  }
  std::vector<std::pair<std::size_t, std::size_t>> open;
  for (const auto& [ends, use] : edges) {
    const std::size_t sides = use.forward + use.backward;
    if (sides == 1) {
      open.push_back(ends);
    }
    census.crowded += sides > 2 ? 1 : 0;
    census.disagreeing += sides == 2 && use.forward != 1 ? 1 : 0;
  }
  census.open = open.size();
  census.loops = count_loops(open, vertices);
  census.unused = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  census.euler = static_cast<long>(vertices - census.unused) - static_cast<long>(edges.size()) +
                 static_cast<long>(triangles.size() / 3);
  return census;
}

template TriangleCensus count_triangles(std::span<const std::uint32_t>, std::size_t);
template TriangleCensus count_triangles(std::span<const std::uint16_t>, std::size_t);

} // namespace simdbezier::tests
