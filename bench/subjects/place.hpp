// Where rows put their results: in the shared buffer, in one of the library's three layouts.
#pragma once

#include <algorithm>

#include "bench/subjects/job.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {

enum class Layout { planes, triples, vertices };

/// The number of patches of a cache row: 1 to 64, with no more output than kCacheBytes.
inline std::size_t cached_patches(std::size_t bytes_per_patch) {
  return std::clamp<std::size_t>(kCacheBytes / bytes_per_patch, 1, 64);
}

/// Planes, or planes of triples, follow each other. Each begins at a line's start and five lines
/// further than it need be, because planes a power of two apart would compete for the same sets of
/// a cache. Where they are not aligned, the k-th of them begins another k + 1 elements later.
template <typename T>
Results<T> place_results(OutputGroups groups, std::size_t samples, Layout layout,
                         bool aligned = true) {
  constexpr std::size_t kLine = kLineBytes / sizeof(T);
  const std::size_t count = value_count(groups);
  Results<T> results;
  results.groups = groups;
  results.stride = layout == Layout::planes ? 1 : layout == Layout::triples ? 3 : count;
  const std::size_t gap = (samples * results.stride + kLine - 1) / kLine * kLine + 5 * kLine;
  T* const first = reinterpret_cast<T*>(output_buffer());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t plane = layout == Layout::planes ? k : layout == Layout::triples ? k / 3 : 0;
    const std::size_t within = k - plane * (layout == Layout::planes ? 1 : 3);
    results.component[k] = first + plane * gap + within + (aligned ? 0 : plane + 1);
  }
  return results;
}

} // namespace simdbezier_bench
