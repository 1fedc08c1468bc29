// Polynomials of degree 3 to 5 by their even and odd parts, as docs/accuracy.md has the steps: the
// order of operations of rows, edges and curves. Written from that page for the tests alone; what
// the steps are made of is up to the caller: numbers, or numbers with a bound on their error.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace simdbezier::tests {

/// Whether rows, edges and curves of a degree are evaluated by even and odd parts; all others take
/// Horner's rule.
[[nodiscard]] constexpr bool by_even_and_odd_parts(std::size_t degree) {
  return degree >= 3 && degree <= 5;
}

/// Arithmetic in T, one rounding each; madd has two without fused operations.
template <typename T>
struct Rounded {
  bool fma;

  [[nodiscard]] T madd(T a, T b, T c) const { return fma ? std::fma(a, b, c) : a * b + c; }
  [[nodiscard]] T product(T a, T b) const { return a * b; }
  [[nodiscard]] T square(T a) const { return a * a; }
  [[nodiscard]] T tripled(T a) const { return 3 * a; }
  [[nodiscard]] T sum(T a, T b) const { return a + b; }
  [[nodiscard]] T twice(T a) const { return a + a; }
};

/// A value, its derivative and half of its second derivative.
template <typename Value>
struct EvenOddJet {
  Value value;
  Value slope;
  Value half_second;
};

/// The value and derivatives of sum c[k] t^k, with 4 to 6 coefficients.
template <typename Arithmetic, typename Value>
[[nodiscard]] EvenOddJet<Value> even_odd(const Arithmetic& in, std::span<const Value> c, Value t) {
  const bool quartic = c.size() > 4;
  const bool quintic = c.size() > 5;
  const Value z = in.square(t);
  const Value b = quartic ? in.madd(c[4], z, c[2]) : c[2];
  const Value even = in.madd(b, z, c[0]);
  const Value even_slope = quartic ? in.madd(c[4], z, b) : b;
  const Value d = quintic ? in.madd(c[5], z, c[3]) : c[3];
  const Value odd = in.madd(d, z, c[1]);
  const Value odd_slope = quintic ? in.madd(c[5], z, d) : d;
  const Value value = in.sum(even, in.product(t, odd));

  const Value growth = in.madd(odd_slope, in.twice(z), odd);
  const Value slope = in.sum(growth, in.product(in.twice(t), even_slope));

  const Value four_z = in.twice(in.twice(z));
  const Value bend = quartic ? in.madd(c[4], four_z, even_slope) : c[2];
  const Value cubic_part = in.product(in.tripled(t), odd_slope);
  const Value odd_bend = quintic ? in.madd(c[5], in.product(four_z, t), cubic_part) : cubic_part;
  return {value, slope, in.sum(bend, odd_bend)};
}

} // namespace simdbezier::tests
