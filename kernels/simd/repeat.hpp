// Loops whose every turn is code of its own.
#pragma once

#include <cstddef>
#include <utility>

#include "kernels/simd/vector.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// f(0), f(1), … f(kCount - 1), each in code of its own, so that arrays can live in registers.
template <std::size_t kCount, typename F>
SIMDBEZIER_INLINE void repeat(const F& f) {
  [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) SIMDBEZIER_INLINE_LAMBDA {
    (f(kIndex), ...);
  }
  (std::make_index_sequence<kCount>());
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
