// evaluate(set, where, out, options) evaluates a set's patches into the caller's memory.
//
//   where       Grid, PatchGrids or Samples (patch_set.hpp)
//   out         Outputs (outputs.hpp), or a list of them: results.hpp returns std::vectors
//   options     how the call runs (options.hpp)
//
// evaluate_tiles() hands results to a function, and evaluate_derivatives() computes derivatives of
// any order. curves.hpp contains evaluate() for curves. There are no tiles of curves, and their
// derivatives end at the second order.
//
// Constraints that hold for every call
//   Parameters  u, v in [0,1]; other finite values extrapolate the polynomial (Parameters says how
//               far). If a parameter is nan or infinite, the outputs of that sample are nan; others
//               are not.
//   Outputs     belong to the caller, may not overlap the inputs or each other, need no alignment
//               beyond that of T (64-byte alignment is faster).
//   Accuracy    bicubic patches: |error| <= 21 u max|P| a component with FMA, 30 u without, at the
//               centred parameters as rounded (u = 2^-24 float, 2^-53 double); derivatives, other
//               degrees and weights: docs/accuracy.md, error_bounds().
//   Watertight  positions on an edge depend only on that edge's control points and are bit-equal on
//               both sides whatever the orientation; corners are control points. (On edges near the
//               smallest denormals, and at centred parameters below 2^-24 or 2^-53, zeros may
//               differ in their signs.) An edge whose control points are all one is that point,
//               whatever its weights, and derivatives along it are exactly zero. (With local
//               origins, a point that T cannot hold may be rounded another way in its corners.)
//   Bits        equal for any thread count, batch size, place in the batch, layout, alignment and
//               compiler, and for all instruction sets of one class (see Isa).
//   Allocation  scratch per thread and per call only, none per sample. Nothing throws.
//   Layouts     packed planes, packed triples and vertices without gaps are the fast ones. Planes
//               of unit stride are written directly if they stay in the caches; streamed planes are
//               written directly or by way of staging, whichever suits their rows. Triples and
//               vertices without gaps are written directly on AVX2 and AVX-512, if edges are
//               watertight and the set has no local origins. All others go by way of the
//               first-level cache.
//   Formula     S = sum_l y^l sum_k C[l][k] x^k by Horner's rule in x. In y, degrees 3, 4 and 5 are
//               evaluated by even and odd parts: 3 products and 2 sums a component and pair of
//               samples of bicubic patches. All other degrees take Horner's rule: degree_v
//               multiply-adds a sample. Edges are evaluated as rows are. Rational patches are
//               evaluated by the quotient rule.
//   Source      docs/accuracy.md contains the proofs, and names the papers that they stand on.
//   Statuses    ok, those of outputs and of running (Status), and what each call adds.
//               bad_components: Outputs::first_component is outside of the set's, or a normal or a
//               curvature is asked of a set without exactly three.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include <simdbezier/options.hpp>
#include <simdbezier/outputs.hpp>
#include <simdbezier/patch_set.hpp>

namespace simdbezier {

/// Evaluates every patch of a range on one grid. Also returns bad_grid | bad_patch_range.
/// Cost: O(samples), and some 150 ns a call on one thread; README.md has measurements.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate(const PatchSet<T>& set, const Grid<T>& grid,
                                             const Outputs<T>& out,
                                             const Options& options = {}) noexcept;

/// Evaluates every patch of a range on its own grid, with the bits of the call above on each patch
/// alone. Threads share the samples, so that several of them may evaluate rows of one patch.
/// Outputs overlap if their ranges from index 0 to the last sample overlap. Allocation: 8 bytes a
/// patch and scratch per thread. Also returns null_input | unequal_lengths | bad_grid | bad_offsets
/// | bad_patch_range.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate(const PatchSet<T>& set, const PatchGrids& grids,
                                             const Outputs<T>& out,
                                             const Options& options = {}) noexcept;

/// Evaluates single samples, by the operations of a grid: equal centred parameters give equal bits.
/// Also returns unequal_lengths | null_input | bad_patch_index.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate(const PatchSet<T>& set, const Samples<T>& samples,
                                             const Outputs<T>& out,
                                             const Options& options = {}) noexcept;

// evaluate_derivatives(set, where, derivatives, options): partial derivatives of any order.
//
// The constraints of all calls hold here. evaluate() is the fast way to derivatives of up to the
// second order. These calls have one kernel for all orders; its cost grows with the highest order.

/// What a call is asked for: anything that converts to a span of PartialDerivative.
template <typename T>
struct DerivativeOutputs {
  std::span<const PartialDerivative<T>> derivatives;
  int first_component = 0; ///< as in Outputs

  template <std::convertible_to<std::span<const PartialDerivative<T>>> Range>
  constexpr DerivativeOutputs(Range&& range, int first = 0) noexcept // NOLINT: implicit on purpose
      : derivatives(range), first_component(first) {}
};

/// Evaluates derivatives at single samples, in any order: S^(a,b) = d^(a+b) S / du^a dv^b.
/// Formula:  polynomials by repeated synthetic division in x = 2u-1, then in y; 0 above the degree.
///           Rational patches S = H / w by the quotient rule of any order, S^(a,b) = (H^(a,b) -
///           sum_(i,j)>(0,0) C(a,i) C(b,j) w^(i,j) S^(a-i,b-j)) / w.
/// Outputs:  as in Outputs; they may not overlap the list of derivatives either. No derivative, or
///           one without pointers, is null_output. Options::destination has no effect.
/// Edges:    derivatives along an edge come from that edge's control points alone, so that both
///           sides have equal bits up to the sign of its direction. At the middle of an edge of
///           degree 6 or more, where its halves meet, both sides agree only within the bounds.
/// Bits:     a derivative that evaluate() computes as well has the same bits here, unless a result
///           or a sum on the way leaves the normal range. For (2,0) and (0,2) of rational patches,
///           both agree only within the bounds.
/// Accuracy: docs/accuracy.md. What T cannot hold is infinite or nan.
/// Source:   L. Piegl and W. Tiller, The NURBS Book, 2nd ed., A3.6 (computed in another way), A4.4.
/// Cost:     A n (m + B) multiply-adds a component, A and B the highest orders asked for plus one;
///           rational: 1/4 A^2 B^2 more. Samples of one patch should lie near one another.
/// Returns:  as evaluate() for Samples; bad_degree: an order is not 0 to kMostDerivativeOrder.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_derivatives(
    const PatchSet<T>& set, const Samples<T>& samples,
    const std::type_identity_t<DerivativeOutputs<T>>& out, const Options& options = {}) noexcept;

/// Evaluates derivatives on one grid of every patch of a range, indexed as in Grid, with the bits
/// of single samples at the same centred parameters. Returns as evaluate(), and bad_degree.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_derivatives(
    const PatchSet<T>& set, const Grid<T>& grid,
    const std::type_identity_t<DerivativeOutputs<T>>& out, const Options& options = {}) noexcept;

// Tiles: a grid's samples, handed to the caller while they are still in the cache.

/// How the groups of a tile lie in memory.
enum class TileLayout : std::uint8_t {
  planes,     ///< SoA: every component a plane of its own, 64-byte aligned
  xyz,        ///< AoS: every group packed x y z triples, 64-byte aligned
  interleaved ///< one vertex a sample: the wanted groups' triples in the order of Outputs, no gaps
};

/// Which outputs a tile holds, and how.
struct TileFormat {
  OutputSelection outputs = {Output::position}; ///< curvatures are planes in every layout
  TileLayout layout = TileLayout::planes;
  /// The most samples in one tile. 0: as many as fit into 24 KiB, half of a usual first-level
  /// cache. If a whole patch fits, a tile holds whole patches, else whole rows of one patch, at
  /// least one.
  std::size_t samples = 0;
  int first_component = 0; ///< as in Outputs
};

/// Finished samples: rows [first_row, first_row + row_count) of patches [first_patch, first_patch +
/// patch_count), patch after patch, row after row, u fastest. Several patches are whole patches.
template <typename T>
struct Tile {
  std::size_t first_patch = 0; ///< index in the set
  std::size_t patch_count = 0;
  std::size_t first_row = 0;
  std::size_t row_count = 0;
  std::size_t nu = 0;      ///< samples in a row
  std::size_t samples = 0; ///< patch_count * row_count * nu
  int worker = 0;          ///< number of the thread, from 0; no two calls at once share it
  Outputs<T> out;          ///< the tile's own memory; the caller may change it, not keep it
};

template <typename T>
class TileFunction;

/// What a TileFunction can borrow. Another TileFunction is copied instead, and borrows the same.
template <typename F, typename T>
concept TileCallable =
    !std::same_as<std::remove_cvref_t<F>, TileFunction<T>> && std::invocable<F&, const Tile<T>&>;

/// A borrowed callable `void(const Tile<T>&)`. It must outlive the call and must not throw; it runs
/// in the library's floating-point environment (round to nearest, denormals kept).
template <typename T>
class TileFunction {
public:
  template <TileCallable<T> F>
  TileFunction(F&& function) noexcept // NOLINT: implicit on purpose
      : context_(address_of(function)), call_([](void* context, const Tile<T>& tile) {
          using Function = std::remove_reference_t<F>;
          if constexpr (std::is_function_v<Function>) {
            (*reinterpret_cast<Function*>(context))(tile);
          } else {
            (*static_cast<Function*>(context))(tile);
          }
        }) {}
  void operator()(const Tile<T>& tile) const { call_(context_, tile); }

private:
  template <typename F>
  static void* address_of(F& function) noexcept {
    if constexpr (std::is_function_v<F>) {
      return reinterpret_cast<void*>(&function);
    } else {
      return const_cast<void*>(static_cast<const void*>(std::addressof(function)));
    }
  }

  void* context_;
  void (*call_)(void*, const Tile<T>&);
};

/// Evaluates every patch of a range on one grid, tile by tile, and hands each tile to `function` on
/// the thread that made it, so that it is read from that thread's cache. Every sample arrives once.
/// The tiles of one worker ascend; those of several come in any order. Values are those of
/// evaluate(), bit for bit. Options::destination has no effect. Allocation: one tile and its
/// staging a thread. Returns ok | null_output (the format wants no vector and no curvature) |
/// bad_components | bad_grid | bad_patch_range | size_overflow | the statuses of running. On an
/// error no tile was handed out.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_tiles(const PatchSet<T>& set, const Grid<T>& grid,
                                                   const TileFormat& format,
                                                   std::type_identity_t<TileFunction<T>> function,
                                                   const Options& options = {}) noexcept;

/// The samples of the largest tile that evaluate_tiles() will hand out; 0 if it will refuse them.
template <typename T>
[[nodiscard]] SIMDBEZIER_API std::size_t largest_tile(const PatchSet<T>& set, const Grid<T>& grid,
                                                      const TileFormat& format) noexcept;

} // namespace simdbezier
