// Cells that bicubic polynomial patches need, and what they certify: lanes are patches. Patches of
// other kinds, and corners whose diagonal is forced, are left to src/mesh/bounds/group_bound.hpp.
#pragma once

#include "kernels/rates/cell_candidates.hpp"
#include "kernels/rates/normal_bends.hpp"
#include "kernels/simd/operands.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Cells by Filip's bound for whole patches: of nu with its best nv, and nv with its best nu, the
/// pair of fewer cells; above `most` in a direction that needs more. Roundings, and rates above
/// about 2000, may take more than is left for them here, so a lane's result has to be looked at.
template <typename V>
SIMDBEZIER_INLINE LaneCells<V> filip_cells(const RateGroup<V>& group, V t, V most) {
  using T = ScalarOf<V>;
  const V one = broadcast<V>(T(1));
  const V tiny = broadcast<V>(std::numeric_limits<T>::min());
  const V limit = broadcast<V>(T(8) * (T(1) - T(1e-3))) * t; // steps may be longer: see cell_step()
  const V a = group.largest.uu + group.doubt.uu;
  const V b = group.largest.uv + group.doubt.uv;
  const V c = group.largest.vv + group.doubt.vv;
  const V share = broadcast<V>(T(detail::kMixedShare)) * b;
  const auto least = [&](V along, V across) SIMDBEZIER_INLINE_LAMBDA {
    const V first = larger_of<V>(along, share);
    const V second = larger_of<V>(across, share);
    const V mixed = b * square_root(divide(first, larger_of<V>(second, tiny)));
    const V n = square_root(divide((first + mixed) + (first + mixed), limit));
    return larger_of<V>(whole_above<V>(smaller_of<V>(n, most)), one);
  };
  const auto other = [&](V first, V second, V n) SIMDBEZIER_INLINE_LAMBDA {
    const V left = limit - divide(first, n * n);
    const V mixed = divide(b, n);
    const V root = square_root(madd(mixed, mixed, second * larger_of<V>(left, tiny)));
    const V beyond = most + one;
    const V wanted = divide(mixed + root, larger_of<V>(left, tiny));
    const V count = larger_of<V>(whole_above<V>(smaller_of<V>(wanted, beyond)), one);
    return select_where<V>(left > tiny, count, beyond);
  };
  const V nu = least(a, c);
  const V nv = least(c, a);
  const LaneCells<V> by_u{nu, other(a, c, nu)};
  const LaneCells<V> by_v{other(c, a, nv), nv};
  const MaskOf<V> first = by_u.nu * by_u.nv <= by_v.nu * by_v.nv;
  return {select_where<V>(first, by_u.nu, by_v.nu), select_where<V>(first, by_u.nv, by_v.nv)};
}

/// Cells with their certificate.
template <typename V>
struct CertifiedCells {
  LaneCells<V> cells;
  V bound;
  V diagonals;

  /// Which lanes' triangles may be far closer than that, of those with so many cells.
  [[nodiscard]] SIMDBEZIER_INLINE MaskOf<V>
  is_coarse(const RateScratch<V>& scratch, const RateGroup<V>& group, std::uint32_t fewest) const {
    using T = ScalarOf<V>;
    const V count = cells.nu * cells.nv;
    const MaskOf<V> many = count >= broadcast<V>(static_cast<T>(fewest));
    if (!any_of<V>(many)) {
      return many;
    }
    const V worth = broadcast<V>(T(detail::kWorthLooking));
    const NormalBends<V> bends = bends_of<V>(scratch, CellSteps<V>(cells, group.doubt));
    const V few = worth * count;
    const V square = few * few * bound;
    return many & ((bends.distance <= worth * bound) |
                   ((bends.fewest <= few * bound) & (bends.steps[0] <= square) &
                    (bends.steps[1] <= square)));
  }
};

/// Where Filip's bound takes more cells than these, one cell hardly ever holds.
constexpr int kFewCells = 2;

/// Returns the fewest cells near those that the bound of an even pair of rates, in proportion to
/// the tolerance, asks for. Where none of them holds, it is what Filip's bound gives, whose own
/// bound may be above t.
///
/// One cell is tried first where Filip's bound takes few: if it holds in all lanes, which is usual
/// for models seen from far away, there is no search.
///
/// Few cells need all vectors looked at: the vectors that set the even pair's bound show of most
/// cells that they do not hold. Every lane has candidates of its own, so that lanes do not wait for
/// each other's.
template <typename V>
SIMDBEZIER_INLINE CertifiedCells<V> choose_cells(const RateScratch<V>& scratch,
                                                 const RateGroup<V>& group, V t, V most) {
  using T = ScalarOf<V>;
  const V one = broadcast<V>(T(1));
  const V two = broadcast<V>(T(2));
  const V half = broadcast<V>(T(0.5));
  const LaneCells<V> filip = filip_cells(group, t, most);
  MaskOf<V> holds_one = filip.nu * filip.nv <= broadcast<V>(T(kFewCells));
  CertifiedCells<V> single{{one, one}, one, one};
  if (any_of<V>(holds_one)) {
    single.bound = bound_of_cells<V>(scratch.nets, single.cells, group.doubt, single.diagonals);
    holds_one = holds_one & (single.bound <= t);
    if (all_of<V>(holds_one)) {
      return single;
    }
  }
  const auto even = [&](V n) SIMDBEZIER_INLINE_LAMBDA {
    return larger_of<V>(two * whole_part<V>(half * n), two);
  };
  const LaneCells<V> pair{even(smaller_of<V>(filip.nu, most)), even(smaller_of<V>(filip.nv, most))};
  const CellSteps<V> step(pair, group.doubt);
  const auto leading = largest_squares<LeadingSquare<V>>(scratch.nets, step);
  const V bound = bound_of_even<V>(zone_terms(scratch.nets, step, group.doubt, leading));
  const V scale = smaller_of<V>(square_root(divide(bound, t)), one);
  const LaneCells<V> centre{whole_part<V>(pair.nu * scale), whole_part<V>(pair.nv * scale)};
  CellCandidates<V> candidates(CellScreen<V>(scratch.nets, leading, group.doubt, t), centre, most);
  for (;;) {
    CertifiedCells<V> result;
    result.cells = candidates.fewest(filip);
    result.bound = bound_of_cells<V>(scratch.nets, result.cells, group.doubt, result.diagonals);
    const MaskOf<V> fewer = result.cells.nu * result.cells.nv < filip.nu * filip.nv;
    const MaskOf<V> fails = fewer & !(result.bound <= t) & !holds_one;
    if (!any_of<V>(fails)) {
      result.cells.nu = select_where<V>(holds_one, one, result.cells.nu);
      result.cells.nv = select_where<V>(holds_one, one, result.cells.nv);
      result.bound = select_where<V>(holds_one, single.bound, result.bound);
      result.diagonals = select_where<V>(holds_one, single.diagonals, result.diagonals);
      return result;
    }
    candidates.close(result.cells, fails);
  }
}

/// Reads a group of patches. Its results are one a lane.
template <typename T>
SIMDBEZIER_INLINE RateGroup<vec<T>> read_rate_group(const detail::RateTask<T>& task,
                                                    std::size_t first, std::size_t count,
                                                    RateScratch<vec<T>>& scratch) {
  using V = vec<T>;
  auto* const group = reinterpret_cast<T*>(scratch.points);
  read_group<V>(task.in, first, count, group);
  const SpaceVector<V> origin = scratch.points[0];
  V extent = broadcast<V>(std::numeric_limits<T>::min());
  for (SpaceVector<V>& p : scratch.points) {
    p = p - origin;
    extent = larger_of<V>(larger_of<V>(size_of<V>(p.x), size_of<V>(p.y)),
                          larger_of<V>(size_of<V>(p.z), extent));
  }
  RateGroup<V> result;
  result.size = power_of_two_below<V>(extent);
  const V inverse = divide(broadcast<V>(T(1)), result.size);
  V sum = broadcast<V>(T(0));
  for (SpaceVector<V>& p : scratch.points) {
    p = inverse * p;
    sum = sum + ((p.x + p.y) + p.z);
  }
  result.size = result.size + broadcast<V>(T(0)) * sum; // nan where a value is: extents may not be
  form_quarters<V>(scratch, result.largest);
  // Points around the first one err by u, their second differences by 12 u a component before the
  // factors 6 and 9; halving and raising round ten times, relative to the largest vector.
  constexpr T kRoot3 = T(1.7321);
  const V relative = broadcast<V>(T(16) * kRoundoff<T>);
  const auto doubt = [&](V largest, T factor) SIMDBEZIER_INLINE_LAMBDA {
    return madd(relative, largest, broadcast<V>(T(12) * kRoot3 * factor * kRoundoff<T>));
  };
  result.doubt = {doubt(result.largest.uu, T(6)), doubt(result.largest.uv, T(9)),
                  doubt(result.largest.vv, T(6))};
  return result;
}

/// Where sums of numbers of such a size stay within range; patches of other sizes, and those with
/// values that are not finite, are left undecided.
template <typename V>
SIMDBEZIER_INLINE MaskOf<V> is_usual_size(V size) {
  using T = ScalarOf<V>;
  const MaskOf<V> above = size > broadcast<V>(kSafelySmall<T>);
  const MaskOf<V> below = size < broadcast<V>(kSafelyLarge<T>);
  return above & below;
}

template <typename T>
SIMDBEZIER_INLINE double error_of(const detail::RateTask<T>& task, std::size_t patch) {
  return task.errors == nullptr ? 0 : task.errors[patch];
}

/// Returns what is left of a patch's tolerance for its triangles, over its size. Doubts keep every
/// bound above the least value, which stands for tolerances that are used up.
template <typename T>
SIMDBEZIER_INLINE T tolerance_of(const detail::RateTask<T>& task, std::size_t patch, T size) {
  const double wanted = task.tolerances == nullptr ? task.tolerance : task.tolerances[patch];
  const double left = wanted - error_of(task, patch);
  const double scaled = left / static_cast<double>(size) * (1 - 0x1p-20);
  return scaled > 1e30 ? T(1e30) : scaled > 1e-30 ? static_cast<T>(scaled) : T(1e-30);
}

/// Chooses the cells of a group, or takes those that are given, and writes their certificates.
template <typename T>
SIMDBEZIER_INLINE void rate_group(const detail::RateTask<T>& task, std::size_t first,
                                  std::size_t count, const RateScratch<vec<T>>& scratch,
                                  const RateGroup<vec<T>>& group) {
  using V = vec<T>;
  alignas(64) T size[kLanes<V>];
  alignas(64) T t[kLanes<V>];
  alignas(64) T nu[kLanes<V>];
  alignas(64) T nv[kLanes<V>];
  alignas(64) T bound[kLanes<V>];
  alignas(64) T diagonals[kLanes<V>];
  store_vector<V>(size, group.size);
  for (std::size_t p = 0; p < kLanes<V>; ++p) {
    const std::size_t patch = first + (p < count ? p : count - 1);
    if (task.choose) {
      t[p] = tolerance_of(task, patch, size[p]);
    } else {
      nu[p] = static_cast<T>(task.nu[patch]);
      nv[p] = static_cast<T>(task.nv[patch]);
    }
  }
  const MaskOf<V> sound = is_usual_size<V>(group.size);
  MaskOf<V> decided = sound;
  CertifiedCells<V> found;
  if (task.choose) {
    const V limit = load_vector<V>(t);
    const V most = broadcast<V>(static_cast<T>(task.most));
    found = choose_cells<V>(scratch, group, limit, most);
    decided =
        decided & (found.bound <= limit) & (found.cells.nu <= most) & (found.cells.nv <= most);
  } else {
    found.cells = {load_vector<V>(nu), load_vector<V>(nv)};
    found.bound = bound_of_cells<V>(scratch.nets, found.cells, group.doubt, found.diagonals);
  }
  decided = decided & !found.is_coarse(scratch, group, task.fewest_looked);
  store_vector<V>(nu, found.cells.nu);
  store_vector<V>(nv, found.cells.nv);
  const V undecided = select_where<V>(sound, broadcast<V>(T(detail::kSoundUndecided)),
                                      broadcast<V>(T(detail::kDoubtfulUndecided)));
  store_vector<V>(bound, select_where<V>(decided, found.bound, undecided));
  store_vector<V>(diagonals, found.diagonals);
  for (std::size_t p = 0; p < count; ++p) {
    const std::size_t patch = first + p;
    const bool known = bound[p] >= 0;
    if (task.choose) {
      task.nu[patch] = known ? static_cast<std::uint32_t>(nu[p]) : detail::kUndecided;
      task.nv[patch] = known ? static_cast<std::uint32_t>(nv[p]) : detail::kUndecided;
    }
    task.diagonals[patch] = static_cast<std::uint16_t>(diagonals[p]);
    task.deviations[patch] =
        known ? static_cast<double>(bound[p]) * static_cast<double>(size[p]) + error_of(task, patch)
              : static_cast<double>(bound[p]);
  }
}

/// Asks for packed nets before their turn: a group takes long enough for them to arrive, while
/// their first use would wait for them.
template <typename T>
SIMDBEZIER_INLINE void prefetch_nets(const detail::NetView<const T>& nets, std::size_t begin,
                                     std::size_t end) {
  for (std::size_t p = begin; nets.packed && p < end; ++p) {
    prefetch_values(net_at(nets, p), 3 * 16);
  }
}

template <typename T>
Isa rate_kernel(const detail::RateTask<T>& task, std::size_t begin, std::size_t end,
                unsigned char* memory) {
  using V = vec<T>;
  static_assert(sizeof(RateScratch<V>) <= detail::kRateValues * detail::kLineBytes);
  auto& scratch = *reinterpret_cast<RateScratch<V>*>(memory);
  for_groups<V>(begin, end, [&](std::size_t first, std::size_t count) {
    const RateGroup<V> group = read_rate_group<T>(task, first, count, scratch);
    const std::size_t next = first + count;
    prefetch_nets(task.in, next, end - next < kLanes<V> ? end : next + kLanes<V>);
    rate_group<T>(task, first, count, scratch, group);
  });
  return Isa::SIMDBEZIER_ISA;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
