// Positions of curves go to rows of n samples, in x y z triples or in three planes.
#pragma once

#include <cstdint>

#include "kernels/curve/curve_outputs.hpp"
#include "kernels/simd/pages.hpp"
#include "kernels/simd/registers_to_records.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::CurveTask;

/// This is how far ahead curves are asked for. Streaming stores take the buffers that loads from
/// memory need, so that hardware, which follows the values by itself, comes too late.
template <typename T>
inline constexpr std::size_t kValuesAhead = 4096 / sizeof(T);

/// A component of a cubic without origins has four coefficients and both ends.
inline constexpr std::size_t kOrderOfCubics = 4;
inline constexpr std::size_t kCubicValues = kOrderOfCubics + 2;

/// Returns the ends where x is on them, and `inside` elsewhere.
template <typename V>
SIMDBEZIER_PART V select_ends(V x, V begin, V end, V inside) {
  using T = ScalarOf<V>;
  return select_where<V>(x == broadcast<V>(T(-0.5)), begin,
                         select_where<V>(x == broadcast<V>(T(0.5)), end, inside));
}

/// Rows are one stream of triples, or three of planes. Curve k has its row k * row(n) values behind
/// that of curve 0.
template <bool kTriples, typename T>
struct CurveRows {
  static constexpr std::size_t kStreams = kTriples ? 1 : 3;
  T* first[kStreams];

  static constexpr std::size_t row(std::size_t n) { return kTriples ? 3 * n : n; }
  [[nodiscard]] SIMDBEZIER_PART bool begin_lines() const {
    bool all = true;
    for (T* const to : first) {
      all = all && reinterpret_cast<std::uintptr_t>(to) % 64 == 0;
    }
    return all;
  }
  SIMDBEZIER_PART CurveRows at(std::size_t values) const {
    CurveRows rows;
    for (std::size_t k = 0; k < kStreams; ++k) {
      rows.first[k] = first[k] + values;
    }
    return rows;
  }
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
