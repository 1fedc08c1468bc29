// Loops whose every turn is code of its own.
#pragma once

#include <cstddef>
#include <utility>

#include "kernels/simd/vector.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Calls f(0), f(1), … f(kCount - 1), each in code of its own, so that arrays can live in
/// registers.
template <std::size_t kCount, typename F>
SIMDBEZIER_INLINE void repeat(const F& f) {
  [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) SIMDBEZIER_INLINE_LAMBDA {
    (f(kIndex), ...);
  }
  (std::make_index_sequence<kCount>());
}

/// Calls f(0), f(1), f(2): each in code of its own, or in a loop.
template <bool kApart, typename F>
SIMDBEZIER_INLINE void for_components(const F& f) {
  if constexpr (kApart) {
    repeat<3>(f);
  } else {
    for (std::size_t c = 0; c < 3; ++c) {
      f(c);
    }
  }
}

/// In place of a member that some types do without.
struct Nothing {
  template <typename... Arguments>
  explicit SIMDBEZIER_INLINE Nothing(const Arguments&... /*of the member*/) {}
};

/// Calls f<count>() for the count, which is one of kCounts.
template <std::size_t... kCounts, typename F>
SIMDBEZIER_INLINE void with_one_of(std::size_t count, const F& f) {
  ((count == kCounts ? f.template operator()<kCounts>() : void()), ...);
}

/// Returns how long parts of a whole are, if they are as few as they can be and none is longer than
/// most.
SIMDBEZIER_INLINE std::size_t even_share(std::size_t whole, std::size_t most) {
  const auto parts = static_cast<unsigned>((whole + most - 1) / most);
  return parts < 2 ? whole : (static_cast<unsigned>(whole) + parts - 1) / parts;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
