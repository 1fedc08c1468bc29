// Packing: arguments, memory, threads and faults; the arithmetic is in pack_kernel.hpp.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <type_traits>

#include <simdbezier/patch_set.hpp>

#include "kernels/batch.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/patch_storage.hpp"

namespace simdbezier {
namespace detail {
namespace {

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

/// The first fault of one patch, whose arrays have been written: a component's control points are
/// looked at before its coefficients.
template <typename T, typename S>
PackReport inspect(const ControlNets<S>& nets, const PatchStorage<T>& storage, std::size_t patch) {
  for (std::size_t c = 0; c < kComponents; ++c) {
    const S* const from = component_of(nets, patch, c);
    for (int k = 0; k < 16; ++k) {
      if (!std::isfinite(from[k / 4 * nets.row_stride + k % 4 * nets.point_stride])) {
        return {Status::non_finite_input, patch, k, static_cast<int>(c)};
      }
    }
    const T* const matrix = storage.coefficients + patch * kCoefficients + c * kOrder * kOrder;
    const T* const edges = storage.edges + patch * kEdgeBlock;
    if (!all_finite(matrix, kOrder * kOrder) ||
        !all_finite(edges + c * kOrder * kEdges, kOrder * kEdges) ||
        !all_finite(edges + kCornersAt + c * kEdges, kEdges)) {
      return {Status::coefficient_overflow, patch, 0, static_cast<int>(c)};
    }
  }
  return {};
}

/// What the kernel finds doubtful is inspected here: kernels only know a bound on the squares.
template <typename T, typename S>
PackReport pack_share(PackKernel<T, S> kernel, const PackTask<T, S>& task,
                      const ControlNets<S>& nets, const PatchStorage<T>& storage, std::size_t begin,
                      std::size_t end) {
  while (begin < end) {
    const PackDoubt doubt = kernel(task, begin, end);
    for (std::size_t patch = doubt.begin; patch < doubt.end; ++patch) {
      const PackReport report = inspect(nets, storage, patch);
      if (!report) {
        return report;
      }
    }
    begin = doubt.end;
  }
  return {};
}

template <typename T, typename S>
PackKernel<T, S> pack_kernel(const KernelTable<T>& table) {
  if constexpr (std::is_same_v<S, float>) {
    return table.pack_f32;
  } else {
    return table.pack_f64;
  }
}

/// Packs all patches; reports the fault of the lowest patch, whichever thread finds it.
template <typename T, typename S>
PackReport pack_all(const ControlNets<S>& nets, const PackOptions& options, Isa isa,
                    PatchStorage<T>& storage) {
  const PackKernel<T, S> kernel = pack_kernel<T, S>(kernel_table<T>(isa));
  const double* const shift = options.relative_to;
  const PackTask<T, S> task{
      nets.points,          nets.patch_stride,     nets.row_stride,
      nets.point_stride,    nets.component_stride, {shift[0], shift[1], shift[2]},
      storage.coefficients, storage.edges,         storage.control_points,
      storage.origins,      storage.normal_floor};
  // Shares begin at whole groups of the widest kernel, so that only the last group is incomplete.
  const std::size_t groups = nets.count / kMaxLanes + (nets.count % kMaxLanes == 0 ? 0 : 1);
  PackReport first;
  std::mutex guard;
  auto body = [&](int, std::size_t begin, std::size_t end) {
    const PackReport report = pack_share(kernel, task, nets, storage, begin * kMaxLanes,
                                         std::min(end * kMaxLanes, nets.count));
    if (!report) {
      const std::lock_guard<std::mutex> lock(guard);
      if (first || report.patch < first.patch) {
        first = report;
      }
    }
  };
  for_blocks(groups, thread_count(options.threads, groups), BlockBody(body));
  return first;
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
  return storage_ != nullptr && storage_->buckets[0].origins != nullptr;
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
  Isa isa = Isa::automatic;
  const Status runs = resolve_isa(options.isa, isa);
  if (runs != Status::ok) {
    if (options.isa != Isa::automatic) {
      return {runs};
    }
    isa = available_isas().back(); // a wrong SIMDBEZIER_ISA is for evaluate calls to report
  }
  auto storage = std::make_shared<detail::SetStorage<T>>();
  storage->count = nets.count;
  storage->buckets.resize(1);
  const Status allocated =
      detail::allocate(nets.count, options.local_origin, storage->buckets[0]);
  if (allocated != Status::ok) {
    return {allocated};
  }
  const PackReport report = detail::pack_all(nets, options, isa, storage->buckets[0]);
  if (!report) {
    return report;
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
