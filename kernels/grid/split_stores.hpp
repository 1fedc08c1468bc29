// Stores alone, in the order of a plane's rows: by them src/choice/line_costs.cpp finds out what
// stores across cache lines cost.
#pragma once

#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Stores the register at `to` as often as it is asked for, one behind the other.
template <typename T>
SIMDBEZIER_KERNEL void store_registers(T* to, std::size_t registers) {
  const vec<T> value = load_vector<vec<T>>(to);
  for (std::size_t k = 0; k < registers; ++k) {
    store_vector(to + k * kLanes<vec<T>>, value);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
