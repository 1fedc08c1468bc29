// Curvatures of the exact surface, and how far errors of its derivatives can move them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests {

/// Gaussian, mean, and the two principal curvatures, the smaller first.
inline constexpr std::size_t kCurvatureCount = 4;
using OracleCurvatures = std::array<DoubleDouble, kCurvatureCount>;

/// From the fundamental forms (do Carmo 3.3), L, M and N kept |du x dv| times as large:
/// K = (LN - M^2) / |N|^4, H = (EN - 2FM + GL) / (2 |N|^3), k = H -/+ sqrt(H^2 - K).
/// All nan where du x dv is zero.
[[nodiscard]] inline OracleCurvatures oracle_curvatures(const OracleSample& s) {
  const Vector3dd normal = cross(s.du, s.dv);
  const DoubleDouble area = dot(normal, normal);
  const DoubleDouble l = dot(s.duu, normal);
  const DoubleDouble m = dot(s.duv, normal);
  const DoubleDouble n = dot(s.dvv, normal);
  const DoubleDouble gaussian = (l * n - m * m) / (area * area);
  const DoubleDouble twice = dot(s.du, s.du) * n - dot(s.du, s.dv) * m * 2.0 + dot(s.dv, s.dv) * l;
  const DoubleDouble mean = twice / (area * sqrt(area) * 2.0);
  const DoubleDouble spread = sqrt(mean * mean - gaussian); // 0 at umbilics
  return {gaussian, mean, mean - spread, mean + spread};
}

/// Absolute bounds on the errors of a sample's derivatives.
struct DerivativeErrors {
  Vector3 du{};
  Vector3 dv{};
  Vector3 duu{};
  Vector3 duv{};
  Vector3 dvv{};
};

namespace detail {

/// |change of the curvatures| where one value of the sample moves by `error` either way.
[[nodiscard]] inline std::array<double, 2>
change(const OracleSample& sample, Vector3dd OracleSample::*member, std::size_t c, double error) {
  const OracleCurvatures before = oracle_curvatures(sample);
  std::array<double, 2> largest{};
  for (const double step : {error, -error}) {
    OracleSample moved = sample;
    (moved.*member)[c] = (moved.*member)[c] + DoubleDouble(step);
    const OracleCurvatures after = oracle_curvatures(moved);
    for (std::size_t k = 0; k < 2; ++k) {
      largest[k] = std::max(largest[k], std::abs((after[k] - before[k]).to_double()));
    }
  }
  return largest;
}

} // namespace detail

/// Bounds on the errors of computed curvatures: each derivative moved by its own error, the changes
/// added up, and `roundings` more of the size of the terms. First order, so only good where the
/// errors are small against |du x dv|; infinite where they are not.
[[nodiscard]] inline std::array<double, kCurvatureCount>
curvature_errors(const OracleSample& s, const DerivativeErrors& errors, double roundings) {
  std::array<double, 2> total{};
  const auto add = [&](Vector3dd OracleSample::*member, const Vector3& bound) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto moved = detail::change(s, member, c, bound[c]);
      total[0] += moved[0];
      total[1] += moved[1];
    }
  };
  add(&OracleSample::du, errors.du);
  add(&OracleSample::dv, errors.dv);
  add(&OracleSample::duu, errors.duu);
  add(&OracleSample::duv, errors.duv);
  add(&OracleSample::dvv, errors.dvv);
  // The sizes of the terms, as if nothing cancelled.
  const double u = length(s.du).to_double();
  const double v = length(s.dv).to_double();
  const double area = length(cross(s.du, s.dv)).to_double();
  const double l = length(s.duu).to_double() * u * v;
  const double m = length(s.duv).to_double() * u * v;
  const double n = length(s.dvv).to_double() * u * v;
  const double area3 = area * area * area;
  const OracleCurvatures exact = oracle_curvatures(s);
  total[0] += roundings *
              ((l * n + m * m) / (area3 * area) + (l * n + m * m) * u * v / (area3 * area * area));
  total[1] += roundings * (u * u * n + 2 * u * v * m + v * v * l) / area3 * (1 + u * v / area);
  // k = H -/+ sqrt(D): an error d of D moves its root by at most sqrt(d), and by d / sqrt(D).
  const double h = std::abs(exact[1].to_double());
  const double d = total[0] + (2 * h + total[1]) * total[1] +
                   roundings * (h * h + std::abs(exact[0].to_double()));
  const double root = ((exact[3] - exact[2]) * 0.5).to_double();
  const double moved =
      total[1] + (root * root > d ? d / root : std::sqrt(d)) + roundings * (h + root);
  return {total[0], total[1], moved, moved};
}

} // namespace simdbezier::tests
