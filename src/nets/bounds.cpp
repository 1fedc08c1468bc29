// The calls of bounds.hpp: arguments to tasks.
#include <simdbezier/bounds.hpp>

#include <cmath>
#include <cstdint>

#include "src/nets/net_call.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// ok, or what is wrong with the nets or with arrays of count * row values beside them.
template <typename T>
Status check_arrays(const ControlNets<T>& nets, const T* first, const T* second,
                    std::size_t row) noexcept {
  const Status status = check_input(nets);
  if (status != Status::ok) {
    return status;
  }
  if ((first == nullptr || second == nullptr) && nets.count > 0) {
    return Status::null_output;
  }
  const std::size_t bytes = nets.count * row * sizeof(T);
  const MemoryRange ranges[2] = {{first, bytes}, {second, bytes}};
  for (const MemoryRange& range : ranges) {
    const Status apart = check_apart(nets, range);
    if (apart != Status::ok) {
      return apart;
    }
  }
  const auto a = reinterpret_cast<std::uintptr_t>(first);
  const auto b = reinterpret_cast<std::uintptr_t>(second);
  const std::uintptr_t distance = a < b ? b - a : a - b;
  return distance < bytes ? Status::overlapping_outputs : Status::ok;
}

template <typename T>
NetReport run_boxes(const ControlNets<T>& nets, int levels, const Boxes<T>& out,
                    const Options& options) noexcept {
  const std::size_t row = nets.components < 0 ? 0 : static_cast<std::size_t>(nets.components);
  const Status status = check_arrays<T>(nets, out.low, out.high, row);
  if (status != Status::ok) {
    return {status};
  }
  if (levels < 0 || levels > kMostBoxLevels) {
    return {Status::bad_grid};
  }
  const BoxTask<T> task{view_of(nets), out.low, out.high, levels};
  const std::size_t net = shape_of(nets).control_values();
  return compute_nets(nets, &NetTable<T>::boxes, task,
                      (1 + 2 * static_cast<std::size_t>(levels)) * net, options);
}

/// Rounded up, in any rounding mode of the caller's to the same value.
template <typename T>
T root_of_components(int components) noexcept {
  const DefaultFpEnvironment environment;
  return std::sqrt(static_cast<T>(components)) * T(1.000001);
}

} // namespace
} // namespace detail

template <typename T>
NetReport control_boxes(const ControlNets<T>& nets, const std::type_identity_t<Boxes<T>>& out,
                        const Options& options) noexcept {
  return detail::run_boxes<T>(nets, 0, out, options);
}

template <typename T>
NetReport tight_boxes(const ControlNets<T>& nets, int levels,
                      const std::type_identity_t<Boxes<T>>& out, const Options& options) noexcept {
  return detail::run_boxes<T>(nets, levels, out, options);
}

template <typename T>
NetReport flatness(const ControlNets<T>& nets, std::type_identity_t<T>* out,
                   const Options& options) noexcept {
  Status status = detail::check_input(nets);
  if (status == Status::ok && out == nullptr && nets.count > 0) {
    status = Status::null_output;
  }
  if (status == Status::ok) {
    status = detail::check_apart(nets, detail::MemoryRange{out, nets.count * sizeof(T)});
  }
  if (status != Status::ok) {
    return {status};
  }
  const T root = detail::root_of_components<T>(nets.components);
  const detail::FlatnessTask<T> task{detail::view_of(nets), out, root};
  return detail::compute_nets(nets, &detail::NetTable<T>::flatness, task,
                              detail::shape_of(nets).control_values(), options);
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API NetReport control_boxes(                                                 \
      const ControlNets<T>&, const std::type_identity_t<Boxes<T>>&, const Options&) noexcept;      \
  template SIMDBEZIER_API NetReport tight_boxes(                                                   \
      const ControlNets<T>&, int, const std::type_identity_t<Boxes<T>>&, const Options&) noexcept; \
  template SIMDBEZIER_API NetReport flatness(const ControlNets<T>&, std::type_identity_t<T>*,      \
                                             const Options&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
