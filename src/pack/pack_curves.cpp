// Packing of curves: arguments, memory, threads and faults; the arithmetic is in
// pack/curve_pack_kernel.hpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>

#include <simdbezier/curves.hpp>

#include "src/pack/curve_input.hpp"
#include "src/pack/pack_request.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/storage/curve_storage.hpp"
#include "src/storage/net_faults.hpp"
#include "src/tables/curve_table.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// One block for all arrays.
template <typename T>
Status allocate(std::size_t count, CurveStorage<T>& storage) {
  const CurveShape& shape = storage.shape;
  const std::size_t given_bytes = shape.control_values() * storage.given.value_bytes();
  const std::size_t per_curve = (shape.values() + 1) * sizeof(T) + given_bytes;
  constexpr std::size_t kLimit = std::numeric_limits<std::ptrdiff_t>::max();
  constexpr std::size_t kGap = sizeof(double); // to the first double
  if (count > (kLimit - kGap) / per_curve) {
    return Status::size_overflow;
  }
  const std::size_t bytes = count * per_curve + kGap;
  storage.memory.reset(::operator new (bytes, std::align_val_t{64}, std::nothrow));
  if (storage.memory == nullptr) {
    return Status::out_of_memory;
  }
  storage.count = count;
  storage.values = static_cast<T*>(storage.memory.get());
  storage.tangent_floor = storage.values + count * shape.values();
  const std::size_t before = count * (shape.values() + 1) * sizeof(T);
  storage.given.values =
      static_cast<unsigned char*>(storage.memory.get()) + (before + kGap - 1) / kGap * kGap;
  return Status::ok;
}

/// The first fault of one curve, whose values have been written.
template <typename T, typename S>
Report inspect(const ControlCurves<S>& curves, const CurveStorage<T>& storage, std::size_t curve) {
  const CurveShape& shape = storage.shape;
  const ControlNets<S> rows = as_rows(curves);
  for (std::size_t c = 0; c < shape.channels(); ++c) {
    const bool weight = c == static_cast<std::size_t>(shape.components);
    const int point = ChannelView<S>(rows, curve, c).first_not([weight](S value) {
      return weight ? is_weight<T>(value) : std::isfinite(value);
    });
    if (point >= 0) {
      return {weight ? Status::bad_weight : Status::non_finite_input, curve, point,
              static_cast<int>(c)};
    }
  }
  const T* const values = storage.values + curve * shape.values();
  for (std::size_t k = 0; k < shape.values(); ++k) {
    if (!std::isfinite(values[k])) {
      const std::size_t channel = k % shape.cell_values() / shape.channel_values();
      return {Status::coefficient_overflow, curve, 0, static_cast<int>(channel)};
    }
  }
  return {};
}

/// Packs all curves; reports the fault of the lowest one, whichever thread finds it.
template <typename T, typename S>
Report pack_all(const ControlCurves<S>& curves, const PackOptions& options, Isa isa,
                CurveStorage<T>& storage) {
  const CurvePackKernel<T, S> kernel = packing_kernel<S>(*kernel_table<T>(isa).curves);
  const double* const shift = options.relative_to;
  const CurvePackTask<T, S> task{as_rows(curves),
                                 storage.shape,
                                 {shift[0], shift[1], shift[2]},
                                 storage.values,
                                 writable_points<S>(storage.given),
                                 storage.tangent_floor};
  const std::size_t groups = lane_groups(curves.count);
  LowestFault fault;
  auto body = [&](int, std::size_t begin, std::size_t end) {
    fault.add(pack_and_inspect(
        begin * kMaxLanes, std::min(end * kMaxLanes, curves.count),
        [&](std::size_t first, std::size_t last) { return kernel(task, first, last); },
        [&](std::size_t curve) { return inspect(curves, storage, curve); }));
  };
  divide_work(groups, 20 * kMaxLanes, options.threads, body);
  return fault.report();
}

} // namespace
} // namespace detail

template <typename T>
std::size_t CurveSet<T>::size() const noexcept {
  return storage_ == nullptr ? 0 : storage_->count;
}

template <typename T>
int CurveSet<T>::degree() const noexcept {
  return storage_ == nullptr ? 3 : storage_->shape.degree;
}

template <typename T>
int CurveSet<T>::components() const noexcept {
  return storage_ == nullptr ? 3 : storage_->shape.components;
}

template <typename T>
bool CurveSet<T>::rational() const noexcept {
  return storage_ != nullptr && storage_->shape.rational;
}

template <typename T>
bool CurveSet<T>::has_local_origins() const noexcept {
  return storage_ != nullptr && storage_->shape.origins;
}

template <typename T, typename S>
Report pack(const ControlCurves<S>& curves, CurveSet<T>& set, const PackOptions& options) noexcept
    try {
  const Status usable = detail::check_curves(curves);
  if (usable != Status::ok) {
    return {usable};
  }
  Isa isa = Isa::automatic;
  if (const Report resolved = detail::resolve_packing(options, curves.components, isa); !resolved) {
    return resolved;
  }
  auto storage = std::make_shared<detail::CurveStorage<T>>();
  storage->shape = {curves.degree, curves.components, curves.weights != Weights::none,
                    options.local_origin};
  storage->given = detail::given_form<S>(curves.weights, options);
  const Status allocated = detail::allocate(curves.count, *storage);
  if (allocated != Status::ok) {
    return {allocated};
  }
  const Report report = detail::pack_all(curves, options, isa, *storage);
  if (!report) {
    return report;
  }
  set = CurveSet<T>(std::move(storage));
  return {};
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

template class CurveSet<float>;
template class CurveSet<double>;
template SIMDBEZIER_API Report pack(const ControlCurves<float>&, CurveSet<float>&,
                                    const PackOptions&) noexcept;
template SIMDBEZIER_API Report pack(const ControlCurves<double>&, CurveSet<float>&,
                                    const PackOptions&) noexcept;
template SIMDBEZIER_API Report pack(const ControlCurves<float>&, CurveSet<double>&,
                                    const PackOptions&) noexcept;
template SIMDBEZIER_API Report pack(const ControlCurves<double>&, CurveSet<double>&,
                                    const PackOptions&) noexcept;

} // namespace simdbezier
