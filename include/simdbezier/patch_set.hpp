// The packed, immutable form of a batch of patches.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier {

namespace detail {
template <typename T>
struct PatchStorage;
}

/// Where packing stopped. On ok the other members are 0.
struct PackReport {
  Status status = Status::ok;
  std::size_t patch = 0; ///< first patch at fault
  int point = 0;         ///< its control point j*(degree_u+1)+i (0 for coefficient_overflow)
  int component = 0;     ///< 0, 1, 2 for x, y, z

  [[nodiscard]] explicit operator bool() const noexcept { return status == Status::ok; }
};

/// Bicubic patches as centred coefficient matrices, one per component, T = float or double.
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

  /// For the library's own use: the packed arrays (null for an empty set).
  [[nodiscard]] const detail::PatchStorage<T>* storage() const noexcept { return storage_.get(); }
  explicit PatchSet(std::shared_ptr<const detail::PatchStorage<T>> storage) noexcept
      : storage_(std::move(storage)) {}

private:
  std::shared_ptr<const detail::PatchStorage<T>> storage_;
};

/// Forms the coefficient matrices C = A P A^T of all patches, A being the basis change from
/// Bernstein to powers of the centred parameter; edge cubics from each edge's own four control
/// points; and the corners.
///
/// nets:       S = float or double, see ControlNets; the memory may be freed after the call.
/// set:        replaced on ok, left as it was otherwise.
/// Numerics:   S = float: formed in double, S = double: in double-double; rounded once to T.
///             Results do not depend on the instruction set. -0 in the input becomes +0.
/// Allocation: one block of about 180 T per patch. Threads: runs on the caller's.
/// Returns:    ok | null_input | bad_degree | bad_stride | non_finite_input |
///             coefficient_overflow | size_overflow | out_of_memory.
/// Cost:       O(count); about 50 ns (float) or 500 ns (double) a patch.
template <typename T, typename S>
[[nodiscard]] PackReport pack(const ControlNets<S>& nets, PatchSet<T>& set) noexcept;

extern template class PatchSet<float>;
extern template class PatchSet<double>;

} // namespace simdbezier
