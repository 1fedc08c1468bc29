// The places that the vertices of a mesh go to.
#pragma once

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
