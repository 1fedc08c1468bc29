// Vertices of a mesh in the formats that graphics processors and glTF read. Every value is computed
// from evaluate_mesh()'s own, so that vertices of equal bits have equal bits in any format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/evaluate_mesh.hpp>

namespace simdbezier {

/// How one output of a vertex is stored. The errors below are those of storing alone.
enum class VertexFormat : std::uint8_t {
  float32, ///< 4 bytes a component; none if values are float
  half,    ///< 2 bytes: 2^-11 of the value, 2^-25 below 2^-14; infinite above 65 504
  unorm16, ///< 2 bytes: 0 to 65 535. Positions: low + step q, off by step / 2 at most a component,
           ///< in a box with one step for all axes. Parameters: q / 65 535.
  snorm16, ///< 2 bytes: -32 767 to 32 767. Positions alone: low + step q, low being the middle.
  octahedral16, ///< normals alone, two snorm16: 0.0037 degrees at most
  octahedral8   ///< normals alone, two snorm8: 0.95 degrees at most
};

/// The bytes of one vertex's output: 3 components for positions and normals, 2 for parameters.
[[nodiscard]] constexpr std::size_t format_bytes(VertexFormat format,
                                                 std::size_t components) noexcept {
  switch (format) {
  case VertexFormat::float32:
    return 4 * components;
  case VertexFormat::octahedral16:
    return 4;
  case VertexFormat::octahedral8:
    return 2;
  default:
    return 2 * components;
  }
}

/// Where one output goes, and how: that of vertex k at first + k * stride, in bytes.
struct FormattedOutput {
  void* first = nullptr;     ///< null: not asked for
  std::ptrdiff_t stride = 0; ///< 0: packed, format_bytes() apart
  VertexFormat format = VertexFormat::float32;
  std::size_t capacity = kTrusted; ///< vertices
};

/// A box and its step, for positions as unorm16 or snorm16: position = low + step q. All axes have
/// one step, since different scales would turn normals; a whole model has one box, so that edges
/// shared with other meshes of it stay shared.
struct QuantisationBox {
  std::array<double, 3> low = {0, 0, 0};
  double step = 0;
};

/// Finds the box of all control points of three components, for one of the two formats.
/// Returns: ok | the statuses of views | non_finite_input | bad_tolerance (another format, or
///          points so close to each other, or so far apart, that the step is 0 or infinite).
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status quantisation_box(std::span<const ControlNets<S>> nets,
                                                     VertexFormat format,
                                                     QuantisationBox& box) noexcept;

/// The outputs of a mesh's vertices, formatted; one at least. They may share memory as members of
/// one vertex: equal strides, no common byte.
struct FormattedOutputs {
  FormattedOutput position;   ///< float32, half, unorm16, snorm16
  FormattedOutput normal;     ///< float32, octahedral16, octahedral8; zero ones become +z
  FormattedOutput parameters; ///< float32, half, unorm16
  QuantisationBox box;        ///< the box of positions; what lies outside of it moves to its border
};

/// Evaluates vertices as evaluate_mesh(set, layout, MeshOutputs, …) does, and formats them.
/// Octahedral: n / (|x| + |y| + |z|), whose lower half is folded over the upper one, is a point (s,
///             t) of a square: rounded to the nearest q / 32 767 or q / 127. Source: Z. Cigolle et
///             al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT, 2014.
/// Returns:    as that call; bad_components also for a format that an output does not have,
///             bad_tolerance for a box without a step.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_mesh(const PatchSet<T>& set, const MeshLayout& layout,
                                                  const FormattedOutputs& out,
                                                  const Options& options = {},
                                                  SetRange patches = {}) noexcept;

} // namespace simdbezier
