// The contract between the base code and the kernels that store vertices in their formats.
#pragma once

#include <cstddef>

#include <simdbezier/evaluate_mesh.hpp>

namespace simdbezier::detail {

/// One output of consecutive vertices, from planes to its format.
template <typename T>
struct FormatTask {
  const T* plane[3]; ///< whole cache lines are readable
  std::size_t count;
  unsigned char* to; ///< the first vertex
  std::ptrdiff_t stride;
  VertexFormat format;
  std::size_t components;
  QuantisationBox box; ///< of unorm16 and snorm16
};

/// A table of its own because static programs that store no formats are linked without it.
template <typename T>
struct FormatTable {
  void (*format)(const FormatTask<T>& task);
};

} // namespace simdbezier::detail
