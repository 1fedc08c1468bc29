// Pairs of patches of any degrees that share one edge, in all 8 x 8 placements: only the degree
// along the edge is common, and with weights those of the edge's points. Where these are all 1, one
// patch may have weights, in either form, and the other one none.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "tests/properties/watertight/shared_edges.hpp"
#include "tests/support/long_form.hpp"
#include "tests/support/nets/shaped_nets.hpp"

namespace simdbezier::tests {

/// mixed: weights of 1 along the edge, and each patch in one of the other three forms.
enum class EdgeForm : std::uint8_t { polynomial, cartesian, homogeneous, mixed };
inline constexpr EdgeForm kEdgeForms[] = {EdgeForm::polynomial, EdgeForm::cartesian,
                                          EdgeForm::homogeneous, EdgeForm::mixed};

struct ShapedEdge {
  std::vector<Vector3> points;
  std::vector<double> weights; ///< empty in polynomial edges
};

/// A patch of a pair, by its number in the batch.
struct ShapedPlaced {
  Placement place;
  std::size_t index = 0;
};

/// What a batch is made of.
struct ShapedEdgeRule {
  int degree = 3; ///< along the edge
  EdgeKind kind = EdgeKind::plain;
  EdgeForm form = EdgeForm::polynomial;
  double weight_ratio = 100;
};

[[nodiscard]] inline ShapedEdge make_shaped_edge(const ShapedEdgeRule& rule, Random& random) {
  const double distance = std::ldexp(1e6, -random.integer(0, 20));
  const double offset = distance * random.sign();
  ShapedEdge edge;
  for (int k = 0; k <= rule.degree; ++k) {
    Vector3 point;
    for (double& value : point) {
      value = edge_value(rule.kind, offset, random);
    }
    edge.points.push_back(point);
    if (rule.form != EdgeForm::polynomial) {
      const double weight = graded_weight(rule.weight_ratio, random.integer(0, 16));
      edge.weights.push_back(rule.form == EdgeForm::mixed ? 1 : weight);
    }
  }
  if (rule.kind == EdgeKind::collapsed) {
    edge.points.assign(edge.points.size(), edge.points[0]);
  } else if (rule.kind == EdgeKind::repeated) {
    edge.points[1 + random.below(edge.points.size() - 1)] = edge.points[0];
  }
  return edge;
}

inline void flip_some_zeros(ShapedEdge& edge, Random& random) {
  for (Vector3& point : edge.points) {
    for (double& value : point) {
      if (value == 0 && random.below(2) == 0) {
        value = -value;
      }
    }
  }
}

/// A random net of the edge's kind with the edge put in place; `across` is its other degree.
[[nodiscard]] inline Net shaped_net_around(const ShapedEdge& edge, Placement place, int across,
                                           const ShapedEdgeRule& rule, Random& random) {
  const bool along_u = place.side < 2;
  const Degrees degrees = along_u ? Degrees{rule.degree, across} : Degrees{across, rule.degree};
  const double offset = edge.points[0][0];
  Net net = shaped_net(degrees, [&](int, int) {
    Vector3 point;
    for (double& value : point) {
      value = edge_value(rule.kind, offset, random);
    }
    return point;
  });
  if (!edge.weights.empty()) {
    net = weighted(std::move(net), rule.weight_ratio, random);
    net.homogeneous = rule.form == EdgeForm::homogeneous;
  }
  for (int k = 0; k <= rule.degree; ++k) {
    const auto from = static_cast<std::size_t>(place.reversed ? rule.degree - k : k);
    side_point(net, place.side, k) = edge.points[from];
    if (!edge.weights.empty()) {
      const int i = place.side == 2 ? 0 : place.side == 3 ? net.degree_u : k;
      const int j = place.side == 0 ? 0 : place.side == 1 ? net.degree_v : k;
      net.weight(j, i) = edge.weights[from];
    }
  }
  return net;
}

struct ShapedEdgeBatch {
  std::vector<Net> nets;
  std::vector<std::pair<ShapedPlaced, ShapedPlaced>> pairs;

  ShapedPlaced add(const ShapedEdge& edge, Placement place, const ShapedEdgeRule& rule,
                   Random& random) {
    // Every other patch as square as it can be: bicubic ones, which have kernels of their own.
    const int across = random.below(2) == 0 ? rule.degree : random.integer(1, 15);
    ShapedEdgeRule own = rule;
    ShapedEdge values = edge;
    if (rule.form == EdgeForm::mixed) {
      own.form = kEdgeForms[random.below(3)];
      values.weights.resize(own.form == EdgeForm::polynomial ? 0 : values.weights.size());
    }
    nets.push_back(shaped_net_around(values, place, across, own, random));
    return {place, nets.size() - 1};
  }
};

/// One pair in each of the 64 combinations of placements; in a quarter of them in the short form,
/// another one for each degree.
[[nodiscard]] inline ShapedEdgeBatch make_shaped_edge_batch(const ShapedEdgeRule& rule,
                                                            Random& random) {
  ShapedEdgeBatch batch;
  for (int a = 0; a < kPlacements; ++a) {
    for (int b = 0; b < kPlacements; ++b) {
      if (!in_form(static_cast<std::size_t>(a + b + rule.degree), 4)) {
        continue;
      }
      ShapedEdge edge = make_shaped_edge(rule, random);
      const ShapedPlaced first = batch.add(edge, placement(a), rule, random);
      flip_some_zeros(edge, random);
      batch.pairs.emplace_back(first, batch.add(edge, placement(b), rule, random));
    }
  }
  return batch;
}

} // namespace simdbezier::tests
