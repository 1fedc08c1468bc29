// See patch_bound.hpp: the control vectors of a patch's second derivatives over its quarters.
#include "src/mesh/rates/patch_bound.hpp"

namespace simdbezier::detail {
namespace {

/// Roundings of a second difference and of what it is formed from, in units of the largest value.
constexpr double kDifferenceError = 64 * 0x1p-53;

void halve_all(const SecondNets& nets, bool in_u, SecondNets (&halves)[2]) {
  halve_net(nets.uu, in_u, halves[0].uu, halves[1].uu);
  halve_net(nets.uv, in_u, halves[0].uv, halves[1].uv);
  halve_net(nets.vv, in_u, halves[0].vv, halves[1].vv);
}

} // namespace

template <typename S>
bool PatchBound::read(const ControlNets<S>& nets, std::size_t patch, std::uint8_t flags) {
  flags_ = flags;
  if (!patch_.read(nets, patch)) {
    return false;
  }
  form_second_nets(patch_.net, nets_);
  find_hulls();
  largest_.fill({});
  halve_all(nets_, true, halves_);
  for (std::size_t u = 0; u < 2; ++u) {
    halve_all(halves_[u], false, parts_);
    take_quarter(u, parts_[0]);
    take_quarter(u + 2, parts_[1]);
  }
  whole_ = {largest_of(nets_.uu, kAll), largest_of(nets_.uv, kAll), largest_of(nets_.vv, kAll)};
  const double m = nets.degree_u;
  const double n = nets.degree_v;
  const double unit = kDifferenceError * patch_.largest;
  doubt_ = {m * (m - 1) * unit, m * n * unit, n * (n - 1) * unit};
  return true;
}

template bool PatchBound::read(const ControlNets<float>&, std::size_t, std::uint8_t);
template bool PatchBound::read(const ControlNets<double>&, std::size_t, std::uint8_t);

/// The largest size of a net's vectors, measured from the hull of some quarters.
double PatchBound::largest_of(const VectorNet& net, QuarterSet quarters) {
  planes_.read(net);
  return sizes_.largest(planes_.list(), hull_of(quarters), patch_.rational);
}

void PatchBound::take_quarter(std::size_t quarter, SecondNets& nets) {
  const auto put = [&](const VectorNet& net, double SecondBounds::*derivative) {
    planes_.read(net);
    const auto size = [&](QuarterSet set) {
      return sizes_.largest(planes_.list(), hull_of(set), patch_.rational);
    };
    const double size_everywhere = patch_.rational ? 0 : size(kAll);
    for (const QuarterSet set : kZones) {
      if ((set >> quarter & 1) != 0) {
        double& largest = largest_[set].*derivative;
        largest = larger_bound(largest, patch_.rational ? size(set) : size_everywhere);
      }
    }
  };
  put(nets.uu, &SecondBounds::uu);
  put(nets.vv, &SecondBounds::vv);
  raise_all(nets, patch_.net);
  RaisedPlanes& planes = quarters_[quarter];
  planes.uu.read(nets.uu);
  planes.uv.read(nets.uv);
  planes.vv.read(nets.vv);
}

/// Polynomial patches have no weights to be bounded, and no vector depends on their hull.
void PatchBound::find_hulls() {
  if (!patch_.rational) {
    hulls_[kAll] = Hull{};
    return;
  }
  HullBox boxes[4];
  halve_net(patch_.net, true, net_halves_[0], net_halves_[1]);
  for (std::size_t u = 0; u < 2; ++u) {
    halve_net(net_halves_[u], false, net_parts_[0], net_parts_[1]);
    boxes[u].include(net_parts_[0]);
    boxes[u + 2].include(net_parts_[1]);
  }
  for (const QuarterSet set : kZones) {
    HullBox box;
    for (std::size_t k = 0; k < 4; ++k) {
      if ((set >> k & 1) != 0) {
        box.include(boxes[k]);
      }
    }
    hulls_[set] = box.hull();
  }
}

} // namespace simdbezier::detail
