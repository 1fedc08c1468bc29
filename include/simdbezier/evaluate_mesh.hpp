// The vertices of a mesh: positions, normals and attributes, straight into its numbering.
//
//     find_topology(nets, topology);   choose_rates(nets, topology, options, rates);
//     lay_out_mesh(topology, rates, layout);
//     evaluate_mesh(set, layout, outputs);   write_triangles(layout, triangles);
//
// tessellate() in mesh.hpp is all of it in one call. The constraints of evaluate.hpp hold here:
// outputs, bits, allocation, layouts, threads. Vertices have the indices that triangles use.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/evaluate.hpp>
#include <simdbezier/mesh_layout.hpp>

namespace simdbezier {

/// What the vertices of a mesh are asked for. Every output is optional, but one is required. They
/// may share memory only as members of one vertex: equal strides, no common element.
template <typename T>
struct MeshOutputs {
  Vectors<T> position = {};
  /// Merged over all patches that have the vertex; see evaluate_mesh().
  Vectors<T> normal = {};
  /// u as x and v as y, z null, on the lowest patch that has the vertex; in a layout of
  /// split_parameters(), on the patch of all of its triangles. At a side that is a point, the
  /// parameter along it is 1/2.
  Vectors<T> parameters = {};
  /// The number of that patch.
  Values<std::uint32_t> patch = {};
};

/// Evaluates the vertices that the patches of a range own; lay_out_mesh() says which these are.
/// set:        the patches of the layout's topology, in the same order, with three components.
/// out:        index 0 is MeshLayout::first_vertex() of the first patch of the range.
/// Position:   on an edge and in a corner, the position of the lowest patch there. If control
///             points are equal, all other patches have the same position bit for bit.
/// Normal:     the sum of the unit normals of all patches that have the vertex, in ascending order
///             of patch and side or corner, divided by its length. Normals of patches that the
///             topology turned are reversed, and zero normals add nothing. On an edge of two sides,
///             the normals of the second patch may disagree with those of the first one. If turning
///             has not made them agree, they are left out. If the length of the sum is below 0.001
///             times the number of normals, the first normal is used instead.
/// Order:      if patches are given in another order, positions stay, as long as control points are
///             equal. Normals at inner points and on edges of one side or two stay, too. Other
///             normals change by the rounding of their sum. docs/tessellation.md says what the
///             lowest patch decides.
/// Returns:    ok | the statuses of outputs (bad_components: not three) and of running |
///             unequal_lengths (set and layout have other numbers of patches) | bad_patch_range.
/// Allocation: scratch per thread, which grows with the most vertices on one patch's boundary.
/// Cost:       a vertex takes as long as two to six samples of a grid (docs/experiments.md).
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_mesh(const PatchSet<T>& set, const MeshLayout& layout,
                                                  const MeshOutputs<T>& out,
                                                  const Options& options = {},
                                                  SetRange patches = {}) noexcept;

/// Evaluates further components of the control points, such as colours or texture coordinates:
/// first_component and up to two that follow it, of the lowest patch that has the vertex. The set
/// has the same patches, with any number of components. In a layout of split_parameters(), or of
/// split_creases() with an angle of 0, every patch has values of its own. Returns, allocation: as
/// evaluate_mesh(); bad_components if the set has no such component.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_mesh_attributes(
    const PatchSet<T>& set, const MeshLayout& layout, const Vectors<T>& out,
    int first_component = 0, const Options& options = {}, SetRange patches = {}) noexcept;

/// Gives the vertices on edges and in corners more than one number if the patches' normals differ
/// too much to be merged. Triangles and positions stay as they are.
/// degrees:    an angle. Along an edge, a side joins the first group of earlier sides whose
///             normals all differ from its own by less than the angle; in a corner, patches join
///             their neighbours across edges by the same rule. Sides that are points keep one
///             vertex, and patches whose normals disagree (see evaluate_mesh()) never join. 0:
///             patches share no vertices. 180 and more: only disagreeing ones are split.
/// layout:     of lay_out_mesh(). `split` may be the same object. Determinism: as normals.
/// Allocation: 4 bytes for each vertex on an edge and side of it, and 8 a patch.
/// Returns:    ok | bad_components | unequal_lengths | bad_tolerance (a negative angle, or nan) |
///             size_overflow | the statuses of running.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status split_creases(const PatchSet<T>& set, const MeshLayout& layout,
                                                  double degrees, MeshLayout& split,
                                                  const Options& options = {}) noexcept;

/// Gives each patch vertices of its own on its sides and corners, so that they can have its own u,
/// v. Their positions and merged normals are those of the vertex in `layout`, bit for bit. A side
/// that is a point keeps one vertex a patch. Triangles stay as they are, with one exception: if a
/// patch has one row of cells, and two of its neighbouring sides are one edge, some triangles
/// appear that have two vertices in one place.
/// layout:  of lay_out_mesh() or split_creases(), which may also be called afterwards. `split` may
///          be the same object; it keeps the layout alive.
/// Threads: the caller's alone. Determinism: a function of the layout. Allocation: that of the
///          layout once more, and 4 bytes for each vertex on an edge and side of it.
/// Cost:    some 50 ns a patch, and 1 ns for each of these vertices.
/// Returns: ok | size_overflow | out_of_memory.
[[nodiscard]] SIMDBEZIER_API Status split_parameters(const MeshLayout& layout,
                                                     MeshLayout& split) noexcept;

// Vertices of a mesh in the formats that graphics processors and glTF read. Every value is computed
// from evaluate_mesh()'s own, so that vertices of equal bits have equal bits in any format.

/// How one output of a vertex is stored. The errors below are those of storing alone.
enum class VertexFormat : std::uint8_t {
  float32, ///< 4 bytes a component; no error if values are float
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
  case VertexFormat::half:
  case VertexFormat::unorm16:
  case VertexFormat::snorm16:
    break;
  }
  return 2 * components;
}

/// Where one output goes, and how: that of vertex k at first + k * stride, in bytes.
struct FormattedOutput {
  void* first = nullptr;     ///< null: not asked for
  std::ptrdiff_t stride = 0; ///< 0: packed, format_bytes() apart
  VertexFormat format = VertexFormat::float32;
  std::size_t capacity = kTrusted; ///< vertices
};

/// A box and its step, for positions as unorm16 or snorm16: position = low + step q. All axes have
/// one step, because different scales would turn normals. Meshes of one model should have one box:
/// edges that they share then stay shared.
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
  FormattedOutput normal;     ///< float32; octahedral16, octahedral8: zero ones become +z
  FormattedOutput parameters; ///< float32, half, unorm16
  QuantisationBox box;        ///< the box of positions; what lies outside of it moves to its border
};

/// Evaluates vertices as the call with MeshOutputs does, and formats them. All stores are plain.
/// Octahedral: the point n / (|x| + |y| + |z|) lies on an octahedron. Its lower half is folded over
///             the upper one, so that n becomes a point (s, t) of a square, which is rounded to the
///             nearest q / 32 767 or q / 127. Source: Z. Cigolle et al., A Survey of Efficient
///             Representations for Independent Unit Vectors, JCGT, 2014.
/// Returns:    as that call; bad_components also for a format that an output does not have,
///             bad_tolerance for a box without a step.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_mesh(const PatchSet<T>& set, const MeshLayout& layout,
                                                  const FormattedOutputs& out,
                                                  const Options& options = {},
                                                  SetRange patches = {}) noexcept;

} // namespace simdbezier
