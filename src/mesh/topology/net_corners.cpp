#include "src/mesh/topology/net_corners.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "src/runtime/batch.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/sort.hpp"
#include "src/storage/one_point.hpp"

namespace simdbezier::detail {
namespace {

/// Whether two control points of a view are one.
template <typename S>
[[gnu::noinline]] bool are_one(const ControlNets<S>& nets, const S* a, const S* b) noexcept {
  return are_one_point(a, b - a, 2, 3, nets.component_stride, nets.weights);
}

/// The way from an end of a side, whose values begin at `end`, to its first control point that is
/// somewhere else; `stride` leads from one to the next.
template <typename S>
Point3 way_along(const ControlNets<S>& nets, const S* end, std::ptrdiff_t stride, int degree) {
  Point3 way{};
  for (std::ptrdiff_t k = 1; k <= degree && !has_length(way); ++k) {
    const S* const next = end + k * stride;
    way = are_one(nets, end, next) ? Point3{} : point_of(nets, next) - point_of(nets, end);
  }
  return way;
}

/// Whether patch b read in one of eight ways has the values of patch a. As on edges, weights of 1
/// count as none, and their form does not matter.
template <typename S>
bool same_in(const ControlNets<S>& a, std::size_t patch_a, const ControlNets<S>& b,
             std::size_t patch_b, int way) {
  const bool transposed = (way & 1) != 0;
  if (a.degree_u != (transposed ? b.degree_v : b.degree_u) ||
      a.degree_v != (transposed ? b.degree_u : b.degree_v)) {
    return false;
  }
  for (std::ptrdiff_t j = 0; j <= a.degree_v; ++j) {
    for (std::ptrdiff_t i = 0; i <= a.degree_u; ++i) {
      std::ptrdiff_t k = transposed ? j : i;
      std::ptrdiff_t l = transposed ? i : j;
      k = (way & 2) != 0 ? b.degree_u - k : k;
      l = (way & 4) != 0 ? b.degree_v - l : l;
      const S* const p = values_at(a, patch_a, i, j);
      const S* const q = values_at(b, patch_b, k, l);
      const S weight = weight_of(a, p);
      if (weight != weight_of(b, q) || (weight != 1 && a.weights != b.weights)) {
        return false;
      }
      for (std::ptrdiff_t c = 0; c < a.components; ++c) {
        if (p[c * a.component_stride] != q[c * b.component_stride]) {
          return false;
        }
      }
    }
  }
  return true;
}

} // namespace

template <typename S>
void NetCorners<S>::read_side(std::size_t side, SideNet& to) const {
  const auto at = views_.place(side / kPatchEdges);
  const ControlNets<S>& nets = *at.nets;
  const EdgeForm form(nets, static_cast<PatchEdge>(side % kPatchEdges));
  const S* const first = values_at(nets, at.patch, 0, 0) + form.first;
  to.points.clear();
  to.weights.clear();
  for (std::ptrdiff_t k = 0; k <= form.degree; ++k) {
    to.points.push_back(point_of(nets, first + k * form.stride));
    to.weights.push_back(static_cast<double>(weight_of(nets, first + k * form.stride)));
  }
}

template <typename S>
Point3 NetCorners<S>::corner_point(std::size_t corner) const noexcept {
  const auto at = views_.place(corner / kPatchCorners);
  return point_at(*at.nets, at.patch, corner % 2 == 0 ? 0 : at.nets->degree_u,
                  corner % kPatchCorners < 2 ? 0 : at.nets->degree_v);
}

template <typename S>
bool NetCorners<S>::side_within(std::size_t side, double distance) const {
  SideNet net;
  read_side(side, net);
  // Both ends count, so that the sides of an edge agree whichever way they run.
  return net.reach(net.points.front()) <= distance && net.reach(net.points.back()) <= distance;
}

template <typename S>
FreshVector<std::uint8_t> NetCorners<S>::doubts(int threads) const {
  FreshVector<std::uint8_t> doubts(views_.patches());
  auto body = [&](int, std::size_t begin, std::size_t end) {
    views_.for_views(begin, end, [&](const auto& nets, auto view, auto first, auto last) {
      const auto look_at = [&](const auto& look) {
        for (std::size_t patch = first; patch < last; ++patch) {
          doubts[patch] = look.doubts(views_.net(view, patch));
        }
      };
      if (nets.weights == Weights::homogeneous) {
        look_at(QuickLook<S, true>(nets));
      } else {
        look_at(QuickLook<S, false>(nets));
      }
    });
  };
  divide_work(views_.patches(), 15, threads, body);
  return doubts;
}

template <typename S>
bool NetCorners<S>::ends_meet(std::size_t side) const noexcept {
  const auto at = views_.place(side / kPatchEdges);
  const ControlNets<S>& nets = *at.nets;
  const EdgeForm form(nets, static_cast<PatchEdge>(side % kPatchEdges));
  const S* const first = values_at(nets, at.patch, 0, 0) + form.first;
  return are_one(nets, first, first + form.degree * form.stride);
}

template <typename S>
bool NetCorners<S>::sides_leave_together(std::size_t patch, std::size_t corner) const noexcept {
  const auto at = views_.place(patch);
  const ControlNets<S>& nets = *at.nets;
  const bool at_u1 = corner % 2 != 0;
  const bool at_v1 = corner >= 2;
  const S* const end =
      values_at(nets, at.patch, at_u1 ? nets.degree_u : 0, at_v1 ? nets.degree_v : 0);
  const std::ptrdiff_t in_u = at_u1 ? -nets.point_stride : nets.point_stride;
  const std::ptrdiff_t in_v = at_v1 ? -nets.row_stride : nets.row_stride;
  int exponent = 0;
  const Point3 a = scaled_to_one(way_along(nets, end, in_u, nets.degree_u), exponent);
  const Point3 b = scaled_to_one(way_along(nets, end, in_v, nets.degree_v), exponent);
  const Point3 n = cross(a, b);
  constexpr double kSine = 1e-9;
  return dot(a, b) > 0 && dot(n, n) <= kSine * kSine * dot(a, a) * dot(b, b);
}

template <typename S>
std::array<double, 3> NetCorners<S>::lowest_point(std::size_t patch) const noexcept {
  const auto at = views_.place(patch);
  std::array<double, 3> lowest = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  for_points(*at.nets, at.patch, [&](const Point3& point) {
    const std::array<double, 3> x = {point.x[0] + 0.0, point.x[1] + 0.0, point.x[2] + 0.0};
    lowest = is_finite(point) ? std::min(lowest, x) : lowest;
  });
  return lowest;
}

template <typename S>
bool NetCorners<S>::same(std::size_t a, std::size_t b) const noexcept {
  const auto p = views_.place(a);
  const auto q = views_.place(b);
  for (int way = 0; way < 8; ++way) {
    if (same_in(*p.nets, p.patch, *q.nets, q.patch, way)) {
      return true;
    }
  }
  return false;
}

namespace {

/// Marks repetitions among patches with the same four edges, ascending. Equal patches have the same
/// lowest control point; different ones, also the many that may be points, seldom do.
template <typename S>
void mark_repeated_of(const NetCorners<S>& nets, std::span<const std::uint32_t> group,
                      TopologyData& topology) {
  if (group.size() < 2) {
    return;
  }
  std::vector<std::pair<std::array<double, 3>, std::uint32_t>> patches;
  for (const std::uint32_t patch : group) {
    patches.emplace_back(nets.lowest_point(patch), patch);
  }
  sort_range(patches.begin(), patches.end());
  std::vector<std::uint32_t> different; // those with one lowest point
  for (std::size_t k = 0; k < patches.size(); ++k) {
    if (k == 0 || patches[k].first != patches[k - 1].first) {
      different.clear();
    }
    const std::uint32_t patch = patches[k].second;
    const auto original =
        std::find_if(different.begin(), different.end(),
                     [&](std::uint32_t earlier) { return nets.same(earlier, patch); });
    if (original != different.end()) {
      topology.flags[patch] |= kRepeated;
      topology.originals.emplace_back(patch, *original);
    } else {
      different.push_back(patch);
    }
  }
}

/// Numbers of a patch's edges, ascending; ~0 for sides that are points.
using FourEdges = std::array<std::uint32_t, kPatchEdges>;

FourEdges edges_of(const TopologyData& topology, std::size_t patch) {
  FourEdges edges;
  for (std::size_t k = 0; k < kPatchEdges; ++k) {
    const Side& side = topology.sides[kPatchEdges * patch + k];
    edges[k] = side.collapsed() ? ~0U : side.edge();
  }
  sort_range(edges.begin(), edges.end());
  return edges;
}

} // namespace

template <typename S>
void mark_repeated(const NetCorners<S>& nets, std::span<const std::uint32_t> candidates,
                   TopologyData& topology) {
  // Only patches with the same four edges can be the same.
  std::vector<std::pair<FourEdges, std::uint32_t>> patches;
  for (const std::uint32_t patch : candidates) {
    patches.emplace_back(edges_of(topology, patch), patch);
  }
  sort_range(patches.begin(), patches.end());
  for (std::size_t begin = 0, end = 0; begin < patches.size(); begin = end) {
    std::vector<std::uint32_t> group;
    for (end = begin; end < patches.size() && patches[end].first == patches[begin].first; ++end) {
      group.push_back(patches[end].second);
    }
    mark_repeated_of(nets, group, topology);
  }
  sort_range(topology.originals.begin(), topology.originals.end());
  topology.counts.repeated_patches = topology.originals.size();
}

template class NetCorners<float>;
template class NetCorners<double>;
SIMDBEZIER_OF_BOTH_TYPES(mark_repeated);

} // namespace simdbezier::detail
