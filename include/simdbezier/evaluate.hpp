// evaluate(set, where, out, options) evaluates a set's patches into the caller's memory.
//
//   where       Grid, PatchGrids or Samples (samples.hpp)
//   out         Outputs (outputs.hpp), or a list of them: results.hpp returns std::vectors
//   options     how the call runs (options.hpp)
//
// tiles.hpp hands results to a function; derivatives.hpp computes derivatives of any order;
// curves.hpp has the same calls for curves.
//
// Constraints that hold for every call
//   Parameters  u, v in [0,1]; other finite values extrapolate the polynomial (Parameters says how
//               far). If one is nan or infinite, that sample's outputs are nan, no others.
//   Outputs     belong to the caller, may not overlap the inputs or each other, need no alignment
//               beyond that of T (64-byte alignment is faster).
//   Accuracy    bicubic patches: |error| <= 21 u max|P| a component with FMA, 30 u without, at the
//               centred parameters as rounded (u = 2^-24 float, 2^-53 double); derivatives, other
//               degrees and weights: docs/accuracy.md, error_bounds().
//   Watertight  positions on an edge depend only on that edge's control points and are bit-equal on
//               both sides whatever the orientation; corners are control points. (On edges near the
//               smallest denormals, and at centred parameters below 2^-24 or 2^-53, zeros may
//               differ in their signs.) An edge whose control points are all one is that point,
//               whatever its weights, and derivatives along it are exactly zero.
//   Bits        equal for any thread count, batch size, place in the batch, layout, alignment and
//               compiler, and for all instruction sets of one class (see Isa).
//   Allocation  scratch per thread and per call only, none per sample. Nothing throws.
//   Layouts     packed planes, packed triples and vertices without gaps are the fast ones. Planes
//               of unit stride are written directly, all others by way of the first-level cache.
//   Formula     S = sum_l y^l sum_k C[l][k] x^k by Horner's rule in x, then in y by even and odd
//               parts (degree_v 3, 4, 5: 3 products and 2 sums a component and pair of samples of
//               bicubic patches) or by Horner's rule (any other: degree_v multiply-adds a sample).
//               Edges are evaluated as rows are. Rational patches by the quotient rule.
//   Source      docs/accuracy.md has the proofs, and names the papers that they stand on.
//   Statuses    ok, those of outputs and of running (Status), and what each call adds.
//               bad_components: Outputs::first_component is outside of the set's, or a normal or a
//               curvature is asked of a set without exactly three.
#pragma once

#include <simdbezier/options.hpp>
#include <simdbezier/outputs.hpp>
#include <simdbezier/patch_set.hpp>
#include <simdbezier/samples.hpp>

namespace simdbezier {

/// Evaluates every patch of a range on one grid. Also returns bad_grid | bad_patch_range.
/// Cost: O(samples), and some 150 ns a call on one thread; README.md has measurements.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate(const PatchSet<T>& set, const Grid<T>& grid,
                                             const Outputs<T>& out,
                                             const Options& options = {}) noexcept;

/// Evaluates every patch of a range on its own grid, with the bits of the call above on each patch
/// alone. Threads share samples, also the rows of a dense patch. Outputs overlap if their ranges
/// from index 0 to the last sample do. Allocation: 8 bytes a patch and scratch per thread. Also
/// returns null_input | unequal_lengths | bad_grid | bad_offsets | bad_patch_range.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate(const PatchSet<T>& set, const PatchGrids& grids,
                                             const Outputs<T>& out,
                                             const Options& options = {}) noexcept;

/// Evaluates single samples, in the grid's own order of operations: if centred parameters are
/// equal, the bits are. Also returns unequal_lengths | null_input | bad_patch_index.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate(const PatchSet<T>& set, const Samples<T>& samples,
                                             const Outputs<T>& out,
                                             const Options& options = {}) noexcept;

} // namespace simdbezier
