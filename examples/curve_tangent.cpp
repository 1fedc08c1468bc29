// A curve with its tangents: the first row of the sample patch, as a batch of one cubic, evaluated
// at nine parameters and compared with de Casteljau's algorithm.
#include <algorithm>
#include <cstdio>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "seed/curve.hpp"
#include "seed/sample_patch.hpp"

using namespace simdbezier;

int main() {
  const std::vector<seed::Point> row = seed::sample_patch().row(0);
  const std::vector<double> points = seed::coordinates<double>(row);

  CurveSet<double> curves;
  const auto polygon = ControlCurves<double>::packed(points.data(), 1, 3);
  if (const Report report = pack(polygon, curves); !report) {
    std::fprintf(stderr, "%s\n", to_string(report.status).data());
    return 1;
  }

  constexpr std::size_t kSamples = 9;
  std::vector<double> position(3 * kSamples);
  std::vector<double> tangent(3 * kSamples);
  std::vector<double> curvature(kSamples);
  CurveOutputs<double> out;
  out.position = Vectors<double>::xyz(position.data());
  out.tangent = Vectors<double>::xyz(tangent.data());
  out.curvature = curvature.data();
  const Status status = evaluate(curves, CurveGrid<double>::uniform(kSamples), out);
  if (status != Status::ok) {
    std::fprintf(stderr, "%s\n", to_string(status).data());
    return 1;
  }

  double worst = 0;
  std::printf("    t   position                   tangent                   curvature\n");
  for (std::size_t k = 0; k < kSamples; ++k) {
    const double t = static_cast<double>(k) / (kSamples - 1);
    const seed::Point p = seed::point_at(position, k);
    const seed::Point direction = seed::point_at(tangent, k);
    std::printf("%.3f  %7.4f %7.4f %7.4f   %7.4f %7.4f %7.4f   %7.4f\n", t, p.x, p.y, p.z,
                direction.x, direction.y, direction.z, curvature[k]);
    const seed::CurvePoint slow = seed::de_casteljau(row, t);
    const seed::Point slow_direction = (1 / seed::length(slow.derivative)) * slow.derivative;
    worst = std::max(
        {worst, seed::distance(p, slow.position), seed::distance(direction, slow_direction)});
  }
  const bool agree = worst < 1e-14;
  std::printf("de Casteljau's algorithm gives the same within 1e-14: %s\n", agree ? "yes" : "no");
  return agree ? 0 : 1;
}
