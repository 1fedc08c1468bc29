// The calls of nets.hpp: arguments to tasks.
#include <simdbezier/nets.hpp>

#include <algorithm>
#include <cmath>

#include "src/nets/linear_maps.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/both_types.hpp"

namespace simdbezier {
namespace detail {
namespace {

template <typename T>
Weighting<T> weighting(const UnitParameter<T>& at) noexcept {
  return {at.t(), at.complement()};
}

/// ok | non_finite_input | bad_weight where a weight could lose its sign.
template <typename T>
Status check_parameter(const ControlNets<T>& nets, const UnitParameter<T>& at) noexcept {
  if (!std::isfinite(at.t()) || !std::isfinite(at.complement())) {
    return Status::non_finite_input;
  }
  const bool inside = at.t() >= 0 && at.complement() >= 0;
  return inside || nets.weights == Weights::none ? Status::ok : Status::bad_weight;
}

template <typename T>
std::size_t net_values(const ControlNets<T>& nets) noexcept {
  return shape_of(nets).control_values();
}

/// All cuts; outputs that are not wanted are null.
template <typename T>
Report run_split(const ControlNets<T>& nets, const UnitParameter<T>* u, const UnitParameter<T>* v,
                 const MutableNets<T>* const (&out)[4], const RunOptions& options) noexcept {
  SplitTask<T> task{};
  task.in_u = u != nullptr;
  task.in_v = v != nullptr;
  for (std::size_t k = 0; k < 4; ++k) {
    if (out[k] != nullptr) {
      task.out[k] = view_of(*out[k]);
    }
  }
  for (const UnitParameter<T>* const at : {u, v}) {
    if (const Status usable = at == nullptr ? Status::ok : check_parameter(nets, *at); !usable) {
      return argument_fault(usable);
    }
  }
  task.in = view_of(nets);
  task.u = u == nullptr ? Weighting<T>{} : weighting(*u);
  task.v = v == nullptr ? Weighting<T>{} : weighting(*v);
  for (std::size_t half = 0; half < 2; ++half) {
    task.support_u[half] =
        support_of_piece(nets.degree_u, u == nullptr || half == 0, u == nullptr || half == 1);
    task.support_v[half] =
        support_of_piece(nets.degree_v, v == nullptr || half == 0, v == nullptr || half == 1);
  }
  return compute_nets(nets, &NetOperationTable<T>::split, task, 3 * net_values(nets), options);
}

/// Whether a parameter is 0; of a mirrored one, whether it was 1.
template <typename T>
bool is_end(const UnitParameter<T>& at) noexcept {
  return at.t() == 0 && at.complement() == 1;
}
template <typename T>
Support support_between(int degree, const UnitParameter<T>& from,
                        const UnitParameter<T>& to) noexcept {
  return support_of_piece(degree, is_end(from), is_end(to.mirrored()));
}

template <typename T>
Report run_map(const ControlNets<T>& nets, const MutableNets<T>& out, const LinearMap& u,
               const LinearMap& v, const RunOptions& options,
               bool signed_weights = false) noexcept {
  const MapTask<T> task{view_of(nets), view_of(out), &u, &v, support_of(u), support_of(v)};
  NetShape most = shape_of(nets);
  most.degree_u = std::max(most.degree_u, out.degree_u);
  most.degree_v = std::max(most.degree_v, out.degree_v);
  return compute_nets(nets, &NetOperationTable<T>::map, task, 3 * most.control_values(), options,
                      signed_weights);
}

/// Copies values, without any arithmetic, in the order of `nets`, a view of `original` in another
/// order.
template <typename T>
Report run_copy(const ControlNets<T>& original, const ControlNets<T>& nets,
                const MutableNets<T>& out, const RunOptions& options) noexcept {
  Isa isa = Isa::automatic;
  if (const Report sound = prepare(original, options, false, isa); !sound) {
    return sound;
  }
  const std::ptrdiff_t channels = static_cast<std::ptrdiff_t>(shape_of(nets).channels());
  const auto copy_patch = [&](std::ptrdiff_t patch) {
    const T* from_row = nets.points + patch * nets.patch_stride;
    T* to_row = out.points + patch * out.patch_stride;
    for (int j = 0; j <= nets.degree_v; ++j) {
      for (int i = 0; i <= nets.degree_u; ++i) {
        for (std::ptrdiff_t c = 0; c < channels; ++c) {
          to_row[i * out.point_stride + c * out.component_stride] =
              from_row[i * nets.point_stride + c * nets.component_stride] + T(0);
        }
      }
      from_row += nets.row_stride;
      to_row += out.row_stride;
    }
  };
  return {run_blocks(nets.count, duration_of(nets.count, 50), options, 0,
                     [&](int, std::size_t begin, std::size_t end, unsigned char*) {
                       for (std::size_t patch = begin; patch < end; ++patch) {
                         copy_patch(static_cast<std::ptrdiff_t>(patch));
                       }
                       return isa;
                     })};
}

/// Cuts nets in two, in u or in v, whichever is given.
template <typename T>
Report run_halves(const ControlNets<T>& nets, const UnitParameter<T>* u, const UnitParameter<T>* v,
                  const MutableNets<T>& low, const MutableNets<T>& high,
                  const RunOptions& options) noexcept {
  if (const Status status = check_nets<T>(nets, {&low, &high}, nets.degree_u, nets.degree_v);
      !status) {
    return {status};
  }
  const auto high_of = [&](const auto* cut) { return cut == nullptr ? nullptr : &high; };
  return run_split<T>(nets, u, v, {&low, high_of(u), high_of(v), nullptr}, options);
}

/// The nets as `view` sees them, which is with these degrees.
template <typename T, typename View>
Report run_view(const ControlNets<T>& nets, const MutableNets<T>& out, int degree_u, int degree_v,
                View view, const RunOptions& options) noexcept {
  const Status status = check_nets<T>(nets, {&out}, degree_u, degree_v);
  return status ? run_copy<T>(nets, view(nets), out, options) : Report{status};
}

/// Derivatives of these orders, 0 or 1; lines keep degree 1.
template <typename T>
Report run_hodograph(const ControlNets<T>& nets, const MutableNets<T>& out, int order_u,
                     int order_v, const RunOptions& options) noexcept {
  // Degrees have not been checked yet, and may be the least integer.
  const auto left = [](int degree, int order) { return std::max(degree, order + 1) - order; };
  if (const Status status =
          check_nets<T>(nets, {&out}, left(nets.degree_u, order_u), left(nets.degree_v, order_v));
      !status) {
    return {status};
  }
  if (nets.weights != Weights::none) {
    return argument_fault(Status::bad_weight);
  }
  const auto map = [](int degree, int order) {
    return order == 0 ? identity_map(degree) : hodograph_map(degree);
  };
  return run_map<T>(nets, out, map(nets.degree_u, order_u), map(nets.degree_v, order_v), options);
}

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
  return run_map<T>(nets, out, basis_map(basis, nets.degree_u, to_bezier),
                    basis_map(basis, nets.degree_v, to_bezier), options, is_power(basis));
}

} // namespace

template <typename T>
T one_less(T t) noexcept {
  return T(1) - t;
}

template <typename T>
T quotient(std::int64_t i, std::int64_t n) noexcept {
  return static_cast<T>(i) / static_cast<T>(n);
}

SIMDBEZIER_EXPORT_BOTH_TYPES(one_less);
SIMDBEZIER_EXPORT_BOTH_TYPES(quotient);

} // namespace detail

template <typename T>
Report split_u(const ControlNets<T>& nets, AtParameter<T> u,
               const std::type_identity_t<MutableNets<T>>& low,
               const std::type_identity_t<MutableNets<T>>& high,
               const RunOptions& options) noexcept {
  return detail::run_halves<T>(nets, &u, nullptr, low, high, options);
}

template <typename T>
Report split_v(const ControlNets<T>& nets, AtParameter<T> v,
               const std::type_identity_t<MutableNets<T>>& low,
               const std::type_identity_t<MutableNets<T>>& high,
               const RunOptions& options) noexcept {
  return detail::run_halves<T>(nets, nullptr, &v, low, high, options);
}

template <typename T>
Report split(const ControlNets<T>& nets, AtParameter<T> u, AtParameter<T> v,
             const std::array<std::type_identity_t<MutableNets<T>>, 4>& out,
             const RunOptions& options) noexcept {
  const Status status = detail::check_nets<T>(nets, {&out[0], &out[1], &out[2], &out[3]},
                                              nets.degree_u, nets.degree_v);
  return status ? detail::run_split<T>(nets, &u, &v, {&out[0], &out[1], &out[2], &out[3]}, options)
                : Report{status};
}

template <typename T>
Report segment(const ControlNets<T>& nets, const std::type_identity_t<SubPatch<T>>& piece,
               const std::type_identity_t<MutableNets<T>>& out,
               const RunOptions& options) noexcept {
  if (const Status status = detail::check_nets<T>(nets, {&out}, nets.degree_u, nets.degree_v);
      !status) {
    return {status};
  }
  for (const UnitParameter<T>* const at : {&piece.u0, &piece.u1, &piece.v0, &piece.v1}) {
    if (const Status usable = detail::check_parameter(nets, *at); !usable) {
      return detail::argument_fault(usable);
    }
  }
  const detail::SegmentTask<T> task{
      detail::view_of(nets),
      detail::view_of(out),
      !detail::is_end(piece.u0) || !detail::is_end(piece.u1.mirrored()),
      !detail::is_end(piece.v0) || !detail::is_end(piece.v1.mirrored()),
      {detail::weighting(piece.u0), detail::weighting(piece.u1)},
      {detail::weighting(piece.v0), detail::weighting(piece.v1)},
      detail::support_between(nets.degree_u, piece.u0, piece.u1),
      detail::support_between(nets.degree_v, piece.v0, piece.v1)};
  return detail::compute_nets(nets, &detail::NetOperationTable<T>::segment, task,
                              4 * detail::net_values(nets), options);
}

template <typename T>
Report elevate(const ControlNets<T>& nets, const std::type_identity_t<MutableNets<T>>& out,
               const RunOptions& options) noexcept {
  Status status = detail::check_input(nets);
  const bool rises = out.degree_u >= nets.degree_u && out.degree_u <= kMostDegree &&
                     out.degree_v >= nets.degree_v && out.degree_v <= kMostDegree;
  if (status) {
    status = rises ? detail::check_nets<T>(nets, {&out}, out.degree_u, out.degree_v)
                   : Status(Status::bad_degree);
  }
  if (!status) {
    return {status};
  }
  return detail::run_map<T>(nets, out, detail::elevation_map(nets.degree_u, out.degree_u),
                            detail::elevation_map(nets.degree_v, out.degree_v), options);
}

template <typename T>
Report hodograph_u(const ControlNets<T>& nets, const std::type_identity_t<MutableNets<T>>& out,
                   const RunOptions& options) noexcept {
  return detail::run_hodograph<T>(nets, out, 1, 0, options);
}

template <typename T>
Report hodograph_v(const ControlNets<T>& nets, const std::type_identity_t<MutableNets<T>>& out,
                   const RunOptions& options) noexcept {
  return detail::run_hodograph<T>(nets, out, 0, 1, options);
}

template <typename T>
Report reverse_u(const ControlNets<T>& nets, const std::type_identity_t<MutableNets<T>>& out,
                 const RunOptions& options) noexcept {
  return detail::run_view<T>(nets, out, nets.degree_u, nets.degree_v, reversed_u<T>, options);
}

template <typename T>
Report reverse_v(const ControlNets<T>& nets, const std::type_identity_t<MutableNets<T>>& out,
                 const RunOptions& options) noexcept {
  return detail::run_view<T>(nets, out, nets.degree_u, nets.degree_v, reversed_v<T>, options);
}

template <typename T>
Report transpose(const ControlNets<T>& nets, const std::type_identity_t<MutableNets<T>>& out,
                 const RunOptions& options) noexcept {
  return detail::run_view<T>(nets, out, nets.degree_v, nets.degree_u, transposed<T>, options);
}

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

SIMDBEZIER_EXPORT_BOTH_TYPES(split_u);
SIMDBEZIER_EXPORT_BOTH_TYPES(split_v);
SIMDBEZIER_EXPORT_BOTH_TYPES(split);
SIMDBEZIER_EXPORT_BOTH_TYPES(segment);
SIMDBEZIER_EXPORT_BOTH_TYPES(elevate);
SIMDBEZIER_EXPORT_BOTH_TYPES(hodograph_u);
SIMDBEZIER_EXPORT_BOTH_TYPES(hodograph_v);
SIMDBEZIER_EXPORT_BOTH_TYPES(reverse_u);
SIMDBEZIER_EXPORT_BOTH_TYPES(reverse_v);
SIMDBEZIER_EXPORT_BOTH_TYPES(transpose);
SIMDBEZIER_EXPORT_BOTH_TYPES(to_bezier);
SIMDBEZIER_EXPORT_BOTH_TYPES(from_bezier);

} // namespace simdbezier
