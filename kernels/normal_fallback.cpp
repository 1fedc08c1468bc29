// See normal_fallback.hpp. Everything in double and unvectorised: rare, and equal on all machines.
#include "kernels/normal_fallback.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simdbezier::detail {
namespace {

struct Vector {
  double x = 0;
  double y = 0;
  double z = 0;

  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};

Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double squared_length(Vector a) { return a.x * a.x + a.y * a.y + a.z * a.z; }
double length(Vector a) { return std::sqrt(squared_length(a)); }
double max_norm(Vector a) {
  return std::max(std::fabs(a.x), std::max(std::fabs(a.y), std::fabs(a.z)));
}
template <typename T>
Vector point(const T* control_points, int j, int i) {
  const T* const p = control_points + (j * 4 + i) * 3;
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// 2^-ilogb(size), for a positive finite size.
double inverse_power(double size) { return std::scalbn(1.0, -std::ilogb(size)); }

/// A patch moved to its first control point and scaled by powers of two, so that it is of size
/// about 1 and that each hodograph is, too.
struct Frame {
  Vector net[4][4];
  double scale = 1;  ///< of the net
  double size_u = 0; ///< largest |3 (P[j][i+1] - P[j][i])| of the scaled net
  double size_v = 0;
  double scale_u = 1; ///< 2^-ilogb(size_u)
  double scale_v = 1;

  template <typename T>
  explicit Frame(const T* control_points) {
    double size = 0;
    for (int k = 0; k < 16; ++k) {
      size = std::max(size, max_norm(point(control_points, k / 4, k % 4)));
    }
    if (size == 0) {
      return;
    }
    // Halved once more, so that differences cannot overflow.
    const int exponent = -std::ilogb(size) - 1;
    scale = std::scalbn(1.0, exponent);
    const auto scaled_point = [&](int j, int i) {
      const Vector p = point(control_points, j, i);
      return Vector{std::scalbn(p.x, exponent), std::scalbn(p.y, exponent),
                    std::scalbn(p.z, exponent)};
    };
    const Vector origin = scaled_point(0, 0);
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        net[j][i] = scaled_point(j, i) - origin;
      }
    }
    measure();
  }

private:
  void measure() {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) {
        size_u = std::max(size_u, 3 * max_norm(net[j][i + 1] - net[j][i]));
        size_v = std::max(size_v, 3 * max_norm(net[i + 1][j] - net[i][j]));
      }
    }
    scale_u = size_u > 0 ? inverse_power(size_u) : 1;
    scale_v = size_v > 0 ? inverse_power(size_v) : 1;
  }
};

/// First and second derivatives.
struct Jet {
  Vector u;
  Vector v;
  Vector uu;
  Vector uv;
  Vector vv;
};

/// Bernstein values of degree 3 and their first two derivatives. (1-t, t) = (1/2-X, 1/2+X).
struct Basis {
  double value[4];
  double first[4];
  double second[4];

  explicit Basis(double half_centred) {
    const double t = 0.5 + half_centred;
    const double s = 0.5 - half_centred;
    const double quadratic[3] = {s * s, 2 * s * t, t * t};
    const double linear[2] = {s, t};
    const double cubic[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    for (int i = 0; i < 4; ++i) {
      const double q0 = i > 0 ? quadratic[i - 1] : 0;
      const double q1 = i < 3 ? quadratic[i] : 0;
      const auto l = [&](int k) { return k >= 0 && k < 2 ? linear[k] : 0.0; };
      value[i] = cubic[i];
      first[i] = 3 * (q0 - q1);
      second[i] = 6 * (l(i - 2) - 2 * l(i - 1) + l(i));
    }
  }
};

/// Derivatives scaled so that both hodographs have size 1..2. The first ones are formed from
/// differences of control points: where these are equal, the tangent is exactly zero.
Jet jet(const Frame& frame, double x, double y) {
  const Basis bu(x);
  const Basis bv(y);
  const double quadratic_u[3] = {(0.5 - x) * (0.5 - x), 2 * (0.5 - x) * (0.5 + x),
                                 (0.5 + x) * (0.5 + x)};
  const double quadratic_v[3] = {(0.5 - y) * (0.5 - y), 2 * (0.5 - y) * (0.5 + y),
                                 (0.5 + y) * (0.5 + y)};
  Jet d;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) {
      const double wu = 3 * bv.value[j] * quadratic_u[i];
      const double wv = 3 * bu.value[j] * quadratic_v[i];
      d.u = d.u + (wu * frame.scale_u) * (frame.net[j][i + 1] - frame.net[j][i]);
      d.v = d.v + (wv * frame.scale_v) * (frame.net[i + 1][j] - frame.net[i][j]);
    }
    for (int i = 0; i < 4; ++i) {
      const Vector p = frame.net[j][i];
      d.uu = d.uu + (frame.scale_u * bu.second[i] * bv.value[j]) * p;
      d.uv = d.uv + (bu.first[i] * bv.first[j]) * p;
      d.vv = d.vv + (frame.scale_v * bu.value[i] * bv.second[j]) * p;
    }
  }
  return d;
}

template <typename T>
SampleStatus write(Vector direction, T normal[3], SampleStatus status) {
  const double inverse = 1 / length(direction); // finite, and far from 0: callers saw to it
  normal[0] = static_cast<T>(direction.x * inverse);
  normal[1] = static_cast<T>(direction.y * inverse);
  normal[2] = static_cast<T>(direction.z * inverse);
  return status;
}

/// True where `n` = du x dv is clear of errors of relative size `c` in du and dv. Sizes are those
/// of the scaled frame, where the hodograph bounds lie in [1,2).
bool is_clear(const Frame& frame, Vector du, Vector dv, Vector n, double c) {
  const double su = frame.size_u * frame.scale_u;
  const double sv = frame.size_v * frame.scale_v;
  return std::isfinite(length(n)) && length(n) > c * (su * length(dv) + sv * length(du));
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
  const Frame frame(query.control_points);
  if (frame.size_u == 0 || frame.size_v == 0) {
    return SampleStatus::degenerate;
  }
  const bool inside = std::fabs(x) <= 0.5 && std::fabs(y) <= 0.5;
  if (inside) {
    const double su = frame.scale * frame.scale_u;
    const double sv = frame.scale * frame.scale_v;
    const Vector du = su * Vector{query.du[0], query.du[1], query.du[2]};
    const Vector dv = sv * Vector{query.dv[0], query.dv[1], query.dv[2]};
    const Vector n = cross(du, dv);
    if (is_clear(frame, du, dv, n, kKernelError<T>)) {
      return write(n, normal, SampleStatus::regular);
    }
  }
  const Jet d = jet(frame, x, y);
  const Vector n = cross(d.u, d.v);
  if (!inside) {
    // Hodographs bound nothing out here, and there is no inside to take a limit from.
    const bool clear = std::isfinite(length(n)) && length(n) > 0x1p-20 * length(d.u) * length(d.v);
    return clear ? write(n, normal, SampleStatus::regular) : SampleStatus::degenerate;
  }
  if (is_clear(frame, d.u, d.v, n, kDoubleError)) {
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
  const Jet pulled = jet(frame, x * kPull, y * kPull);
  const Vector near = cross(pulled.u, pulled.v);
  if (length(near) > 0x1p-40) {
    return write(near, normal, SampleStatus::limit);
  }
  return SampleStatus::degenerate;
}

template SampleStatus resolve_normal(const NormalQuery<float>&, float[3]) noexcept;
template SampleStatus resolve_normal(const NormalQuery<double>&, double[3]) noexcept;

} // namespace simdbezier::detail
