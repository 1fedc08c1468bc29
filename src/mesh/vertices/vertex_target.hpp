// The places that the vertices of a mesh go to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// Attributes of vertices, in the caller's memory; null where not wanted.
template <typename T>
struct ParameterOutputs {
  T* u = nullptr;
  T* v = nullptr;
  std::ptrdiff_t stride = 1;
  std::uint32_t* patch = nullptr;

  [[nodiscard]] bool wanted() const noexcept { return u != nullptr || patch != nullptr; }
  void put(std::size_t vertex, std::uint32_t of_patch, T at_u, T at_v) const noexcept {
    if (u != nullptr) {
      u[static_cast<std::ptrdiff_t>(vertex) * stride] = at_u;
      v[static_cast<std::ptrdiff_t>(vertex) * stride] = at_v;
    }
    if (patch != nullptr) {
      patch[vertex] = of_patch;
    }
  }
  /// Those of vertices one after the other, whose v is the same.
  void put_row(std::size_t vertex, std::size_t count, std::uint32_t of_patch, const T* at_u,
               T at_v) const noexcept {
    if (stride == 1 && u != nullptr) {
      std::copy_n(at_u, count, u + vertex);
      std::fill_n(v + vertex, count, at_v);
      if (patch != nullptr) {
        std::fill_n(patch + vertex, count, of_patch);
      }
      return;
    }
    for (std::size_t k = 0; k < count; ++k) {
      put(vertex + k, of_patch, at_u[k], at_v);
    }
  }
};

/// Planes that vertices go to: values of vertex k at [(k - first) * step] of a plane.
template <typename T>
struct VertexTarget {
  Planes<T> position;
  Planes<T> normal;
  std::size_t step = 1;
  std::size_t first = 0;
  ParameterOutputs<T> parameters; ///< of vertex k at k - parameters_first
  std::size_t parameters_first = 0;
  DrainQueue<T>* drain = nullptr; ///< what kernels pass on meanwhile
};

} // namespace simdbezier::detail
