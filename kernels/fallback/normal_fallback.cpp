// See fallback/normal_fallback.hpp. Everything in double and unvectorised: rare, and equal on all
// machines.
#include "kernels/fallback/normal_fallback.hpp"

#include <cmath>
#include <limits>

#include "kernels/fallback/surface_jet.hpp"

namespace simdbezier::detail {
namespace {

template <typename T>
Vector vector_of(const T from[3]) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

template <typename T>
SampleStatus write(Vector direction, T normal[3], SampleStatus status) {
  const double inverse = 1 / length(direction); // finite, and far from 0: callers saw to it
  normal[0] = static_cast<T>(direction.x * inverse);
  normal[1] = static_cast<T>(direction.y * inverse);
  normal[2] = static_cast<T>(direction.z * inverse);
  return status;
}

/// True where `n` = du x dv is clear of errors of relative size `c` in du and dv, which are scaled
/// as the frame says.
bool is_clear(SurfaceFrame::ErrorSizes sizes, Vector du, Vector dv, Vector n, double c) {
  return std::isfinite(length(n)) && length(n) > c * (sizes.u * length(dv) + sizes.v * length(du));
}

/// A tangent is wrong by k u times its hodograph bound, k <= 18, and 5 at the most in every family
/// that was measured; relative to |N| that turns the normal by k u / c. Hence c = 2^-10 for float:
/// 0.02 degrees at k = 5.
template <typename T>
inline constexpr double kKernelError = sizeof(T) == sizeof(float) ? 0x1p-10 : 0x1p-41;
inline constexpr double kDoubleError = 0x1p-41;

} // namespace

template <typename T>
SampleStatus resolve_normal(const NormalQuery<T>& query, T normal[3]) noexcept {
  const auto x = static_cast<double>(query.x);
  const auto y = static_cast<double>(query.y);
  normal[0] = normal[1] = normal[2] = T(0);
  if (!std::isfinite(x) || !std::isfinite(y)) {
    normal[0] = normal[1] = normal[2] = std::numeric_limits<T>::quiet_NaN();
    return SampleStatus::non_finite;
  }
  const SurfaceFrame frame(*query.shape, query.net);
  if (frame.size_u == 0 || frame.size_v == 0) {
    return SampleStatus::degenerate;
  }
  const bool inside = std::fabs(x) <= 0.5 && std::fabs(y) <= 0.5;
  if (inside) {
    const double su = frame.scale * frame.scale_u;
    const double sv = frame.scale * frame.scale_v;
    const Vector du = su * vector_of(query.du);
    const Vector dv = sv * vector_of(query.dv);
    const Vector n = cross(du, dv);
    const double weight = surface_weight(frame, x, y);
    if (is_clear(frame.kernel_errors(weight), du, dv, n, kKernelError<T>)) {
      return write(n, normal, SampleStatus::regular);
    }
  }
  const SurfaceJet d = surface_jet(frame, x, y);
  const Vector n = cross(d.u, d.v);
  if (!inside) {
    // Hodographs bound nothing out here, and there is no inside to take a limit from.
    const bool clear = std::isfinite(length(n)) && length(n) > 0x1p-20 * length(d.u) * length(d.v);
    return clear ? write(n, normal, SampleStatus::regular) : SampleStatus::degenerate;
  }
  if (is_clear(frame.jet_errors(d.weight), d.u, d.v, n, kDoubleError)) {
    return write(n, normal, SampleStatus::regular);
  }
  // K = d/dt (du x dv) along (a,b) = (-x,-y), the centred parameters: towards the centre.
  const double a = -2 * x;
  const double b = -2 * y;
  const Vector toward_u = (a)*d.uu + (b * frame.scale_u) * d.uv;
  const Vector toward_v = (a * frame.scale_v) * d.uv + (b)*d.vv;
  const Vector limit = n + 0.125 * (cross(d.u, toward_v) - cross(d.v, toward_u));
  if (squared_length(limit) > 0x1p-22) {
    return write(limit, normal, SampleStatus::limit);
  }
  constexpr double kPull = 1 - 0x1p-12;
  const SurfaceJet pulled = surface_jet(frame, x * kPull, y * kPull);
  const Vector near = cross(pulled.u, pulled.v);
  if (length(near) > 0x1p-40) {
    return write(near, normal, SampleStatus::limit);
  }
  return SampleStatus::degenerate;
}

template SampleStatus resolve_normal(const NormalQuery<float>&, float[3]) noexcept;
template SampleStatus resolve_normal(const NormalQuery<double>&, double[3]) noexcept;

} // namespace simdbezier::detail
