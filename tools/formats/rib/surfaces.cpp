#include <tools/formats/rib/surfaces.hpp>

#include <optional>
#include <utility>
#include <vector>

#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

constexpr const char* kPoints = "\"P\" or \"Pw\" of the patch";

// Points of which patches are means need not be looked at once more when they have become patches.
bool has_means(const RibBasis& basis) { return !basis.matrix || basis.matrix->has_means(); }

} // namespace

RibShape RibSurfaces::read(const RibState& state) {
  RibShape shape;
  shape.line = tokens_.line();
  shape.map = state.map;
  shape.is_inside = state.is_inside;
  if (tokens_.at_word("NuPatch")) {
    shape.u.spline = spline_direction("u");
    shape.v.spline = spline_direction("v");
    check_trim(state, shape);
  } else {
    patch(state, tokens_.at_word("PatchMesh"), shape);
  }
  parameters(shape);
  return shape;
}

/// Reads what stands in front of the parameters of Patch and PatchMesh.
void RibSurfaces::patch(const RibState& state, bool is_mesh, RibShape& shape) {
  tokens_.next();
  const bool bicubic = tokens_.text() == "bicubic";
  if (!tokens_.at(TokenKind::string) || !(bicubic || tokens_.text() == "bilinear")) {
    tokens_.fail("\"bicubic\" or \"bilinear\"");
  }
  if (bicubic) {
    for (const RibBasis* const basis : {&state.bases.u, &state.bases.v}) {
      if (!basis->is_known()) {
        bad_input_at(tokens_.name(), shape.line, "a patch in a basis of RIB or a matrix",
                     "one in " + in_quotes(basis->name));
      }
    }
    shape.u.basis = state.bases.u;
    shape.v.basis = state.bases.v;
  }
  shape.degree = bicubic ? 3 : 1;
  const std::size_t order = bicubic ? 4 : 2;
  shape.u.mesh =
      is_mesh ? direction(shape.degree, shape.u.basis, "u") : MeshDirection{order, order, 1};
  shape.v.mesh =
      is_mesh ? direction(shape.degree, shape.v.basis, "v") : MeshDirection{order, order, 1};
}

MeshDirection RibSurfaces::direction(int degree, const RibBasis& basis, const std::string& name) {
  const std::size_t step = degree == 3 ? basis.step : 1;
  const auto order = static_cast<std::size_t>(degree) + 1;
  const std::size_t points = tokens_.next_count("the number of points in " + name, 2);
  const std::string found = std::to_string(points);
  const std::size_t line = tokens_.line();
  tokens_.next();
  const bool periodic = tokens_.text() == "periodic";
  if (!tokens_.at(TokenKind::string) || !(periodic || tokens_.text() == "nonperiodic")) {
    tokens_.fail("\"periodic\" or \"nonperiodic\"");
  }
  const std::string each = std::to_string(step);
  if (periodic ? points % step != 0 : points < order || (points - order) % step != 0) {
    bad_input_at(tokens_.name(), line,
                 periodic ? "a multiple of " + each + " points in periodic " + name
                          : std::to_string(order) + " points in " + name + " and " + each +
                                " more a patch",
                 found);
  }
  return {points, step, periodic ? points / step : (points - order) / step + 1};
}

SplineDirection RibSurfaces::spline_direction(const std::string& name) {
  const std::size_t points = tokens_.next_count("the number of points in " + name, 2);
  const std::size_t line = tokens_.line();
  const std::size_t order = tokens_.next_count("the order in " + name, 2, kMostDegree + 1);
  const std::string fit = "of order " + std::to_string(order) + " in " + name;
  if (points < order) {
    bad_input_at(tokens_.name(), line, std::to_string(order) + " points or more " + fit,
                 std::to_string(points));
  }
  SplineDirection direction{static_cast<int>(order) - 1, points, {}, {}, false};
  direction.knots = tokens_.numbers_of("a knot in " + name);
  if (direction.knots.size() != points + order) {
    tokens_.fail(std::to_string(points + order) + " knots for " + std::to_string(points) +
                     " points " + fit,
                 std::to_string(direction.knots.size()));
  }
  direction.range.begin = tokens_.next().number();
  direction.range.end = tokens_.next().number();
  if (!(direction.range.begin < direction.range.end)) {
    tokens_.fail("a largest parameter in " + name + " above " + shortest(direction.range.begin));
  }
  return direction;
}

void RibSurfaces::check_trim(const RibState& state, RibShape& shape) const {
  if (!state.trim ||
      (state.keeps_what_trims_enclose &&
       state.trim->rectangle == RibRectangle{shape.u.spline->range, shape.v.spline->range})) {
    return;
  }
  if (!ignore_trims_) {
    bad_input_at(tokens_.name(), state.trim->line,
                 "no part of the NuPatch in line " + std::to_string(shape.line) +
                     " (--ignore-trims reads all of it)",
                 "'TrimCurve'");
  }
  shape.is_widened = true;
}

/// Reads the parameter list. What follows a list has to be a request: anything else belongs to a
/// list that is not as it should be.
void RibSurfaces::parameters(RibShape& shape) {
  std::optional<Weights> weights;
  for (tokens_.next(); tokens_.at(TokenKind::string); tokens_.next()) {
    const std::string name = tokens_.parameter_name();
    if (name == "P" || name == "Pw" || name == "Pz") {
      if (weights || name == "Pz") {
        tokens_.fail(weights ? "one of \"P\" and \"Pw\"" : kPoints);
      }
      shape.weights = name == "Pw" ? Weights::homogeneous : Weights::none;
      weights = shape.weights;
      read_points(shape, has_means(shape.u.basis) && has_means(shape.v.basis));
    } else {
      tokens_.pass_over_value(name);
    }
  }
  if (!weights) {
    tokens_.fail(kPoints);
  }
  if (!tokens_.at(TokenKind::end) && (!tokens_.at(TokenKind::word) || tokens_.at_number())) {
    tokens_.fail("a parameter's name or a request behind the patch");
  }
}

void RibSurfaces::read_points(const RibShape& shape, bool has_means) {
  const std::size_t values = shape.weights == Weights::none ? 3 : 4;
  const Count count = shape.is_spline() ? Count(shape.u.spline->points) * shape.v.spline->points
                                        : Count(shape.u.mesh.points) * shape.v.mesh.points;
  const std::size_t all = tokens_.counted(count * values, "coordinates");
  const std::string what =
      std::to_string(all / values) + " points of " + std::to_string(values) + " numbers";
  if (!tokens_.next().at(TokenKind::open)) {
    tokens_.fail("'[' and " + std::to_string(all / values) + " points");
  }
  for (std::size_t k = 0; k < all; ++k) {
    tokens_.next();
    if (tokens_.at(TokenKind::close) || tokens_.at(TokenKind::end)) {
      tokens_.fail(what, tokens_.described() + " after " + quantity(k, "number", "numbers"));
    }
    if (k % values == 0) {
      file_.add_line(tokens_.line());
    }
    const bool is_weight = has_means && k % values == 3;
    file_.points.push_back(is_weight ? tokens_.weight() : tokens_.number());
    if (is_weight) {
      file_.check_quotients();
    }
  }
  tokens_.expect_close(what);
}

} // namespace simdbezier::tools
