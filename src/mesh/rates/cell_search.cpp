// See group_bound.hpp: the fewest cells whose bound is at most a tolerance.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "src/mesh/bounds/group_bound.hpp"
#include "src/mesh/rates/filip_terms.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier::detail {
namespace {

/// Cells as one number, in the order in which they are looked at: fewer ones first, and of as many
/// those with fewer in u. Rates are below 2^16.
class CellRank {
public:
  CellRank() = default;
  explicit CellRank(const CellCounts& cells)
      : value_((std::uint64_t{cells.nu} * cells.nv) << 32 | std::uint64_t{cells.nu} << 16 |
               cells.nv) {}

  [[nodiscard]] CellCounts cells() const {
    return {static_cast<std::uint32_t>(value_ >> 16 & 0xffff),
            static_cast<std::uint32_t>(value_ & 0xffff)};
  }
  friend bool operator<(const CellRank& a, const CellRank& b) { return a.value_ < b.value_; }

private:
  std::uint64_t value_ = 0;
};

/// What one patch has tried and will try: candidates in the order of their cells, so that the first
/// that holds is the best one, and given cells, which are tried where no candidate of fewer cells
/// holds, and raised until they do. Filip's bound gives cells that hold, except where a corner's
/// diagonal is forced, of which it knows nothing.
class CellTrials {
public:
  CellTrials() = default;
  /// The cells to be raised, and no candidates.
  CellTrials(const CellCounts& to_raise, std::uint32_t most) : most_(most), best_(to_raise) {
    move_on();
  }
  /// With candidates near a pair of rates.
  CellTrials(const CellCounts& to_raise, const CellCounts& centre, std::uint32_t most)
      : most_(most), best_(to_raise), count_(std::size(candidates_)) {
    const auto near_centre = [&](std::uint32_t n, std::int64_t step) {
      return static_cast<std::uint32_t>(std::clamp<std::int64_t>(std::int64_t{n} + step, 1, most));
    };
    for (std::int64_t k = 0; k < 16; ++k) {
      candidates_[k] =
          CellRank({near_centre(centre.nu, k / 4 - 1), near_centre(centre.nv, k % 4 - 1)});
    }
    sort_range(std::begin(candidates_), std::end(candidates_));
    move_on();
  }

  [[nodiscard]] bool done() const { return done_; }
  /// The cells to be looked at, or the result.
  [[nodiscard]] const CellCounts& cells() const { return result_.cells; }
  [[nodiscard]] const CertifiedCells& result() const { return result_; }

  /// The cells do not hold.
  void reject() {
    if (!raising_) {
      ++next_;
      move_on();
    } else if (result_.cells.nu == most_ && result_.cells.nv == most_) {
      take_raised(uncertified({most_ + 1, most_ + 1}));
    } else {
      result_.cells = {std::min(most_, result_.cells.nu + 1),
                       std::min(most_, result_.cells.nv + 1)};
    }
  }
  void accept(double bound, std::uint16_t diagonals) {
    const CertifiedCells certified{result_.cells, bound, diagonals};
    if (raising_) {
      take_raised(certified);
    } else {
      finish(certified);
    }
  }

private:
  void take_raised(const CertifiedCells& certified) {
    raised_ = certified;
    best_ = certified.cells;
    raising_ = false;
    has_raised_ = true;
    move_on();
  }
  void finish(const CertifiedCells& certified) {
    result_ = certified;
    done_ = true;
  }
  /// Goes on to the next candidate, to raising, or to the end.
  void move_on() {
    const bool is_candidate = next_ < count_ && candidates_[next_] < CellRank(best_);
    if (is_candidate && (!has_raised_ || best_.nu <= most_)) {
      result_ = uncertified(candidates_[next_].cells());
    } else if (has_raised_) {
      finish(raised_);
    } else if (best_.nu > most_ || best_.nv > most_) {
      take_raised(uncertified(best_));
    } else {
      raising_ = true;
      result_ = uncertified(best_);
    }
  }

  std::uint32_t most_ = 0;
  CellCounts best_{}; ///< to be raised, or raised
  CellRank candidates_[16];
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  bool raising_ = false;
  bool has_raised_ = false;
  bool done_ = false;
  CertifiedCells raised_{};
  CertifiedCells result_{};
};

} // namespace

/// The trials of all lanes side by side. A few vectors refuse most cells that do not hold: the
/// leading ones, which set the bound of an even pair of rates. Lanes whose cells pass these wait
/// for the others, so that all vectors are looked at for all lanes at once.
class GroupBound::Search {
public:
  /// has_leading: whether leading vectors have been found.
  Search(const GroupBound& group, const Lanes<double>& t, bool has_leading)
      : group_(group), t_(t), first_phase_(has_leading ? 0 : kLastPhase) {}

  [[nodiscard]] Lanes<CertifiedCells> run(Lanes<CellTrials>& trials) const {
    Lanes<std::size_t> phases;
    phases.fill(first_phase_);
    for (;;) {
      std::size_t phase = kLastPhase + 1;
      for (std::size_t lane = 0; lane < group_.count_; ++lane) {
        phase = trials[lane].done() ? phase : std::min(phase, phases[lane]);
      }
      if (phase > kLastPhase) {
        break;
      }
      LaneSet lanes = 0;
      for (std::size_t lane = 0; lane < group_.count_; ++lane) {
        lanes |= !trials[lane].done() && phases[lane] == phase ? 1U << lane : 0;
      }
      look_in(phase, lanes, phases, trials);
    }
    Lanes<CertifiedCells> results;
    for (std::size_t lane = 0; lane < group_.count_; ++lane) {
      results[lane] = trials[lane].result();
    }
    return results;
  }

private:
  static constexpr std::size_t kLastPhase = 2;
  /// Zones across the middle take far longer than those of quarters where there are weights.
  [[nodiscard]] unsigned zones_in(std::size_t phase) const {
    return !group_.group_.rational || phase == kLastPhase ? kAllZones
           : phase == 0                                   ? kQuarterZones
                                                          : kAllZones & ~kQuarterZones;
  }
  [[nodiscard]] std::size_t after(std::size_t phase) const {
    return group_.group_.rational ? phase + 1 : kLastPhase;
  }
  /// What a bound by leading vectors may be above the one by all of them, because of roundings.
  static constexpr double kLeadingRounding = 1 - 1e-9;

  void look_in(std::size_t phase, LaneSet lanes, Lanes<std::size_t>& phases,
               Lanes<CellTrials>& trials) const {
    const bool last = phase == kLastPhase;
    Lanes<CellCounts> cells;
    cells.fill({2, 2}); // zones that no lane has are left out
    for (std::size_t lane = 0; lane < group_.count_; ++lane) {
      cells[lane] = (lanes >> lane & 1) != 0 ? trials[lane].cells() : cells[lane];
    }
    const LaneSegments segments = group_.segments_of(cells);
    const BoundKernels& kernels = group_.kernels_;
    CellBounds bounds;
    (last ? kernels.bound : kernels.leading)(group_.group_, segments, zones_in(phase), bounds);
    if (last) {
      group_.include_corners(lanes, segments, bounds);
    }
    for (std::size_t lane = 0; lane < group_.count_; ++lane) {
      if ((lanes >> lane & 1) == 0) {
        continue;
      }
      const double found = bounds.bound[lane] * (last ? 1 : kLeadingRounding);
      const double bound = group_.smaller_in_space(lane, trials[lane].cells(), found);
      if (!(bound <= t_[lane])) {
        trials[lane].reject();
        phases[lane] = first_phase_;
      } else if (last) {
        trials[lane].accept(bound, static_cast<std::uint16_t>(bounds.falling[lane]));
        phases[lane] = first_phase_;
      } else {
        phases[lane] = after(phase);
      }
    }
  }

  const GroupBound& group_;
  const Lanes<double>& t_;
  std::size_t first_phase_;
};

CellCounts GroupBound::filip(std::size_t lane, double tolerance, std::uint32_t most) const {
  // Derivatives are far below the largest limit: one cell keeps it, and no quotient overflows.
  constexpr double kLargestLimit = 1e30;
  const double slack = 8 / (kRounding * step_slack(most) * step_slack(most));
  const double t = tolerance * patches_[lane].scale.inverse();
  const FilipTerms general{whole_.largest.uu[lane] + group_.doubt.uu[lane],
                           whole_.largest.uv[lane] + group_.doubt.uv[lane],
                           whole_.largest.vv[lane] + group_.doubt.vv[lane],
                           std::min(kLargestLimit, slack * t * whole_.hull.smallest_weight[lane])};
  const CellCounts best = general.fewest(most);
  const SeparableBound& other = separable_[lane];
  if (!(other.off < t)) {
    return best;
  }
  const FilipTerms separable{other.uu, other.uv, other.vv,
                             std::min(kLargestLimit, slack * (t - other.off))};
  const CellCounts cells = separable.fewest(most);
  return cells.product() < best.product() ? cells : best;
}

GroupBound::Lanes<CertifiedCells> GroupBound::raise(const Lanes<CellCounts>& cells,
                                                    const Lanes<double>& t,
                                                    std::uint32_t most) const {
  Lanes<CellTrials> trials;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    trials[lane] = CellTrials(cells[lane], most);
  }
  Lanes<CertifiedCells> raised = Search(*this, t, false).run(trials);
  for (std::size_t lane = 0; lane < count_; ++lane) {
    CellCounts fewer = cells[lane];
    while (std::max(fewer.nu, fewer.nv) <= most && fewer.product() < raised[lane].cells.product()) {
      const double stop = in_patch(lane, t[lane]);
      SpaceBound* const space = space_of(lane, raised[lane]);
      if (space == nullptr) {
        break;
      }
      take_if_close(lane, space->certify(fewer, stop, stop / 2), raised[lane]);
      fewer = {fewer.nu + 1, fewer.nv + 1};
    }
  }
  return raised;
}

GroupBound::Lanes<CertifiedCells> GroupBound::fewer(const Lanes<CertifiedCells>& chosen,
                                                    const Lanes<CellCounts>& least,
                                                    const Lanes<double>& t,
                                                    std::uint32_t most) const {
  Lanes<CertifiedCells> found = chosen;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    SpaceBound* const space = space_of(lane, chosen[lane], thorough_ ? 2 : kFewestLooked);
    if (space != nullptr) {
      const SpaceSearch search{chosen[lane].cells, least[lane], most, in_patch(lane, t[lane]),
                               thorough_};
      take_if_close(lane, space->choose(search, *bends_[lane]), found[lane]);
    }
  }
  return found;
}

GroupBound::Lanes<CertifiedCells> GroupBound::choose(const Lanes<double>& t,
                                                     std::uint32_t most) const {
  // Rates near those that the bound of an even pair, in proportion to the tolerance, asks for.
  Lanes<CellCounts> best;
  Lanes<CellCounts> even;
  best.fill({1, 1});
  even.fill({1, 1});
  const auto even_below = [](std::uint32_t n) { return std::max(2U, n & ~1U); };
  LaneSet beyond = 0;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    best[lane] = filip(lane, t[lane], most);
    if (best[lane].nu > most) { // beyond Filip's bound ours may still hold
      beyond |= 1U << lane;
      best[lane] = {most, most};
    }
    even[lane] = {even_below(best[lane].nu), even_below(best[lane].nv)};
  }
  const Lanes<CertifiedCells> at_most = beyond != 0 ? certify(best, t) : Lanes<CertifiedCells>{};
  const LaneSegments pairs = segments_of(even);
  CellBounds bounds;
  kernels_.lead(group_, pairs, bounds); // even rates have no other zones
  include_corners(all_lanes(), pairs, bounds);
  Lanes<CellTrials> trials;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    if ((beyond >> lane & 1) != 0 && !(at_most[lane].bound <= t[lane])) {
      trials[lane] = CellTrials({most + 1, most + 1}, most);
      continue;
    }
    const double scale =
        std::min(1.0, std::sqrt(smaller_in_space(lane, even[lane], bounds.bound[lane]) / t[lane]));
    const auto scaled = [&](std::uint32_t n) { return static_cast<std::uint32_t>(n * scale); };
    trials[lane] = CellTrials(best[lane], {scaled(even[lane].nu), scaled(even[lane].nv)}, most);
  }
  Lanes<CellCounts> least;
  least.fill({1, 1});
  Lanes<CertifiedCells> chosen = fewer(Search(*this, t, true).run(trials), least, t, most);
  for (std::size_t lane = 0; lane < count_; ++lane) {
    if ((beyond >> lane & 1) != 0 && !(chosen[lane].bound <= t[lane]) &&
        at_most[lane].bound <= t[lane]) {
      chosen[lane] = at_most[lane];
    }
  }
  return chosen;
}

} // namespace simdbezier::detail
