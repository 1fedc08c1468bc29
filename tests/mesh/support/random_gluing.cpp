#include "tests/mesh/support/random_gluing.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace simdbezier::tests {
namespace {

/// Corners 2 v + u at the ends of the sides v0, v1, u0, u1.
constexpr std::size_t kEnds[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};

} // namespace

RandomGluing::RandomGluing(unsigned seed) : random_(seed) {
  patches = 1 + random_() % 5;
  sides_.resize(4 * patches);
  parent_.resize(4 * patches);
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  join_sides();
  place_points();
}

std::size_t RandomGluing::find(std::size_t corner) {
  while (parent_[corner] != corner) {
    corner = parent_[corner] = parent_[parent_[corner]];
  }
  return corner;
}

std::size_t RandomGluing::corner(std::size_t side, bool end) {
  return find(side / 4 * 4 + kEnds[side % 4][end ? 1 : 0]);
}

void RandomGluing::join_sides() {
  std::vector<std::size_t> order(sides_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), random_);
  const bool with_points = random_() % 4 == 0;
  while (!order.empty()) {
    const std::size_t a = order.back();
    order.pop_back();
    if (with_points && random_() % 6 == 0) {
      sides_[a].point = has_points = true;
      parent_[corner(a, false)] = corner(a, true);
      continue;
    }
    sides_[a].edge = edges_++;
    if (order.empty() || random_() % 5 == 0) {
      ++open_edges;
      continue;
    }
    const std::size_t b = order.back();
    order.pop_back();
    const bool reversed = random_() % 2 != 0;
    sides_[b] = {sides_[a].edge, reversed, false};
    parent_[corner(a, false)] = corner(b, reversed);
    parent_[corner(a, true)] = corner(b, !reversed);
    folded = folded || (a / 4 == b / 4 && (a % 4 < 2) != (b % 4 < 2));
  }
}

RandomGluing::Point RandomGluing::random_point() {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double x = uniform(random_);
  const double y = uniform(random_);
  return {x, y, uniform(random_)};
}

void RandomGluing::place_points() {
  std::map<std::size_t, Point> corners;
  std::vector<std::array<Point, 2>> edges(edges_);
  for (auto& edge : edges) {
    edge = {random_point(), random_point()};
  }
  values.resize(48 * patches);
  const auto put = [&](std::size_t patch, std::size_t i, std::size_t j, const Point& point) {
    std::copy(point.begin(), point.end(), &values[48 * patch + 3 * (4 * j + i)]);
  };
  for (std::size_t patch = 0; patch < patches; ++patch) {
    for (std::size_t k = 0; k < 16; ++k) {
      put(patch, k % 4, k / 4, random_point());
    }
    for (std::size_t c = 0; c < 4; ++c) {
      const auto [at, fresh] = corners.try_emplace(find(4 * patch + c));
      if (fresh) {
        at->second = random_point();
      }
      put(patch, c % 2 * 3, c / 2 * 3, at->second);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const Joint& side = sides_[4 * patch + k];
      for (std::size_t q = 1; q < 3; ++q) {
        const Point point = side.point ? corners[corner(4 * patch + k, false)]
                                       : edges[side.edge][side.reversed ? 2 - q : q - 1];
        const std::size_t across = k % 2 * 3;
        put(patch, k < 2 ? q : across, k < 2 ? across : q, point);
      }
    }
  }
}

} // namespace simdbezier::tests
