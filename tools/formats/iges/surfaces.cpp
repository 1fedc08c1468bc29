#include <tools/formats/iges/surfaces.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tools/formats/iges/kinds.hpp>
#include <tools/formats/iges/parameters.hpp>
#include <tools/formats/surfaces/cartesian_points.hpp>
#include <tools/formats/surfaces/parameter_boundary.hpp>
#include <tools/formats/surfaces/roundings.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/length.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kMostPoints = std::size_t{1} << 31;
constexpr double kSmallest = 0x1p-1066; // more than what underflows in some dozen operations

/// Reads numbers that do not fall; they have to rise where `step` says so.
std::vector<double> ascending(IgesParameters& parameters, std::size_t count, const char* what,
                              bool rise) {
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) {
    const double value = parameters.real(what);
    if (k > 0 && (rise ? value <= values.back() : value < values.back())) {
      parameters.fail(std::string(what) + (rise ? " above " : " of at least ") +
                          shortest(values.back()),
                      shortest(value));
    }
    values.push_back(value);
  }
  return values;
}

/// Reads the part of the knots' domain that the surface has.
Interval range(IgesParameters& parameters, const SplineDirection& direction,
               const std::string& name) {
  const double begin = parameters.real("where the surface begins");
  const double end = parameters.real("where the surface ends");
  const Interval domain = range_of(direction);
  const auto part = part_of_domain(domain, {begin, end});
  if (!part) {
    parameters.fail("a range in " + name + " within that of the knots, " + shortest(domain.begin) +
                        " to " + shortest(domain.end),
                    shortest(begin) + " to " + shortest(end));
  }
  return *part;
}

int degree(IgesParameters& parameters, std::size_t points, const std::string& name) {
  const std::size_t most = std::min<std::size_t>(points - 1, kMostDegree);
  return static_cast<int>(
      parameters.integer("degree 1 to " + std::to_string(most) + " in " + name, 1, most));
}

IgesSurface read_spline_surface(IgesRecords& records, std::size_t entity) {
  IgesParameters parameters(records, entity);
  IgesSurface surface;
  FileSpline& spline = surface.spline;
  const auto points = [&](const char* name) {
    const std::string what = std::string("the largest index of points in ") + name;
    return parameters.integer(what, 1, kMostPoints) + 1;
  };
  spline.u.points = points("u");
  spline.line = parameters.line();
  spline.v.points = points("v");
  spline.u.degree = degree(parameters, spline.u.points, "u");
  spline.v.degree = degree(parameters, spline.v.points, "v");
  for (int k = 0; k < 5; ++k) { // these follow from the other numbers
    parameters.integer("a flag of the surface, 0 or 1", 0, 1);
  }
  for (SplineDirection* const direction : {&spline.u, &spline.v}) {
    direction->knots =
        ascending(parameters, direction->points + static_cast<std::size_t>(direction->degree) + 1,
                  "a knot", false);
  }
  const Count count = Count(spline.u.points) * spline.v.points;
  const std::size_t all = count.value().value_or(kMostPoints * kMostPoints); // more than there are
  std::vector<double> weights;
  for (std::size_t k = 0; k < all; ++k) {
    weights.push_back(parameters.weight());
  }
  const bool rational = std::ranges::any_of(weights, [&](double w) { return w != weights[0]; });
  spline.weights = rational ? Weights::cartesian : Weights::none;
  for (std::size_t k = 0; k < all; ++k) {
    for (const char* const name : {"x of a point", "y of a point", "z of a point"}) {
      spline.points.push_back(parameters.real(name));
    }
    if (rational) {
      spline.points.push_back(weights[k]);
      check_cartesian_point(records.name, parameters.line(), std::span(spline.points).last<4>());
    }
  }
  spline.u.range = range(parameters, spline.u, "u");
  spline.v.range = range(parameters, spline.v, "v");
  parameters.finish();
  return surface;
}

/// The 16 control points of x, y and z of one piece of a parametric surface, u fastest.
using Piece = std::array<double, 48>;

// A coefficient of s^k t^l counts C(i,k) C(j,l) / (C(3,k) C(3,l)) times in the control point (i, j)
// of the unit square, and lengths[0]^k lengths[1]^l times there because s and t are not normalised.
// Each factor of a direction has 7 roundings at most, their product and the term one each, and the
// sum 15.
Piece control_points(const Piece& coefficients, const std::array<double, 2>& lengths,
                     double& error) {
  constexpr double kShare[4][4] = {
      {1, 0, 0, 0}, {1, 1.0 / 3, 0, 0}, {1, 2.0 / 3, 1.0 / 3, 0}, {1, 1, 1, 1}};
  Piece points = {};
  for (std::size_t at = 0; at < 16; ++at) {
    std::array<double, 3> magnitudes = {};
    for (std::size_t c = 0; c < 3; ++c) {
      double v = 1;
      for (std::size_t l = 0; l < 4; ++l, v *= lengths[1]) {
        double u = 1;
        for (std::size_t k = 0; k < 4; ++k, u *= lengths[0]) {
          const double factor = (kShare[at % 4][k] * u) * (kShare[at / 4][l] * v);
          const double term = factor * coefficients[16 * c + 4 * l + k];
          points[3 * at + c] += term;
          magnitudes[c] += std::abs(term);
        }
      }
    }
    error = std::max(error, 32 * kUnit * length_of(magnitudes) + kSmallest);
  }
  return points;
}

IgesSurface read_parametric_surface(IgesRecords& records, std::size_t entity) {
  IgesParameters parameters(records, entity);
  IgesSurface surface;
  FileSpline& spline = surface.spline;
  parameters.integer("the kind of a parametric surface, 0 to 6", 0, 6);
  spline.line = parameters.line();
  parameters.integer("the kind of patches, 0 or 1", 0, 1);
  const std::size_t columns = parameters.integer("the number of pieces in u", 1, kMostPoints / 4);
  const std::size_t rows = parameters.integer("the number of pieces in v", 1, kMostPoints / 4);
  const std::vector<double> u = ascending(parameters, columns + 1, "a break point", true);
  const std::vector<double> v = ascending(parameters, rows + 1, "a break point", true);
  std::vector<Piece> pieces; // those of a column follow each other, and one that does not count
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < rows; ++j) {
      Piece coefficients;
      for (double& coefficient : coefficients) {
        coefficient = parameters.real("a coefficient");
      }
      pieces.push_back(
          control_points(coefficients, {u[i + 1] - u[i], v[j + 1] - v[j]}, surface.error));
      if (!std::ranges::all_of(pieces.back(), [](double x) { return std::isfinite(x); })) {
        parameters.fail("coefficients of a surface that is finite", "others");
      }
    }
    parameters.skip(i + 1 < columns ? 48 : 0, "a coefficient");
  }
  spline.u.points = 4 * columns;
  spline.v.points = 4 * rows;
  spline.merges_knots = false;
  for (const auto& [direction, breaks] : {std::pair(&spline.u, &u), std::pair(&spline.v, &v)}) {
    for (const double at : *breaks) {
      direction->knots.insert(direction->knots.end(), 4, at);
    }
  }
  for (std::size_t j = 0; j < spline.v.points; ++j) {
    for (std::size_t i = 0; i < spline.u.points; ++i) {
      const Piece& piece = pieces[i / 4 * rows + j / 4];
      const auto point = std::span(piece).subspan(3 * (j % 4 * 4 + i % 4), 3);
      spline.points.insert(spline.points.end(), point.begin(), point.end());
    }
  }
  return surface;
}

/// Makes columns of rows.
void exchange_directions(FileSpline& spline) {
  const std::size_t each = spline.weights == Weights::none ? 3 : 4;
  const std::vector<double> points = std::move(spline.points);
  spline.points.clear();
  for (std::size_t i = 0; i < spline.u.points; ++i) {
    for (std::size_t j = 0; j < spline.v.points; ++j) {
      const auto point = std::span(points).subspan((j * spline.u.points + i) * each, each);
      spline.points.insert(spline.points.end(), point.begin(), point.end());
    }
  }
  std::swap(spline.u, spline.v);
}

} // namespace

IgesSurface read_iges_surface(IgesRecords& records, std::size_t entity) {
  return records.entities[entity].type == iges_spline_surface
             ? read_spline_surface(records, entity)
             : read_parametric_surface(records, entity);
}

AffineMap iges_map(IgesRecords& records, std::size_t entity) {
  constexpr int kMost = 64;
  AffineMap map;
  std::size_t at = entity;
  for (int count = 0; records.entities[at].matrix != 0; ++count) {
    const std::uint32_t number = records.entities[at].matrix;
    const std::size_t next = number / 2;
    if (number % 2 == 0 || next >= records.entities.size() ||
        records.entities[next].type != iges_matrix) {
      records.fail(at, "the number of a transformation (entity 124)", std::to_string(number));
    }
    if (count == kMost) {
      records.fail(entity, "at most 64 transformations of transformations", "more");
    }
    IgesParameters parameters(records, next);
    AffineMap::Rows rows; // each parameter row is what becomes of one coordinate
    for (std::size_t j = 0; j < 3; ++j) {
      for (AffineMap::Vector& row : rows) {
        row[j] = parameters.real("a number of the transformation");
      }
    }
    map = map * AffineMap(rows);
    at = next;
  }
  return map;
}

void move_surface(IgesSurface& surface, const AffineMap& map, bool turned,
                  const std::string& name) {
  FileSpline& spline = surface.spline;
  const std::size_t each = spline.weights == Weights::none ? 3 : 4;
  double most = 0;
  for (std::size_t k = 0; k < spline.points.size() && !map.is_identity(); k += each) {
    std::array<double, 4> point = {0, 0, 0, each == 4 ? spline.points[k + 3] : 1};
    std::copy_n(spline.points.begin() + static_cast<std::ptrdiff_t>(k), 3, point.begin());
    most = std::max(most, map.move(point.data(), 1));
    check_cartesian_point(name, spline.line, point);
    std::copy_n(point.begin(), 3, spline.points.begin() + static_cast<std::ptrdiff_t>(k));
  }
  if (!map.is_identity()) {
    surface.error = (surface.error * map.stretch() + most) * (1 + 0x1p-40);
  }
  if (map.mirrors() != turned) {
    exchange_directions(spline);
  }
}

} // namespace simdbezier::tools
