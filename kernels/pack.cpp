// Control points -> centred coefficients, edge cubics, corners.
//
// All sums are folded: even coefficients are symmetric, odd ones antisymmetric under reversal of
// the control points, operation by operation. With x_i = -x_{N-i} that makes both sides of a
// shared edge round alike, however it is oriented.
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

/// One component of one net: 16 values [j][i].
template <typename T, typename W>
void pack_component(const W net[kOrder][kOrder], T* matrix, T* edges, T* corners) {
  W rows[kOrder][kOrder]; // [j][k]: row j as a polynomial in X
  for (std::size_t j = 0; j < kOrder; ++j) {
    centred_cubic(net[j][0], net[j][1], net[j][2], net[j][3], rows[j]);
  }
  for (std::size_t k = 0; k < kOrder; ++k) {
    W column[kOrder];
    centred_cubic(rows[0][k], rows[1][k], rows[2][k], rows[3][k], column);
    for (std::size_t l = 0; l < kOrder; ++l) {
      matrix[k * kOrder + l] = rounded<T>(column[l]);
    }
  }
  W u0[kOrder];
  W u1[kOrder];
  centred_cubic(net[0][0], net[1][0], net[2][0], net[3][0], u0);
  centred_cubic(net[0][3], net[1][3], net[2][3], net[3][3], u1);
  for (std::size_t k = 0; k < kOrder; ++k) {
    edges[k * kEdges + kEdgeV0] = rounded<T>(rows[0][k]);
    edges[k * kEdges + kEdgeV1] = rounded<T>(rows[3][k]);
    edges[k * kEdges + kEdgeU0] = rounded<T>(u0[k]);
    edges[k * kEdges + kEdgeU1] = rounded<T>(u1[k]);
  }
  for (std::size_t corner = 0; corner < 4; ++corner) {
    corners[corner] = rounded<T>(net[corner / 2 * 3][corner % 2 * 3]);
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
PackReport pack_patch(const ControlNets<S>& nets, std::size_t patch, PatchStorage<T>& storage) {
  using W = WideOf<T, S>;
  T* const coefficients = storage.coefficients + patch * kCoefficients;
  T* const edges = storage.edges + patch * kEdgeBlock;
  T* const points = storage.control_points + patch * kCoefficients;
  for (std::size_t c = 0; c < kComponents; ++c) {
    const S* const from = component_of(nets, patch, c);
    W net[kOrder][kOrder];
    for (int k = 0; k < 16; ++k) {
      const S value = from[k / 4 * nets.row_stride + k % 4 * nets.point_stride] + S(0);
      if (!std::isfinite(value)) {
        return {Status::non_finite_input, patch, k, static_cast<int>(c)};
      }
      net[k / 4][k % 4] = W(value);
      points[static_cast<std::size_t>(k) * kComponents + c] = static_cast<T>(value) + T(0);
    }
    T* const matrix = coefficients + c * kOrder * kOrder;
    T* const edge = edges + c * kOrder * kEdges;
    T* const corner = edges + kCornersAt + c * kEdges;
    pack_component(net, matrix, edge, corner);
    if (!all_finite(matrix, kOrder * kOrder) || !all_finite(edge, kOrder * kEdges) ||
        !all_finite(corner, kEdges)) {
      return {Status::coefficient_overflow, patch, 0, static_cast<int>(c)};
    }
  }
  for (std::size_t i = kCornersAt + kComponents * kEdges; i < kEdgeBlock; ++i) {
    edges[i] = T(0);
  }
  storage.normal_floor[patch] = normal_floor(points);
  return {};
}

/// One block for all arrays; false where its size overflows or memory is short.
template <typename T>
Status allocate(std::size_t count, PatchStorage<T>& storage) {
  constexpr std::size_t kPerPatch = 2 * kCoefficients + kEdgeBlock + 1;
  constexpr std::size_t kLimit = std::numeric_limits<std::ptrdiff_t>::max();
  if (count > kLimit / sizeof(T) / kPerPatch) {
    return Status::size_overflow;
  }
  storage.memory.reset(
      ::operator new (count* kPerPatch * sizeof(T), std::align_val_t{64}, std::nothrow));
  if (storage.memory == nullptr) {
    return Status::out_of_memory;
  }
  storage.count = count;
  storage.coefficients = static_cast<T*>(storage.memory.get());
  storage.edges = storage.coefficients + count * kCoefficients;
  storage.control_points = storage.edges + count * kEdgeBlock;
  storage.normal_floor = storage.control_points + count * kCoefficients;
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

template <typename T, typename S>
PackReport pack(const ControlNets<S>& nets, PatchSet<T>& set) noexcept try {
  const Status usable = detail::check(nets);
  if (usable != Status::ok) {
    return {usable};
  }
  const detail::DefaultFpEnvironment environment;
  auto storage = std::make_shared<detail::PatchStorage<T>>();
  const Status allocated = detail::allocate(nets.count, *storage);
  if (allocated != Status::ok) {
    return {allocated};
  }
  for (std::size_t patch = 0; patch < nets.count; ++patch) {
    const PackReport report = detail::pack_patch(nets, patch, *storage);
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
template SIMDBEZIER_API PackReport pack(const ControlNets<float>&, PatchSet<float>&) noexcept;
template SIMDBEZIER_API PackReport pack(const ControlNets<double>&, PatchSet<float>&) noexcept;
template SIMDBEZIER_API PackReport pack(const ControlNets<float>&, PatchSet<double>&) noexcept;
template SIMDBEZIER_API PackReport pack(const ControlNets<double>&, PatchSet<double>&) noexcept;

} // namespace simdbezier
