// Sorting.
#pragma once

#include <algorithm>
#include <functional>

namespace simdbezier::detail {

/// Sorts [first, last) in O(n log n); what is equal may come in any order. For WebAssembly, whose
/// code goes over a network, by a heap: std::sort() of libc++ is ten times as much code for every
/// type, which was a fifteenth of the module.
template <typename Iterator, typename Less = std::less<>>
void sort_range(Iterator first, Iterator last, const Less& less = {}) {
#if defined(__wasm__)
  std::make_heap(first, last, less);
  std::sort_heap(first, last, less);
#else
  std::sort(first, last, less);
#endif
}

} // namespace simdbezier::detail
