// Sums and products carried in two doubles, for packing double control points; lanes are
// independent. There is only what packing needs. Nothing is fused, so that the bits are the same on
// every instruction set.
//
// The second double collects errors and is never brought below half a unit of the first one: the
// value is their sum, whose error stays below 2^-104 of the largest number on the way for each
// operation, and only the last rounding counts. That saves a quarter of the operations. Source: T.
// J. Dekker, "A floating-point technique for extending the available precision", Numerische
// Mathematik 18 (1971); two_sum after D. E. Knuth, TAOCP vol. 2, 4.2.2.
#pragma once

#include "kernels/simd/transpose.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

struct DoubleDouble {
  Wide high;
  Wide low;
};

/// Returns a + b without error. It is commutative and odd, which edge coefficients rely on: both
/// sides of a reversed edge must get the same bits.
SIMDBEZIER_INLINE DoubleDouble two_sum(Wide a, Wide b) {
  const Wide sum = a + b;
  const Wide part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}
/// Returns a - b without error, as two_sum(a, -b) does, operation by operation.
SIMDBEZIER_INLINE DoubleDouble two_difference(Wide a, Wide b) {
  const Wide sum = a - b;
  const Wide part = sum - a;
  return {sum, (a - (sum - part)) - (b + part)};
}

// The first argument is of the type that a sum is carried in.
template <typename W>
SIMDBEZIER_INLINE W sum_of(Wide a, Wide b) {
  if constexpr (sizeof(W) == sizeof(Wide)) {
    return a + b;
  } else {
    return two_sum(a, b);
  }
}
template <typename W>
SIMDBEZIER_INLINE W difference_of(Wide a, Wide b) {
  if constexpr (sizeof(W) == sizeof(Wide)) {
    return a - b;
  } else {
    return two_difference(a, b);
  }
}
template <typename W>
SIMDBEZIER_INLINE W sum_of(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble sum = two_sum(a.high, b.high);
  return {sum.high, sum.low + (a.low + b.low)};
}
template <typename W>
SIMDBEZIER_INLINE W difference_of(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble difference = two_difference(a.high, b.high);
  return {difference.high, difference.low + (a.low - b.low)};
}

/// Returns a times a power of two.
SIMDBEZIER_INLINE Wide scaled(Wide a, double power) { return a * Wide(power); }
SIMDBEZIER_INLINE DoubleDouble scaled(DoubleDouble a, double power) {
  return {a.high * Wide(power), a.low * Wide(power)};
}

/// Returns 3 a, or that times a power of two: in one product of single doubles, which rounds as 3 a
/// does, since what is carried in them comes from floats and is far from the ends of their range.
SIMDBEZIER_INLINE Wide tripled(Wide a, double power = 1) { return Wide(3 * power) * a; }
SIMDBEZIER_INLINE DoubleDouble tripled(DoubleDouble a) {
  const Wide two(2.0);
  return sum_of<DoubleDouble>(DoubleDouble{two * a.high, two * a.low}, a);
}
SIMDBEZIER_INLINE DoubleDouble tripled(DoubleDouble a, double power) {
  return scaled(tripled(a), power);
}

/// Returns a * b, exact up to 2^-106 of it where both halves have all of their bits; it is odd in a
/// and in b.
SIMDBEZIER_INLINE DoubleDouble two_product(Wide a, Wide b) {
  const Wide a0 = leading_bits(a);
  const Wide b0 = leading_bits(b);
  const Wide a1 = a - a0;
  const Wide b1 = b - b0;
  const Wide rounded = a * b;
  return {rounded, (((a0 * b0 - rounded) + a0 * b1) + a1 * b0) + a1 * b1};
}

/// Returns a * b where b is a single double.
SIMDBEZIER_INLINE Wide product(Wide a, Wide b) { return a * b; }
SIMDBEZIER_INLINE DoubleDouble product(DoubleDouble a, Wide b) {
  const DoubleDouble rounded = two_product(a.high, b);
  return {rounded.high, rounded.low + a.low * b};
}

/// Returns a times an integer of up to 26 bits.
SIMDBEZIER_INLINE Wide times_integer(Wide a, double integer) { return a * Wide(integer); }
SIMDBEZIER_INLINE DoubleDouble times_integer(DoubleDouble a, double integer) {
  const Wide factor(integer);
  const Wide leading = leading_bits(a.high);
  const Wide rounded = a.high * factor;
  const Wide rest = (leading * factor - rounded) + (a.high - leading) * factor;
  return {rounded, rest + a.low * factor};
}

/// Returns a single double as W carries it.
template <typename W>
SIMDBEZIER_INLINE W carried(Wide a) {
  if constexpr (sizeof(W) == sizeof(Wide)) {
    return a;
  } else {
    return {a, Wide(0.0)};
  }
}

/// Returns the value rounded to one double.
SIMDBEZIER_INLINE Wide to_wide(Wide a) { return a; }
SIMDBEZIER_INLINE Wide to_wide(DoubleDouble a) { return a.high + a.low; }

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
