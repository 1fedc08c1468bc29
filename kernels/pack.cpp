// Control points -> centred coefficients, edge cubics, corners.
//
// All sums are folded: even coefficients are symmetric, odd ones antisymmetric under reversal of
// the control points, operation by operation. With x_i = -x_{N-i} that makes both sides of a
// shared edge round alike, however it is oriented.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#include <simdbezier/patch_set.hpp>

#include "kernels/double_double.hpp"
#include "kernels/fp_environment.hpp"
#include "kernels/normal_fallback.hpp"
#include "kernels/patch_storage.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// What coefficients are formed in: wide enough that only the rounding to T counts.
template <typename T, typename S>
using WideOf =
    std::conditional_t<std::is_same_v<T, float> && std::is_same_v<S, float>, double, DoubleDouble>;

/// Half-centred power coefficients of a cubic: c[k] multiplies X^k, X = u - 1/2.
template <typename W>
void centred_cubic(const W& b0, const W& b1, const W& b2, const W& b3, W c[kOrder]) {
  const W inner = b2 - b1;
  const W outer = b3 - b0;
  c[0] = scaled((b0 + b3) + tripled(b1 + b2), 0.125);
  c[1] = scaled(tripled(outer + inner), 0.25);
  c[2] = scaled(tripled((b0 - b1) + (b3 - b2)), 0.5);
  c[3] = outer - tripled(inner);
}

/// One rounding; + 0 turns the -0 of an underflow into +0.
template <typename T, typename W>
T rounded(const W& value) {
  return static_cast<T>(value) + T(0);
}

/// Where one component of one patch goes.
template <typename T>
struct PackedComponent {
  T* matrix;
  T* edges;
  T* corners;
  T* origins; ///< or null
};

/// Splits the rounded constant term off, so that it can be added last.
template <typename T, typename W>
T take_origin(W& constant) {
  const T origin = rounded<T>(constant);
  constant = constant - W(origin);
  return origin;
}

/// One component of one net: 16 values [j][i].
template <typename T, typename W>
void pack_component(const W net[kOrder][kOrder], const PackedComponent<T>& out) {
  W rows[kOrder][kOrder];   // [j][k]: row j as a polynomial in X
  W matrix[kOrder][kOrder]; // [k][l]
  for (std::size_t j = 0; j < kOrder; ++j) {
    centred_cubic(net[j][0], net[j][1], net[j][2], net[j][3], rows[j]);
  }
  for (std::size_t k = 0; k < kOrder; ++k) {
    centred_cubic(rows[0][k], rows[1][k], rows[2][k], rows[3][k], matrix[k]);
  }
  W edges[kEdges][kOrder];
  for (std::size_t k = 0; k < kOrder; ++k) {
    edges[kEdgeV0][k] = rows[0][k];
    edges[kEdgeV1][k] = rows[3][k];
  }
  centred_cubic(net[0][0], net[1][0], net[2][0], net[3][0], edges[kEdgeU0]);
  centred_cubic(net[0][3], net[1][3], net[2][3], net[3][3], edges[kEdgeU1]);
  if (out.origins != nullptr) {
    std::fill_n(out.origins, kOriginsPerComponent, T(0));
    out.origins[0] = take_origin<T>(matrix[0][0]);
    for (std::size_t e = 0; e < kEdges; ++e) {
      out.origins[kEdgeOriginsAt + e] = take_origin<T>(edges[e][0]);
    }
  }
  for (std::size_t k = 0; k < kOrder; ++k) {
    for (std::size_t l = 0; l < kOrder; ++l) {
      out.matrix[k * kOrder + l] = rounded<T>(matrix[k][l]);
    }
    for (std::size_t e = 0; e < kEdges; ++e) {
      out.edges[k * kEdges + e] = rounded<T>(edges[e][k]);
    }
  }
  for (std::size_t corner = 0; corner < 4; ++corner) {
    out.corners[corner] = rounded<T>(net[corner / 2 * 3][corner % 2 * 3]);
  }
}

template <typename T>
bool all_finite(const T* values, std::size_t count) {
  // x - x is 0 for finite x only, and sums of zeros stay 0.
  T sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += values[i] - values[i];
  }
  return sum == 0;
}

template <typename S>
const S* component_of(const ControlNets<S>& nets, std::size_t patch, std::size_t c) {
  return nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride +
         static_cast<std::ptrdiff_t>(c) * nets.component_stride;
}

template <typename T, typename S>
PackReport pack_patch(const ControlNets<S>& nets, std::size_t patch, const PackOptions& options,
                      PatchStorage<T>& storage) {
  using W = WideOf<T, S>;
  T* const coefficients = storage.coefficients + patch * kCoefficients;
  T* const edges = storage.edges + patch * kEdgeBlock;
  T* const points = storage.control_points + patch * kCoefficients;
  T* const origins = storage.origins == nullptr ? nullptr : storage.origins + patch * kOriginBlock;
  for (std::size_t c = 0; c < kComponents; ++c) {
    const S* const from = component_of(nets, patch, c);
    const W shift(options.relative_to[c]);
    W net[kOrder][kOrder];
    for (int k = 0; k < 16; ++k) {
      const S value = from[k / 4 * nets.row_stride + k % 4 * nets.point_stride];
      if (!std::isfinite(value)) {
        return {Status::non_finite_input, patch, k, static_cast<int>(c)};
      }
      const W wide = W(value + S(0)) - shift;
      net[k / 4][k % 4] = wide;
      points[static_cast<std::size_t>(k) * kComponents + c] = rounded<T>(wide);
    }
    const PackedComponent<T> out{coefficients + c * kOrder * kOrder, edges + c * kOrder * kEdges,
                                 edges + kCornersAt + c * kEdges,
                                 origins == nullptr ? nullptr : origins + c * kOriginsPerComponent};
    pack_component(net, out);
    if (!all_finite(out.matrix, kOrder * kOrder) || !all_finite(out.edges, kOrder * kEdges) ||
        !all_finite(out.corners, kEdges)) {
      return {Status::coefficient_overflow, patch, 0, static_cast<int>(c)};
    }
  }
  std::fill(edges + kCornersAt + kComponents * kEdges, edges + kEdgeBlock, T(0));
  storage.normal_floor[patch] = normal_floor(points);
  return {};
}

/// One block for all arrays; false where its size overflows or memory is short.
template <typename T>
Status allocate(std::size_t count, bool origins, PatchStorage<T>& storage) {
  const std::size_t per_patch = 2 * kCoefficients + kEdgeBlock + (origins ? kOriginBlock : 0) + 1;
  constexpr std::size_t kLimit = std::numeric_limits<std::ptrdiff_t>::max();
  if (count > kLimit / sizeof(T) / per_patch) {
    return Status::size_overflow;
  }
  storage.memory.reset(
      ::operator new (count* per_patch * sizeof(T), std::align_val_t{64}, std::nothrow));
  if (storage.memory == nullptr) {
    return Status::out_of_memory;
  }
  storage.count = count;
  storage.coefficients = static_cast<T*>(storage.memory.get());
  storage.edges = storage.coefficients + count * kCoefficients;
  storage.control_points = storage.edges + count * kEdgeBlock;
  storage.normal_floor = storage.control_points + count * kCoefficients;
  storage.origins = origins ? storage.normal_floor + count : nullptr;
  return Status::ok;
}

template <typename S>
Status check(const ControlNets<S>& nets) {
  if (nets.degree_u != 3 || nets.degree_v != 3) {
    return Status::bad_degree;
  }
  if (nets.points == nullptr && nets.count > 0) {
    return Status::null_input;
  }
  if (nets.row_stride == 0 || nets.point_stride == 0 || nets.component_stride == 0) {
    return Status::bad_stride;
  }
  return Status::ok;
}

} // namespace
} // namespace detail

template <typename T>
std::size_t PatchSet<T>::size() const noexcept {
  return storage_ == nullptr ? 0 : storage_->count;
}

template <typename T>
bool PatchSet<T>::has_local_origins() const noexcept {
  return storage_ != nullptr && storage_->origins != nullptr;
}

template <typename T, typename S>
PackReport pack(const ControlNets<S>& nets, PatchSet<T>& set, const PackOptions& options) noexcept
    try {
  const Status usable = detail::check(nets);
  if (usable != Status::ok) {
    return {usable};
  }
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(options.relative_to[c])) {
      return {Status::non_finite_input, 0, 0, c};
    }
  }
  const detail::DefaultFpEnvironment environment;
  auto storage = std::make_shared<detail::PatchStorage<T>>();
  const Status allocated = detail::allocate(nets.count, options.local_origin, *storage);
  if (allocated != Status::ok) {
    return {allocated};
  }
  for (std::size_t patch = 0; patch < nets.count; ++patch) {
    const PackReport report = detail::pack_patch(nets, patch, options, *storage);
    if (!report) {
      return report;
    }
  }
  set = PatchSet<T>(std::move(storage));
  return {};
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

template class PatchSet<float>;
template class PatchSet<double>;
template SIMDBEZIER_API PackReport pack(const ControlNets<float>&, PatchSet<float>&,
                                        const PackOptions&) noexcept;
template SIMDBEZIER_API PackReport pack(const ControlNets<double>&, PatchSet<float>&,
                                        const PackOptions&) noexcept;
template SIMDBEZIER_API PackReport pack(const ControlNets<float>&, PatchSet<double>&,
                                        const PackOptions&) noexcept;
template SIMDBEZIER_API PackReport pack(const ControlNets<double>&, PatchSet<double>&,
                                        const PackOptions&) noexcept;

} // namespace simdbezier
