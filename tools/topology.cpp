#include <tools/topology.hpp>

#include <algorithm>
#include <array>
#include <span>

namespace simdbezier::tools {

namespace {

using Point = std::span<const double, 3>;

// The four edges of a patch: rows v = 0 and v = 1, columns u = 0 and u = 1.
constexpr std::array<std::array<std::size_t, 4>, 4> kEdgePoints = {
    {{0, 1, 2, 3}, {12, 13, 14, 15}, {0, 4, 8, 12}, {3, 7, 11, 15}}};

/// An edge's control points in the direction that comes first, so that two edges with the same
/// points compare equal however their patches lie. Comparing finite doubles takes -0 for +0.
class EdgePoints {
public:
  EdgePoints(const PatchFile& file, std::size_t edge)
      : first_(file.points.data() + edge / 4 * PatchFile::kCoordinates),
        order_(kEdgePoints[edge % 4]) {
    const std::size_t ends = compare(point(0), point(3)) == 0 ? 1 : 0;
    if (compare(point(ends), point(3 - ends)) > 0) {
      std::ranges::reverse(order_);
    }
  }

  [[nodiscard]] int compare(const EdgePoints& other) const {
    for (std::size_t k = 0; k < 4; ++k) {
      if (const int order = compare(point(k), other.point(k)); order != 0) {
        return order;
      }
    }
    return 0;
  }
  [[nodiscard]] bool collapsed() const {
    return compare(point(0), point(1)) == 0 && compare(point(0), point(2)) == 0 &&
           compare(point(0), point(3)) == 0;
  }

private:
  [[nodiscard]] Point point(std::size_t k) const { return Point(first_ + order_[k] * 3, 3); }
  static int compare(Point a, Point b) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (a[c] != b[c]) {
        return a[c] < b[c] ? -1 : 1;
      }
    }
    return 0;
  }

  const double* first_;
  std::array<std::size_t, 4> order_;
};

} // namespace

EdgeCounts count_edges(const PatchFile& file) {
  EdgeCounts counts;
  std::vector<std::size_t> edges;
  for (std::size_t edge = 0; edge < file.count * 4; ++edge) {
    if (EdgePoints(file, edge).collapsed()) {
      ++counts.collapsed;
    } else {
      edges.push_back(edge);
    }
  }
  const auto compare = [&file](std::size_t a, std::size_t b) {
    return EdgePoints(file, a).compare(EdgePoints(file, b));
  };
  std::ranges::sort(edges, [&](std::size_t a, std::size_t b) { return compare(a, b) < 0; });
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const bool like_previous = k > 0 && compare(edges[k], edges[k - 1]) == 0;
    const bool like_next = k + 1 < edges.size() && compare(edges[k], edges[k + 1]) == 0;
    ++(like_previous || like_next ? counts.shared : counts.boundary);
  }
  return counts;
}

} // namespace simdbezier::tools
