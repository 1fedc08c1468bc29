// Cells that bicubic polynomial patches need, and what they certify: lanes are patches. The bound
// is that of src/mesh/patch_bound.hpp, with the second derivatives of the patch's four quarters;
// patches of other kinds, and corners whose diagonal is forced, are left to that one.
//
// Source: docs/accuracy.md, "Meshes".
#pragma once

#include "kernels/nets/net_boxes.hpp"
#include "kernels/simd/extrema.hpp"
#include "kernels/simd/lanes.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The largest whole number that is not above x, for 0 <= x below 2^22.
template <typename V>
SIMDBEZIER_INLINE V whole_part(V x) {
  using T = ScalarOf<V>;
  const V magic = broadcast<V>(static_cast<T>(T(1) / std::numeric_limits<T>::epsilon()));
  const V nearest = (x + magic) - magic;
  return select_where<V>(nearest > x, nearest - broadcast<V>(T(1)), nearest);
}
/// The smallest whole number that is not below x.
template <typename V>
SIMDBEZIER_INLINE V whole_above(V x) {
  const V below = whole_part<V>(x);
  return select_where<V>(below < x, below + broadcast<V>(ScalarOf<V>(1)), below);
}

/// A vector in space, of as many patches as a register has lanes.
template <typename V>
struct SpaceVector {
  V x;
  V y;
  V z;

  friend SIMDBEZIER_INLINE SpaceVector operator+(const SpaceVector& a, const SpaceVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend SIMDBEZIER_INLINE SpaceVector operator-(const SpaceVector& a, const SpaceVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend SIMDBEZIER_INLINE SpaceVector operator*(V s, const SpaceVector& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  [[nodiscard]] SIMDBEZIER_INLINE V square() const { return madd(x, x, madd(y, y, z * z)); }
};

/// One number for each second derivative: S_uu, S_uv, S_vv.
template <typename V>
struct SecondTerms {
  V uu;
  V uv;
  V vv;
};

/// The second derivatives of one quarter.
template <typename V>
struct QuarterNets {
  SecondTerms<V> largest; ///< squares of the largest vectors
  SpaceVector<V> uu[16];  ///< raised to degrees 3, 3: [j][i]
  SpaceVector<V> uv[16];
  SpaceVector<V> vv[16];
};

/// Scratch of a group, and what bounds need besides.
template <typename V>
struct RateScratch {
  SpaceVector<V> points[16]; ///< around the first one, over a power of two of about their size
  QuarterNets<V> quarter[4];
};
template <typename V>
struct RateGroup {
  V size;                 ///< the power of two
  SecondTerms<V> largest; ///< vectors of the whole patch
  SecondTerms<V> doubt;   ///< what rounding may have taken from vectors
};

/// Both halves of a line of control vectors of degree n.
template <std::size_t kOrder, typename V>
SIMDBEZIER_INLINE void halve(const SpaceVector<V>* line, std::size_t step, SpaceVector<V>* low,
                             SpaceVector<V>* high) {
  const V half = broadcast<V>(ScalarOf<V>(0.5));
  SpaceVector<V> part[kOrder];
  for (std::size_t k = 0; k < kOrder; ++k) {
    part[k] = line[k * step];
  }
  for (std::size_t level = 0; level < kOrder; ++level) {
    low[level * step] = part[0];
    high[(kOrder - 1 - level) * step] = part[kOrder - 1 - level];
    for (std::size_t k = 0; k + 1 + level < kOrder; ++k) {
      part[k] = half * (part[k] + part[k + 1]);
    }
  }
}

/// Four quarters of a net of kColumns x kRows, number 2 * (half of v) + (half of u).
template <std::size_t kColumns, std::size_t kRows, typename V>
SIMDBEZIER_INLINE void quarter_net(const SpaceVector<V>* net,
                                   SpaceVector<V> (&to)[4][kColumns * kRows]) {
  SpaceVector<V> halves[2][kColumns * kRows];
  for (std::size_t j = 0; j < kRows; ++j) {
    halve<kColumns>(net + j * kColumns, 1, halves[0] + j * kColumns, halves[1] + j * kColumns);
  }
  for (std::size_t h = 0; h < 2; ++h) {
    for (std::size_t i = 0; i < kColumns; ++i) {
      halve<kRows>(halves[h] + i, kColumns, to[h] + i, to[2 + h] + i);
    }
  }
}

template <std::size_t kCount, typename V>
SIMDBEZIER_INLINE V largest_square(const SpaceVector<V> (&net)[kCount]) {
  V largest = net[0].square();
  for (std::size_t k = 1; k < kCount; ++k) {
    largest = larger_of<V>(net[k].square(), largest);
  }
  return largest;
}

/// Second differences times 6 in one direction, or 9 of mixed ones.
template <typename V>
SIMDBEZIER_INLINE void second_differences(const SpaceVector<V>* p, SpaceVector<V> (&uu)[8],
                                          SpaceVector<V> (&uv)[9], SpaceVector<V> (&vv)[8]) {
  using T = ScalarOf<V>;
  const V six = broadcast<V>(T(6));
  const V nine = broadcast<V>(T(9));
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 2; ++i) {
      const SpaceVector<V>* const at = p + 4 * j + i;
      uu[2 * j + i] = six * ((at[2] - at[1]) - (at[1] - at[0]));
    }
  }
  for (std::size_t j = 0; j < 2; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const SpaceVector<V>* const at = p + 4 * j + i;
      vv[4 * j + i] = six * ((at[8] - at[4]) - (at[4] - at[0]));
    }
  }
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      const SpaceVector<V>* const at = p + 4 * j + i;
      uv[3 * j + i] = nine * ((at[5] - at[4]) - (at[1] - at[0]));
    }
  }
}

/// From degrees 1 and 2 to 3, for control vectors `step` apart.
template <typename V>
SIMDBEZIER_INLINE void raise_line(const SpaceVector<V>* from, std::size_t order, std::size_t step,
                                  SpaceVector<V>* to, std::size_t to_step) {
  using T = ScalarOf<V>;
  const V third = broadcast<V>(T(1) / T(3));
  const V rest = broadcast<V>(T(2) / T(3));
  to[0] = from[0];
  to[3 * to_step] = from[(order - 1) * step];
  if (order == 2) {
    to[to_step] = rest * from[0] + third * from[step];
    to[2 * to_step] = third * from[0] + rest * from[step];
  } else {
    to[to_step] = third * from[0] + rest * from[step];
    to[2 * to_step] = rest * from[step] + third * from[2 * step];
  }
}

template <typename V>
SIMDBEZIER_INLINE void raise_quarter(const SpaceVector<V> (&uu)[8], const SpaceVector<V> (&uv)[9],
                                     const SpaceVector<V> (&vv)[8], QuarterNets<V>& to) {
  to.largest = {largest_square(uu), largest_square(uv), largest_square(vv)};
  for (std::size_t j = 0; j < 4; ++j) {
    raise_line(uu + 2 * j, 2, 1, to.uu + 4 * j, 1);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    raise_line(vv + i, 2, 4, to.vv + i, 4);
  }
  SpaceVector<V> rows[12];
  for (std::size_t j = 0; j < 3; ++j) {
    raise_line(uv + 3 * j, 3, 1, rows + 4 * j, 1);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    raise_line(rows + i, 3, 4, to.uv + i, 4);
  }
}

/// The quarters' nets, and the largest squares of the whole patch. A function of its own, or its
/// arrays would be in the way of what follows.
template <typename V>
__attribute__((noinline)) void form_quarters(RateScratch<V>& scratch, SecondTerms<V>& whole) {
  SpaceVector<V> uu[8];
  SpaceVector<V> uv[9];
  SpaceVector<V> vv[8];
  second_differences(scratch.points, uu, uv, vv);
  whole = {largest_square(uu), largest_square(uv), largest_square(vv)};
  SpaceVector<V> uu_parts[4][8];
  SpaceVector<V> uv_parts[4][9];
  SpaceVector<V> vv_parts[4][8];
  quarter_net<2, 4>(uu, uu_parts);
  quarter_net<3, 3>(uv, uv_parts);
  quarter_net<4, 2>(vv, vv_parts);
  for (std::size_t k = 0; k < 4; ++k) {
    raise_quarter(uu_parts[k], uv_parts[k], vv_parts[k], scratch.quarter[k]);
  }
}

/// The largest value of sum l_i l_j q_ij / 2 over a triangle, for three squared edge terms.
template <typename V>
SIMDBEZIER_INLINE V triangle_bound(V a, V c, V d) {
  using T = ScalarOf<V>;
  const V largest = larger_of<V>(larger_of<V>(a, c), d);
  const V sum = a + c + d;
  const V products = madd(a, c, madd(c, d, d * a));
  const V squares = madd(a, a, madd(c, c, d * d));
  const V divisor = (products + products) - squares;
  const V inside = divide(a * c * d, larger_of<V>(divisor + divisor, broadcast<V>(kSmallest<T>)));
  return select_where<V>(largest + largest < sum, inside, largest * broadcast<V>(T(0.125)));
}

/// What every zone of cells is bounded by.
template <typename V>
struct ZoneTerms {
  V uu[4]; ///< of the quarters: h_u^2 |S_uu|, …
  V vv[4];
  V rising[4];
  V falling[4];
};

/// Segments in u and v of every lane, whole numbers.
template <typename V>
struct LaneCells {
  V nu;
  V nv;
};

template <typename V>
SIMDBEZIER_INLINE ZoneTerms<V> zone_terms(const QuarterNets<V> (&quarters)[4],
                                          const LaneCells<V>& cells, const SecondTerms<V>& doubt) {
  using T = ScalarOf<V>;
  const V one = broadcast<V>(T(1));
  const V slack = broadcast<V>(T(4 * 0x1p-24));
  const V hu = divide(one, cells.nu) + slack;
  const V hv = divide(one, cells.nv) + slack;
  const V uu = hu * hu;
  const V uv = (hu + hu) * hv;
  const V vv = hv * hv;
  const V rest = madd(uu, doubt.uu, madd(uv, doubt.uv, vv * doubt.vv));
  ZoneTerms<V> terms;
  for (std::size_t k = 0; k < 4; ++k) {
    const QuarterNets<V>& q = quarters[k];
    V rising = broadcast<V>(T(0));
    V falling = rising;
    for (std::size_t i = 0; i < 16; ++i) {
      const SpaceVector<V> s = uu * q.uu[i] + vv * q.vv[i];
      const SpaceVector<V> t = uv * q.uv[i];
      rising = larger_of<V>((s + t).square(), rising);
      falling = larger_of<V>((s - t).square(), falling);
    }
    terms.uu[k] = uu * (square_root(q.largest.uu) + doubt.uu);
    terms.vv[k] = vv * (square_root(q.largest.vv) + doubt.vv);
    terms.rising[k] = square_root(rising) + rest;
    terms.falling[k] = square_root(falling) + rest;
  }
  return terms;
}

/// The bound of every lane's cells; diagonals: a bit for each zone (PatchRates), where wanted.
template <typename V>
SIMDBEZIER_INLINE V bound_of_cells(const QuarterNets<V> (&quarters)[4], const LaneCells<V>& cells,
                                   const SecondTerms<V>& doubt, V* diagonals) {
  using T = ScalarOf<V>;
  const V zero = broadcast<V>(T(0));
  const ZoneTerms<V> terms = zone_terms(quarters, cells, doubt);
  const V half = broadcast<V>(T(0.5));
  const auto is_odd = [&](V n)
                          SIMDBEZIER_INLINE_LAMBDA { return whole_part<V>(half * n) != half * n; };
  const V one = broadcast<V>(T(1));
  const MaskOf<V> odd[2] = {is_odd(cells.nu), is_odd(cells.nv)};
  const MaskOf<V> several[2] = {cells.nu > one, cells.nv > one};
  V worst = zero;
  V bits = zero;
  for (std::size_t zone_v = 0; zone_v < 3; ++zone_v) {
    for (std::size_t zone_u = 0; zone_u < 3; ++zone_u) {
      V a = zero;
      V c = zero;
      V rising = zero;
      V falling = zero;
      for (std::size_t k = 0; k < 4; ++k) {
        if ((zone_u == 2 || k % 2 == zone_u) && (zone_v == 2 || k / 2 == zone_v)) {
          a = larger_of<V>(terms.uu[k], a);
          c = larger_of<V>(terms.vv[k], c);
          rising = larger_of<V>(terms.rising[k], rising);
          falling = larger_of<V>(terms.falling[k], falling);
        }
      }
      const MaskOf<V> occurs =
          (zone_u == 2 ? odd[0] : several[0]) & (zone_v == 2 ? odd[1] : several[1]);
      const V bound = triangle_bound<V>(a, c, smaller_of<V>(rising, falling));
      worst = larger_of<V>(select_where<V>(occurs, bound, zero), worst);
      if (diagonals != nullptr) {
        const V bit = broadcast<V>(static_cast<T>(1U << (3 * zone_v + zone_u)));
        bits = bits + select_where<V>(occurs & !(rising < falling), bit, zero);
      }
    }
  }
  if (diagonals != nullptr) {
    *diagonals = bits;
  }
  // The roundings of the bound itself, a few dozen.
  return worst * broadcast<V>(T(1) + 64 * std::numeric_limits<T>::epsilon());
}

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

/// What is left of a patch's tolerance, in units of its size; rounded down.
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
    } else {
      certify_group<T>(task, first, count, scratch, group);
    }
  });
  return Isa::SIMDBEZIER_ISA;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
