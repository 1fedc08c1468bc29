// Outputs of vertices on their way from planes to formats.
#pragma once

#include <algorithm>

#include "kernels/mesh/vertex_formats.hpp"
#include "kernels/simd/repeat.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Stores the first lanes, kBytes of each.
template <std::size_t kBytes, std::size_t kWords>
SIMDBEZIER_INLINE void put_lanes(const Words (&words)[kWords], std::size_t lanes, unsigned char* to,
                                 std::ptrdiff_t stride) {
  alignas(64) std::uint64_t lane[kWords][kWideLanes];
  __builtin_memcpy(lane, words, sizeof lane);
  const auto put = [&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
    __builtin_memcpy(to, &lane[0][i], std::min<std::size_t>(kBytes, 8));
    if constexpr (kWords > 1) {
      __builtin_memcpy(to + 8, &lane[1][i], kBytes - 8);
    }
    to += stride;
  };
  if (lanes >= kWideLanes) {
    repeat<kWideLanes>(put);
  } else {
    for (std::size_t i = 0; i < lanes; ++i) {
      put(i);
    }
  }
}

/// Writes vertices [k, end). Returns whether they are right beyond doubt.
template <bool kExact, typename Format, typename T>
SIMDBEZIER_PART bool format_vertices(const Format& format, const detail::FormatTask<T>& task,
                                     std::size_t k, std::size_t end) {
  Doubt doubt;
  unsigned char* to = task.to + static_cast<std::ptrdiff_t>(k) * task.stride;
  for (; k < end; k += kWideLanes) {
    Words words[Format::kBytes > 8 ? 2 : 1];
    format.template find<kExact>(task.plane, k, words, doubt);
    put_lanes<Format::kBytes>(words, end - k, to, task.stride);
    to += static_cast<std::ptrdiff_t>(kWideLanes) * task.stride;
  }
  return !doubt.any();
}

template <typename Format, typename T>
SIMDBEZIER_RARE void format_again(const Format& format, const detail::FormatTask<T>& task,
                                  std::size_t k, std::size_t end) {
  format_vertices<true>(format, task, k, end);
}

template <typename Format, typename T>
SIMDBEZIER_PART void format_column(const detail::FormatTask<T>& shared_task) {
  const detail::FormatTask<T> task = shared_task; // which stores of bytes cannot change
  const Format format(task);
  if constexpr (kCompactShapes || !Format::kDoubtful) {
    format_vertices<true>(format, task, 0, task.count);
  } else {
    constexpr std::size_t kBlock = 64;
    for (std::size_t k = 0; k < task.count; k += kBlock) {
      const std::size_t end = std::min(k + kBlock, task.count);
      if (!format_vertices<false>(format, task, k, end)) [[unlikely]] {
        format_again(format, task, k, end);
      }
    }
  }
}

/// Positions and normals have three components, parameters two.
template <template <std::size_t> typename Format, typename T>
SIMDBEZIER_PART void format_components(const detail::FormatTask<T>& task) {
  task.components == 3 ? format_column<Format<3>>(task) : format_column<Format<2>>(task);
}

template <typename T>
SIMDBEZIER_KERNEL void format_kernel(const detail::FormatTask<T>& task) {
  switch (task.format) {
  case VertexFormat::float32:
    return format_components<FloatFormat>(task);
  case VertexFormat::half:
    return format_components<HalfFormat>(task);
  case VertexFormat::octahedral16:
    return format_column<OctahedralFormat<16>>(task);
  case VertexFormat::octahedral8:
    return format_column<OctahedralFormat<8>>(task);
  case VertexFormat::unorm16:
  case VertexFormat::snorm16:
    return format_components<StepFormat>(task);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
