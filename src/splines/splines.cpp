// The calls of splines.hpp that make no sets; src/splines/pack_splines.cpp has the others.
#include <simdbezier/splines.hpp>

#include "src/nets/net_call.hpp"
#include "src/nets/net_places.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/splines/spline_knots.hpp"
#include "src/splines/spline_nets.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// ok | bad_degree | bad_components: whether a spline's pieces can be nets of a view.
template <typename T>
Status check_fits(const SplineSurface<T>& surface, const MutableNets<T>& out) noexcept {
  if (surface.degree_u != out.degree_u || surface.degree_v != out.degree_v) {
    return Status::bad_degree;
  }
  const bool same_weights = (surface.weights == Weights::none) == (out.weights == Weights::none);
  return surface.components == out.components && same_weights ? Status::ok : Status::bad_components;
}

template <typename T>
MemoryRange points_of(const SplineSurface<T>& surface) noexcept {
  Lattice lattice;
  return lattice_of(one_net(surface), lattice) ? lattice.range : MemoryRange();
}

/// The nets of a piece of `list`, in the form of its view.
template <typename T>
Status check_cut(const SplineList<T>& list, const MutableNets<T>& out) noexcept {
  ControlNets<T> like = out;
  like.count = list.patches();
  Status status = check_output(out, like, out.degree_u, out.degree_v);
  for (const PreparedSpline<T>& spline : list.splines()) {
    status = status == Status::ok ? check_apart<T>(out, points_of(spline.surface)) : status;
  }
  return status;
}

/// Writes all nets; `out` is sound.
template <typename T>
Status cut_all(const SplineList<T>& list, const NetView<T>& out,
               const RunOptions& options) noexcept {
  Isa isa = Isa::automatic;
  if (const Status status = resolve_isa(options.isa, isa); !status) {
    return status;
  }
  const MeanKernels& means = separate_table<NetTable<float>>(isa).means;
  const auto work = [&](int, std::size_t begin, std::size_t end, unsigned char* scratch) {
    SplineCutter<T> cutter(list, means, scratch);
    for (std::size_t row = begin; row < end; ++row) {
      NetView<T> to = out;
      to.points += static_cast<std::ptrdiff_t>(list.patch_of(row)) * out.patch_stride;
      cutter.cut(row, to);
    }
    return isa;
  };
  return run_blocks(list.rows(), duration_of(list.patches(), 100), options, list.scratch_bytes(),
                    work);
}

template <typename T>
Report cut_surfaces(std::span<const SplineSurface<T>> surfaces, const MutableNets<T>& out,
                    std::span<PatchInterval> intervals, const RunOptions& options) {
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (const Status status = check_fits(surfaces[k], out); !status) {
      return {status, k};
    }
  }
  SplineList<T> list;
  if (const Report report = list.prepare(surfaces, out.weights); !report) {
    return report;
  }
  if (!intervals.empty() && intervals.size() != list.patches()) {
    return {Status::unequal_lengths};
  }
  if (const Status status = check_cut(list, out); !status) {
    return {status};
  }
  const Status status = cut_all(list, view_of(out), options);
  if (status == Status::ok) {
    list.write_intervals(intervals);
  }
  return {status};
}

template <typename T>
Report cut_curve(const SplineCurve<T>& curve, const Values<T>& points,
                 std::span<Interval> intervals, const RunOptions& options) {
  SplineList<T> list;
  if (const Report report = list.prepare(curve); !report) {
    return report;
  }
  const PreparedSpline<T>& spline = list.splines().front();
  const std::size_t pieces = list.patches();
  const std::size_t values = pieces * spline.u->order() * spline.channels();
  if (!intervals.empty() && intervals.size() != pieces) {
    return {Status::unequal_lengths};
  }
  if (points.first == nullptr) {
    return {Status::null_output};
  }
  if (values > points.capacity) {
    return {Status::output_too_small};
  }
  if (MemoryRange(points.first, values * sizeof(T)).meets(points_of(spline.surface))) {
    return {Status::overlapping_outputs};
  }
  const NetView<T> out = view_of(MutableNets<T>::packed(points.first, pieces, curve.degree, 0,
                                                        curve.components, curve.weights));
  const Status status = cut_all(list, out, options);
  for (std::size_t k = 0; status == Status::ok && k < intervals.size(); ++k) {
    intervals[k] = spline.u->interval(k);
  }
  return {status};
}

} // namespace
} // namespace detail

template <typename T>
Report to_bezier(std::span<const SplineSurface<T>> surfaces,
                 const std::type_identity_t<MutableNets<T>>& out,
                 std::span<PatchInterval> intervals, const RunOptions& options) noexcept {
  if (surfaces.data() == nullptr && !surfaces.empty()) {
    return {Status::null_input};
  }
  return detail::guarded(
      [&] { return detail::cut_surfaces<T>(surfaces, out, intervals, options); });
}

template <typename T>
Report to_bezier(const SplineSurface<T>& surface, const std::type_identity_t<MutableNets<T>>& out,
                 std::span<PatchInterval> intervals, const RunOptions& options) noexcept {
  return to_bezier(std::span<const SplineSurface<T>>(&surface, 1), out, intervals, options);
}

template <typename T>
Report to_bezier(const SplineCurve<T>& curve, const std::type_identity_t<Values<T>>& points,
                 std::span<Interval> intervals, const RunOptions& options) noexcept {
  return detail::guarded([&] { return detail::cut_curve<T>(curve, points, intervals, options); });
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API Report to_bezier(std::span<const SplineSurface<T>>,                      \
                                           const std::type_identity_t<MutableNets<T>>&,            \
                                           std::span<PatchInterval>, const RunOptions&) noexcept;  \
  template SIMDBEZIER_API Report to_bezier(const SplineSurface<T>&,                                \
                                           const std::type_identity_t<MutableNets<T>>&,            \
                                           std::span<PatchInterval>, const RunOptions&) noexcept;  \
  template SIMDBEZIER_API Report to_bezier(const SplineCurve<T>&,                                  \
                                           const std::type_identity_t<Values<T>>&,                 \
                                           std::span<Interval>, const RunOptions&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
