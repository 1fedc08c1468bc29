// From a spline of a file to its patches.
#include <tools/formats/surfaces/file_spline.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tools/formats/patch_file.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

/// What is expected of a direction that the library refuses, and what is found.
std::pair<std::string, std::string> complaint(const SplineDirection& direction, double tolerance,
                                              const Report& report) {
  const std::vector<double>& knots = direction.knots;
  const auto order = static_cast<std::size_t>(direction.degree) + 1;
  if (report.status == Status::bad_grid) {
    return {quantity(order - (direction.periodic ? 1 : 0), "point", "points") + " or more",
            std::to_string(direction.points)};
  }
  const std::size_t count = direction.points + (direction.periodic ? 1 : order);
  if (knots.size() != count) {
    return {quantity(count, "knot", "knots"), std::to_string(knots.size())};
  }
  const double begin = knots[direction.periodic ? 0 : order - 1];
  const double end = knots[direction.points];
  if (report.status == Status::bad_range) {
    return {"a range inside of " + shortest(begin) + " to " + shortest(end),
            shortest(direction.range.begin) + " to " + shortest(direction.range.end)};
  }
  const auto at = static_cast<std::size_t>(report.point);
  const double knot = knots[at];
  if (std::fabs(knot) > 0x1p1000) {
    return {"knots of 2^1000 at most", shortest(knot)};
  }
  if (at > 0 && knot < knots[at - 1]) {
    return {"ascending knots", shortest(knot) + " behind " + shortest(knots[at - 1])};
  }
  if (!(begin < end)) {
    return {"a domain from one knot to a larger one", shortest(begin) + " to " + shortest(end)};
  }
  return {"every knot at most " + std::to_string(order) + " times",
          shortest(knot) + " once more" +
              (tolerance > 0 ? ", with those within --knot-tolerance" : "")};
}

/// Refuses knots that the library refuses, and none, which it would take for uniform ones.
void require_knots(const std::string& file, const FileSpline& spline,
                   const SplineSurface<double>& surface) {
  const bool lacks_u = spline.u.knots.empty();
  const Report report = lacks_u || spline.v.knots.empty()
                            ? Report{Status::bad_knots, 0, 0, lacks_u ? 0 : 1}
                            : locate(surface, 0, nullptr, nullptr, {});
  if (report.status == Status::bad_grid || report.status == Status::bad_knots ||
      report.status == Status::bad_range) {
    const bool is_v = report.component == 1;
    const auto [expected, found] =
        complaint(is_v ? spline.v : spline.u, surface.knot_tolerance, report);
    bad_input_at(file, spline.line, expected + (is_v ? " in v" : " in u"), found);
  }
  check(report.status);
}

SplineSurface<double> view_of(const FileSpline& spline, double knot_tolerance) {
  SplineSurface<double> surface;
  const std::ptrdiff_t channels = spline.weights == Weights::none ? 3 : 4;
  surface.points = spline.points.data();
  surface.rows = spline.v.points;
  surface.columns = spline.u.points;
  surface.row_stride = channels * static_cast<std::ptrdiff_t>(spline.u.points);
  surface.point_stride = channels;
  surface.weights = spline.weights;
  surface.periodic_u = spline.u.periodic;
  surface.periodic_v = spline.v.periodic;
  surface.degree_u = spline.u.degree;
  surface.degree_v = spline.v.degree;
  surface.knots_u = spline.u.knots;
  surface.knots_v = spline.v.knots;
  surface.u_range = spline.u.range;
  surface.v_range = spline.v.range;
  surface.knot_tolerance = knot_tolerance;
  surface.memory = spline.points;
  return surface;
}

} // namespace

void PatchFile::close_spline(const FileSpline& spline) {
  const double tolerance = spline.merges_knots ? knot_tolerance : 0;
  const SplineSurface<double> surface = view_of(spline, tolerance);
  require_knots(name, spline, surface);
  const SpanCounts spans = span_count(surface);
  const bool rational = spline.weights != Weights::none;
  const std::size_t stride = rational ? 4 : 3;
  const std::size_t order_u = static_cast<std::size_t>(spline.u.degree) + 1;
  const std::size_t order_v = static_cast<std::size_t>(spline.v.degree) + 1;
  const std::size_t each = order_u * order_v;
  const std::size_t first = points.size();
  points.resize(first + spans.patches() * each * stride);
  MutableNets<double> nets = MutableNets<double>::packed(
      points.data() + first, spans.patches(), spline.u.degree, spline.v.degree, 3,
      rational ? Weights::homogeneous : Weights::none);
  nets.point_stride = static_cast<std::ptrdiff_t>(stride);
  nets.row_stride = nets.point_stride * static_cast<std::ptrdiff_t>(order_u);
  nets.patch_stride = nets.row_stride * static_cast<std::ptrdiff_t>(order_v);
  const Report report = to_bezier(surface, nets);
  if (report.status == Status::non_finite_input || report.status == Status::bad_weight) {
    bad_input_at(name, spline.line, "finite coordinates and weights above 0", "others");
  }
  if (report.status == Status::coefficient_overflow) {
    bad_input_at(name, spline.line, "coordinates of at most 1e295, also when multiplied by weights",
                 "others");
  }
  check(report.status);
  for (std::size_t k = first; k < points.size(); k += stride) {
    add_line(spline.line);
    const double weight = rational ? points[k + 3] : 1;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!std::isfinite(points[k + c] / weight)) {
        bad_input_at(name, spline.line, "coordinates whose products with weights are finite",
                     shortest(points[k + c]) + " / " + shortest(weight));
      }
    }
  }
  splines.push_back({spline.line, spline.u, spline.v, rational, count, spans});
  SplineRecord& record = splines.back();
  check(merged_knots(surface, record.u.knots, record.v.knots).status);
  merged_splines += record.u.knots != spline.u.knots || record.v.knots != spline.v.knots ? 1 : 0;
  // The patches follow each other like those of a mesh of one column.
  PatchRun run{spline.u.degree, spline.v.degree, nets.weights};
  run.stride = stride;
  run.first_value = first;
  run.first_point = lines.size() - spans.patches() * each;
  run.u = {order_u, order_u, 1};
  run.v = {order_v * spans.patches(), order_v, spans.patches()};
  add(run);
  cut_error = std::max(cut_error, extraction_error(surface));
}

} // namespace simdbezier::tools
