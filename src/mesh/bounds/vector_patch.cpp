#include "src/mesh/bounds/vector_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/net_points.hpp"
#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {
template <typename S>
bool VectorPatch::read(const ControlNets<S>& nets, std::size_t patch) {
  rational = nets.weights != Weights::none;
  net.resize(static_cast<std::size_t>(nets.degree_u) + 1,
             static_cast<std::size_t>(nets.degree_v) + 1);
  PointBox box;
  double largest_weight = 0;
  for (std::size_t j = 0; j < net.rows; ++j) {
    for (std::size_t i = 0; i < net.columns; ++i) {
      const S* const values =
          values_at(nets, patch, static_cast<std::ptrdiff_t>(i), static_cast<std::ptrdiff_t>(j));
      const Point3 point = point_of(nets, values);
      const auto weight = static_cast<double>(weight_of(nets, values));
      if (!(weight > 0 && std::isfinite(weight) && is_finite(point))) {
        return false;
      }
      net(i, j) = {{point.x[0], point.x[1], point.x[2], weight}};
      box.include(point);
      largest_weight = std::max(largest_weight, weight);
    }
  }
  // Moving a patch does not change its second derivatives, and around its middle values are
  // smallest.
  largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    largest = std::max({largest, std::fabs(box.low(c)), std::fabs(box.high(c))});
  }
  scale = largest > 0 ? power_of_two_below(largest) : PowerOfTwo();
  const PowerOfTwo down = scale.inverse();
  const PowerOfTwo weight_down = power_of_two_below(largest_weight).inverse();
  largest = largest * down;
  double middle[3];
  for (std::size_t c = 0; c < 3; ++c) {
    const double least = box.low(c) * down;
    middle[c] = least + (box.high(c) * down - least) / 2;
  }
  for (ControlVector& v : net.at) {
    v.x[3] = v.x[3] * weight_down;
    for (std::size_t c = 0; c < 3; ++c) {
      v.x[c] = (v.x[c] * down - middle[c]) * v.x[3];
    }
  }
  largest *= largest_weight * weight_down;
  return true;
}

template bool VectorPatch::read(const ControlNets<float>&, std::size_t);
template bool VectorPatch::read(const ControlNets<double>&, std::size_t);

void VectorPatch::shrink_to_point() {
  std::fill(net.at.begin(), net.at.end(), ControlVector{{0, 0, 0, 1}});
  largest = 0;
  scale = PowerOfTwo();
}

double VectorPatch::in_space(double bound) const {
  const double scaled = bound * scale;
  return bound > 0 && scaled < std::numeric_limits<double>::min()
             ? std::nextafter(scaled, std::numeric_limits<double>::infinity())
             : scaled;
}

namespace {

/// Whether a turned net's control vectors come before another's; both have the same sizes.
bool is_before(const VectorNet& net, const PatchTurn& a, const PatchTurn& b) {
  const std::size_t columns = a.transposed ? net.rows : net.columns;
  for (std::size_t k = 0; k < net.at.size(); ++k) {
    const ControlVector& p = a.at(net, k % columns, k / columns);
    const ControlVector& q = b.at(net, k % columns, k / columns);
    if (!std::equal(p.x, p.x + 4, q.x)) {
      return std::lexicographical_compare(p.x, p.x + 4, q.x, q.x + 4);
    }
  }
  return false;
}

} // namespace

PatchTurn PatchTurn::canonical(const VectorNet& net) {
  const bool is_wide = net.columns > net.rows;
  PatchTurn first{false, false, is_wide};
  for (unsigned k = 1; k < 8; ++k) {
    const PatchTurn other{(k & 1) != 0, (k & 2) != 0, ((k & 4) != 0) != is_wide};
    if ((k < 4 || net.columns == net.rows) && is_before(net, other, first)) {
      first = other;
    }
  }
  return first;
}

VectorPatch PatchTurn::turned(const VectorPatch& patch) const {
  VectorPatch result = patch;
  if (transposed) {
    std::swap(result.net.columns, result.net.rows);
  }
  for (std::size_t j = 0; j < result.net.rows; ++j) {
    for (std::size_t i = 0; i < result.net.columns; ++i) {
      result.net(i, j) = at(patch.net, i, j);
    }
  }
  return result;
}

RateFlags PatchTurn::turned(RateFlags flags) const {
  unsigned result = flags & ~(15U | kAllOpen);
  // Of the side at which u, or v, is low or high, as PatchEdge numbers them.
  const auto side_bit = [](bool of_v, unsigned high) {
    return unsigned{kOpenSide} << ((of_v ? 0U : 2U) + high);
  };
  for (unsigned u = 0; u < 2; ++u) {
    for (unsigned v = 0; v < 2; ++v) {
      const unsigned turned_u = u ^ (reversed_u ? 1U : 0U);
      const unsigned turned_v = v ^ (reversed_v ? 1U : 0U);
      const unsigned corner = transposed ? turned_v + 2 * turned_u : turned_u + 2 * turned_v;
      result |= is_forced_through(flags, u + 2 * v) ? unsigned{kThroughCorner} << corner : 0U;
    }
    const unsigned turned_u = u ^ (reversed_u ? 1U : 0U);
    const unsigned turned_v = u ^ (reversed_v ? 1U : 0U);
    result |= (flags & side_bit(false, u)) != 0 ? side_bit(transposed, turned_u) : 0U;
    result |= (flags & side_bit(true, u)) != 0 ? side_bit(!transposed, turned_v) : 0U;
  }
  return static_cast<RateFlags>(result);
}

unsigned PatchTurn::zone_of(unsigned turned_zone) const {
  const unsigned places[2] = {turned_zone % 3, turned_zone / 3};
  const auto place = [&](bool of_v, bool reversed) {
    const unsigned turned = places[of_v != transposed ? 1 : 0];
    return turned == static_cast<unsigned>(Zone::middle) || !reversed ? turned : 1 - turned;
  };
  return place(false, reversed_u) + 3 * place(true, reversed_v);
}

} // namespace simdbezier::detail
