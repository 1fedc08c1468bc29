// One call for rates: which patches go to a kernel, and which to GroupBound.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include <simdbezier/rates.hpp>

#include "src/mesh/radians.hpp"
#include "src/mesh/rates/patch_groups.hpp"
#include "src/mesh/topology/snapping.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/nets/net_call.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::detail {

/// Raises rates until no segment has more than `most` of what is measured in u and in v.
inline CellCounts at_least(const CellCounts& cells, const std::array<double, 2>& measured,
                           double most) {
  const auto segments = [&](std::uint32_t n, double all) {
    const double wanted = std::ceil(all / most);
    return wanted > n ? static_cast<std::uint32_t>(std::min(wanted, 1e9)) : n;
  };
  return {segments(cells.nu, measured[0]), segments(cells.nv, measured[1])};
}

/// One call: bicubic polynomial patches go to a kernel, and all that it leaves goes to GroupBound.
template <typename S>
class RateCall {
public:
  /// run: with an instruction set that is there. Of both kinds of tolerances, `tolerances` count.
  RateCall(std::span<const ControlNets<S>> nets, const Topology& topology,
           const RateOptions& options, const RunOptions& run, const CertifiedRates& out)
      : nets_(nets), topology_(*topology.data()), options_(options), run_(run),
        errors_(options.errors), out_(out),
        most_(std::clamp(options.most_segments, 1U, kMostSegments)) {
    if (!topology_.displacement.empty()) { // of these nets, which may have moved since then
      displacement_ = find_displacements(NetCorners<S>(nets), topology_);
      own_errors_ = displacement_;
      for (std::size_t patch = 0; patch < errors_.size(); ++patch) {
        own_errors_[patch] += errors_[patch];
      }
      errors_ = own_errors_;
    }
    deviations_ = out.deviation;
    if (deviations_.empty()) {
      own_deviations_.resize(out.cells_u.size());
      deviations_ = own_deviations_;
    }
  }

  /// A tolerance is not to blame where snapping has taken more than half of it.
  [[nodiscard]] Report with_snapping_blamed(const Report& report) const {
    const bool snapped = report.status == Status::bad_tolerance && !displacement_.empty() &&
                         wanted(report.item) > 0 &&
                         displacement_[report.item] > wanted(report.item) / 2;
    return snapped ? Report{Status::snap_too_large, report.item} : report;
  }

  /// The rates that are there now.
  [[nodiscard]] std::vector<CellCounts> rates() const {
    std::vector<CellCounts> all(out_.cells_u.size());
    for (std::size_t patch = 0; patch < all.size(); ++patch) {
      all[patch] = rates(patch);
    }
    return all;
  }

  /// Rates of the frame before take the place of chosen ones that have few cells less, if they
  /// hold. Those with fewer cells hardly ever do.
  Report keep(const std::vector<CellCounts>& before) {
    const auto is_open = [&](std::size_t patch, bool) {
      const CellCounts& old = before[patch];
      const CellCounts now = rates(patch);
      const bool covers = old.nu >= now.nu && old.nv >= now.nv;
      return old.nu <= most_ && old.nv <= most_ && (old.nu != now.nu || old.nv != now.nv) &&
             old.product() >= now.product() && old.product() <= options_.keep * now.product() &&
             (covers || !measures());
    };
    return for_groups(is_open, [&](const PatchGroup& open) {
      const auto cells =
          lanes_of(open, CellCounts{1, 1}, [&](auto patch) { return before[patch]; });
      const Lanes<CertifiedCells> certified = open.bound().certify(cells, tolerances(open));
      open.for_lanes([&](std::size_t lane, std::size_t patch) {
        if (certified[lane].bound + error(patch) <= wanted(patch)) {
          put(patch, certified[lane]);
        }
      });
    });
  }

  /// Chooses rates, with their certificates.
  Report choose() {
    is_final_.resize(options_.thorough ? out_.cells_u.size() : 0);
    if (const Report ran = run_kernels(true); !ran) {
      return ran;
    }
    const auto is_open = [&](std::size_t patch, bool kernel) {
      return !kernel || measures() || has_corner(patch) || out_.cells_u[patch] == kUndecided;
    };
    return for_groups(is_open, [&](const PatchGroup& open) {
      const Lanes<double> t = tolerances(open);
      Lanes<CertifiedCells> chosen = open.bound().choose(t, most_);
      if (measures()) {
        Lanes<CellCounts> cells;
        cells.fill({1, 1});
        open.for_lanes([&](std::size_t lane, std::size_t) {
          cells[lane] = measured(open.bound(), lane, chosen[lane].cells);
        });
        chosen = open.bound().raise(cells, t, most_);
      }
      put_chosen(open, chosen);
      open.for_lanes([&](std::size_t lane, std::size_t patch) {
        if (options_.thorough && open.bound().has_point_sets(lane)) {
          is_final_[patch] = 1;
        }
      });
    });
  }

  /// Takes fewer cells than chosen ones where a thorough search finds them. All certificates are
  /// thorough from now on.
  Report choose_fewer() {
    thorough_ = true;
    const auto is_open = [&](std::size_t patch, bool) {
      return is_final_[patch] == 0 && rates(patch).product() > 1;
    };
    return for_groups(is_open, [&](const PatchGroup& open) {
      const auto chosen = lanes_of(open, uncertified({1, 1}), [&](std::size_t patch) {
        return CertifiedCells{rates(patch), deviations_[patch] - error(patch),
                              out_.diagonals[patch]};
      });
      Lanes<CellCounts> least;
      open.for_lanes([&](std::size_t lane, std::size_t) {
        least[lane] = measured(open.bound(), lane, {1, 1});
      });
      const auto fewer = open.bound().fewer(chosen, least, tolerances(open), most_);
      open.for_lanes([&](std::size_t lane, std::size_t patch) {
        if (fewer[lane].cells.product() < rates(patch).product()) {
          put(patch, fewer[lane]);
        }
      });
    });
  }

  /// What has been chosen; bounds include errors.
  [[nodiscard]] std::vector<CertifiedCells> chosen() const {
    std::vector<CertifiedCells> all(out_.cells_u.size());
    for (std::size_t patch = 0; patch < all.size(); ++patch) {
      all[patch] = {rates(patch), deviations_[patch], out_.diagonals[patch]};
    }
    return all;
  }
  /// Patches that have more cells than those `before` take these back, or all patches do. Returns
  /// whether any had more.
  bool take_back(const std::vector<CertifiedCells>& before, bool all) {
    bool any = false;
    for (std::size_t patch = 0; patch < before.size(); ++patch) {
      const CertifiedCells& had = before[patch];
      const bool more = rates(patch).product() > had.cells.product();
      any = any || more;
      if (more || all) {
        put(patch, {had.cells, 0, had.diagonals});
        deviations_[patch] = had.bound;
      }
    }
    return any;
  }

  /// Certifies rates that have been raised since they were `certified`, and raises them further
  /// where that does not hold, since the bound does not fall with every step. The certificates of
  /// all other patches stay, so that none depends on patches elsewhere.
  Report settle(const std::vector<CellCounts>& certified, bool& changed) {
    const auto is_raised = [&](std::size_t patch, bool) {
      return out_.cells_u[patch] != certified[patch].nu ||
             out_.cells_v[patch] != certified[patch].nv;
    };
    std::atomic<bool> any = false;
    const Report report = for_groups(is_raised, [&](const PatchGroup& open) {
      const Lanes<CellCounts> cells = rates(open);
      const Lanes<CertifiedCells> raised = open.bound().raise(cells, tolerances(open), most_);
      open.for_lanes([&](std::size_t lane, std::size_t) {
        any = any || raised[lane].cells.product() != cells[lane].product();
      });
      put_chosen(open, raised);
    });
    changed = any;
    return report;
  }

  /// Certifies the caller's rates, for nets that have not been checked yet, as closely as pays: by
  /// the kernel, and by GroupBound where that one is coarse.
  Report certify_given() {
    for (std::size_t patch = 0; patch < out_.cells_u.size(); ++patch) {
      const auto is_rate = [](std::uint32_t n) { return n >= 1 && n <= kMostSegments; };
      if (!is_rate(out_.cells_u[patch]) || !is_rate(out_.cells_v[patch])) {
        return {Status::bad_rates, patch};
      }
    }
    if (const Report ran = run_kernels(false); !ran) {
      return ran;
    }
    const auto is_open = [&](std::size_t patch, bool kernel) {
      return !kernel || has_corner(patch) || deviations_[patch] < 0;
    };
    return for_groups(is_open, [&](const PatchGroup& open) {
      const Lanes<double> enough{};
      const Lanes<CertifiedCells> certified = open.bound().certify(rates(open), enough);
      open.for_lanes([&](std::size_t lane, std::size_t patch) { put(patch, certified[lane]); });
    });
  }

private:
  template <typename Value>
  using Lanes = GroupBound::Lanes<Value>;

  static bool suits_kernel(const ControlNets<S>& nets) {
    return nets.degree_u == 3 && nets.degree_v == 3 && nets.weights == Weights::none;
  }
  [[nodiscard]] bool has_corner(std::size_t patch) const {
    return has_forced_diagonal(topology_.flags[patch]);
  }
  [[nodiscard]] RateFlags flags_of(std::size_t patch) const {
    RateFlags flags = topology_.flags[patch];
    for (std::size_t side = 0; side < kPatchEdges; ++side) {
      const Side at = topology_.sides[kPatchEdges * patch + side];
      const bool open = !at.collapsed() && topology_.sides_of(at.edge()).size() == 1;
      flags = static_cast<RateFlags>(flags | (open ? kOpenSide << side : 0));
    }
    return flags;
  }
  /// Whether more is asked for than a distance.
  [[nodiscard]] bool measures() const {
    return std::isfinite(options_.longest_edge) || std::isfinite(options_.normal_degrees);
  }
  /// Raises rates to what is asked for besides a distance.
  [[nodiscard]] CellCounts measured(const GroupBound& bound, std::size_t lane,
                                    const CellCounts& cells) const {
    const CellCounts short_edges = at_least(cells, bound.lengths(lane), options_.longest_edge);
    return at_least(short_edges, bound.normal_turns(lane), radians(options_.normal_degrees));
  }
  [[nodiscard]] CellCounts rates(std::size_t patch) const {
    return {out_.cells_u[patch], out_.cells_v[patch]};
  }
  [[nodiscard]] double error(std::size_t patch) const {
    return errors_.empty() ? 0 : errors_[patch];
  }
  [[nodiscard]] double wanted(std::size_t patch) const {
    return options_.tolerances.empty() ? options_.tolerance : options_.tolerances[patch];
  }
  [[nodiscard]] double tolerance(std::size_t patch) const {
    return tolerance_less(wanted(patch), error(patch));
  }

  /// A value for each lane: of(patch), or another one where there is no patch.
  template <typename Value, typename Of>
  static Lanes<Value> lanes_of(const PatchGroup& open, const Value& other, const Of& of) {
    Lanes<Value> lanes;
    lanes.fill(other);
    open.for_lanes([&](std::size_t lane, std::size_t patch) { lanes[lane] = of(patch); });
    return lanes;
  }
  /// Patches fail where no tolerance is left.
  [[nodiscard]] Lanes<double> tolerances(const PatchGroup& open) const {
    open.for_lanes([&](std::size_t lane, std::size_t patch) {
      if (!(tolerance(patch) > 0)) {
        open.fail(lane, Status::bad_tolerance);
      }
    });
    return lanes_of(open, 1.0, [&](std::size_t patch) { return tolerance(patch); });
  }
  [[nodiscard]] Lanes<CellCounts> rates(const PatchGroup& open) const {
    return lanes_of(open, CellCounts{1, 1}, [&](auto patch) { return rates(patch); });
  }
  void put(std::size_t patch, const CertifiedCells& certified) {
    out_.cells_u[patch] = certified.cells.nu;
    out_.cells_v[patch] = certified.cells.nv;
    out_.diagonals[patch] = certified.diagonals;
    deviations_[patch] = certified.bound + error(patch);
  }
  void put_chosen(const PatchGroup& open, const Lanes<CertifiedCells>& chosen) {
    open.for_lanes([&](std::size_t lane, std::size_t patch) {
      const CellCounts& cells = chosen[lane].cells;
      put(patch, chosen[lane]);
      if (cells.nu > most_ || cells.nv > most_) {
        open.fail(lane, Status::bad_tolerance);
      }
    });
  }

  /// Nets that a kernel has seen are looked at again only if some of them may not be finite.
  Report find_faults() const {
    std::size_t first = 0;
    for (const ControlNets<S>& nets : nets_) {
      const auto seen = deviations_.subspan(first, nets.count);
      const bool sound = suits_kernel(nets) && std::all_of(seen.begin(), seen.end(), [](double d) {
                           return d >= kSoundUndecided;
                         });
      const Report checked = sound ? Report{} : find_fault(nets, run_.threads);
      if (!checked) {
        return {checked.status, first + checked.item};
      }
      first += nets.count;
    }
    return {};
  }

  /// Chooses rates, or certifies those that are there, however few their cells. Finds faults.
  Report run_kernels(bool choose) {
    std::size_t first = 0;
    for (const ControlNets<S>& nets : nets_) {
      if (suits_kernel(nets) && nets.count > 0) {
        RateTask<S> task{};
        task.in = view_of(nets);
        task.choose = choose;
        task.fewest_looked = choose ? kFewestLooked : 0;
        task.tolerance = options_.tolerance;
        task.tolerances = options_.tolerances.empty() ? nullptr : &options_.tolerances[first];
        task.errors = errors_.empty() ? nullptr : &errors_[first];
        task.most = most_;
        task.nu = &out_.cells_u[first];
        task.nv = &out_.cells_v[first];
        task.diagonals = &out_.diagonals[first];
        task.deviations = &deviations_[first];
        const Status status =
            run_net_kernel(&NetTable<S>::rates, task, nets.count, kRateValues, run_);
        if (status != Status::ok) {
          return {status};
        }
      }
      first += nets.count;
    }
    return find_faults();
  }

  /// Calls visit(group) for all patches with is_open(patch, whether a kernel has seen it), in
  /// parallel; the report names the lowest one at fault.
  template <typename IsOpen, typename Visit>
  Report for_groups(const IsOpen& is_open, const Visit& visit) {
    std::size_t first = 0;
    for (const ControlNets<S>& nets : nets_) {
      std::vector<std::uint32_t> open;
      for (std::size_t patch = 0; patch < nets.count; ++patch) {
        if (is_open(first + patch, suits_kernel(nets))) {
          open.push_back(static_cast<std::uint32_t>(patch));
        }
      }
      const Report report = visit_groups(
          nets, open, [&](std::size_t patch) { return flags_of(first + patch); }, thorough_,
          run_.isa, run_.threads, [&](const PatchGroup& group) { visit(group.shifted(first)); });
      if (!report) {
        return {report.status, first + report.item};
      }
      first += nets.count;
    }
    return {};
  }

  std::span<const ControlNets<S>> nets_;
  const TopologyData& topology_;
  const RateOptions& options_;
  RunOptions run_;
  std::vector<double> displacement_; ///< by snapping; may be empty
  std::span<const double> errors_;   ///< of vertices, by rounding and by snapping
  std::vector<double> own_errors_;
  const CertifiedRates& out_;
  std::uint32_t most_;
  bool thorough_ = false;
  std::vector<std::uint8_t> is_final_; ///< whether a thorough search would find nothing else
  std::span<double> deviations_;
  std::vector<double> own_deviations_;
};

} // namespace simdbezier::detail
