#include "tests/mesh/support/triangle_census.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace simdbezier::tests {
namespace {

/// An edge of a triangle, in the order of its vertices' numbers.
struct EdgeUse {
  std::size_t low;
  std::size_t high;
  bool forward; ///< from the lower number to the higher one

  [[nodiscard]] auto operator<=>(const EdgeUse&) const = default;
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
  for (const auto& [a, b] : edges) {
    parent[find(a)] = find(b);
  }
  std::set<std::size_t> roots;
  for (const auto& [a, b] : edges) {
    roots.insert(find(a));
  }
  return roots.size();
}

/// Counts edges by how many triangles they have, and in which directions; returns the open ones.
std::vector<std::pair<std::size_t, std::size_t>>
count_edges(std::vector<EdgeUse>& uses, TriangleCensus& census, std::size_t& edges) {
  std::sort(uses.begin(), uses.end());
  std::vector<std::pair<std::size_t, std::size_t>> open;
  for (std::size_t k = 0; k < uses.size();) {
    std::size_t sides = 0;
    std::size_t forward = 0;
    const EdgeUse first = uses[k];
    for (; k < uses.size() && uses[k].low == first.low && uses[k].high == first.high; ++k) {
      ++sides;
      forward += uses[k].forward ? 1 : 0;
    }
    if (sides == 1) {
      open.emplace_back(first.low, first.high);
    }
    census.crowded += sides > 2 ? 1 : 0;
    census.disagreeing += sides == 2 && forward != 1 ? 1 : 0;
    ++edges;
  }
  census.open = open.size();
  return open;
}

} // namespace

template <typename Index>
TriangleCensus count_triangles(std::span<const Index> triangles, std::size_t vertices) {
  TriangleCensus census;
  std::vector<EdgeUse> uses;
  std::vector<bool> used(vertices);
  std::vector<std::array<std::size_t, 3>> seen;
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
      uses.push_back({std::min(a, b), std::max(a, b), a < b});
    }
    std::sort(corners.begin(), corners.end());
    census.degenerate += corners[0] == corners[1] || corners[1] == corners[2] ? 1 : 0;
    seen.push_back(corners);
  }
  std::sort(seen.begin(), seen.end());
  census.repeated = static_cast<std::size_t>(seen.end() - std::unique(seen.begin(), seen.end()));
  std::size_t edges = 0;
  census.loops = count_loops(count_edges(uses, census, edges), vertices);
  census.unused = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  census.euler = static_cast<long>(vertices - census.unused) - static_cast<long>(edges) +
                 static_cast<long>(triangles.size() / 3);
  return census;
}

template TriangleCensus count_triangles(std::span<const std::uint32_t>, std::size_t);
template TriangleCensus count_triangles(std::span<const std::uint16_t>, std::size_t);

} // namespace simdbezier::tests
