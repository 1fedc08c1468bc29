#include <tools/formats/rib_shape.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

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

/// Moves points; the k-th one stands in line_of(k). Returns a bound on how far any of them is from
/// where it should be.
template <typename Line>
double move_points(const std::string& name, std::span<double> values, const RibShape& shape,
                   const Line& line_of) {
  if (shape.map.is_identity()) {
    return 0;
  }
  const std::size_t each = values_of(shape);
  double error = 0;
  for (std::size_t k = 0; k * each < values.size(); ++k) {
    double* const point = values.data() + k * each;
    const double weight = each == 4 ? point[3] : 1;
    error = std::max(error, shape.map.move(point, weight));
    for (std::size_t c = 0; c < 3; ++c) {
      if (!std::isfinite(point[c] / weight)) {
        bad_input_at(name, line_of(k), "a point that its transformations leave finite", "another");
      }
    }
  }
  return error;
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
  return error + move_points(file.name, std::span(file.points).subspan(first_value), shape,
                             [&](std::size_t k) { return file.lines[first_line + k]; });
}

// What making patches of it rounds is not part of the bound.
double close_spline(PatchFile& file, const RibShape& shape) {
  TakenPoints taken = take_points(file, shape);
  FileSpline spline{shape.line, *shape.u.spline, *shape.v.spline, shape.weights,
                    std::move(taken.values)};
  const double error =
      move_points(file.name, spline.points, shape, [&](std::size_t k) { return taken.lines[k]; });
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
