// Derivatives of any order: what the base code asks a kernel for. No xsimd in here.
#pragma once

#include <cstddef>

#include <simdbezier/outputs.hpp>

#include "src/storage/patch_arrays.hpp"

namespace simdbezier::detail {

inline constexpr std::size_t kMostDerivatives = std::size_t{kMostDerivativeOrder} + 1;

/// Which orders a sample has to be computed to: of u derivatives up to highest_u, and with the a-th
/// of them v derivatives up to highest_v[a] (-1: none).
struct DerivativeOrders {
  int highest_u = 0;
  int highest_v[kMostDerivatives];
};

/// Samples on patches of one shape. Sample k is number first + k of the call's outputs.
template <typename T>
struct DerivativeTask : PatchArrays<T> {
  const std::size_t* patch;
  const T* x; ///< half-centred; nan where the parameter is not finite
  const T* y;
  std::size_t first;
  std::size_t count;

  const PartialDerivative<T>* derivatives; ///< orders checked
  std::size_t derivative_count;
  const DerivativeOrders* orders;
  std::size_t first_component; ///< the component that goes to Vectors::x
  bool watertight;
  Isa executed; ///< written by the kernel
};

} // namespace simdbezier::detail
