#include "src/nets/linear_maps.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <numeric>

namespace simdbezier::detail {
namespace {

std::int64_t binomial(int n, int k) noexcept {
  if (k < 0 || k > n) {
    return 0;
  }
  std::int64_t value = 1;
  for (int i = 1; i <= k; ++i) {
    value = value * (n - k + i) / i;
  }
  return value;
}

/// Rows are given by their entries; terms are paired from both ends, so that rows that mirror each
/// other have mirrored orders of additions as well.
template <typename Entry>
void set_folded_row(LinearMap::Row& row, int degree, std::int64_t factor, std::int64_t divisor,
                    Entry entry) noexcept {
  row.factor = static_cast<double>(factor);
  row.divisor = static_cast<double>(divisor);
  for (int k = 0; 2 * k <= degree; ++k) {
    const int other = degree - k;
    const std::int64_t a = entry(k);
    const std::int64_t b = other == k ? 0 : entry(other);
    if (a != 0 || b != 0) {
      row.pair[row.pairs++] = {static_cast<std::size_t>(k), static_cast<std::size_t>(other),
                               static_cast<double>(a), static_cast<double>(b)};
    }
  }
}

LinearMap sized(int degree) noexcept {
  LinearMap map;
  map.rows = static_cast<std::size_t>(degree) + 1;
  return map;
}

/// Coefficient of z^k in (1 + z)^i (1 - z)^j.
std::int64_t krawtchouk(int i, int j, int k) noexcept {
  std::int64_t sum = 0;
  for (int l = 0; l <= k; ++l) {
    const std::int64_t term = binomial(j, l) * binomial(i, k - l);
    sum += l % 2 == 0 ? term : -term;
  }
  return sum;
}

LinearMap power_to_bezier(int n) noexcept {
  LinearMap map = sized(n);
  for (int i = 0; i <= n; ++i) {
    std::int64_t divisor = 1;
    for (int k = 0; k <= i; ++k) {
      divisor = std::lcm(divisor, binomial(n, k));
    }
    set_folded_row(map.row[i], n, 1, divisor,
                   [&](int k) { return binomial(i, k) * divisor / binomial(n, k); });
  }
  return map;
}

LinearMap bezier_to_power(int n) noexcept {
  LinearMap map = sized(n);
  for (int k = 0; k <= n; ++k) {
    set_folded_row(map.row[k], n, binomial(n, k), 1,
                   [&](int i) { return (k - i) % 2 == 0 ? binomial(k, i) : -binomial(k, i); });
  }
  return map;
}

/// x = u - (1-u) and 1 = u + (1-u), so x^k has the control values of (z-1)^k (z+1)^(n-k).
LinearMap centred_power_to_bezier(int n) noexcept {
  LinearMap map = sized(n);
  for (int i = 0; i <= n; ++i) {
    set_folded_row(map.row[i], n, 1, binomial(n, i), [&](int k) {
      const std::int64_t value = krawtchouk(n - k, k, i);
      return k % 2 == 0 ? value : -value;
    });
  }
  return map;
}

/// u = (1+x)/2.
LinearMap bezier_to_centred_power(int n) noexcept {
  LinearMap map = sized(n);
  for (int k = 0; k <= n; ++k) {
    set_folded_row(map.row[k], n, 1, std::int64_t{1} << n,
                   [&](int i) { return binomial(n, i) * krawtchouk(i, n - i, k); });
  }
  return map;
}

using Pairs = std::initializer_list<LinearMap::Pair>;

/// A row with its own order of additions.
LinearMap::Row sum(Pairs pairs, double factor, double divisor) noexcept {
  LinearMap::Row row;
  std::copy(pairs.begin(), pairs.end(), row.pair);
  row.pairs = pairs.size();
  row.factor = factor;
  row.divisor = divisor;
  return row;
}
/// One of the values alone.
LinearMap::Row copy(std::size_t k) noexcept { return sum({{k, k, 1, 0}}, 1, 1); }

LinearMap cubic(const LinearMap::Row (&rows)[4], bool keeps_constants) noexcept {
  LinearMap map = sized(3);
  std::copy_n(rows, 4, map.row);
  map.keeps_constants = keeps_constants;
  return map;
}

} // namespace

LinearMap identity_map(int degree) noexcept {
  LinearMap map = sized(degree);
  map.identity = true;
  return map;
}

LinearMap elevation_map(int degree, int new_degree) noexcept {
  if (degree == new_degree) {
    return identity_map(degree);
  }
  const int steps = new_degree - degree;
  LinearMap map = sized(new_degree);
  for (int i = 0; i <= new_degree; ++i) {
    set_folded_row(map.row[i], degree, 1, binomial(new_degree, i),
                   [&](int k) { return binomial(degree, k) * binomial(steps, i - k); });
  }
  map.keeps_constants = true;
  return map;
}

LinearMap hodograph_map(int degree) noexcept {
  LinearMap map = sized(degree > 1 ? degree - 1 : 1);
  for (std::size_t i = 0; i < map.rows; ++i) {
    const std::size_t k = degree > 1 ? i : 0;
    map.row[i] = sum({{k, k + 1, -1, 1}}, degree, 1);
  }
  return map;
}

Support support_of_piece(int degree, bool first, bool last) noexcept {
  Support support{};
  for (int k = 0; k <= degree; ++k) {
    support.first[k] = static_cast<std::uint8_t>(last ? k : 0);
    support.last[k] = static_cast<std::uint8_t>(first ? k : degree);
  }
  return support;
}

Support support_of(const LinearMap& map) noexcept {
  if (map.identity) {
    return support_of_piece(static_cast<int>(map.rows) - 1, true, true);
  }
  Support support{};
  for (std::size_t r = 0; r < map.rows; ++r) {
    std::size_t first = kMostOrder;
    std::size_t last = 0;
    bool positive = map.keeps_constants;
    const auto include = [&](double entry, std::size_t column) {
      positive = positive && entry >= 0;
      if (entry != 0) {
        first = std::min(first, column);
        last = std::max(last, column);
      }
    };
    for (std::size_t q = 0; q < map.row[r].pairs; ++q) {
      const LinearMap::Pair& pair = map.row[r].pair[q];
      include(pair.entry_a, pair.a);
      include(pair.entry_b, pair.b);
    }
    support.first[r] = static_cast<std::uint8_t>(positive ? first : 1);
    support.last[r] = static_cast<std::uint8_t>(positive ? last : 0);
  }
  return support;
}

LinearMap basis_map(Basis basis, int degree, bool to_bezier) noexcept {
  switch (basis) {
  case Basis::power:
    return to_bezier ? power_to_bezier(degree) : bezier_to_power(degree);
  case Basis::centred_power:
    return to_bezier ? centred_power_to_bezier(degree) : bezier_to_centred_power(degree);
  case Basis::hermite:
    return to_bezier
               ? cubic({copy(0), sum({{0, 2, 3, 1}}, 1, 3), sum({{1, 3, 3, -1}}, 1, 3), copy(1)},
                       false)
               : cubic({copy(0), copy(3), sum({{0, 1, -1, 1}}, 3, 1), sum({{2, 3, -1, 1}}, 3, 1)},
                       false);
  case Basis::catmull_rom:
    return to_bezier ? cubic({copy(1), sum({{0, 2, -1, 1}, {1, 1, 6, 0}}, 1, 6),
                              sum({{1, 3, 1, -1}, {2, 2, 6, 0}}, 1, 6), copy(2)},
                             true)
                     : cubic({sum({{0, 1, 6, -6}, {3, 3, 1, 0}}, 1, 1), copy(0), copy(3),
                              sum({{2, 3, -6, 6}, {0, 0, 1, 0}}, 1, 1)},
                             true);
  case Basis::b_spline:
    break;
  }
  // Outer points are added first: the last point of a piece and the first point of the next are
  // then the same sum of the same three points.
  return to_bezier ? cubic({sum({{0, 2, 1, 1}, {1, 1, 4, 0}}, 1, 6), sum({{1, 2, 4, 2}}, 1, 6),
                            sum({{1, 2, 2, 4}}, 1, 6), sum({{1, 3, 1, 1}, {2, 2, 4, 0}}, 1, 6)},
                           true)
                   : cubic({sum({{0, 1, 6, -7}, {2, 2, 2, 0}}, 1, 1), sum({{1, 2, 2, -1}}, 1, 1),
                            sum({{1, 2, -1, 2}}, 1, 1), sum({{2, 3, -7, 6}, {1, 1, 2, 0}}, 1, 1)},
                           true);
}

} // namespace simdbezier::detail
