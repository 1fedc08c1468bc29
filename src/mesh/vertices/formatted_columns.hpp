// Formatted outputs, checked and with their sizes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <simdbezier/evaluate_mesh.hpp>

#include "src/output/memory_range.hpp"

namespace simdbezier::detail {

inline constexpr std::size_t kPositionComponents = 3;
inline constexpr std::size_t kParameterComponents = 2;

/// One output with its size and its stride.
struct FormattedColumn {
  unsigned char* first = nullptr;
  std::ptrdiff_t stride = 0;
  std::size_t bytes = 0;
  VertexFormat format = VertexFormat::float32;

  FormattedColumn(const FormattedOutput& out, std::size_t components) noexcept
      : first(static_cast<unsigned char*>(out.first)), bytes(format_bytes(out.format, components)),
        format(out.format) {
    stride = out.stride == 0 ? static_cast<std::ptrdiff_t>(bytes) : out.stride;
  }
  [[nodiscard]] bool wanted() const noexcept { return first != nullptr; }
  [[nodiscard]] unsigned char* at(std::size_t vertex) const noexcept {
    return first + static_cast<std::ptrdiff_t>(vertex) * stride;
  }

  /// ok | bad_stride | output_too_small | size_overflow
  [[nodiscard]] Status check(std::size_t vertices, std::size_t capacity) const noexcept {
    if (stride < static_cast<std::ptrdiff_t>(bytes)) {
      return Status::bad_stride;
    }
    constexpr std::size_t kMost = ~std::size_t(0) / 2;
    if (vertices > kMost / static_cast<std::size_t>(stride)) {
      return Status::size_overflow;
    }
    return capacity < vertices ? Status::output_too_small : Status::ok;
  }
  [[nodiscard]] bool collides(const FormattedColumn& other, std::size_t vertices) const noexcept {
    if (!wanted() || !other.wanted() || vertices == 0) {
      return false;
    }
    const auto range = [&](const FormattedColumn& column) {
      return MemoryRange(column.first,
                         (vertices - 1) * static_cast<std::size_t>(column.stride) + column.bytes);
    };
    if (!range(*this).meets(range(other))) {
      return false;
    }
    // Signed, since the ranges meet, and an unsigned difference keeps its remainder only where the
    // stride is a power of two.
    const auto distance = static_cast<std::ptrdiff_t>(
        reinterpret_cast<std::uintptr_t>(other.first) - reinterpret_cast<std::uintptr_t>(first));
    const auto all = static_cast<std::size_t>(stride);
    const auto apart = static_cast<std::size_t>((distance % stride + stride) % stride);
    return stride != other.stride || apart < bytes || apart + other.bytes > all;
  }
};

/// The three outputs of a call.
struct FormattedColumns {
  FormattedColumn position;
  FormattedColumn normal;
  FormattedColumn parameters;
  QuantisationBox box;

  explicit FormattedColumns(const FormattedOutputs& out) noexcept
      : position(out.position, kPositionComponents), normal(out.normal, kPositionComponents),
        parameters(out.parameters, kParameterComponents), box(out.box) {}

  [[nodiscard]] bool formats_fit() const noexcept {
    const bool normals = normal.format == VertexFormat::float32 ||
                         normal.format == VertexFormat::octahedral16 ||
                         normal.format == VertexFormat::octahedral8;
    return position.format <= VertexFormat::snorm16 && normals &&
           parameters.format <= VertexFormat::unorm16;
  }
  [[nodiscard]] Status check(const FormattedOutputs& out, std::size_t vertices) const noexcept {
    if (!position.wanted() && !normal.wanted() && !parameters.wanted()) {
      return Status::null_output;
    }
    if (!formats_fit()) {
      return Status::bad_components;
    }
    const bool boxed =
        position.format == VertexFormat::unorm16 || position.format == VertexFormat::snorm16;
    if (position.wanted() && boxed && !(box.step > 0 && std::isfinite(box.step))) {
      return Status::bad_tolerance;
    }
    for (const auto& [column, given] : {std::pair{&position, &out.position},
                                        {&normal, &out.normal},
                                        {&parameters, &out.parameters}}) {
      const Status status =
          column->wanted() ? column->check(vertices, given->capacity) : Status(Status::ok);
      if (!status) {
        return status;
      }
    }
    return position.collides(normal, vertices) || position.collides(parameters, vertices) ||
                   normal.collides(parameters, vertices)
               ? Status::overlapping_outputs
               : Status::ok;
  }
};

} // namespace simdbezier::detail
