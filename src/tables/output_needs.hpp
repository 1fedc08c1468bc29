// Sets of outputs that need the same. They are constants: kernels may not read the table that they
// come from, which would be one more symbol of all objects.
#pragma once

#include <cstddef>

#include <simdbezier/outputs.hpp>

namespace simdbezier::detail {

/// Returns the outputs of patches of which is(Output) holds.
template <typename Is>
constexpr OutputSelection outputs_where(const Is& is) noexcept {
  OutputSelection all;
  for (std::size_t k = 0; k < kOutputs; ++k) {
    if (is(static_cast<Output>(k))) {
      all.add(static_cast<Output>(k));
    }
  }
  return all;
}
/// Returns the outputs whose highest derivatives are of that order, and not those of lower ones.
consteval OutputSelection outputs_of_order(int order) noexcept {
  return outputs_where([order](Output output) { return derivative_order(output) == order; });
}
inline constexpr OutputSelection kSpaceOutputs = outputs_where(needs_space);

} // namespace simdbezier::detail
