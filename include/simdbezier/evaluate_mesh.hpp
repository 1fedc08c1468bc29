// The vertices of a mesh: positions, normals and attributes, straight into its numbering.
//
//     find_topology(nets, topology);   choose_rates(nets, topology, options, rates);
//     lay_out_mesh(topology, rates, layout);
//     evaluate_mesh(set, layout, outputs);   write_triangles(layout, triangles);
//
// mesh.hpp has all of it in one call. What evaluate.hpp says about outputs, bits, allocation,
// layouts and threads holds here; a vertex's index is the one that triangles use.
#pragma once

#include <cstdint>

#include <simdbezier/evaluate.hpp>
#include <simdbezier/mesh_layout.hpp>

namespace simdbezier {

/// What the vertices of a mesh are asked for; every output is optional, one is required. They may
/// share memory only as members of one vertex: equal strides, no common element.
template <typename T>
struct MeshOutputs {
  Vectors<T> position = {};
  /// Merged over all patches that have the vertex; see evaluate_mesh().
  Vectors<T> normal = {};
  /// u as x and v as y, z null, on the lowest patch that has the vertex: of all triangles in a
  /// layout of split_parameters(). At a side that is a point, the parameter along it is 1/2.
  Vectors<T> parameters = {};
  /// The number of that patch.
  Values<std::uint32_t> patch = {};
};

/// Evaluates the vertices that the patches of a range own; lay_out_mesh() says which these are.
///
/// set:      the patches that the layout's topology was made of, in the same order. A set of
///           patches with three components.
/// out:      index 0 is MeshLayout::first_vertex() of the first patch of the range.
/// patches:  all of them, or some: large meshes can be written piece by piece.
/// Position: on an edge and in a corner, that of the lowest patch there. Where control points are
///           equal, all others have the same position bit for bit.
/// Normal:   the sum of the unit normals of all patches that have the vertex, in ascending order of
///           patch and side or corner, divided by its length. Patches that the topology turned
///           count with their normals reversed; zero normals add nothing; patches whose normals
///           disagree with the first one's along the edge, and are not turned, are left out. The
///           first normal stays where the sum is shorter than 0.001 of the number of normals. On
///           edges of more than two sides, all sides count.
/// Order:    where control points are equal, positions do not depend on the order of the patches.
///           Nor do normals at inner points and on edges of one side or two; those of more patches
///           differ by the rounding of their sum. What does depend on it: at edges whose sides
///           disagree (TopologyCounts::turned_edges), and in their corners, the lowest patch
///           decides which normals count and what is their outside, as it does in each connected
///           part where TopologyOptions::orient turns the others; and sums that are too short.
/// Creases:  split_creases() makes a layout in which such vertices are several, and
///           split_parameters() one in which every patch has its own.
/// Returns:  ok | null_output | missing_y | missing_z | extra_z (planes that are not the
///           components) | output_too_small | bad_components (not three) | bad_stride |
///           overlapping_outputs | unequal_lengths (set and layout differ in their number of
///           patches) | bad_patch_range | size_overflow | unknown_isa | unsupported_isa |
///           out_of_memory. On an error nothing has been written.
/// Allocation: scratch per thread, which grows with the most vertices on one patch's boundary.
/// Cost:     a vertex takes as long as two to six samples of a grid (docs/experiments.md).
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_mesh(const PatchSet<T>& set, const MeshLayout& layout,
                                                  const MeshOutputs<T>& out,
                                                  const Options& options = {},
                                                  SetRange patches = {}) noexcept;

/// Further components of the control points, such as colours or texture coordinates: components
/// first_component and up to two that follow it, of the lowest patch that has the vertex.
///
/// set: the same patches, with any number of components. In a layout of split_parameters(), or of
/// split_creases() with an angle of 0, every patch's vertices are its own, and so are these values.
/// Returns, allocation: as evaluate_mesh(); bad_components where the set has no such component.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_mesh_attributes(
    const PatchSet<T>& set, const MeshLayout& layout, const Vectors<T>& out,
    int first_component = 0, const Options& options = {}, SetRange patches = {}) noexcept;

/// Gives the vertices on edges and in corners more than one number where the patches' normals
/// differ too much to be merged. Triangles and positions stay as they are.
///
/// angle:    in radians. Along an edge, a side joins the first group of earlier sides whose normals
///           all differ from its own by less than the angle; in a corner, patches join their
///           neighbours across edges by the same rule. Sides that are points keep one vertex, and
///           patches whose normals disagree (see evaluate_mesh()) never join. 0: patches share no
///           vertices. Pi and more: only disagreeing ones are split.
/// layout:   of lay_out_mesh(). split: replaced on ok, left as it was otherwise; may be the same.
/// Allocation: 4 bytes for each vertex on an edge and side of it, and 8 a patch. Determinism: as
///           normals.
/// Returns:  ok | bad_components | unequal_lengths | bad_tolerance (a negative angle, or nan) |
///           size_overflow | unknown_isa | unsupported_isa | out_of_memory.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status split_creases(const PatchSet<T>& set, const MeshLayout& layout,
                                                  double angle, MeshLayout& split,
                                                  const Options& options = {}) noexcept;

/// Gives each side and corner its own vertices, for u, v of its own, with the position and merged
/// normal of the one in `layout`, bit for bit. Sides that are points keep one vertex a patch.
/// Triangles stay as they are; of patches with one row of cells, two neighbouring sides of which
/// are one edge, some appear that have two vertices in one place.
///
/// layout:   of lay_out_mesh() or split_creases(), which may also come after it. split: replaced on
///           ok, left as it was otherwise; may be the same. Holds the layout, too.
/// Threads:  the caller's alone. Allocation: that of the layout once more, and 4 bytes for each
///           vertex on an edge and side of it. Determinism: a function of the layout.
/// Cost:     some 50 ns a patch, and 1 ns for each of these vertices.
/// Returns:  ok | size_overflow | out_of_memory.
[[nodiscard]] SIMDBEZIER_API Status split_parameters(const MeshLayout& layout,
                                                     MeshLayout& split) noexcept;

} // namespace simdbezier
