#include <tools/formats/obj/trims.hpp>

#include <algorithm>
#include <utility>

#include <tools/formats/obj/statements.hpp>
#include <tools/formats/surfaces/cartesian_points.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

std::uint32_t obj_index(const Lexer& lexer, std::size_t count, const char* what) {
  const auto reference = parse_obj_reference(lexer.text());
  if (!reference || reference->number > count) {
    const std::string most = std::to_string(count);
    lexer.fail(std::string("the number of a ") + what +
               (count == 0 ? " before it" : ", 1 to " + most + " or -1 to -" + most));
  }
  return static_cast<std::uint32_t>(reference->from_end ? count - reference->number
                                                        : reference->number - 1);
}

void ObjCurves::read_point(Lexer& lexer) {
  std::array<double, 3> point = {0, 0, 1};
  std::size_t count = 0;
  for (lexer.next(); !ends_statement(lexer); lexer.next(), ++count) {
    const double number = lexer.number();
    if (count == point.size()) {
      lexer.fail("up to three numbers u v w");
    }
    point[count] = number;
  }
  points_.push_back(point);
}

void ObjCurves::begin_curve(Lexer& lexer, const ObjState& state) {
  curve_ = Curve{state.type(), static_cast<std::size_t>(state.curve_degree()), {}, {}};
  parameters_.clear();
  bool known = state.curve_degree() > 0;
  for (lexer.next(); !ends_statement(lexer); lexer.next()) {
    const auto& point = points_.at(obj_index(lexer, points_.size(), "point (vp)"));
    curve_->points.push_back({point[0], point[1]});
    known = known && (!state.rational() || point[2] > 0);
  }
  if (!known) {
    curve_->points.clear();
  }
}

// The ends of Bézier curves are control points, and so are those of B-splines where the knots there
// occur as often as they can.
void ObjCurves::end_curve() {
  Curve& curve = *curve_;
  const std::size_t points = curve.points.size();
  const std::size_t order = curve.degree + 1;
  const bool has_knots = curve.type == ObjType::bspline;
  bool known = points >= order && parameters_.size() >= 2;
  if (known && has_knots) {
    known = parameters_.size() == points + order && parameters_[0] == parameters_[order - 1] &&
            parameters_[points] == parameters_.back();
  } else if (known) {
    known = curve.type == ObjType::bezier && (parameters_.size() - 1) * curve.degree + 1 == points;
  }
  if (known) {
    curve.range = {parameters_.front(), parameters_.back()};
  } else {
    curve.points.clear();
  }
  curves_.push_back(std::move(curve));
  curve_.reset();
}

void ObjCurves::read_trim(Lexer& lexer, ObjTrims& trims) const {
  const bool is_first = trims.line == 0;
  if (is_first) {
    trims.line = lexer.line();
    trims.keyword = lexer.text();
  }
  trims.known = is_first && lexer.at_word("trim");
  for (lexer.next(); !ends_statement(lexer); lexer.next()) {
    const double begin = lexer.number();
    const double end = lexer.next().number();
    const Curve& curve = curves_.at(obj_index(lexer.next(), curves_.size(), "curve (curv2)"));
    if (curve.points.empty() || curve.range != Interval{begin, end}) {
      trims.known = false;
    } else if (trims.known) { // so that curves are not copied again and again
      trims.boundary.append(curve.points, curve.degree > 1);
    }
  }
}

namespace {

/// Leaves the part of a surface that its trimming curves leave, if it is a rectangle.
bool leave_rectangle(ObjSurface& surface, const ObjTrims& trims) {
  const auto rectangle = trims.known ? trims.boundary.rectangle() : std::nullopt;
  Interval u = surface.u.range;
  Interval v = surface.v.range;
  if (!rectangle || !narrow(u, v, *rectangle)) {
    return false;
  }
  if (surface.u.basis && (u != surface.u.range || v != surface.v.range)) {
    return false; // these have no parts
  }
  surface.u.range = u;
  surface.v.range = v;
  return true;
}

void check_weights(const PatchFile& file, const ObjSurface& surface) {
  for (const std::uint32_t vertex : surface.vertices) {
    const double* const point = file.points.data() + std::size_t{4} * vertex;
    check_cartesian_point(file.name, file.lines[vertex], std::span<const double, 4>(point, 4));
  }
}

/// Checks that the parameters are there, and that the range is a part of them.
void check_direction(const Lexer& lexer, const ObjSurface& surface, ObjDirection& direction,
                     const std::string& name) {
  const std::vector<double>& parameters = direction.parameters;
  if (parameters.empty()) {
    lexer.fail("parm " + name + " before the end of the surface in line " +
               std::to_string(surface.line));
  }
  Interval domain = {parameters.front(), parameters.back()};
  if (surface.type == ObjType::bspline) {
    domain = range_of(direction.spline(surface.type));
  }
  const auto part = part_of_domain(domain, direction.range);
  const bool has_parts = !direction.basis;
  if (!part || (!has_parts && *part != domain)) {
    bad_input_at(lexer.name(), surface.line,
                 std::string(has_parts ? "a range within " : "the whole range ") +
                     shortest(domain.begin) + " " + shortest(domain.end) + " of parm " + name,
                 shortest(direction.range.begin) + " " + shortest(direction.range.end));
  }
  direction.range = *part;
}

} // namespace

void finish_obj_surface(const Lexer& lexer, PatchFile& file, ObjSurface& surface,
                        const ObjTrims& trims, bool ignore_trims) {
  check_direction(lexer, surface, surface.u, "u");
  check_direction(lexer, surface, surface.v, "v");
  const Count points_u = surface.u.points(surface.type);
  const Count points_v = surface.v.points(surface.type);
  const Count expected = points_u * points_v;
  if (expected.value() != surface.vertices.size()) {
    bad_input_at(lexer.name(), surface.line,
                 to_string(expected) + " points (" + to_string(points_u) + " x " +
                     to_string(points_v) + ")",
                 std::to_string(surface.vertices.size()));
  }
  if (surface.rational && !surface.u.basis) {
    check_weights(file, surface);
  }
  if (trims.line > 0 && !leave_rectangle(surface, trims)) {
    if (!ignore_trims) {
      bad_input_at(lexer.name(), trims.line,
                   "a surface without trimming curves (--ignore-trims reads all of it)",
                   in_quotes(trims.keyword));
    }
    ++file.ignored_trims;
  }
}

} // namespace simdbezier::tools
