// Passing staged samples on, in whole cache lines, between the rows that are being computed.
#pragma once

#include "kernels/drain.hpp"
#include "kernels/isa/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::DrainQueue;

/// To be called by kernels after every few rows: `values` of T have been written since the last
/// call. Passes about as many on, so that memory and arithmetic overlap.
template <typename T>
SIMDBEZIER_INLINE void pace(DrainQueue<T>* drain, std::size_t values) {
  if (drain != nullptr) [[unlikely]] {
    drain->owed += values;
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
