// The places that the vertices of a mesh go to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "src/mesh/vertices/vertex_samples.hpp"
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
  /// Those of vertices one after the other. u_step, v_step: from one value to the next, 1, -1 or 0.
  void put_run(std::size_t vertex, std::size_t count, std::uint32_t of_patch, const T* at_u,
               std::ptrdiff_t u_step, const T* at_v, std::ptrdiff_t v_step) const noexcept {
    if (u != nullptr) {
      put_values(at_u, u_step, count, u + static_cast<std::ptrdiff_t>(vertex) * stride);
      put_values(at_v, v_step, count, v + static_cast<std::ptrdiff_t>(vertex) * stride);
    }
    if (patch != nullptr) {
      std::fill_n(patch + vertex, count, of_patch);
    }
  }

private:
  /// Values of planes go in blocks, of which the last one ends with the last value: to start a
  /// function that copies takes as long as most rows.
  void put_values(const T* from, std::ptrdiff_t step, std::size_t count, T* to) const noexcept {
    constexpr std::size_t kBlock = PointBlock<T>::kPoints;
    if (stride != 1 || step < 0 || count < kBlock) {
      for (std::size_t k = 0; k < count; ++k, from += step, to += stride) {
        *to = *from;
      }
      return;
    }
    auto block = typename PointBlock<T>::Values{} + *from;
    for (std::size_t k = 0; k < count; k += kBlock) {
      const std::size_t at = std::min(k, count - kBlock);
      if (step != 0) {
        std::memcpy(&block, from + at, sizeof block);
      }
      std::memcpy(to + at, &block, sizeof block);
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
