// From a spline of a file to its patches.
#include <tools/formats/file_spline.hpp>

#include <algorithm>
#include <cmath>

#include <tools/formats/patch_file.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

/// Says what is wrong with one direction where something is.
class DirectionCheck {
public:
  DirectionCheck(const std::string& file, std::size_t line, const SplineDirection& direction,
                 const char* name)
      : file_(file), line_(line), direction_(direction), name_(name) {}

  void run() const {
    const auto order = static_cast<std::size_t>(direction_.degree) + 1;
    const std::vector<double>& knots = direction_.knots;
    const std::size_t least = order - (direction_.periodic ? 1 : 0);
    if (direction_.points < least) {
      fail(quantity(least, "point", "points") + " or more in ", std::to_string(direction_.points));
    }
    const std::size_t expected = direction_.points + (direction_.periodic ? 1 : order);
    if (knots.size() != expected) {
      fail(quantity(expected, "knot", "knots") + " in ", std::to_string(knots.size()));
    }
    std::size_t equal = 0;
    for (std::size_t k = 0; k < knots.size(); ++k) {
      if (k > 0 && knots[k] < knots[k - 1]) {
        fail("ascending knots in ", shortest(knots[k]) + " behind " + shortest(knots[k - 1]));
      }
      equal = k > 0 && knots[k] == knots[k - 1] ? equal + 1 : 1;
      if (equal > order) {
        fail("every knot at most " + std::to_string(order) + " times in ",
             shortest(knots[k]) + " once more");
      }
    }
    check_range(knots[direction_.periodic ? 0 : order - 1], knots[direction_.points]);
  }

private:
  void check_range(double begin, double end) const {
    const Interval& range = direction_.range;
    if (!(begin < end)) {
      fail("a domain from one knot to a larger one in ", shortest(begin) + " to " + shortest(end));
    }
    if (!range.empty() && !(begin <= range.begin && range.begin < range.end && range.end <= end)) {
      fail("a range inside of " + shortest(begin) + " to " + shortest(end) + " in ",
           shortest(range.begin) + " to " + shortest(range.end));
    }
  }
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
    bad_input_at(file_, line_, expected + name_, found);
  }

  const std::string& file_;
  std::size_t line_;
  const SplineDirection& direction_;
  const char* name_;
};

SplineSurface<double> view_of(const FileSpline& spline) {
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
  surface.memory = spline.points;
  return surface;
}

} // namespace

void PatchFile::close_spline(const FileSpline& spline) {
  DirectionCheck(name, spline.line, spline.u, "u").run();
  DirectionCheck(name, spline.line, spline.v, "v").run();
  const SplineSurface<double> surface = view_of(spline);
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
  const SplineReport report = to_bezier(surface, nets);
  if (report.status == Status::non_finite_input || report.status == Status::bad_weight) {
    bad_input_at(name, spline.line, "finite coordinates and weights above 0", "others");
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
