// The calls of bounds.hpp: arguments to tasks.
#include <simdbezier/bounds.hpp>

#include <cmath>

#include "src/nets/net_call.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// ok, or what is wrong with the nets or with arrays of count * row values beside them.
template <typename T>
Status check_arrays(const ControlNets<T>& nets, const Boxes<T>& out, std::size_t row) noexcept {
  if (const Status status = check_input(nets); !status) {
    return status;
  }
  const std::size_t count = nets.count * row;
  for (const Values<T>* const array : {&out.low, &out.high}) {
    if (const Status status = check_array(nets, *array, count); !status) {
      return status;
    }
  }
  const MemoryRange low(out.low.first, count * sizeof(T));
  const MemoryRange high(out.high.first, count * sizeof(T));
  return low.meets(high) ? Status::overlapping_outputs : Status::ok;
}

template <typename T>
Report run_boxes(const ControlNets<T>& nets, int levels, const Boxes<T>& out,
                 const RunOptions& options) noexcept {
  const std::size_t row = nets.components < 0 ? 0 : static_cast<std::size_t>(nets.components);
  if (const Status status = check_arrays<T>(nets, out, row); !status) {
    return {status};
  }
  if (levels < 0 || levels > kMostBoxLevels) {
    return {Status::bad_grid};
  }
  const BoxTask<T> task{view_of(nets), out.low.first, out.high.first, levels};
  const std::size_t net = shape_of(nets).control_values();
  return compute_nets(nets, &NetOperationTable<T>::boxes, task,
                      (1 + 2 * static_cast<std::size_t>(levels)) * net, options);
}

/// Rounded up, to the same value in any rounding mode that the caller may have set.
template <typename T>
T root_of_components(int components) noexcept {
  const DefaultFpEnvironment environment;
  return std::sqrt(static_cast<T>(components)) * T(1.000001);
}

} // namespace
} // namespace detail

template <typename T>
Report control_boxes(const ControlNets<T>& nets, const std::type_identity_t<Boxes<T>>& out,
                     const RunOptions& options) noexcept {
  return detail::run_boxes<T>(nets, 0, out, options);
}

template <typename T>
Report tight_boxes(const ControlNets<T>& nets, int levels,
                   const std::type_identity_t<Boxes<T>>& out, const RunOptions& options) noexcept {
  return detail::run_boxes<T>(nets, levels, out, options);
}

template <typename T>
Report flatness(const ControlNets<T>& nets, const std::type_identity_t<Values<T>>& out,
                const RunOptions& options) noexcept {
  Status status = detail::check_input(nets);
  if (status) {
    status = detail::check_array(nets, out, nets.count);
  }
  if (!status) {
    return {status};
  }
  const T root = detail::root_of_components<T>(nets.components);
  const detail::FlatnessTask<T> task{detail::view_of(nets), out.first, root};
  return detail::compute_nets(nets, &detail::NetOperationTable<T>::flatness, task,
                              detail::shape_of(nets).control_values(), options);
}

SIMDBEZIER_EXPORT_BOTH_TYPES(control_boxes);
SIMDBEZIER_EXPORT_BOTH_TYPES(tight_boxes);
SIMDBEZIER_EXPORT_BOTH_TYPES(flatness);

} // namespace simdbezier
