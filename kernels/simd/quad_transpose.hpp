// Square matrices in the 128-bit lanes of registers: rows become columns, all lanes at once.
// Shuffles that stay in these lanes do not compete with multiply-adds.
#pragma once

#include <cstddef>
#include <utility>

#include "kernels/simd/vector.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns where a value comes from in a result that has the low (high) units of a and b in turn,
/// in each `quad` of `lanes` values; a unit is kUnit values.
template <std::size_t kUnit, bool kHigh>
constexpr int zipped(std::size_t lane, std::size_t lanes, std::size_t quad) {
  const std::size_t k = lane % quad / kUnit;
  return static_cast<int>(lane / quad * quad + (kHigh ? quad / 2 : 0) + k / 2 * kUnit +
                          lane % kUnit + (k % 2) * lanes);
}

template <typename T, std::size_t kUnit, bool kHigh, std::size_t kQuad = 16 / sizeof(T), typename B>
SIMDBEZIER_INLINE B zip(B a, B b) {
  constexpr std::size_t kAll = sizeof(B) / sizeof(T);
  return [&]<std::size_t... kLane>(std::index_sequence<kLane...>) SIMDBEZIER_INLINE_LAMBDA {
    return __builtin_shufflevector(a, b, zipped<kUnit, kHigh>(kLane, kAll, kQuad)...);
  }
  (std::make_index_sequence<kAll>());
}

/// Result k: of the k-th fourth of each kQuad lanes, groups of four values, one of each register.
template <typename T, std::size_t kQuad, typename B>
SIMDBEZIER_INLINE void transpose_four(B m[4]) {
  const B low01 = zip<T, 1, false, kQuad>(m[0], m[1]);
  const B high01 = zip<T, 1, true, kQuad>(m[0], m[1]);
  const B low23 = zip<T, 1, false, kQuad>(m[2], m[3]);
  const B high23 = zip<T, 1, true, kQuad>(m[2], m[3]);
  m[0] = zip<T, 2, false, kQuad>(low01, low23);
  m[1] = zip<T, 2, true, kQuad>(low01, low23);
  m[2] = zip<T, 2, false, kQuad>(high01, high23);
  m[3] = zip<T, 2, true, kQuad>(high01, high23);
}

/// Transposes the matrices of 16 / sizeof(T) registers. B is a vector of T that the compiler knows.
template <typename T, typename B>
SIMDBEZIER_INLINE void transpose_quads(B m[16 / sizeof(T)]) {
  if constexpr (sizeof(T) == 8) {
    const B low = zip<T, 1, false>(m[0], m[1]);
    m[1] = zip<T, 1, true>(m[0], m[1]);
    m[0] = low;
  } else {
    transpose_four<T, 4>(m);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
