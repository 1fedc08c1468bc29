// Pairs of random patches that share one edge, in all 8 x 8 placements.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tests/support/nets/net_shapes.hpp"

namespace simdbezier::tests {

/// What the four control points of a shared edge look like.
enum class EdgeKind : std::uint8_t {
  plain,     ///< uniform in [-1,1)
  offset,    ///< a unit edge up to 1e6 from the origin
  collapsed, ///< four equal points
  zeros,     ///< many zeros, whose signs differ between the two patches
  spread,    ///< each coordinate scaled by its own power of two, 2^-40 … 2^40
  repeated   ///< neighbouring points that coincide
};
inline constexpr std::array kEdgeKinds{EdgeKind::plain, EdgeKind::offset, EdgeKind::collapsed,
                                       EdgeKind::zeros, EdgeKind::spread, EdgeKind::repeated};

using Edge = std::array<Vector3, 4>;

/// Which side of its patch the edge is (0: v=0, 1: v=1, 2: u=0, 3: u=1), and whether it runs
/// against the parameter there.
struct Placement {
  int side = 0;
  bool reversed = false;
};
inline constexpr int kPlacements = 8;

[[nodiscard]] inline Placement placement(int number) { return {number / 2, number % 2 != 0}; }

[[nodiscard]] inline double edge_value(EdgeKind kind, double offset, Random& random) {
  const double value = random.symmetric();
  switch (kind) {
  case EdgeKind::offset:
    return offset + value;
  case EdgeKind::zeros:
    return random.below(2) == 0 ? 0.0 : value;
  case EdgeKind::spread:
    return std::ldexp(value, random.integer(-40, 40));
  default:
    return value;
  }
}

[[nodiscard]] inline Edge make_edge(EdgeKind kind, Random& random) {
  const double distance = std::ldexp(1e6, -random.integer(0, 20));
  const double offset = distance * random.sign();
  Edge edge;
  for (Vector3& point : edge) {
    for (double& value : point) {
      value = edge_value(kind, offset, random);
    }
  }
  if (kind == EdgeKind::collapsed) {
    edge[1] = edge[2] = edge[3] = edge[0];
  } else if (kind == EdgeKind::repeated) {
    edge[static_cast<std::size_t>(random.integer(1, 3))] = edge[0];
  }
  return edge;
}

/// The other sign for every other zero: equal as numbers, different as bits.
inline void flip_some_zeros(Edge& edge, Random& random) {
  for (Vector3& point : edge) {
    for (double& value : point) {
      if (value == 0 && random.below(2) == 0) {
        value = -value;
      }
    }
  }
}

/// A random net with the edge put in place. The other points have the edge's own kind, so that a
/// far edge belongs to a far patch.
[[nodiscard]] inline Net net_around(const Edge& edge, Placement place, EdgeKind kind,
                                    Random& random) {
  const double offset = edge[0][0];
  Net net = bicubic([&](int, int) {
    return Vector3{edge_value(kind, offset, random), edge_value(kind, offset, random),
                   edge_value(kind, offset, random)};
  });
  for (int k = 0; k <= 3; ++k) {
    side_point(net, place.side, k) = edge[static_cast<std::size_t>(place.reversed ? 3 - k : k)];
  }
  return net;
}

/// One patch of a pair: its place in one of the batch's two sets.
struct Placed {
  Placement place;
  bool along_v = false; ///< in the set whose edges run in v
  std::size_t index = 0;
};

/// Pairs of patches, sorted into two sets by the direction in which the shared edge runs, since
/// the number of samples along the edge is that of u in one and of v in the other.
struct EdgeBatch {
  std::array<std::vector<Net>, 2> nets; ///< [0] edges in u, [1] edges in v
  std::vector<std::pair<Placed, Placed>> pairs;

  Placed add(const Edge& edge, Placement place, EdgeKind kind, Random& random) {
    const bool along_v = place.side >= 2;
    std::vector<Net>& set = nets[along_v ? 1 : 0];
    set.push_back(net_around(edge, place, kind, random));
    return {place, along_v, set.size() - 1};
  }
};

/// One pair in each of the 64 combinations of placements.
[[nodiscard]] inline EdgeBatch make_edge_batch(EdgeKind kind, Random& random) {
  EdgeBatch batch;
  for (int a = 0; a < kPlacements; ++a) {
    for (int b = 0; b < kPlacements; ++b) {
      Edge edge = make_edge(kind, random);
      const Placed first = batch.add(edge, placement(a), kind, random);
      flip_some_zeros(edge, random);
      batch.pairs.emplace_back(first, batch.add(edge, placement(b), kind, random));
    }
  }
  return batch;
}

/// The index within a patch's nu x nv samples of sample t of N along one side.
[[nodiscard]] inline std::size_t side_sample(Placement place, std::size_t t, std::size_t nu,
                                             std::size_t nv) {
  const std::size_t last = (place.side < 2 ? nu : nv) - 1;
  const std::size_t k = place.reversed ? last - t : t;
  switch (place.side) {
  case 0:
    return k;
  case 1:
    return (nv - 1) * nu + k;
  case 2:
    return k * nu;
  default:
    return k * nu + nu - 1;
  }
}

} // namespace simdbezier::tests
