// Certified boxes and flatness of control nets, for culling, intersection and adaptive subdivision.
// Each bound holds for the exact surface of the given control points, roundings included.
// For every call
//   Nets      S = float or double, any degrees and components; values finite, weights positive.
//   Outputs   the caller's packed arrays, one row a patch; they may not overlap the nets or each
//             other. Component c of patch p is at [p * components + c].
//   Bits      equal on all instruction sets, for any number of threads and place in the batch.
//   Threads   Options::threads, isa and executed are honoured. Allocation: scratch per thread.
//   Statuses  as in nets.hpp; on an error nothing has been written.
#pragma once

#include <type_traits>

#include <simdbezier/nets.hpp>
#include <simdbezier/vectors.hpp>

namespace simdbezier {

/// Where boxes go: count * components values each, neither null.
template <typename T>
struct Boxes {
  Values<T> low;
  Values<T> high;
};

/// Finds the smallest and largest control values of each patch, projected if nets have weights. S
/// lies in the convex hull of its control points, and so in this box. Boxes are exact; those of
/// homogeneous nets, which divide, are opened by 4 u of each bound. Cost: reading the nets.
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport control_boxes(const ControlNets<T>& nets,
                                                     const std::type_identity_t<Boxes<T>>& out,
                                                     const Options& options = {}) noexcept;

/// How far tight_boxes() may subdivide.
inline constexpr int kMostBoxLevels = 6;

/// Finds closer boxes of the surface, never larger than the control boxes: the hull of the control
/// points of 4^levels pieces, opened by a proven bound on the roundings (docs/accuracy.md). Every
/// level cuts the distance to the surface's own box to a quarter. If weights or values come near
/// the ends of the number range, the control box is returned.
/// levels: 0 (control boxes) to kMostBoxLevels, else bad_grid; 2 leaves about 6 % of the excess.
/// Cost:   about 4^levels times that of split().
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport tight_boxes(const ControlNets<T>& nets, int levels,
                                                   const std::type_identity_t<Boxes<T>>& out,
                                                   const Options& options = {}) noexcept;

/// An upper bound on max |S(u,v) - L(u,v)| over each patch, Euclidean over all components, L being
/// the bilinear patch of the four corner points at the same parameters. If it is below a tolerance,
/// two triangles can replace the patch, up to their distance from L.
/// Formula: max |P_ij - L(i/m, j/n)|; for rational nets the same at degree (m+1, n+1).
///          docs/accuracy.md has the proof and counts the roundings. 0 if all points are equal;
///          infinite if weights come near the ends of the number range or differences overflow.
/// out:     count values.
/// Cost:    one pass over the control points, some 10 operations a component and point.
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport flatness(const ControlNets<T>& nets,
                                                const std::type_identity_t<Values<T>>& out,
                                                const Options& options = {}) noexcept;

} // namespace simdbezier
