#include <tools/formats/rib/shape.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <tools/formats/surfaces/roundings.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

std::size_t values_of(const RibShape& shape) { return shape.weights == Weights::none ? 3 : 4; }

/// The last points of a file, taken out of it.
struct TakenPoints {
  std::vector<double> values;
  std::vector<std::uint32_t> lines;
};

TakenPoints take_points(PatchFile& file, const RibShape& shape) {
  const auto count = static_cast<std::ptrdiff_t>(shape.points());
  const std::ptrdiff_t values = count * static_cast<std::ptrdiff_t>(values_of(shape));
  TakenPoints taken{{file.points.end() - values, file.points.end()},
                    {file.lines.end() - count, file.lines.end()}};
  file.points.resize(file.points.size() - taken.values.size());
  file.lines.resize(file.lines.size() - taken.lines.size());
  return taken;
}

/// Makes columns of rows.
void exchange_directions(PatchFile& file, RibShape& shape) {
  const TakenPoints taken = take_points(file, shape);
  const std::size_t columns = shape.is_spline() ? shape.u.spline->points : shape.u.mesh.points;
  const std::size_t rows = taken.lines.size() / columns;
  const std::size_t each = values_of(shape);
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < rows; ++j) {
      const std::size_t k = j * columns + i;
      const auto point = taken.values.begin() + static_cast<std::ptrdiff_t>(k * each);
      file.points.insert(file.points.end(), point, point + static_cast<std::ptrdiff_t>(each));
      file.lines.push_back(taken.lines[k]);
    }
  }
  std::swap(shape.u, shape.v);
}

/// Whether two homogeneous points are one, by the rule of the library (docs/accuracy.md, Edges that
/// are points).
bool are_one(const double* a, const double* b) {
  double size = 0;
  double apart = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double x = a[c] / a[3];
    const double y = b[c] / b[3];
    size = std::max({size, std::abs(x), std::abs(y)});
    apart = std::max(apart, std::abs(x - y));
  }
  return apart <= 16 * kUnit * size;
}

/// Nets of points in rows, one net after the other.
struct NetRows {
  std::size_t columns;
  std::size_t rows;
  std::size_t each; ///< values of a point

  /// The neighbour before point k of `values` that is one point with it, or k itself.
  [[nodiscard]] std::size_t one_before(const std::vector<double>& values, std::size_t k) const {
    const auto is_one_with = [&](std::size_t other) {
      return each == 4 && are_one(&values[k * each], &values[other * each]);
    };
    const std::size_t at = k % (columns * rows);
    return at % columns != 0 && is_one_with(k - 1)     ? k - 1
           : at >= columns && is_one_with(k - columns) ? k - columns
                                                       : k;
  }
};

/// Moves the points of a shape's nets; the k-th one stands in line_of(k). Returns a bound on how
/// far any of them is from where it should be. A point that is one with a neighbour takes its
/// place, since sums that cancel would take them apart.
template <typename Line>
double move_points(const std::string& name, std::span<double> values, const RibShape& shape,
                   const NetRows& nets, const Line& line_of) {
  if (shape.map.is_identity()) {
    return 0;
  }
  const std::size_t each = nets.each;
  const std::vector<double> given(values.begin(), values.end());
  // As far as two points that are one may be apart, for each point of a row and a column; and two
  // roundings.
  const double apart = static_cast<double>(nets.columns + nets.rows) * 32 * kUnit *
                       (1 + shape.map.stretch()) * kRounding;
  double error = 0;
  double merged = 0; // what is added to the error of a point by those that follow it
  for (std::size_t k = 0; k * each < values.size(); ++k) {
    double* const point = values.data() + k * each;
    const double weight = each == 4 ? point[3] : 1;
    if (const std::size_t before = nets.one_before(given, k); before != k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double moved = values[before * each + c] / values[before * each + 3];
        merged = std::max({merged, apart * std::abs(moved), apart * std::abs(point[c] / weight)});
        point[c] = moved * weight;
      }
    } else {
      error = std::max(error, shape.map.move(point, weight));
    }
    for (std::size_t c = 0; c < 3; ++c) {
      if (!std::isfinite(point[c] / weight)) {
        bad_input_at(name, line_of(k), "a point that its transformations leave finite", "another");
      }
    }
  }
  return error + merged;
}

double close_mesh(PatchFile& file, const RibShape& shape) {
  const std::size_t first_value = file.points.size() - shape.points() * values_of(shape);
  const std::size_t first_line = file.lines.size() - shape.points();
  double error = 0;
  if (shape.has_bezier_points()) {
    file.close_mesh(shape.degree, shape.degree, shape.weights, shape.u.mesh, shape.v.mesh);
  } else {
    const TakenPoints taken = take_points(file, shape);
    static const auto bezier = rib_basis_matrix(kRibNamedBases[0].matrix, 1);
    const auto matrix = [&](const RibBasis& basis) -> const BasisMatrix& {
      return basis.matrix ? *basis.matrix : *bezier;
    };
    error = add_basis_mesh(file, {matrix(shape.u.basis), matrix(shape.v.basis), shape.u.mesh,
                                  shape.v.mesh, shape.weights, taken.values, taken.lines});
    error = error == 0 ? 0 : error * shape.map.stretch();
  }
  const std::size_t order =
      shape.has_bezier_points() ? static_cast<std::size_t>(shape.degree) + 1 : 4;
  return error + move_points(file.name, std::span(file.points).subspan(first_value), shape,
                             {order, order, values_of(shape)},
                             [&](std::size_t k) { return file.lines[first_line + k]; });
}

// What making patches of it rounds is not part of the bound.
double close_spline(PatchFile& file, const RibShape& shape) {
  TakenPoints taken = take_points(file, shape);
  FileSpline spline{shape.line, *shape.u.spline, *shape.v.spline, shape.weights,
                    std::move(taken.values)};
  const double error =
      move_points(file.name, spline.points, shape,
                  {shape.u.spline->points, shape.v.spline->points, values_of(shape)},
                  [&](std::size_t k) { return taken.lines[k]; });
  file.close_spline(spline);
  return error;
}

} // namespace

void close_rib_shape(PatchFile& file, const RibShape& given) {
  RibShape shape = given;
  if (shape.is_inside != shape.map.mirrors()) {
    exchange_directions(file, shape);
  }
  const double error = shape.is_spline() ? close_spline(file, shape) : close_mesh(file, shape);
  file.moved_error = std::max(file.moved_error, error);
  file.ignored_trims += shape.is_widened ? 1 : 0;
}

void RibObject::take(PatchFile& file, RibShape shape) {
  const TakenPoints taken = take_points(file, shape);
  points_.insert(points_.end(), taken.values.begin(), taken.values.end());
  lines_.insert(lines_.end(), taken.lines.begin(), taken.lines.end());
  shapes_.push_back(std::move(shape));
}

} // namespace simdbezier::tools
