// See space_bound.hpp: all cells of a patch, and the fewest that hold.
#include <algorithm>
#include <bit>
#include <limits>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/rates/space_bound.hpp"
#include "src/tables/bound_task.hpp"

namespace simdbezier::detail {
namespace {

/// Cells, in units of an operation for each pair of control points: of which some take 0.5 s.
constexpr double kMostWork = 0x1p24;

/// Of Zone, by the number of a cell among n.
unsigned place_of(std::uint32_t i, std::uint32_t n) {
  return static_cast<unsigned>(n % 2 != 0 && i == n / 2 ? Zone::middle
                               : 2 * i >= n             ? Zone::high
                                                        : Zone::low);
}

} // namespace

SpaceBound::Range SpaceBound::range_of(unsigned place, std::uint32_t n) {
  const std::uint32_t half = n / 2;
  const std::uint32_t rest = n - half;
  return place == 0 ? Range{0, half} : place == 1 ? Range{rest, n} : Range{half, rest};
}

CertifiedCells SpaceBound::certify(const CellCounts& cells, double stop, double enough,
                                   bool may_fall) {
  if (!(cells.product() * work_ <= kMostWork)) {
    return uncertified(cells);
  }
  CertifiedCells all{cells, 0, 0};
  for (unsigned zone = 0; zone < kZoneCount; ++zone) {
    const Range u = range_of(zone % 3, cells.nu);
    const Range v = range_of(zone / 3, cells.nv);
    if (u.begin == u.end || v.begin == v.end) {
      continue;
    }
    const double least = std::max(enough, all.bound);
    const double rising = bound_range(u, v, cells, false, least, stop);
    const double falling = may_fall && rising > least
                               ? bound_range(u, v, cells, true, least, std::min(stop, rising))
                               : std::numeric_limits<double>::infinity();
    all.diagonals =
        static_cast<std::uint16_t>(all.diagonals | (falling < rising ? 1U << zone : 0U));
    all.bound = std::max(all.bound, std::min(rising, falling));
    if (!(all.bound <= stop)) {
      return uncertified(cells);
    }
  }
  all.bound += doubt_;
  return all;
}

/// Whether the cells where others have not held do not hold either.
bool SpaceBound::misses(const CellCounts& cells, double stop) {
  std::uint32_t at[2][2];
  for (std::size_t way = 0; way < 2; ++way) {
    at[way][0] = static_cast<std::uint32_t>(misses_[way][0] * cells.nu);
    at[way][1] = static_cast<std::uint32_t>(misses_[way][1] * cells.nv);
  }
  if (place_of(at[0][0], cells.nu) != place_of(at[1][0], cells.nu) ||
      place_of(at[0][1], cells.nv) != place_of(at[1][1], cells.nv)) {
    return false; // these may have different diagonals
  }
  for (std::size_t way = 0; way < 2; ++way) {
    take_row(at[way][1], cells.nv);
    take_cell(at[way][0], cells.nu);
    even_out();
    if (bound_cell(at[way][0], at[way][1], cells, way == 1, stop, stop) <= stop) {
      return false;
    }
  }
  return true;
}

CertifiedCells SpaceBound::choose(const CellCounts& usual, double stop, std::uint32_t most) {
  std::vector<CellCounts> candidates;
  const auto count = [](std::uint32_t k) { return k < 4 ? k : (4 + k % 4) << (k / 4 - 1); };
  for (std::uint32_t u = 1; count(u) <= most; ++u) {
    for (std::uint32_t v = 1; count(v) <= most; ++v) {
      const CellCounts cells{count(u), count(v)};
      if (cells.product() < usual.product() && cells.product() * work_ <= kMostWork) {
        candidates.push_back(cells);
      }
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const CellCounts& a, const CellCounts& b) {
    return a.product() < b.product() || (a.product() == b.product() && a.nu < b.nu);
  });
  looked_at_ = 0;
  CertifiedCells best = uncertified(usual);
  for (const bool powers :
       {true, false}) { // at first those of two, which are at most 4-fold too many
    const double least = powers ? 0 : best.cells.product() / 4;
    for (const CellCounts& cells : candidates) {
      if (cells.product() >= best.cells.product() || looked_at_ * work_ > kMostWork) {
        break;
      }
      const bool counts = powers ? std::has_single_bit(cells.nu) && std::has_single_bit(cells.nv)
                                 : cells.product() > least;
      if (counts && !misses(cells, stop)) {
        const CertifiedCells found = certify(cells, stop, stop);
        best = found.bound <= stop ? found : best;
      }
    }
    if (!(best.bound <= stop)) {
      return best;
    }
  }
  const CertifiedCells closer = certify(best.cells, best.bound);
  return closer.bound < best.bound ? closer : best;
}

} // namespace simdbezier::detail
