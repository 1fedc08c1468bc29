// See meta_net.hpp.
#include "tests/properties/metamorphic/meta_net.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace simdbezier::tests {
namespace {

/// Where nets with origins lie.
constexpr std::array<double, 3> kAway{8, -16, 24};
constexpr double kUnit = 0x1p-10;

/// new(j, i) = old(from(j, i)), channels as they are.
template <typename From>
[[nodiscard]] MetaNet rearranged(const MetaNet& net, int degree_u, int degree_v, From from) {
  MetaNet result = net;
  result.degree_u = degree_u;
  result.degree_v = degree_v;
  for (int j = 0; j <= degree_v; ++j) {
    for (int i = 0; i <= degree_u; ++i) {
      const auto [old_j, old_i] = from(j, i);
      for (int c = 0; c < net.channels(); ++c) {
        result.at(j, i, c) = net.at(old_j, old_i, c);
      }
    }
  }
  return result;
}

[[nodiscard]] MetaNet transposed(const MetaNet& net) {
  return rearranged(net, net.degree_v, net.degree_u, [](int j, int i) { return std::pair(i, j); });
}
[[nodiscard]] MetaNet reversed_u(const MetaNet& net) {
  return rearranged(net, net.degree_u, net.degree_v,
                    [&](int j, int i) { return std::pair(j, net.degree_u - i); });
}
[[nodiscard]] MetaNet reversed_v(const MetaNet& net) {
  return rearranged(net, net.degree_u, net.degree_v,
                    [&](int j, int i) { return std::pair(net.degree_v - j, i); });
}

/// change(values of one point, its weight)
template <typename Change>
[[nodiscard]] MetaNet with_each_point(MetaNet net, Change change) {
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= net.degree_u; ++i) {
      change(&net.at(j, i, 0), net.weight(j, i));
    }
  }
  return net;
}

[[nodiscard]] MetaNet translated(const MetaNet& net, const std::array<double, 3>& by) {
  return with_each_point(net, [&](double* point, double weight) {
    const double factor = net.weights == Weights::homogeneous ? weight : 1;
    for (int c = 0; c < std::min(net.components, 3); ++c) {
      point[c] += factor * by[static_cast<std::size_t>(c)];
    }
  });
}
[[nodiscard]] MetaNet scaled(const MetaNet& net) {
  return with_each_point(net, [&](double* point, double) {
    std::for_each(point, point + net.components, [](double& value) { value *= kScale; });
  });
}
[[nodiscard]] MetaNet permuted(const MetaNet& net) {
  return with_each_point(net, [&](double* point, double) {
    std::rotate(point, point + 1, point + std::min(net.components, 3));
  });
}
[[nodiscard]] MetaNet reweighted(const MetaNet& net) {
  return with_each_point(net, [&](double* point, double) {
    const int first = net.weights == Weights::homogeneous ? 0 : net.components;
    std::for_each(point + first, point + net.channels(), [](double& value) { value *= kReweight; });
  });
}

/// Q_i = (i P_{i-1} + (n + 1 - i) P_i) / (n + 1), exact because control values are multiples of
/// n+1.
[[nodiscard]] MetaNet elevated_u(const MetaNet& net) {
  const int degree = net.degree_u + 1;
  MetaNet result{degree, net.degree_v, net.components, net.weights, {}};
  result.values.resize(
      static_cast<std::size_t>((degree + 1) * (net.degree_v + 1) * net.channels()));
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= degree; ++i) {
      for (int c = 0; c < net.channels(); ++c) {
        const double before = net.at(j, std::max(i - 1, 0), c);
        const double here = net.at(j, std::min(i, net.degree_u), c);
        result.at(j, i, c) = (i * before + (degree - i) * here) / degree;
      }
    }
  }
  return result;
}
[[nodiscard]] MetaNet elevated(const MetaNet& net) {
  const MetaNet once = elevated_u(net);
  return net.degree_v == 0 ? once : transposed(elevated_u(transposed(once)));
}

/// Copies one point, its weight left alone.
void copy_point(MetaNet& net, int j, int i, int from_j, int from_i) {
  for (int c = 0; c < net.components; ++c) {
    net.at(j, i, c) = net.at(from_j, from_i, c);
  }
}

/// Makes a net degenerate at v = 0; other sides follow by turning the net.
void degenerate_at_v0(MetaNet& net, Kind kind) {
  switch (kind) {
  case Kind::regular:
    return;
  case Kind::collapsed_edge:
    for (int i = 1; i <= net.degree_u; ++i) {
      copy_point(net, 0, i, 0, 0);
    }
    return;
  case Kind::doubled_row:
    for (int i = 0; i <= net.degree_u; ++i) {
      copy_point(net, 1, i, 0, i);
      if (net.weights != Weights::none) {
        net.at(1, i, net.components) = net.at(0, i, net.components);
      }
    }
    return;
  case Kind::collapsed_corner:
    copy_point(net, 0, 1, 0, 0);
    copy_point(net, 1, 0, 0, 0);
  }
}

/// Makes homogeneous values of cartesian ones.
void multiply_weights(MetaNet& net) {
  net = with_each_point(std::move(net), [&](double* point, double weight) {
    std::for_each(point, point + net.components, [&](double& value) { value *= weight; });
  });
}

/// A height field of integers; weights 1 to 4.
[[nodiscard]] MetaNet random_net(int degree_u, int degree_v, const ShapeRow& shape,
                                 Random& random) {
  MetaNet net{degree_u, degree_v, shape.components, shape.weights, {}};
  const double step = kUnit * (degree_u + 1) * (degree_v + 1);
  for (int j = 0; j <= degree_v; ++j) {
    for (int i = 0; i <= degree_u; ++i) {
      const double base[3] = {50.0 * (2 * i - degree_u) / std::max(degree_u, 1),
                              50.0 * (2 * j - degree_v) / std::max(degree_v, 1), 0};
      for (int c = 0; c < shape.components; ++c) {
        const double wave = c < 3 ? base[c] : 0;
        net.values.push_back(step * (std::nearbyint(wave) + random.integer(-9, 9)));
      }
      if (shape.weights != Weights::none) {
        net.values.push_back(random.integer(1, 4) * (degree_u + 1.0) * (degree_v + 1.0));
      }
    }
  }
  return net;
}

/// Differences of one channel: the hodograph's control values, without its factor.
void difference(std::vector<double>& values, int& degree, int stride_out, bool along_u) {
  std::vector<double> result;
  const int rows = along_u ? stride_out : degree;
  const int columns = along_u ? degree : stride_out;
  const int row = along_u ? degree + 1 : stride_out;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto here = static_cast<std::size_t>(j * row + i);
      const std::size_t next = here + static_cast<std::size_t>(along_u ? 1 : row);
      result.push_back(degree * (values[next] - values[here]));
    }
  }
  values = std::move(result);
  --degree;
}

/// max |control value| of every hodograph of a scalar net [j][i].
[[nodiscard]] SizeTable hodograph_sizes(const std::vector<double>& values, int degree_u,
                                        int degree_v) {
  SizeTable sizes{};
  std::vector<double> by_u = values;
  for (std::size_t a = 0; a < kOrders && degree_u >= 0; ++a) {
    std::vector<double> by_v = by_u;
    int rest = degree_v;
    for (std::size_t b = 0; b < kOrders && rest >= 0; ++b) {
      for (const double value : by_v) {
        sizes[a][b] = std::max(sizes[a][b], std::abs(value));
      }
      difference(by_v, rest, degree_u + 1, false);
    }
    difference(by_u, degree_u, degree_v + 1, true);
  }
  return sizes;
}

constexpr double kBinomials[kOrders][kOrders] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};

} // namespace

Placement placement_of(Origin origin) {
  return {origin == Origin::local, origin == Origin::relative ? kAway : std::array<double, 3>{}};
}

MetaNet meta_net(const ShapeRow& shape, Kind kind, std::size_t side, Origin origin,
                 Random& random) {
  const bool turned = side >= 2; // u0 and u1 are v0 and v1 of the transposed net
  MetaNet net = turned ? random_net(shape.degree_v, shape.degree_u, shape, random)
                       : random_net(shape.degree_u, shape.degree_v, shape, random);
  degenerate_at_v0(net, kind);
  net = side % 2 == 1 ? reversed_v(net) : net;
  net = turned ? transposed(net) : net;
  if (net.weights == Weights::homogeneous) {
    multiply_weights(net);
  }
  return origin == Origin::none ? net : translated(net, kAway);
}

MetaNet related(const MetaNet& net, Relation relation) {
  switch (relation) {
  case Relation::transposed:
    return transposed(net);
  case Relation::reversed_u:
    return reversed_u(net);
  case Relation::reversed_v:
    return reversed_v(net);
  case Relation::scaled:
    return scaled(net);
  case Relation::translated:
    return translated(net, kTranslation);
  case Relation::permuted:
    return permuted(net);
  case Relation::elevated:
    return elevated(net);
  default:
    return reweighted(net);
  }
}

Placement related(const Placement& placement, Relation relation, int components) {
  Placement result = placement;
  if (relation == Relation::scaled) {
    for (double& value : result.relative_to) {
      value *= kScale;
    }
  } else if (relation == Relation::permuted) {
    std::rotate(result.relative_to.begin(), result.relative_to.begin() + 1,
                result.relative_to.begin() + std::min(components, 3));
  }
  return result;
}

SizeTable derivative_sizes(const MetaNet& net, int component, const Placement& placement) {
  std::vector<double> h;
  std::vector<double> w;
  const double away =
      component < 3 ? placement.relative_to[static_cast<std::size_t>(component)] : 0;
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= net.degree_u; ++i) {
      w.push_back(net.weight(j, i));
      const double factor = net.weights == Weights::cartesian ? w.back() : 1;
      h.push_back(factor * net.at(j, i, component) - w.back() * away);
    }
  }
  SizeTable sizes = hodograph_sizes(h, net.degree_u, net.degree_v);
  if (net.weights == Weights::none) {
    return sizes;
  }
  const SizeTable weights = hodograph_sizes(w, net.degree_u, net.degree_v);
  const double least = *std::min_element(w.begin(), w.end());
  for (std::size_t a = 0; a < kOrders; ++a) {
    for (std::size_t b = 0; b < kOrders; ++b) {
      for (std::size_t i = 0; i <= a; ++i) {
        for (std::size_t j = i == 0 ? 1 : 0; j <= b; ++j) {
          sizes[a][b] += kBinomials[a][i] * kBinomials[b][j] * weights[i][j] * sizes[a - i][b - j];
        }
      }
      sizes[a][b] /= least;
    }
  }
  return sizes;
}

} // namespace simdbezier::tests
