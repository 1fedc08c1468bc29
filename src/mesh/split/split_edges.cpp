#include <simdbezier/topology.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <utility>

#include <simdbezier/nets.hpp>

#include "src/mesh/net_points.hpp"
#include "src/mesh/split/along_finder.hpp"
#include "src/mesh/topology/net_corners.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Where patches are to be cut: for each patch and direction, 2 * patch + (0 in u, 1 in v).
template <typename S>
class Cuts {
public:
  Cuts(const TopologyData& topology, const NetCorners<S>& nets, std::size_t most)
      : topology_(topology), nets_(nets), most_(most), cuts_(2 * topology.patches()),
        pieces_(topology.patches()) {}

  [[nodiscard]] bool any() const { return pieces_ > topology_.patches(); }

  /// Cuts a side's patch, and all across the cut. A cut whose ends are within `near` of those of
  /// another one is that one: the piece between them would have two sides of hardly any length.
  /// False, and nothing has changed, where that makes too many pieces.
  bool insert(std::size_t side, double t, double near) {
    std::vector<Cut> open;
    std::vector<Cut> made;
    const auto add = [&](std::size_t at, double where) {
      open.push_back({2 * (at / kPatchEdges) + (runs_in_u(at) ? 0 : 1), where});
    };
    const std::size_t before = pieces_;
    for (add(side, t); !open.empty() && pieces_ <= most_;) {
      const Cut cut = open.back();
      open.pop_back();
      std::vector<double>& own = cuts_[cut.line];
      if (std::any_of(own.begin(), own.end(),
                      [&](double other) { return is_one(cut, other, near); })) {
        continue;
      }
      own.push_back(cut.t);
      made.push_back(cut);
      pieces_ += cuts_[cut.line ^ 1].size() + 1;
      for (const std::size_t at : sides_of(cut.line)) {
        const Side& along = topology_.sides[at];
        for (const std::uint32_t other : along.collapsed() ? std::span<const std::uint32_t>()
                                                           : topology_.sides_of(along.edge())) {
          const bool against = topology_.sides[other].reversed() != along.reversed();
          add(other, against ? 1 - cut.t : cut.t);
        }
      }
    }
    if (pieces_ <= most_) {
      return true;
    }
    for (const Cut& cut : made) {
      std::erase(cuts_[cut.line], cut.t);
    }
    pieces_ = before;
    return false;
  }

  /// 0, the cuts of a patch in a direction, and 1.
  [[nodiscard]] std::vector<double> bounds(std::size_t patch, std::size_t direction) const {
    std::vector<double> bounds = cuts_[2 * patch + direction];
    bounds.insert(bounds.end(), {0.0, 1.0});
    sort_range(bounds.begin(), bounds.end());
    return bounds;
  }

private:
  struct Cut {
    std::size_t line;
    double t;
  };

  /// The two sides that a cut begins and ends on.
  static std::array<std::size_t, 2> sides_of(std::size_t line) {
    const std::size_t first = kPatchEdges * (line / 2) + (line % 2 == 0 ? 0 : 2);
    return {first, first + 1};
  }
  [[nodiscard]] bool is_one(const Cut& cut, double other, double near) const {
    constexpr double kParameters = 64 * kRoundoff<S>;
    constexpr double kFar = 1.0 / 16; // for `near` to be looked at
    const double apart = std::fabs(other - cut.t);
    const auto is_near = [&](std::size_t side) {
      SideNet net;
      nets_.read_side(side, net);
      const SideCurve curve(net);
      return length(curve.at(other) - curve.at(cut.t)) <= near;
    };
    const std::array<std::size_t, 2> sides = sides_of(cut.line);
    return apart <= kParameters || (apart <= kFar && is_near(sides[0]) && is_near(sides[1]));
  }

  const TopologyData& topology_;
  const NetCorners<S>& nets_;
  std::size_t most_;
  std::vector<std::vector<double>> cuts_;
  std::size_t pieces_;
};

/// What the documented errors of segment() may move points of a patch by.
template <typename S>
double cutting_error(const ControlNets<S>& nets, std::size_t patch) {
  double largest = 0;
  for_points(nets, patch, [&](const Point3& point) {
    largest =
        std::max({largest, std::fabs(point.x[0]), std::fabs(point.x[1]), std::fabs(point.x[2])});
  });
  double least = 1;
  double most = 1;
  for (std::ptrdiff_t j = 0; j <= nets.degree_v; ++j) {
    for (std::ptrdiff_t i = 0; i <= nets.degree_u; ++i) {
      const auto weight = static_cast<double>(weight_of(nets, values_at(nets, patch, i, j)));
      least = i + j == 0 ? weight : std::min(least, weight);
      most = i + j == 0 ? weight : std::max(most, weight);
    }
  }
  const double of_weights = nets.weights == Weights::none ? 1 : 2 * most / least;
  return 1.75 * 4 * (nets.degree_u + nets.degree_v) * kRoundoff<S> * largest * of_weights;
}

/// Puts the pieces of the first patch of a view into `to`.
template <typename S>
Status cut_patch(const ControlNets<S>& one, const PatchPiece& from, const std::vector<double>& u,
                 const std::vector<double>& v, SplitNets<S>& to) {
  const std::size_t size = static_cast<std::size_t>((one.degree_u + 1) * (one.degree_v + 1)) *
                           (one.weights == Weights::none ? 3 : 4);
  const std::size_t count = (u.size() - 1) * (v.size() - 1);
  auto values = std::make_shared<std::vector<S>>(count * size);
  const double error = from.error + cutting_error(one, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k % (u.size() - 1);
    const std::size_t j = k / (u.size() - 1);
    const auto out = MutableNets<S>::packed(values->data() + k * size, 1, one.degree_u,
                                            one.degree_v, 3, one.weights);
    const Report cut = segment<S>(one,
                                  {static_cast<S>(u[i]), static_cast<S>(u[i + 1]),
                                   static_cast<S>(v[j]), static_cast<S>(v[j + 1])},
                                  out, {.threads = 1});
    if (!cut) {
      return cut.status;
    }
    to.pieces.push_back({from.patch, from.whole_u(u[i]), from.whole_u(u[i + 1]), from.whole_v(v[j]),
                         from.whole_v(v[j + 1]), error});
  }
  to.nets.push_back(
      ControlNets<S>::packed(values->data(), count, one.degree_u, one.degree_v, 3, one.weights));
  to.memory.push_back(std::move(values));
  return Status::ok;
}

template <typename S>
Status cut_all(const Cuts<S>& cuts, SplitNets<S>& split) {
  SplitNets<S> cut = split;
  cut.nets.clear();
  cut.pieces.clear();
  std::size_t number = 0;
  for (const ControlNets<S>& view : split.nets) {
    bool is_open = false;
    for (std::size_t patch = 0; patch < view.count; ++patch, ++number) {
      ControlNets<S> one = view;
      one.points += static_cast<std::ptrdiff_t>(patch) * view.patch_stride;
      one.count = 1;
      const std::vector<double> u = cuts.bounds(number, 0);
      const std::vector<double> v = cuts.bounds(number, 1);
      if (u.size() + v.size() > 4) {
        if (const Status status = cut_patch(one, split.pieces[number], u, v, cut); !status) {
          return status;
        }
      } else {
        cut.pieces.push_back(split.pieces[number]);
        if (is_open) {
          ++cut.nets.back().count;
        } else {
          cut.nets.push_back(one);
        }
      }
      is_open = u.size() + v.size() == 4;
    }
  }
  split = std::move(cut);
  return Status::ok;
}

/// Finds where to cut, and does. `again`: whether anything was cut.
template <typename S>
Status split_once(const RunOptions& run, std::size_t most, SplitNets<S>& split, bool& again) {
  const std::span<const ControlNets<S>> nets = split.nets;
  TopologyOptions how;
  how.snap = split.snap;
  Topology topology;
  if (const Status status = find_topology(nets, topology, how, run); !status) {
    return status;
  }
  const NetCorners<S> corners(nets);
  Cuts<S> cuts(*topology.data(), corners, most);
  split.counts = {split.counts.splits, 0, 0};
  for (const Along& along : AlongFinder<S>(corners, *topology.data(), split.snap).find()) {
    bool joined = along.distance <= split.snap;
    for (const double t : {along.t0, along.t1}) {
      joined =
          joined && (t == 0 || t == 1 || cuts.insert(along.side, t, split.snap - along.distance));
    }
    split.counts.splits += joined ? 1 : 0;
    split.counts.unjoined += joined ? 0 : 1;
    split.counts.largest_gap = std::max(split.counts.largest_gap, joined ? 0 : along.distance);
  }
  again = cuts.any();
  return again ? cut_all(cuts, split) : Status(Status::ok);
}

} // namespace
} // namespace detail

template <typename S>
Status split_edges(std::span<const ControlNets<S>> nets, SplitNets<S>& split,
                   const SplitOptions& options, const RunOptions& run) noexcept try {
  const detail::DefaultFpEnvironment environment;
  Topology topology; // which checks all arguments
  TopologyOptions how;
  how.snap = options.snap;
  if (const Status status = find_topology(nets, topology, how, run); !status) {
    return status;
  }
  SplitNets<S> found;
  found.nets.assign(nets.begin(), nets.end());
  double largest = 0;
  int degree = 0;
  for (const ControlNets<S>& view : nets) {
    degree = std::max({degree, view.degree_u, view.degree_v});
    for (std::size_t patch = 0; patch < view.count; ++patch) {
      found.pieces.push_back({static_cast<std::uint32_t>(found.pieces.size())});
      detail::for_points(view, patch, [&](const detail::Point3& point) {
        for (const double x : point.x) {
          largest = std::isfinite(x) ? std::max(largest, std::fabs(x)) : largest;
        }
      });
    }
  }
  found.snap = std::max(options.snap, 64 * (degree + 1) * detail::kRoundoff<S> * largest);
  constexpr std::size_t kMost = 512; // of few patches, all of which may lie around one another
  const std::size_t most =
      options.most_pieces != 0 ? options.most_pieces : std::max(8 * found.pieces.size(), kMost);
  for (bool again = topology.counts().open_edges > 0; again;) {
    if (const Status status = detail::split_once(run, most, found, again); !status) {
      return status;
    }
  }
  split = std::move(found);
  return Status::ok;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

SIMDBEZIER_EXPORT_BOTH_TYPES(split_edges);

} // namespace simdbezier
