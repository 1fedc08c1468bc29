// How many cells a patch needs, so that triangles stay within a distance of its surface.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/patch_set.hpp>
#include <simdbezier/topology.hpp>

namespace simdbezier {

/// Infinity: nothing is asked for. Made from bits, because clang's -ffast-math knows no infinity.
inline constexpr double kUnlimited = std::bit_cast<double>(std::uint64_t{0x7ff} << 52);

/// How close a mesh is to be.
struct RateOptions {
  /// The largest distance of a point of the surface from the mesh, or of the mesh from the surface.
  double tolerance = kUnlimited;
  /// One value a patch, or empty. If `tolerance` is given as well, the smaller one counts.
  std::span<const double> tolerances = {};
  /// How far vertices may be from the exact ones: one value a patch, or empty for 0. It is a part
  /// of the tolerance. choose_rates() needs position_errors() of the set that will be evaluated;
  /// plan_mesh() adds these by itself.
  std::span<const double> errors = {};
  /// The longest edge of a cell, roughly. The longest leg of the control net times the degree,
  /// divided by the number of cells, is at most this. Above 0, else bad_tolerance.
  double longest_edge = kUnlimited;
  /// The largest angle between the normals at both ends of an edge of a cell, roughly. The total
  /// turn of the net's normals, divided by the number of cells, is at most this. Above 0.
  double normal_degrees = kUnlimited;
  std::uint32_t most_segments = kMostSegments; ///< 1 or more; larger numbers count as this one
  /// For views and models that move: on entry, CertifiedRates contain the rates of the frame
  /// before, or 0. A patch keeps them if they are within its tolerance and make as many cells as
  /// would be chosen, or up to `keep` times as many, so that rates change seldom. Below 1, or nan:
  /// no rates are read or kept. plan_mesh() ignores this member.
  double keep = 0;
  /// For models that stay: fewer triangles, in more time. Fewer cells are searched for, with bounds
  /// on point sets, if 1/1.6 of a patch's cells may be enough and this smaller number is at most
  /// about 1024. No patch has more cells than by default. Gumbo has 43, 31 and 28 % fewer triangles
  /// at 1e-2, 1e-3 and 1e-4 of its size, and octants of spheres have half as many. Rates then take
  /// 0.3 to 8 us for each triangle (AVX2), and up to 0.1 s a patch. The default is for models that
  /// move.
  bool thorough = false;
};

/// A pinhole camera, or an orthographic one. Take a point whose distance from the eye is one unit
/// along the direction, and x units across it. The pinhole camera shows this point x * focal_length
/// pixels from the middle of the picture.
struct Camera {
  std::array<double, 3> eye = {0, 0, 0};
  std::array<double, 3> direction = {0, 0, -1}; ///< of any length but zero
  double focal_length = 1000;                   ///< in pixels: height / (2 tan(angle of view / 2))
  double width = 1920;                          ///< the width of the picture, in pixels
  double height = 1080;
  double nearest = 1e-3; ///< nothing closer than this along the direction is drawn
  /// Parallel projection: focal_length is the number of pixels a unit, at any depth.
  bool orthographic = false;
  /// Patches that certainly lie outside of the circle around the picture's corners are not seen.
  bool skip_outside = false;
  /// Patches without weights are not seen, either, if du x dv certainly points away from the eye
  /// everywhere: the far side of a closed model. In plan_mesh(), this is the mesh's normal, which
  /// TopologyOptions::orient and `flip` turn.
  bool skip_back = false;
};

/// Rates with their certificate: one value a patch each.
struct CertifiedRates {
  std::span<std::uint32_t> cells_u;
  std::span<std::uint32_t> cells_v;
  std::span<std::uint16_t> diagonals; ///< as in PatchRates
  std::span<double> deviation;        ///< the bound on the distance, errors included; may be empty
};

/// Bounds the distance of evaluated positions of each patch from the exact ones, by the norm of
/// error_bounds() over three components. out: one value a patch. Allocation: none. Cost: 10 to 20
/// ns a bicubic patch, 3 us with weights. Returns ok | output_too_small | unknown_isa |
/// unsupported_isa.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status position_errors(const PatchSet<T>& set, std::span<double> out,
                                                    const RunOptions& options = {}) noexcept;

/// Finds tolerances for choose_rates(). With them, this camera sees no point of a surface more than
/// `pixels` away from its place on the mesh.
/// Formula: pixels * depth / (focal_length * f). The depth is that of the nearest control point, at
///          least Camera::nearest; f is the secant of the angle between the axis and the picture's
///          corners. An orthographic camera has pixels / focal_length.
/// Unseen:  a patch that is skipped, or nearer than Camera::nearest, gets kUnlimited: as few cells
///          as its neighbours allow. Meshes stay closed.
/// out:     one value a patch. Cost: one pass over the control points.
/// Returns: ok | the statuses of views | bad_tolerance (pixels, focal_length, width, height or
///          nearest that is not above zero and finite; an eye that is not finite; a direction of
///          length zero, or not finite) | output_too_small | unknown_isa | unsupported_isa.
///          Allocation: none. Neither threads nor the instruction set change a bit.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status pixel_tolerances(std::span<const ControlNets<S>> nets,
                                                     const Camera& camera, double pixels,
                                                     std::span<double> out,
                                                     const RunOptions& options = {}) noexcept;

/// Chooses a small number of rows and columns of cells for every patch, and the diagonals of the
/// cells, so that the triangles stay within the patch's tolerance. The rates depend on the patch's
/// control points and tolerance, on which of its sides are shared, and on forced diagonals.
/// separate_vertices() raises small rates if the mesh would be degenerate.
/// Bound:       max |S - T| over a triangle is at most the largest value of 1/2 sum l_i l_j Q_ij
///              over barycentric coordinates l; Q_ij is the largest second derivative of S along
///              edge ij, over control vectors of the patch's quarters. Vertices that a neighbour
///              adds to an edge do not raise it. docs/tessellation.md has the proof, and closer
///              bounds of rational patches, of weights that are products, and of uneven parameters
///              or weights more than 4.5-fold apart.
/// Source:      Filip, Magedson, Markot, Surface Algorithms Using Bounds on Derivatives, CAGD 3,
///              1986. Their bound uses the triangle inequality for the diagonal.
/// Determinism: a function of the control points, and of rates that are kept; the same in each
///              class of instruction sets (Isa), for any number of threads.
/// Allocation:  bytes a patch, scratch per thread. Outputs must not overlap inputs (not checked).
/// Returns:     ok | the statuses of views (bad_components: not three) | non_finite_input |
///              bad_weight | bad_rates (spans that are not one value a patch, or a topology of
///              another number of patches) | bad_tolerance (one that is not above both zero and the
///              patch's error, an error below 0 or nan, or more than most_segments needed) |
///              bad_topology (found for other nets, see fits()) | snap_too_large (snapping has
///              taken more than half of a tolerance) | the statuses of running. The report names
///              the patch. Outputs are undefined on an error.
/// Cost:        on AVX-512, 0.25 to 0.4 us a bicubic float patch, 0.65 us in double. On AVX2,
///              patches of other degrees, with weights or with forced diagonals take 1 to 4 us up
///              to degree 5. Patches of degree 15 take 15 us, or 35 us with weights. Weights that
///              are products add up to 100 us. Uneven parameters add 5 us a cell of a bicubic
///              patch, up to a second. Certificates are included.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Report choose_rates(std::span<const ControlNets<S>> nets,
                                                 const Topology& topology,
                                                 const RateOptions& options,
                                                 const CertifiedRates& out,
                                                 const RunOptions& run = {}) noexcept;

/// Certifies given rates: finds the best diagonals, and their bound. Determinism, allocation and
/// overlaps are as for choose_rates(), which takes longer.
/// rates:   cells_u and cells_v are read, from 1 to kMostSegments. diagonals and deviation are
///          written, and undefined on an error. errors: one value a patch, or empty.
/// Returns: as choose_rates(), less snap_too_large; bad_rates also for rates outside of that range.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Report certify_rates(std::span<const ControlNets<S>> nets,
                                                  const Topology& topology,
                                                  std::span<const double> errors,
                                                  const CertifiedRates& rates,
                                                  const RunOptions& options = {}) noexcept;

/// The largest number of cells in one direction for certify_grids().
inline constexpr std::uint32_t kMostGridCells = std::uint32_t{1} << 20;
/// Certifies meshes whose patches stay apart: each patch is a grid of cells_u x cells_v cells, its
/// vertices are numbered as evaluate() numbers samples, and diagonals run from (0,0) to (1,1).
/// errors:    as in RateOptions. deviation: one value a patch, errors included; undefined on an
///            error.
/// Cost:      0.3 to 1.7 us a patch up to degree 5 (AVX2).
/// Returns:   ok | the statuses of views (bad_components: not three) | non_finite_input |
///            bad_weight | bad_rates (outside of 1 to kMostGridCells, or spans that are not one
///            value a patch) | bad_tolerance (an error below 0 or nan) | the statuses of running.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Report certify_grids(std::span<const ControlNets<S>> nets,
                                                  std::uint32_t cells_u, std::uint32_t cells_v,
                                                  std::span<const double> errors,
                                                  std::span<double> deviation,
                                                  const RunOptions& options = {}) noexcept;

// The same for a single view.
template <typename S>
[[nodiscard]] Status pixel_tolerances(const ControlNets<S>& nets, const Camera& camera,
                                      double pixels, std::span<double> out,
                                      const RunOptions& options = {}) noexcept {
  return pixel_tolerances(std::span<const ControlNets<S>>(&nets, 1), camera, pixels, out, options);
}
template <typename S>
[[nodiscard]] Report choose_rates(const ControlNets<S>& nets, const Topology& topology,
                                  const RateOptions& options, const CertifiedRates& out,
                                  const RunOptions& run = {}) noexcept {
  return choose_rates(std::span<const ControlNets<S>>(&nets, 1), topology, options, out, run);
}
template <typename S>
[[nodiscard]] Report certify_rates(const ControlNets<S>& nets, const Topology& topology,
                                   std::span<const double> errors, const CertifiedRates& rates,
                                   const RunOptions& options = {}) noexcept {
  return certify_rates(std::span<const ControlNets<S>>(&nets, 1), topology, errors, rates, options);
}

} // namespace simdbezier
