#include "bench/subjects/reference_sample.hpp"

#include <cmath>
#include <cstddef>

namespace simdbezier_bench {
namespace {

constexpr int kMostDegree = 15;

/// The Bernstein polynomials of a degree and their first two derivatives at t. From one degree to
/// the next, B_i = (1-t) B_i + t B_(i-1); the derivatives come from the two degrees before,
/// B_i' = n (B_(i-1) - B_i).
struct Basis {
  double value[kMostDegree + 1] = {1};
  double slope[kMostDegree + 1] = {};
  double curvature[kMostDegree + 1] = {};

  Basis(int degree, double t) {
    for (int n = 1; n <= degree; ++n) {
      for (int i = n; i >= 0; --i) {
        const double left = i > 0 ? value[i - 1] : 0;
        const double slope_left = i > 0 ? slope[i - 1] : 0;
        const double here = i < n ? value[i] : 0;
        const double slope_here = i < n ? slope[i] : 0;
        curvature[i] = n * (slope_left - slope_here);
        slope[i] = n * (left - here);
        value[i] = (1 - t) * here + t * left;
      }
    }
  }
};

/// The sums that S, S_u, S_v, S_uu, S_uv and S_vv are made of, in this order.
struct Sums {
  double of[6][4] = {}; ///< w x, w y, w z, w
};

template <typename T>
Sums bernstein_sums(const T* net, BatchShape shape, double u, double v) {
  const Basis bu(shape.degree_u, u);
  const Basis bv(shape.degree_v, v);
  Sums sums;
  for (int j = 0; j <= shape.degree_v; ++j) {
    for (int i = 0; i <= shape.degree_u; ++i) {
      const double w = shape.rational ? static_cast<double>(net[3]) : 1;
      const double products[6] = {bu.value[i] * bv.value[j], bu.slope[i] * bv.value[j],
                                  bu.value[i] * bv.slope[j], bu.curvature[i] * bv.value[j],
                                  bu.slope[i] * bv.slope[j], bu.value[i] * bv.curvature[j]};
      for (int k = 0; k < 6; ++k) {
        for (int c = 0; c < 3; ++c) {
          sums.of[k][c] += products[k] * w * static_cast<double>(net[c]);
        }
        sums.of[k][3] += products[k] * w;
      }
      net += values_per_point(shape);
    }
  }
  return sums;
}

/// w S = h, differentiated: w S_u = h_u - w_u S, w S_uv = h_uv - w_u S_v - w_v S_u - w_uv S, …
void quotients(const Sums& h, Sample& s) {
  const auto weight = [&h](int k) { return h.of[k][3]; };
  for (int c = 0; c < 3; ++c) {
    const double w = weight(0);
    const double p = h.of[0][c] / w;
    const double pu = (h.of[1][c] - weight(1) * p) / w;
    const double pv = (h.of[2][c] - weight(2) * p) / w;
    s.position[c] = p;
    s.du[c] = pu;
    s.dv[c] = pv;
    s.duu[c] = (h.of[3][c] - 2 * weight(1) * pu - weight(3) * p) / w;
    s.duv[c] = (h.of[4][c] - weight(1) * pv - weight(2) * pu - weight(4) * p) / w;
    s.dvv[c] = (h.of[5][c] - 2 * weight(2) * pv - weight(5) * p) / w;
  }
}

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void normal_and_curvatures(Sample& s) {
  const double n[3] = {s.du[1] * s.dv[2] - s.du[2] * s.dv[1], s.du[2] * s.dv[0] - s.du[0] * s.dv[2],
                       s.du[0] * s.dv[1] - s.du[1] * s.dv[0]};
  const double length = std::sqrt(dot(n, n));
  for (int c = 0; c < 3; ++c) {
    s.normal[c] = n[c] / length;
  }
  const double first[3] = {dot(s.du, s.du), dot(s.du, s.dv), dot(s.dv, s.dv)}; // E, F, G
  const double second[3] = {dot(s.normal, s.duu), dot(s.normal, s.duv), dot(s.normal, s.dvv)};
  const double area = dot(n, n); // EG - F^2
  s.gaussian = (second[0] * second[2] - second[1] * second[1]) / area;
  s.mean = (first[0] * second[2] - 2 * first[1] * second[1] + first[2] * second[0]) / (2 * area);
}

} // namespace

template <typename T>
Sample reference_sample(const T* net, BatchShape shape, double u, double v) {
  Sample sample;
  quotients(bernstein_sums(net, shape, u, v), sample);
  normal_and_curvatures(sample);
  return sample;
}

template Sample reference_sample<float>(const float*, BatchShape, double, double);
template Sample reference_sample<double>(const double*, BatchShape, double, double);

} // namespace simdbezier_bench
