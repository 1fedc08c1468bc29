// Cells that bicubic polynomial patches need, and what they certify: lanes are patches. Patches of
// other kinds, and corners whose diagonal is forced, are left to src/mesh/patch_bound.hpp.
#pragma once

#include "kernels/nets/cell_bounds.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Filip's bound for whole patches: nu with its best nv, and the other way round; the fewer cells.
template <typename V>
SIMDBEZIER_INLINE LaneCells<V> filip_cells(const RateGroup<V>& group, V t, V most) {
  using T = ScalarOf<V>;
  const V one = broadcast<V>(T(1));
  const V tiny = broadcast<V>(std::numeric_limits<T>::min());
  const V limit =
      broadcast<V>(T(8) * (T(1) - T(1e-3))) * t; // steps may be longer: see zone_terms()
  const V a = group.largest.uu + group.doubt.uu;
  const V b = group.largest.uv + group.doubt.uv;
  const V c = group.largest.vv + group.doubt.vv;
  const auto least = [&](V first, V second) SIMDBEZIER_INLINE_LAMBDA {
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

/// Cells next to those for which the bound of an even pair is in proportion, in about the order of
/// their number: the first ones that hold. What Filip's bound gives always holds.
template <typename V>
SIMDBEZIER_INLINE LaneCells<V> choose_cells(const RateScratch<V>& scratch,
                                            const RateGroup<V>& group, V t, V most) {
  using T = ScalarOf<V>;
  const V one = broadcast<V>(T(1));
  const V two = broadcast<V>(T(2));
  const V half = broadcast<V>(T(0.5));
  LaneCells<V> best = filip_cells(group, t, most);
  const auto even = [&](V n) SIMDBEZIER_INLINE_LAMBDA {
    return larger_of<V>(two * whole_part<V>(half * n), two);
  };
  const LaneCells<V> pair{even(smaller_of<V>(best.nu, most)), even(smaller_of<V>(best.nv, most))};
  const V bound = bound_of_cells<V>(scratch.quarter, pair, group.doubt, nullptr);
  const V scale = smaller_of<V>(square_root(divide(bound, t)), one);
  const LaneCells<V> centre{whole_part<V>(pair.nu * scale), whole_part<V>(pair.nv * scale)};
  static constexpr signed char kSteps[][2] = {{-1, 0}, {0, -1}, {0, 0}, {-1, 1}, {1, -1},
                                              {0, 1},  {1, 0},  {1, 1}, {0, 2},  {2, 0},
                                              {1, 2},  {2, 1},  {2, 2}};
  for (const auto& step : kSteps) {
    const auto stepped = [&](V n, signed char by) SIMDBEZIER_INLINE_LAMBDA {
      return smaller_of<V>(larger_of<V>(n + broadcast<V>(T(by)), one), most);
    };
    const LaneCells<V> cells{stepped(centre.nu, step[0]), stepped(centre.nv, step[1])};
    const MaskOf<V> fewer = cells.nu * cells.nv < best.nu * best.nv;
    if (!any_of<V>(fewer)) {
      continue;
    }
    const MaskOf<V> holds = bound_of_cells<V>(scratch.quarter, cells, group.doubt, nullptr) <= t;
    best.nu = select_where<V>(fewer & holds, cells.nu, best.nu);
    best.nv = select_where<V>(fewer & holds, cells.nv, best.nv);
  }
  return best;
}

/// Reads a group of patches; what it says is per lane.
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
  for (SpaceVector<V>& p : scratch.points) {
    p = inverse * p;
  }
  SecondTerms<V> squares;
  form_quarters<V>(scratch, squares);
  result.largest = {square_root(squares.uu), square_root(squares.uv), square_root(squares.vv)};
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

/// Whether sums of such numbers stay within range; patches of other sizes are left undecided.
template <typename T>
SIMDBEZIER_INLINE bool is_usual_size(T size) {
  return size > kSafelySmall<T> && size < kSafelyLarge<T>;
}

/// What is left of a patch's tolerance for its triangles.
template <typename T>
SIMDBEZIER_INLINE double tolerance_of(const detail::RateTask<T>& task, std::size_t patch) {
  const double wanted = task.tolerances == nullptr ? task.tolerance : task.tolerances[patch];
  return wanted - (task.errors == nullptr ? 0 : task.errors[patch]);
}

template <typename T>
SIMDBEZIER_INLINE void choose_group(const detail::RateTask<T>& task, std::size_t first,
                                    std::size_t count, const RateScratch<vec<T>>& scratch,
                                    const RateGroup<vec<T>>& group) {
  using V = vec<T>;
  alignas(64) T size[kLanes<V>];
  alignas(64) T t[kLanes<V>];
  store_vector<V>(size, group.size);
  for (std::size_t p = 0; p < kLanes<V>; ++p) {
    const double left = tolerance_of(task, first + (p < count ? p : count - 1));
    const double scaled = left / static_cast<double>(size[p]) * (1 - 0x1p-20);
    t[p] = scaled > 1e30 ? T(1e30) : scaled > 1e-30 ? static_cast<T>(scaled) : T(1e-30);
  }
  const V most = broadcast<V>(static_cast<T>(task.most));
  const LaneCells<V> cells = choose_cells<V>(scratch, group, load_vector<V>(t), most);
  alignas(64) T nu[kLanes<V>];
  alignas(64) T nv[kLanes<V>];
  store_vector<V>(nu, cells.nu);
  store_vector<V>(nv, cells.nv);
  for (std::size_t p = 0; p < count; ++p) {
    const bool known = is_usual_size(size[p]);
    const bool any = tolerance_of(task, first + p) > 0;
    const std::uint32_t other = any ? detail::kUndecided : 0;
    task.nu[first + p] = any && known ? static_cast<std::uint32_t>(nu[p]) : other;
    task.nv[first + p] = any && known ? static_cast<std::uint32_t>(nv[p]) : other;
  }
}

template <typename T>
SIMDBEZIER_INLINE void certify_group(const detail::RateTask<T>& task, std::size_t first,
                                     std::size_t count, const RateScratch<vec<T>>& scratch,
                                     const RateGroup<vec<T>>& group) {
  using V = vec<T>;
  alignas(64) T nu[kLanes<V>];
  alignas(64) T nv[kLanes<V>];
  for (std::size_t p = 0; p < kLanes<V>; ++p) {
    const std::size_t patch = first + (p < count ? p : count - 1);
    nu[p] = static_cast<T>(task.nu[patch]);
    nv[p] = static_cast<T>(task.nv[patch]);
  }
  const LaneCells<V> cells{load_vector<V>(nu), load_vector<V>(nv)};
  V diagonals;
  const V bound = bound_of_cells<V>(scratch.quarter, cells, group.doubt, &diagonals);
  alignas(64) T bounds[kLanes<V>];
  alignas(64) T bits[kLanes<V>];
  alignas(64) T size[kLanes<V>];
  store_vector<V>(bounds, bound);
  store_vector<V>(bits, diagonals);
  store_vector<V>(size, group.size);
  for (std::size_t p = 0; p < count; ++p) {
    const bool known = is_usual_size(size[p]);
    const double error = task.errors == nullptr ? 0 : task.errors[first + p];
    task.diagonals[first + p] = known ? static_cast<std::uint16_t>(bits[p]) : std::uint16_t{0};
    task.deviations[first + p] =
        known ? static_cast<double>(bounds[p]) * static_cast<double>(size[p]) + error : -1;
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
    if (task.choose) {
      choose_group<T>(task, first, count, scratch, group);
    }
    certify_group<T>(task, first, count, scratch, group);
  });
  return Isa::SIMDBEZIER_ISA;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
