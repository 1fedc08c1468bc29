// Iso-parametric curves of patches: de Casteljau's algorithm across the control net, in double.
//
// No kernels: a patch's net is read once and interpolated row against row, which compilers turn
// into vector code, and without contraction the bits are the same everywhere.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <span>

#include <simdbezier/iso_curves.hpp>

#include "src/nets/net_call.hpp"
#include "src/storage/patch_storage.hpp"

namespace simdbezier {
namespace detail {
namespace {

enum class Across : std::uint8_t { u, v };

/// The nets, seen from the direction that is interpolated away.
template <typename S>
struct IsoTask {
  ControlNets<S> nets;
  int degree;            ///< across
  int curve_degree;      ///< along
  std::ptrdiff_t across; ///< stride from point to point
  std::ptrdiff_t along;
  std::size_t channels;
  double t;
  const std::size_t* number = nullptr; ///< of each patch among the results; null: its index
  Weights form;                        ///< of the results: that of the nets, or cartesian

  IsoTask(const ControlNets<S>& all, Across direction, double parameter)
      : nets(all), degree(direction == Across::u ? all.degree_u : all.degree_v),
        curve_degree(direction == Across::u ? all.degree_v : all.degree_u),
        across(direction == Across::u ? all.point_stride : all.row_stride),
        along(direction == Across::u ? all.row_stride : all.point_stride),
        channels(static_cast<std::size_t>(all.components) + (all.weights == Weights::none ? 0 : 1)),
        t(parameter), form(all.weights) {}
  /// The nets of a bucket.
  template <typename T>
  IsoTask(const PatchStorage<T>& bucket, Across direction, double parameter)
      : IsoTask(ControlNets<S>::packed(static_cast<const S*>(bucket.given.values), bucket.count,
                                       bucket.shape.degree_u, bucket.shape.degree_v,
                                       bucket.shape.components, bucket.given.weights),
                direction, parameter) {
    number = bucket.number.get();
  }

  [[nodiscard]] std::size_t curve_values() const {
    return (static_cast<std::size_t>(curve_degree) + 1) * channels;
  }
  [[nodiscard]] const S* net(std::size_t patch) const {
    return nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride;
  }
  [[nodiscard]] double* place(double* points, std::size_t patch) const {
    return points + (number == nullptr ? patch : number[patch]) * curve_values();
  }
};

/// One patch's control points as rows of `row` values, one row for each point across.
template <typename S>
void read_rows(const IsoTask<S>& task, const S* net, double* rows) {
  const bool homogenise = task.nets.weights == Weights::cartesian;
  const auto weight_at = static_cast<std::ptrdiff_t>(task.nets.components);
  for (int i = 0; i <= task.degree; ++i) {
    for (int j = 0; j <= task.curve_degree; ++j) {
      const S* const point = net + i * task.across + j * task.along;
      for (std::size_t c = 0; c < task.channels; ++c) {
        const auto at = static_cast<std::ptrdiff_t>(c);
        *rows = static_cast<double>(point[at * task.nets.component_stride]);
        if (homogenise && at < weight_at) {
          *rows *= static_cast<double>(point[weight_at * task.nets.component_stride]);
        }
        ++rows;
      }
    }
  }
}

template <typename S>
void interpolate(const IsoTask<S>& task, std::size_t patch, double* points) {
  const std::size_t row = task.curve_values();
  double rows[kMostOrder * kMostOrder * kMostChannels];
  read_rows(task, task.net(patch), rows);
  const double s = 1 - task.t;
  for (int last = task.degree; last > 0; --last) {
    // All rows of a level lie side by side: one long loop.
    const std::size_t count = static_cast<std::size_t>(last) * row;
    for (std::size_t k = 0; k < count; ++k) {
      rows[k] = s * rows[k] + task.t * rows[k + row];
    }
  }
  const bool divides = task.nets.weights == Weights::cartesian;
  for (std::size_t k = 0; k < row; ++k) {
    const std::size_t c = k % task.channels;
    const bool weight = c + 1 == task.channels;
    points[k] = (divides && !weight ? rows[k] / rows[k - c + task.channels - 1] : rows[k]) + 0.0;
  }
}

/// At 0 and 1 a boundary, whose points are copied: products with weights would round.
template <typename S>
void copy_boundary(const IsoTask<S>& task, std::size_t patch, double* points) {
  const S* const first = task.net(patch) + (task.t == 1 ? task.degree * task.across : 0);
  for (int j = 0; j <= task.curve_degree; ++j) {
    for (std::size_t c = 0; c < task.channels; ++c) {
      const auto at = j * task.along + static_cast<std::ptrdiff_t>(c) * task.nets.component_stride;
      *points++ = static_cast<double>(first[at]) + 0.0;
    }
  }
}

/// Homogeneous points become Cartesian ones.
template <typename S>
void divide_by_weights(const IsoTask<S>& task, double* points) {
  for (std::size_t k = 0; k < task.curve_values(); k += task.channels) {
    for (std::size_t c = 0; c + 1 < task.channels; ++c) {
      points[k + c] = points[k + c] / points[k + task.channels - 1] + 0.0;
    }
  }
}

/// Nets are read twice, so that nothing is written where one of them is at fault.
template <typename S>
PackReport form(const IsoTask<S>& task, double* points, int threads) {
  const NetReport fault = find_fault(task.nets, threads);
  if (!fault) {
    return {fault.status, fault.patch, fault.point, fault.component};
  }
  auto body = [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t patch = begin; patch < end; ++patch) {
      double* const to = task.place(points, patch);
      task.t == 0 || task.t == 1 ? copy_boundary(task, patch, to) : interpolate(task, patch, to);
      if (task.form != task.nets.weights) {
        divide_by_weights(task, to);
      }
    }
  };
  for_blocks(task.nets.count, thread_count(threads, task.nets.count), BlockBody(body));
  return {};
}

/// Bytes of the points of `count` curves; false where they are too many.
template <typename S>
bool count_bytes(const IsoTask<S>& task, std::size_t count, std::size_t& bytes) {
  return !__builtin_mul_overflow(count, task.curve_values() * sizeof(double), &bytes) &&
         bytes <= static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max());
}

template <typename S>
Status iso_points(const ControlNets<S>& nets, Across direction, double t, double* points,
                  int threads) {
  const Status usable = check_input(nets);
  if (usable != Status::ok) {
    return usable;
  }
  if (!std::isfinite(t)) {
    return Status::non_finite_input;
  }
  if (points == nullptr && nets.count > 0) {
    return Status::null_output;
  }
  const IsoTask<S> task(nets, direction, t);
  std::size_t bytes = 0;
  if (!count_bytes(task, nets.count, bytes)) {
    return Status::size_overflow;
  }
  if (nets.count == 0) {
    return Status::ok;
  }
  const Status apart = check_apart(nets, MemoryRange{points, bytes});
  return apart == Status::ok ? form(task, points, threads).status : apart;
}

/// Nets of one shape, the results of all of which go to one set.
template <typename T, typename S>
PackReport iso_set(std::span<const IsoTask<S>> tasks, std::size_t count, CurveSet<T>& curves,
                   const PackOptions& options) {
  const IsoTask<S>& first = tasks.front();
  std::size_t bytes = 0;
  if (!count_bytes(first, count, bytes)) {
    return {Status::size_overflow};
  }
  const std::unique_ptr<double[]> points(new (std::nothrow) double[bytes / sizeof(double)]);
  if (points == nullptr) {
    return {Status::out_of_memory};
  }
  for (const IsoTask<S>& task : tasks) {
    const PackReport report = form(task, points.get(), options.threads);
    if (!report) {
      return report;
    }
  }
  return pack_curves(ControlCurves<double>::packed(points.get(), count, first.curve_degree,
                                                   first.nets.components, first.form),
                     curves, options);
}

template <typename T, typename S>
PackReport iso_of_nets(const ControlNets<S>& nets, Across direction, double t, CurveSet<T>& curves,
                       const PackOptions& options) {
  const Status usable = check_input(nets);
  if (usable != Status::ok) {
    return {usable};
  }
  if (!std::isfinite(t)) {
    return argument_fault(Status::non_finite_input);
  }
  const IsoTask<S> task(nets, direction, t);
  return iso_set<T, S>(std::span(&task, 1), nets.count, curves, options);
}

/// The nets that a set keeps, S as they were given: of one shape, in one form or in both.
template <typename T, typename S>
PackReport iso_of_given(const SetStorage<T>& set, Across direction, double t, CurveSet<T>& curves,
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
  return iso_set<T, S>({tasks, set.buckets.size()}, set.count, curves, options);
}

template <typename T>
PackReport iso_of_set(const PatchSet<T>& patches, Across direction, double t, CurveSet<T>& curves,
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
Status iso_u(const ControlNets<S>& nets, double u0, double* points, int threads) noexcept {
  return detail::iso_points(nets, detail::Across::u, u0, points, threads);
}

template <typename S>
Status iso_v(const ControlNets<S>& nets, double v0, double* points, int threads) noexcept {
  return detail::iso_points(nets, detail::Across::v, v0, points, threads);
}

template <typename T, typename S>
PackReport iso_u(const ControlNets<S>& nets, double u0, CurveSet<T>& curves,
                 const PackOptions& options) noexcept {
  return detail::iso_of_nets(nets, detail::Across::u, u0, curves, options);
}

template <typename T, typename S>
PackReport iso_v(const ControlNets<S>& nets, double v0, CurveSet<T>& curves,
                 const PackOptions& options) noexcept {
  return detail::iso_of_nets(nets, detail::Across::v, v0, curves, options);
}

template <typename T>
PackReport iso_u(const PatchSet<T>& patches, double u0, CurveSet<T>& curves,
                 const PackOptions& options) noexcept {
  return detail::iso_of_set(patches, detail::Across::u, u0, curves, options);
}

template <typename T>
PackReport iso_v(const PatchSet<T>& patches, double v0, CurveSet<T>& curves,
                 const PackOptions& options) noexcept {
  return detail::iso_of_set(patches, detail::Across::v, v0, curves, options);
}

#define SIMDBEZIER_INSTANTIATE_SET(name, T, S)                                                     \
  template SIMDBEZIER_API PackReport name(const ControlNets<S>&, double, CurveSet<T>&,             \
                                          const PackOptions&) noexcept;
#define SIMDBEZIER_INSTANTIATE(name, S)                                                            \
  template SIMDBEZIER_API Status name(const ControlNets<S>&, double, double*, int) noexcept;       \
  template SIMDBEZIER_API PackReport name(const PatchSet<S>&, double, CurveSet<S>&,                \
                                          const PackOptions&) noexcept;                            \
  SIMDBEZIER_INSTANTIATE_SET(name, float, S)                                                       \
  SIMDBEZIER_INSTANTIATE_SET(name, double, S)
SIMDBEZIER_INSTANTIATE(iso_u, float)
SIMDBEZIER_INSTANTIATE(iso_u, double)
SIMDBEZIER_INSTANTIATE(iso_v, float)
SIMDBEZIER_INSTANTIATE(iso_v, double)
#undef SIMDBEZIER_INSTANTIATE
#undef SIMDBEZIER_INSTANTIATE_SET

} // namespace simdbezier
