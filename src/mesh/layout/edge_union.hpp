// The parameters of all sides of an edge, each once.
//
// A side of rate n has the parameters i/n, 0 <= i <= n. They are compared as fractions of integers,
// so that all sides agree whatever their direction; equal fractions have equal centred parameters,
// because (2i - n)/n is one correctly rounded division, and so equal positions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace simdbezier::detail {

/// Greatest common divisors of small numbers, which Euclid's algorithm takes some 20 ns for.
class SmallDivisors {
public:
  static constexpr std::uint32_t kEnd = 64;

  constexpr SmallDivisors() {
    for (std::uint32_t a = 0; a < kEnd; ++a) {
      for (std::uint32_t b = 0; b < kEnd; ++b) {
        values_[a * kEnd + b] = static_cast<std::uint8_t>(std::gcd(a, b));
      }
    }
  }
  [[nodiscard]] constexpr std::uint32_t of(std::uint32_t a, std::uint32_t b) const {
    return values_[a * kEnd + b];
  }

private:
  std::uint8_t values_[kEnd * kEnd] = {};
};
inline constexpr SmallDivisors kSmallDivisors;

/// The segments of an edge of two rates: common points count once.
inline std::uint32_t segments_of(std::uint32_t a, std::uint32_t b) {
  const bool small = a < SmallDivisors::kEnd && b < SmallDivisors::kEnd;
  return a + b - (small ? kSmallDivisors.of(a, b) : std::gcd(a, b));
}

/// Different rates of an edge's sides, ascending.
using EdgeRates = std::vector<std::uint32_t>;

/// Puts a rate among the others, once.
inline void include_rate(EdgeRates& rates, std::uint32_t rate) {
  const auto at = std::lower_bound(rates.begin(), rates.end(), rate);
  if (at == rates.end() || *at != rate) {
    rates.insert(at, rate);
  }
}

/// Calls visit(i, n) for a side's points i = 0 .. rate - 1: n segments lead from one to the next on
/// an edge that has another rate as well.
template <typename Visit>
void walk_segments(std::uint32_t rate, std::uint32_t other, const Visit& visit) {
  // Segments end at the other side's points behind this point, up to the next one, and at the next
  // one itself where it is none of those. rest / rate: how far the next one then lies behind a
  // point of the other side, in segments of that side.
  std::uint32_t rest = 0;
  for (std::uint32_t i = 0; i < rate; ++i) {
    const std::uint32_t all = rest + other;
    rest = all % rate;
    visit(i, all / rate + (rest != 0 ? 1 : 0));
  }
}

/// Passes all fractions in ascending order, equal ones at once: visit(place, next, k) after `place`
/// segments, where next[i] is the numerator that rate i has come to, and next[k] / rates[k] is the
/// fraction. Returns the number of segments.
///
/// next: memory for as many values as rates.
template <typename Visit>
std::uint32_t walk_union(std::span<const std::uint32_t> rates, std::uint32_t* next,
                         const Visit& visit) {
  std::fill_n(next, rates.size(), 0U);
  for (std::uint32_t place = 0;; ++place) {
    std::size_t lowest = 0;
    for (std::size_t k = 1; k < rates.size(); ++k) {
      const std::uint64_t other = std::uint64_t{next[k]} * rates[lowest];
      lowest = other < std::uint64_t{next[lowest]} * rates[k] ? k : lowest;
    }
    visit(place, static_cast<const std::uint32_t*>(next), lowest);
    const std::uint64_t numerator = next[lowest];
    const std::uint64_t denominator = rates[lowest];
    if (numerator == denominator) {
      return place;
    }
    for (std::size_t k = 0; k < rates.size(); ++k) {
      next[k] += next[k] * denominator == numerator * rates[k] ? 1 : 0;
    }
  }
}

/// The segments of an edge.
inline std::uint32_t union_segments(std::span<const std::uint32_t> rates,
                                    std::vector<std::uint32_t>& scratch) {
  if (rates.size() == 1) {
    return rates[0];
  }
  if (rates.size() == 2) {
    return segments_of(rates[0], rates[1]);
  }
  scratch.resize(rates.size());
  return walk_union(rates, scratch.data(), [](auto...) {});
}

/// places[i]: how many segments lie before the fraction i/rate; rate is one of the edge's.
inline void union_places(std::span<const std::uint32_t> rates, std::uint32_t rate,
                         std::vector<std::uint32_t>& scratch, std::span<std::uint32_t> places) {
  if (rates.size() == 1) {
    std::iota(places.begin(), places.end(), 0U);
    return;
  }
  if (rates.size() == 2) {
    const std::uint32_t other = rates[rates[0] == rate ? 1 : 0];
    places[0] = 0;
    walk_segments(rate, other,
                  [&](std::uint32_t i, std::uint32_t n) { places[i + 1] = places[i] + n; });
    return;
  }
  const auto own =
      static_cast<std::size_t>(std::lower_bound(rates.begin(), rates.end(), rate) - rates.begin());
  scratch.resize(rates.size());
  walk_union(rates, scratch.data(), [&](std::uint32_t place, auto next, std::size_t lowest) {
    if (std::uint64_t{next[own]} * rates[lowest] == std::uint64_t{next[lowest]} * rate) {
      places[next[own]] = place;
    }
  });
}

} // namespace simdbezier::detail
