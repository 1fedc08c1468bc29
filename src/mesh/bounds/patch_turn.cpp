// See patch_turn.hpp.
#include "src/mesh/bounds/patch_turn.hpp"

#include <algorithm>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {
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
