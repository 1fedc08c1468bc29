// See space_bound.hpp: all cells of a patch, and the fewest that hold.
#include <algorithm>
#include <limits>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/bounds/chord_distance.hpp"
#include "src/mesh/bounds/space_bound.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/runtime/sort.hpp"
#include "src/tables/bound_task.hpp"

namespace simdbezier::detail {
namespace {

/// Pieces, in units of an operation for each pair of control points: of which some take 0.1 s; and
/// where weights are far apart and other bounds ask for many cells, or do not hold at all so that
/// the mesh would be refused: up to some seconds.
constexpr double kMostWork = 0x1p26;
constexpr double kLastWork = 0x1p28;
constexpr double kManyCells = 4096;
/// Pieces may be looked at so many times for each cell that is expected, and at first.
constexpr double kLooksForEach = 8;
constexpr double kFirstLooks = 512;
/// What is found keeps this share of a tolerance, so that certify(), which comes as close to the
/// distance as that, does not find more than the tolerance. Cells that second derivatives along the
/// normal expect to be above the other share are passed over.
constexpr double kSearchShare = 0.99;
constexpr double kBendShare = 0.95;
/// But not where weights are so far apart that a bend may be far smaller than a cell.
constexpr double kUnknownSpread = 0x1p10;

} // namespace

SpaceBound::Range SpaceBound::range_of(unsigned place, std::uint32_t n) {
  const std::uint32_t half = n / 2;
  const std::uint32_t rest = n - half;
  return place == 0 ? Range{0, half} : place == 1 ? Range{rest, n} : Range{half, rest};
}

CertifiedCells SpaceBound::certify(const CellCounts& cells, double stop, double enough,
                                   bool may_fall) {
  looked_at_ = 0;
  most_looks_ = kMostWork / work_;
  CertifiedCells found = look_at(turn_.turned(cells), stop, enough, may_fall);
  found.cells = cells;
  return found;
}

/// Cells of the turned patch, with the diagonals of the patch itself.
CertifiedCells SpaceBound::look_at(const CellCounts& cells, double stop, double enough,
                                   bool may_fall) {
  if (!(cells.product() <= most_looks_)) {
    return uncertified(cells);
  }
  CertifiedCells all{cells, 0, 0};
  const bool first = !may_fall && turn_.exchanges_diagonals(); // whether it falls
  for (unsigned zone = 0; zone < kZoneCount; ++zone) {
    const Range u = range_of(zone % 3, cells.nu);
    const Range v = range_of(zone / 3, cells.nv);
    if (u.begin == u.end || v.begin == v.end) {
      continue;
    }
    const double least = std::max(enough, all.bound);
    Miss miss{};
    const double one = bound_range(u, v, cells, first, least, stop, miss[0]);
    const double other = may_fall && one > least
                             ? bound_range(u, v, cells, !first, least, std::min(stop, one), miss[1])
                             : std::numeric_limits<double>::infinity();
    const bool falls = (other < one ? !first : first) != turn_.exchanges_diagonals();
    all.diagonals =
        static_cast<std::uint16_t>(all.diagonals | (falls ? 1U << turn_.zone_of(zone) : 0U));
    all.bound = std::max(all.bound, std::min(one, other));
    if (!(all.bound <= stop)) {
      misses_.insert(misses_.begin(), miss);
      misses_.resize(std::min(misses_.size(), kMostMisses));
      return uncertified(cells);
    }
  }
  all.bound += doubt_;
  return all;
}

/// Whether cells do not hold where others have not held.
bool SpaceBound::misses(const CellCounts& cells, double stop) {
  const auto fails = [&](const Miss& miss) {
    std::uint32_t at[2][2];
    for (std::size_t way = 0; way < 2; ++way) {
      at[way][0] = static_cast<std::uint32_t>(miss[way][0] * cells.nu);
      at[way][1] = static_cast<std::uint32_t>(miss[way][1] * cells.nv);
    }
    if (zone_at(at[0][0], cells.nu) != zone_at(at[1][0], cells.nu) ||
        zone_at(at[0][1], cells.nv) != zone_at(at[1][1], cells.nv)) {
      return false; // these may have different diagonals
    }
    bool all = true;
    for (std::size_t way = 0; all && way < 2; ++way) {
      take_row(at[way][1], cells.nv);
      take_cell(at[way][0], cells.nu);
      all = !(bound_cell(at[way][0], at[way][1], cells, way == 1, stop, stop) <= stop);
    }
    return all;
  };
  const auto first = std::find_if(misses_.begin(), misses_.end(), fails);
  const bool found = first != misses_.end();
  if (found) {
    std::rotate(misses_.begin(), first, first + 1);
  }
  return found;
}

CertifiedCells SpaceBound::choose(const SpaceSearch& search, const NormalBends& bends) {
  const CellCounts& usual = search.usual;
  const std::uint32_t most = search.most;
  const double stop = kSearchShare * search.t;
  const bool is_far = spread_ > kLeastSpread;
  const double expected =
      is_far ? std::numeric_limits<double>::infinity() : 4 * bends.fewest(stop) + 1;
  // A few cells in a direction are not small, but no better than some more.
  const auto step = [&](std::uint32_t n) {
    return 1.0 / static_cast<double>(std::max<std::size_t>({n, columns_, rows_}));
  };
  const bool is_known = spread_ < kUnknownSpread && std::max(usual.nu, usual.nv) < most;
  const double enough = stop * (is_known ? kSearchShare : 0.5);
  const auto are_too_few = [&](const CellCounts& cells) {
    const CellCounts of = turn_.turned(cells);
    return of.nu < search.least.nu || of.nv < search.least.nv ||
           (is_known && bends.at(step(of.nu), step(of.nv)) > kBendShare * stop);
  };
  const auto count = [](std::uint32_t k) { return k < 8 ? k : (8 + k % 8) << (k / 8 - 1); };
  looked_at_ = 0;
  const bool needs_it =
      std::max(usual.nu, usual.nv) >= most || (is_far && usual.product() >= kManyCells);
  most_looks_ = needs_it ? kLastWork / work_
                : search.thorough
                    ? kMostWork / work_
                    : std::min(kMostWork / work_,
                               kLooksForEach * std::min(usual.product(), expected) + kFirstLooks);
  const double all = std::min(usual.product(), most_looks_);
  misses_.assign(1, {{{0.5, 0.5}, {0.5, 0.5}}});
  std::vector<CellCounts> candidates;
  for (double few = 1; few < all; few *= 2) {
    candidates.clear();
    for (std::uint32_t u = 1; count(u) <= std::min<double>(most, 2 * few); ++u) {
      for (std::uint32_t v = 1; count(v) <= most; ++v) {
        const CellCounts cells{count(u), count(v)};
        if (cells.product() >= std::min(all, 2 * few)) {
          break;
        }
        if (cells.product() >= few && !are_too_few(cells)) {
          candidates.push_back(cells);
        }
      }
    }
    sort_range(candidates.begin(), candidates.end(), [](const CellCounts& a, const CellCounts& b) {
      return a.product() < b.product() || (a.product() == b.product() && a.nu < b.nu);
    });
    for (const CellCounts& cells : candidates) {
      if (looked_at_ > most_looks_) {
        return uncertified(usual);
      }
      if (!misses(cells, stop)) {
        const CertifiedCells found = look_at(cells, stop, enough, true);
        if (found.bound <= stop) {
          return {turn_.turned(cells), found.bound, found.diagonals};
        }
      }
    }
  }
  return uncertified(usual);
}

} // namespace simdbezier::detail
