// Iso-parametric curves of patches, as points or as sets; src/nets/iso_points.hpp has the
// arithmetic.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>

#include <simdbezier/curves.hpp>

#include "src/nets/iso_points.hpp"
#include "src/nets/net_call.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// What is wrong with the nets as a whole, or with the parameter.
template <typename S>
Report check_arguments(const ControlNets<S>& nets, double t) noexcept {
  if (const Status usable = check_input(nets); !usable) {
    return {usable};
  }
  return std::isfinite(t) ? Report{} : argument_fault(Status::non_finite_input);
}

template <typename F>
void for_patches(std::size_t count, int threads, const F& f) {
  auto body = [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t patch = begin; patch < end; ++patch) {
      f(patch);
    }
  };
  divide_work(count, 200, threads, body);
}

/// Nets are read twice, so that nothing is written where one of them is at fault.
template <typename S>
Report form_all(const ControlNets<S>& nets, const IsoTask<S>& task, double* points, int threads) {
  const Report checked = find_fault(nets, threads);
  if (checked) {
    for_patches(nets.count, threads, [&](std::size_t patch) {
      form_curve(task, patch, points + patch * task.curve_values());
    });
  }
  return checked;
}

/// Bytes of the points of `count` curves; false where they are too many.
template <typename S>
bool count_bytes(const IsoTask<S>& task, std::size_t count, std::size_t& bytes) {
  return !__builtin_mul_overflow(count, task.curve_values() * sizeof(double), &bytes) &&
         bytes <= static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max());
}

template <typename S>
Report iso_points(const ControlNets<S>& nets, Across direction, double t,
                  const Values<double>& points, const RunOptions& options) {
  if (const Report report = check_arguments(nets, t); !report) {
    return report;
  }
  const IsoTask<S> task(nets, direction, t);
  std::size_t bytes = 0;
  if (!count_bytes(task, nets.count, bytes)) {
    return {Status::size_overflow};
  }
  const Status usable = check_array(nets, points, nets.count * task.curve_values());
  return usable ? form_all(nets, task, points.first, options.threads) : Report{usable};
}

/// Curves like the task's, whose points form(points) writes, as a set.
template <typename T, typename S, typename Form>
Report pack_formed(const IsoTask<S>& task, std::size_t count, const Form& form, CurveSet<T>& curves,
                   const PackOptions& options) {
  std::size_t bytes = 0;
  if (!count_bytes(task, count, bytes)) {
    return {Status::size_overflow};
  }
  const std::unique_ptr<double[]> points(new (std::nothrow) double[bytes / sizeof(double)]);
  if (points == nullptr) {
    return {Status::out_of_memory};
  }
  if (const Report report = form(points.get()); !report) {
    return report;
  }
  return pack(ControlCurves<double>::packed(points.get(), count, task.nets.degree_v,
                                            task.nets.components, task.form),
              curves, options);
}

template <typename T, typename S>
Report iso_of_nets(const ControlNets<S>& nets, Across direction, double t, CurveSet<T>& curves,
                   const PackOptions& options) {
  if (const Report report = check_arguments(nets, t); !report) {
    return report;
  }
  const IsoTask<S> task(nets, direction, t);
  const auto form = [&](double* points) { return form_all(nets, task, points, options.threads); };
  return pack_formed(task, nets.count, form, curves, options);
}

/// The nets that a set keeps, in the type S in which they were given. They have one shape; weights
/// of both forms make two buckets.
template <typename T, typename S>
Report iso_of_given(const SetStorage<T>& set, Across direction, double t, CurveSet<T>& curves,
                    const PackOptions& options) {
  const PatchStorage<T>& front = set.buckets.front();
  const PatchStorage<T>& back = set.buckets.back();
  if (set.buckets.size() > 2 || !(front.shape == back.shape)) {
    return {Status::bad_degree};
  }
  IsoTask<S> tasks[] = {{front, direction, t}, {back, direction, t}};
  if (set.buckets.size() == 2) {
    tasks[0].form = tasks[1].form = Weights::cartesian;
  }
  const auto form = [&](double* points) {
    for_patches(set.count, options.threads, [&](std::size_t patch) {
      const PatchPlace place = set.place(patch);
      form_curve(tasks[place.bucket], place.index, points + patch * tasks[0].curve_values());
    });
    return Report{};
  };
  return pack_formed(tasks[0], set.count, form, curves, options);
}

template <typename T>
Report iso_of_set(const PatchSet<T>& patches, Across direction, double t, CurveSet<T>& curves,
                  PackOptions options) {
  const SetStorage<T>* const set = patches.storage();
  if (set == nullptr) {
    return iso_of_nets(ControlNets<T>{}, direction, t, curves, options);
  }
  if (!std::isfinite(t)) {
    return argument_fault(Status::non_finite_input);
  }
  const GivenPoints& given = set->buckets.front().given;
  std::copy_n(given.relative_to, 3, options.relative_to);
  return given.in_double ? iso_of_given<T, double>(*set, direction, t, curves, options)
                         : iso_of_given<T, float>(*set, direction, t, curves, options);
}

} // namespace
} // namespace detail

template <typename S>
Report iso_u(const ControlNets<S>& nets, double u0, Values<double> points,
             const RunOptions& options) noexcept {
  return detail::iso_points(nets, detail::Across::u, u0, points, options);
}

template <typename S>
Report iso_v(const ControlNets<S>& nets, double v0, Values<double> points,
             const RunOptions& options) noexcept {
  return detail::iso_points(nets, detail::Across::v, v0, points, options);
}

template <typename T, typename S>
Report iso_u(const ControlNets<S>& nets, double u0, CurveSet<T>& curves,
             const PackOptions& options) noexcept {
  return detail::iso_of_nets(nets, detail::Across::u, u0, curves, options);
}

template <typename T, typename S>
Report iso_v(const ControlNets<S>& nets, double v0, CurveSet<T>& curves,
             const PackOptions& options) noexcept {
  return detail::iso_of_nets(nets, detail::Across::v, v0, curves, options);
}

template <typename T>
Report iso_u(const PatchSet<T>& patches, double u0, CurveSet<T>& curves,
             const PackOptions& options) noexcept {
  return detail::iso_of_set(patches, detail::Across::u, u0, curves, options);
}

template <typename T>
Report iso_v(const PatchSet<T>& patches, double v0, CurveSet<T>& curves,
             const PackOptions& options) noexcept {
  return detail::iso_of_set(patches, detail::Across::v, v0, curves, options);
}

#define SIMDBEZIER_INSTANTIATE_SET(name, T, S)                                                     \
  template SIMDBEZIER_API Report name(const ControlNets<S>&, double, CurveSet<T>&,                 \
                                      const PackOptions&) noexcept;
#define SIMDBEZIER_INSTANTIATE(name, S)                                                            \
  template SIMDBEZIER_API Report name(const ControlNets<S>&, double, Values<double>,               \
                                      const RunOptions&) noexcept;                                 \
  template SIMDBEZIER_API Report name(const PatchSet<S>&, double, CurveSet<S>&,                    \
                                      const PackOptions&) noexcept;                                \
  SIMDBEZIER_INSTANTIATE_SET(name, float, S)                                                       \
  SIMDBEZIER_INSTANTIATE_SET(name, double, S)
SIMDBEZIER_INSTANTIATE(iso_u, float)
SIMDBEZIER_INSTANTIATE(iso_u, double)
SIMDBEZIER_INSTANTIATE(iso_v, float)
SIMDBEZIER_INSTANTIATE(iso_v, double)
#undef SIMDBEZIER_INSTANTIATE
#undef SIMDBEZIER_INSTANTIATE_SET

} // namespace simdbezier
