#include "src/nets/net_call.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "src/nets/net_places.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier::detail {
namespace {

bool is_degree(int degree) noexcept { return degree >= 1 && degree <= kMostDegree; }

/// Whether one run of values holds one that is not finite: by its exponent, since integers are what
/// compilers vectorise.
template <typename S>
bool any_not_finite(const S* values, std::size_t count) noexcept {
  using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;
  constexpr Bits kExponent = std::bit_cast<Bits>(std::numeric_limits<S>::infinity());
  Bits any = 0;
  for (std::size_t k = 0; k < count; ++k) {
    any |= static_cast<Bits>((std::bit_cast<Bits>(values[k]) & kExponent) == kExponent ? 1 : 0);
  }
  return any != 0;
}

template <typename S>
Report fault_of(const ControlNets<S>& nets, std::size_t patch, bool signed_weights) noexcept {
  const NetView<const S> view = view_of(nets);
  const S* const net = view.points + static_cast<std::ptrdiff_t>(patch) * view.patch_stride;
  int k = 0;
  for (int j = 0; j <= nets.degree_v; ++j) {
    for (int i = 0; i <= nets.degree_u; ++i, ++k) {
      const S* const point = net + j * view.row_stride + i * view.point_stride;
      for (int c = 0; c < static_cast<int>(view.channels); ++c) {
        const S value = point[c * view.component_stride];
        const bool weight = c == nets.components;
        if (weight && !signed_weights && !(value > 0 && std::isfinite(value))) {
          return {Status::bad_weight, patch, k, c};
        }
        if (!std::isfinite(value)) {
          return {Status::non_finite_input, patch, k, c};
        }
      }
    }
  }
  return {};
}

/// A quick look at one patch; says true where fault_of() has to be asked.
template <typename S>
bool doubtful(const NetView<const S>& view, std::size_t patch, bool check_weights) noexcept {
  const S* const net = view.points + static_cast<std::ptrdiff_t>(patch) * view.patch_stride;
  const std::size_t points = view.order_u * view.order_v;
  if (!view.packed) {
    return true;
  }
  bool bad = any_not_finite(net, points * view.channels);
  for (std::size_t k = 0; check_weights && k < points; ++k) {
    bad = bad || !(net[k * view.channels + view.components] > 0);
  }
  return bad;
}

} // namespace

template <typename S>
NetView<const S> view_of(const ControlNets<S>& nets) noexcept {
  const std::size_t channels = shape_of(nets).channels();
  const auto point = static_cast<std::ptrdiff_t>(channels);
  const std::ptrdiff_t row = (nets.degree_u + 1) * point;
  const bool packed = (nets.component_stride == 1 || channels == 1) && nets.point_stride == point &&
                      nets.row_stride == row;
  return {nets.points,
          static_cast<std::size_t>(nets.degree_u) + 1,
          static_cast<std::size_t>(nets.degree_v) + 1,
          static_cast<std::size_t>(nets.components),
          channels,
          nets.patch_stride,
          nets.row_stride,
          nets.point_stride,
          nets.component_stride,
          nets.weights,
          packed};
}

template <typename S>
NetView<S> view_of(const MutableNets<S>& nets) noexcept {
  const NetView<const S> view = view_of(static_cast<ControlNets<S>>(nets));
  return {nets.points,           view.order_u,      view.order_v,    view.components,
          view.channels,         view.patch_stride, view.row_stride, view.point_stride,
          view.component_stride, view.weights,      view.packed};
}

template <typename S>
Status check_input(const ControlNets<S>& nets) noexcept {
  return is_degree(nets.degree_u) && is_degree(nets.degree_v) ? check_places(nets)
                                                              : Status(Status::bad_degree);
}

template <typename S>
Status check_views(std::span<const ControlNets<S>> nets) noexcept {
  if (is_missing(nets)) {
    return Status::null_input;
  }
  std::size_t patches = 0;
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / 512;
  for (const ControlNets<S>& view : nets) {
    if (const Status status = check_input(view); !status) {
      return status;
    }
    if (view.count > kMost - patches) {
      return Status::size_overflow;
    }
    patches += view.count;
  }
  return Status::ok;
}

template <typename S>
Status check_output(const MutableNets<S>& out, const ControlNets<S>& nets, int degree_u,
                    int degree_v) noexcept {
  if (out.degree_u != degree_u || out.degree_v != degree_v) {
    return Status::bad_degree;
  }
  if (out.components != nets.components || out.weights != nets.weights) {
    return Status::bad_components;
  }
  if (out.count != nets.count) {
    return Status::bad_patch_range;
  }
  if (out.points == nullptr && out.count > 0) {
    return Status::null_output;
  }
  Lattice lattice;
  if (!lattice_of(static_cast<ControlNets<S>>(out), lattice)) {
    return Status::size_overflow;
  }
  if (!nests(lattice, sizeof(S))) {
    return Status::bad_stride;
  }
  return lies_in(lattice, out.count, std::span<const S>(out.memory)) ? Status::ok
                                                                     : Status::output_too_small;
}

template <typename S>
Status check_apart(const ControlNets<S>& a, const ControlNets<S>& b) noexcept {
  Lattice lattice_a;
  Lattice lattice_b;
  if (a.count == 0 || b.count == 0 || !lattice_of(a, lattice_a) || !lattice_of(b, lattice_b)) {
    return Status::ok;
  }
  return collide(lattice_a, lattice_b, sizeof(S)) ? Status::overlapping_outputs : Status::ok;
}

template <typename S>
Status check_apart(const ControlNets<S>& nets, const MemoryRange& range) noexcept {
  Lattice lattice;
  const bool apart = nets.count == 0 || !lattice_of(nets, lattice) || !lattice.range.meets(range);
  return apart ? Status::ok : Status::overlapping_outputs;
}

template <typename S>
Status check_nets(const ControlNets<S>& nets, std::initializer_list<const MutableNets<S>*> out,
                  int degree_u, int degree_v) noexcept {
  Status status = check_input(nets);
  for (const MutableNets<S>* const one : out) {
    status = status == Status::ok ? check_output(*one, nets, degree_u, degree_v) : status;
  }
  for (auto one = out.begin(); one != out.end() && status == Status::ok; ++one) {
    status = check_apart<S>(nets, **one);
    for (auto other = out.begin(); other != one && status == Status::ok; ++other) {
      status = check_apart<S>(**other, **one);
    }
  }
  return status;
}

template <typename S>
Report find_fault(const ControlNets<S>& nets, int threads, bool signed_weights) noexcept {
  const NetView<const S> view = view_of(nets);
  const bool check_weights = nets.weights != Weights::none && !signed_weights;
  const std::size_t first = first_failure(nets.count, 10, threads, [=](std::size_t patch) {
    return !doubtful(view, patch, check_weights) || fault_of(nets, patch, signed_weights);
  });
  Report report;
  if (first < nets.count) {
    in_default_environment( // weights may be denormal
        [&]() noexcept { report = fault_of(nets, first, signed_weights); });
  }
  return report;
}

#define SIMDBEZIER_INSTANTIATE(S)                                                                  \
  template NetView<const S> view_of(const ControlNets<S>&) noexcept;                               \
  template NetView<S> view_of(const MutableNets<S>&) noexcept;                                     \
  template Status check_input(const ControlNets<S>&) noexcept;                                     \
  template Status check_views(std::span<const ControlNets<S>>) noexcept;                           \
  template Status check_output(const MutableNets<S>&, const ControlNets<S>&, int, int) noexcept;   \
  template Status check_apart(const ControlNets<S>&, const ControlNets<S>&) noexcept;              \
  template Status check_apart(const ControlNets<S>&, const MemoryRange&) noexcept;                 \
  template Report find_fault(const ControlNets<S>&, int, bool) noexcept;                           \
  template Status check_nets(const ControlNets<S>&, std::initializer_list<const MutableNets<S>*>,  \
                             int, int) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier::detail
