// The packed, immutable form of a batch of patches, and where it is evaluated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier {

namespace detail {
template <typename T>
struct SetStorage;
}

/// What one patch of a set is.
struct PatchShape {
  int degree_u = 3;
  int degree_v = 3;
  int components = 3;
  bool rational = false;

  friend bool operator==(const PatchShape&, const PatchShape&) = default;
};

/// Packed patches, ready to be evaluated: centred coefficients of T = float or double. Degrees may
/// differ and some patches may be rational; all have the same number of components. Immutable: any
/// number of threads may evaluate it at once. Copies share the storage and cost one reference
/// count. A default-constructed set holds no patches.
template <typename T>
class PatchSet {
public:
  PatchSet() noexcept = default;

  /// Number of patches.
  [[nodiscard]] SIMDBEZIER_API std::size_t size() const noexcept;
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }

  /// Components of every point; 3 for an empty set.
  [[nodiscard]] SIMDBEZIER_API int components() const noexcept;
  /// Degrees, components and weights of one patch; all of 0 outside of the set.
  [[nodiscard]] SIMDBEZIER_API PatchShape shape(std::size_t patch) const noexcept;

  /// Whether the set was packed with PackOptions::local_origin.
  [[nodiscard]] SIMDBEZIER_API bool has_local_origins() const noexcept;

  /// This is for the library's own use: the packed arrays (null for an empty set).
  [[nodiscard]] const detail::SetStorage<T>* storage() const noexcept { return storage_.get(); }
  explicit PatchSet(std::shared_ptr<const detail::SetStorage<T>> storage) noexcept
      : storage_(std::move(storage)) {}
  /// For the library's own use, too: gives up the arrays, unless another set shares them (null).
  [[nodiscard]] std::shared_ptr<detail::SetStorage<T>> take() noexcept {
    const bool alone = storage_.use_count() == 1;
    return alone ? std::const_pointer_cast<detail::SetStorage<T>>(std::move(storage_)) : nullptr;
  }

private:
  std::shared_ptr<const detail::SetStorage<T>> storage_;
};

/// How control points become coefficients. The defaults suit nets near the origin.
struct PackOptions {
  /// Each patch and each edge gets an origin of its own, which is added to positions last. Far from
  /// 0, the largest errors that were measured are then about 0.5 u max|P| instead of 2 u max|P|
  /// (docs/accuracy.md); near 0 the error is at most one rounding larger. The price is one addition
  /// a component and sample. This pays if the distance from 0 is more than about four times the
  /// size of a patch. Beyond a hundred times the size, it also saves time for float normals of
  /// patches with weights. Without it, most of these are uncertain, and exact decisions about them
  /// take ten times as long. Both sides of a shared edge need the same choice.
  bool local_origin = false;
  /// Positions come out relative to this point, which is subtracted from the control points in
  /// double (or wider) before anything is rounded to T. Use one point for all sets that share
  /// edges. Members beyond the components are ignored; others must be finite (non_finite_input).
  double relative_to[3] = {0, 0, 0};
  /// Uses the set's memory again if it is large enough, but not more than about twice as large as
  /// needed, and no copy of the set shares it. This is for models that move, because new pages cost
  /// more than packing. Nobody may evaluate the set meanwhile. After an error the set is as it was,
  /// or empty.
  bool reuse_memory = false;
  int threads = 0;          ///< as in RunOptions, to which this converts
  Isa isa = Isa::automatic; ///< as in RunOptions; results do not depend on it

  constexpr operator RunOptions() const noexcept { return {threads, isa}; } // NOLINT: it is one
};

/// Packs the patches of control nets into a set, which evaluate() takes.
/// Formula:    C = A P A^T, from Bernstein to powers of the centred parameter; polynomials of edges
///             from each edge's own control points. Directions of degree 6 or more are cut first.
/// nets:       S = float or double; the memory may be freed after the call. A view of one patch
///             costs as much as a view of 8. Patches are numbered through all nets.
/// Numerics:   T and S float: formed in double, else in double-double; rounded once to T. Results
///             do not depend on the instruction set, threads or other patches. -0 becomes +0.
/// Allocation: one block for each shape and form of weights. A bicubic patch in space takes 113
///             numbers of type T, and 48 of type S for its control points, which are kept. If
///             directions are cut, a patch takes four times as much and more. About 150 KiB of
///             stack per thread.
/// Returns:    ok | the statuses of views | bad_components (also: not the same in all nets) |
///             bad_weight (also: below the smallest normal T, or infinite as T) | non_finite_input
///             | coefficient_overflow | size_overflow (also: strides that lead beyond addressable
///             memory) | unsupported_isa | out_of_memory. A wrong SIMDBEZIER_ISA is ignored. The
///             report names the lowest patch at fault; for a fault of whole nets, their first one.
/// Cost:       in cache on AVX-512 about 22 ns (float) or 100 ns (double) a bicubic patch. It grows
///             with the cube of the degree. New memory costs several times as much.
template <typename T, typename S>
[[nodiscard]] Report pack(const ControlNets<S>& nets, PatchSet<T>& set,
                          const PackOptions& options = {}) noexcept;

/// Packs patches of several degrees, polynomial and rational ones mixed, in the same way. All need
/// the same number of components. Results come in the order of the patches' numbers.
template <typename T, typename S>
[[nodiscard]] Report pack(std::span<const ControlNets<S>> nets, PatchSet<T>& set,
                          const PackOptions& options = {}) noexcept;

extern template class PatchSet<float>;
extern template class PatchSet<double>;

// Where surfaces are evaluated: on one grid, on a grid for each patch, or at single samples.

/// How parameters are given: as u in [0,1], or centred as x = 2u-1 in [-1,1], which is used without
/// a rounding. Kernels work with x/2, so that an x of the smallest denormal counts as 0.
///
/// Other values extrapolate, as long as |2u-1| is below 2^64 (float) or 2^512 (double). Beyond
/// that, multiples of the parameter's square are infinite, and directions of degree 3 to 5 give
/// infinities or nan. In a direction of degree 5, second derivatives contain the parameter's cube,
/// so that their limits are 2^43 and 2^341. Normals are never nan for any finite parameter.
enum class Parameters : std::uint8_t { unit, centred };

/// The centred parameter 2u-1 of a double u, computed in double and rounded once to T.
template <typename T>
[[nodiscard]] SIMDBEZIER_API T to_centred(double u) noexcept;

/// Consecutive patches or curves of a set, or patches of a mesh, for calls on a part of them.
struct SetRange {
  static constexpr std::size_t kToTheEnd = static_cast<std::size_t>(-1);
  std::size_t first = 0;
  std::size_t count = kToTheEnd;
};

/// A tensor grid of nu x nv parameters for all patches of a range. Sample (patch, iu, iv) has the
/// index (patch - patches.first) * nu * nv + iv * nu + iu. If u (v) is null, the parameters are
/// uniform, ends included: x_i = (2i-N)/N with N = nu-1, by one division. Otherwise u holds nu
/// values and v holds nv, in any order.
template <typename T>
struct Grid {
  std::size_t nu = 0;
  std::size_t nv = 0;
  const T* u = nullptr;
  const T* v = nullptr;
  Parameters parameters = Parameters::unit;
  SetRange patches = {};

  [[nodiscard]] static constexpr Grid uniform(std::size_t nu, std::size_t nv,
                                              SetRange patches = {}) noexcept {
    return {nu, nv, nullptr, nullptr, Parameters::unit, patches};
  }
  /// Every pair of the parameters given.
  [[nodiscard]] static constexpr Grid at(std::span<const T> u, std::span<const T> v,
                                         Parameters parameters = Parameters::unit,
                                         SetRange patches = {}) noexcept {
    return {u.size(), v.size(), u.data(), v.data(), parameters, patches};
  }
};

/// Uniform grids, ends included, one for each patch of a range. The samples have compressed-row
/// form: sample (iu, iv) of the k-th of these patches has the index offset[k] + iv * nu[k] + iu.
struct PatchGrids {
  std::span<const std::uint32_t> nu; ///< 2 or more
  std::span<const std::uint32_t> nv; ///< 2 or more; as many as nu
  /// Where each patch's samples begin, ascending by nu*nv or more (samples in between are not
  /// touched). Empty: packed without gaps.
  std::span<const std::size_t> offset = {};
  /// The patches. A count, if given, must be the size of nu and nv (else unequal_lengths).
  SetRange patches = {};
};

/// Single samples in any order: sample k lies on patch[k] at (u[k], v[k]).
template <typename T>
struct Samples {
  std::span<const std::uint32_t> patch; ///< indices into the set
  std::span<const T> u;                 ///< as many
  std::span<const T> v;                 ///< as many
  Parameters parameters = Parameters::unit;
};

/// The number of samples of a call, for which every output needs room. 0 if patches are not in the
/// set or PatchGrids are refused; the largest std::size_t if memory cannot address them.
template <typename T>
[[nodiscard]] SIMDBEZIER_API std::size_t sample_count(const PatchSet<T>& set,
                                                      const Grid<T>& grid) noexcept;
template <typename T>
[[nodiscard]] SIMDBEZIER_API std::size_t sample_count(const PatchSet<T>& set,
                                                      const PatchGrids& grids) noexcept;
template <typename T>
[[nodiscard]] std::size_t sample_count(const PatchSet<T>& /*set*/,
                                       const Samples<T>& samples) noexcept {
  return samples.patch.size();
}

} // namespace simdbezier
