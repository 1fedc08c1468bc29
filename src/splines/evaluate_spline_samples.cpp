// Single samples in the parameters of spline surfaces and curves.
#include <simdbezier/splines.hpp>

#include <vector>

#include "src/splines/spline_grid_work.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Where samples lie, on patches from `first_patch` of a set on. Curves have no direction v.
struct SamplePlaces {
  std::vector<std::uint32_t> patch;
  std::vector<double> centred[2];
  std::vector<double> length[2];

  SamplePlaces(std::size_t samples, int directions) : patch(samples) {
    for (int d = 0; d < directions; ++d) {
      centred[d].resize(samples);
      length[d].resize(samples);
    }
  }
  [[nodiscard]] SplinePlaces view() noexcept {
    SplinePlaces places{patch.data(), nullptr, nullptr, length[0].data(), length[1].data()};
    places.centred_u = centred[0].data();
    places.centred_v = centred[1].data();
    return places;
  }
  /// Numbers of patches become those of a set; false where it does not have all of the spline's.
  [[nodiscard]] bool move_to(std::size_t first_patch, std::size_t patches, std::size_t set_size) {
    for (std::uint32_t& number : patch) {
      number += static_cast<std::uint32_t>(first_patch);
    }
    return set_size >= first_patch && set_size - first_patch >= patches;
  }
  /// The parameters of a direction in T.
  template <typename T>
  [[nodiscard]] std::vector<T> parameters(int direction) const {
    return {centred[direction].begin(), centred[direction].end()};
  }
};

/// Divides derivatives of one kind by divisor(sample).
template <typename T, typename Divisor>
void divide(const Vectors<T>& vectors, std::size_t samples, const Divisor& divisor) noexcept {
  for (T* const component : {vectors.x, vectors.y, vectors.z}) {
    for (std::size_t k = 0; component != nullptr && k < samples; ++k) {
      component[static_cast<std::ptrdiff_t>(k) * vectors.stride] /= static_cast<T>(divisor(k));
    }
  }
}

template <typename T, typename S>
Report evaluate_surface(const PatchSet<T>& set, const SplineSurface<S>& surface,
                        std::span<const double> U, std::span<const double> V, const Outputs<T>& out,
                        const Options& options, std::size_t first_patch) {
  if (U.size() != V.size()) {
    return {Status::unequal_lengths};
  }
  SamplePlaces places(U.size(), 2);
  const Report located = locate(surface, U.size(), U.data(), V.data(), places.view());
  if (!located) {
    return located;
  }
  if (!places.move_to(first_patch, spans_of(surface).patches(), set.size())) {
    return {Status::bad_patch_range};
  }
  const std::vector<T> x = places.parameters<T>(0);
  const std::vector<T> y = places.parameters<T>(1);
  const Samples<T> samples{places.patch, x, y, Parameters::centred};
  const Status status = evaluate(set, samples, out, options);
  for (std::size_t g = 0; status == Status::ok && g < kVectorOutputs; ++g) {
    const Orders orders = orders_of(g);
    if (orders.u + orders.v > 0) {
      divide(out[static_cast<Output>(g)], U.size(), [&](std::size_t k) {
        return derivative_divisor(orders.u, orders.v, places.length[0][k], places.length[1][k]);
      });
    }
  }
  return {status};
}

template <typename T, typename S>
Report evaluate_curve(const CurveSet<T>& set, const SplineCurve<S>& curve,
                      std::span<const double> t, const CurveOutputs<T>& out, const Options& options,
                      std::size_t first_curve) {
  SamplePlaces places(t.size(), 1);
  if (const Report located = locate(curve, t.size(), t.data(), places.view()); !located) {
    return located;
  }
  if (!places.move_to(first_curve, spans_of(as_surface(curve)).patches(), set.size())) {
    return {Status::bad_patch_range};
  }
  const std::vector<T> x = places.parameters<T>(0);
  const CurveSamples<T> samples{places.patch, x, Parameters::centred};
  const Status status = evaluate(set, samples, out, options);
  if (status == Status::ok) {
    const std::vector<double>& length = places.length[0];
    divide(out.d1, t.size(), [&](std::size_t k) { return length[k]; });
    divide(out.d2, t.size(), [&](std::size_t k) { return length[k] * length[k]; });
  }
  return {status};
}

} // namespace
} // namespace detail

template <typename T, typename S>
Report evaluate_samples(const PatchSet<T>& set, const SplineSurface<S>& surface,
                        std::span<const double> U, std::span<const double> V,
                        const std::type_identity_t<Outputs<T>>& out, const Options& options,
                        std::size_t first_patch) noexcept {
  return detail::guarded([&] {
    return detail::evaluate_surface<T, S>(set, surface, U, V, out, options, first_patch);
  });
}

template <typename T, typename S>
Report evaluate_samples(const CurveSet<T>& set, const SplineCurve<S>& curve,
                        std::span<const double> t, const std::type_identity_t<CurveOutputs<T>>& out,
                        const Options& options, std::size_t first_curve) noexcept {
  return detail::guarded(
      [&] { return detail::evaluate_curve<T, S>(set, curve, t, out, options, first_curve); });
}

#define SIMDBEZIER_INSTANTIATE(T, S)                                                               \
  template SIMDBEZIER_API Report evaluate_samples(                                                 \
      const PatchSet<T>&, const SplineSurface<S>&, std::span<const double>,                        \
      std::span<const double>, const std::type_identity_t<Outputs<T>>&, const Options&,            \
      std::size_t) noexcept;                                                                       \
  template SIMDBEZIER_API Report evaluate_samples(                                                 \
      const CurveSet<T>&, const SplineCurve<S>&, std::span<const double>,                          \
      const std::type_identity_t<CurveOutputs<T>>&, const Options&, std::size_t) noexcept;
SIMDBEZIER_INSTANTIATE(float, float)
SIMDBEZIER_INSTANTIATE(float, double)
SIMDBEZIER_INSTANTIATE(double, float)
SIMDBEZIER_INSTANTIATE(double, double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
