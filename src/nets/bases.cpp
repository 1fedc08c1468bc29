// The calls of nets.hpp: which nets a basis takes.
#include <simdbezier/nets.hpp>

#include "src/nets/linear_maps.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/both_types.hpp"

namespace simdbezier {
namespace detail {
namespace {

bool is_power(Basis basis) noexcept {
  return basis == Basis::power || basis == Basis::centred_power;
}

/// ok | bad_degree | bad_weight, for nets that can be read.
template <typename T>
Status check_basis(Basis basis, const ControlNets<T>& nets, bool to_bezier) noexcept {
  if (!is_power(basis) && (nets.degree_u != 3 || nets.degree_v != 3)) {
    return Status::bad_degree;
  }
  const bool any_weights = basis == Basis::b_spline && to_bezier;
  const bool allowed = nets.weights == Weights::none || any_weights ||
                       (is_power(basis) && nets.weights == Weights::homogeneous);
  return allowed ? Status::ok : Status::bad_weight;
}

template <typename T>
Report change_basis(const ControlNets<T>& nets, const MutableNets<T>& out, Basis basis,
                    bool to_bezier, const RunOptions& options) noexcept {
  if (const Status status = check_nets<T>(nets, {&out}, nets.degree_u, nets.degree_v); !status) {
    return {status};
  }
  if (const Status fits = check_basis(basis, nets, to_bezier); !fits) {
    return argument_fault(fits);
  }
  const LinearMap u = basis_map(basis, nets.degree_u, to_bezier);
  const LinearMap v = basis_map(basis, nets.degree_v, to_bezier);
  const MapTask<T> task{view_of(nets), view_of(out), &u, &v, support_of(u), support_of(v)};
  return compute_nets(nets, &NetOperationTable<T>::map, task, 3 * shape_of(nets).control_values(),
                      options, is_power(basis));
}

} // namespace
} // namespace detail

template <typename T>
Report to_bezier(Basis basis, const ControlNets<T>& nets,
                 const std::type_identity_t<MutableNets<T>>& out,
                 const RunOptions& options) noexcept {
  return detail::change_basis<T>(nets, out, basis, true, options);
}

template <typename T>
Report from_bezier(Basis basis, const ControlNets<T>& nets,
                   const std::type_identity_t<MutableNets<T>>& out,
                   const RunOptions& options) noexcept {
  return detail::change_basis<T>(nets, out, basis, false, options);
}

SIMDBEZIER_EXPORT_BOTH_TYPES(to_bezier);
SIMDBEZIER_EXPORT_BOTH_TYPES(from_bezier);

} // namespace simdbezier
