// The packed, immutable form of a batch of patches.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/isa.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier {

namespace detail {
template <typename T>
struct SetStorage;
}

/// Where packing stopped; members are 0 on ok. Point -1: an option is at fault, not a point.
struct PackReport {
  Status status = Status::ok;
  std::size_t patch = 0; ///< first patch at fault
  int point = 0;         ///< its control point j*(degree_u+1)+i (0 for coefficient_overflow)
  int component = 0;     ///< 0, 1, 2 for x, y, z; the number of components for a weight

  [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(status); }
};

/// What one patch of a set is.
struct PatchShape {
  int degree_u = 3;
  int degree_v = 3;
  int components = 3;
  bool rational = false;

  friend bool operator==(const PatchShape&, const PatchShape&) = default;
};

/// Patches as centred coefficient matrices, one per component, T = float or double. Their degrees
/// may differ, and some may be rational; they all have the same number of components.
///
/// Immutable: any number of threads may evaluate one set at once. Copies share the storage and
/// cost one reference count. A default-constructed set holds no patches.
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
  /// Likewise: gives up the arrays, of which no other set is to know (else null); empty then.
  [[nodiscard]] std::shared_ptr<detail::SetStorage<T>> take() noexcept {
    const bool alone = storage_.use_count() == 1;
    return alone ? std::const_pointer_cast<detail::SetStorage<T>>(std::move(storage_)) : nullptr;
  }

private:
  std::shared_ptr<const detail::SetStorage<T>> storage_;
};

/// How control points become coefficients. The defaults suit nets near the origin.
struct PackOptions {
  /// Positions are formed around an origin of each patch's (and each edge's) own, added last: one
  /// more addition a component and sample, 0.8 u max|P| instead of 2 u far from the origin, at most
  /// one rounding more near it. Worth it where the distance is more than about four times the size
  /// of a patch. Both sides of a shared edge must be packed with the same choice. With weights and
  /// normals in float it also saves time where the distance is more than a hundred times the size:
  /// most normals are uncertain there, and looking at them exactly takes ten times as long.
  bool local_origin = false;
  /// Positions come out relative to this point, which is subtracted from the control points in
  /// double (or wider) before anything is rounded to T. One point for all sets that share edges.
  double relative_to[3] = {0, 0, 0};
  /// The set's memory is used again where it has room and no copy of the set knows it: for models
  /// that move, since pages of new memory cost more than packing. The set is then empty on an error
  /// instead of as it was, and nobody may evaluate it meanwhile.
  bool reuse_memory = false;
  int threads = 0;          ///< as in Options
  Isa isa = Isa::automatic; ///< see resolve_isa(); results do not depend on it
};

/// Forms the coefficient matrices C = A P A^T of all patches, A being the basis change from
/// Bernstein to powers of the centred parameter; edge polynomials from each edge's own control
/// points; and the corners. A direction of degree 6 or more is first cut in two at its middle.
/// Rational patches are packed as homogeneous ones.
///
/// nets:       S = float or double, see ControlNets; the memory may be freed after the call. Many
///             patches of a few shapes are best given as few ControlNets: up to 8 patches of one
///             cost as much as one.
/// set:        replaced on ok, left as it was otherwise (but see reuse_memory). Patches are
/// numbered consecutively
///             through all nets.
/// options:    see PackOptions; a relative_to that is not finite is non_finite_input. Its members
///             beyond the components are ignored.
/// Numerics:   T and S float: formed in double, else in double-double; rounded once to T. Results
///             depend neither on the instruction set nor on threads, nor on which other patches
///             are packed. -0 in the input becomes +0.
/// Allocation: one block for each shape and form of weights, for bicubic patches in space 113 T and
///             48 S a patch: control points are kept as given. Four times the control points and
///             more where directions are cut. About 150 KiB of stack per thread. Threads: see
///             PackOptions::threads.
/// Returns:    ok | null_input | input_too_small | bad_degree | bad_components (also: not the same
///             in all nets) | bad_weight (also: below the smallest normal T, or infinite as T) |
///             bad_stride | non_finite_input | coefficient_overflow | size_overflow (also: strides
///             that lead beyond what memory can address) | unsupported_isa | out_of_memory. A wrong
///             SIMDBEZIER_ISA is ignored here. The report names the lowest patch at fault, for a
///             fault of whole nets their first one.
/// Cost:       O(count); in cache on AVX-512 about 22 ns (float) or 100 ns (double) a bicubic patch
///             in space; others grow with the cube of the degree. New memory costs several times
///             that: a set of many megabytes is bound by page faults.
template <typename T, typename S>
[[nodiscard]] PackReport pack(const ControlNets<S>& nets, PatchSet<T>& set,
                              const PackOptions& options = {}) noexcept;

/// Packs patches of several degrees, polynomial and rational ones mixed, in the same way. All need
/// the same number of components. Results of evaluate calls come in the order of the patches'
/// numbers.
template <typename T, typename S>
[[nodiscard]] PackReport pack(std::span<const ControlNets<S>> nets, PatchSet<T>& set,
                              const PackOptions& options = {}) noexcept;

extern template class PatchSet<float>;
extern template class PatchSet<double>;

} // namespace simdbezier
