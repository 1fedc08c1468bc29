#include <tools/formats/obj/surface.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <tools/process/length.hpp>

namespace simdbezier::tools {

namespace {

/// The functions of t that a direction's values are multiplied by.
BasisFunctions functions_of(ObjType type, const ObjBasis& basis) {
  const auto order = static_cast<std::size_t>(basis.degree) + 1;
  BasisFunctions functions{basis.degree, std::vector<double>(order * order), 1};
  if (type == ObjType::cardinal) { // Catmull-Rom: tangents are half the difference of neighbours
    functions.coefficients = {0, 2, 0, 0, -1, 0, 1, 0, 2, -5, 4, -1, -1, 3, -3, 1};
    functions.denominator = 2;
    return functions;
  }
  for (std::size_t k = 0; k < order; ++k) {
    for (std::size_t j = 0; j < order; ++j) {
      functions.coefficients[k * order + j] =
          type == ObjType::taylor ? (k == j ? 1 : 0) : basis.matrix[j * order + k];
    }
  }
  return functions;
}

/// The values of a surface in their order.
struct ObjValues {
  std::vector<double> values; ///< x y z or, where there are weights, x y z w
  std::vector<std::uint32_t> lines;
};

ObjValues values_of(const PatchFile& file, const ObjSurface& surface) {
  ObjValues result;
  for (const std::uint32_t vertex : surface.vertices) {
    const auto value = std::span(file.points).subspan(std::size_t{4} * vertex, 4);
    result.values.insert(result.values.end(), value.begin(),
                         value.end() - (surface.rational ? 0 : 1));
    result.lines.push_back(file.lines[vertex]);
  }
  return result;
}

/// Multiplies values by their weights. Returns the largest length of what that rounds.
double multiply(std::vector<double>& values) {
  double error = 0;
  for (std::size_t k = 0; k < values.size(); k += 4) {
    std::array<double, 3> rounded;
    for (std::size_t c = 0; c < 3; ++c) {
      const double product = values[k + c] * values[k + 3];
      rounded[c] = std::fma(values[k + c], values[k + 3], -product);
      values[k + c] = product;
    }
    error = std::max(error, length_of(rounded) + 0x1p-1070);
  }
  return error;
}

/// How much longer a difference of all values becomes in the Bézier points.
double stretch(const BasisMatrix& basis) {
  double most = 0;
  for (std::size_t i = 0; i < basis.order(); ++i) {
    most = std::max(most, (basis.sum(i) + basis.rounding(i)) / basis.denominator(i));
  }
  return most;
}

double add_mesh(PatchFile& file, const ObjSurface& surface) {
  const auto mesh = [&](const ObjDirection& direction) {
    const std::size_t points = *direction.points(surface.type).value();
    return MeshDirection{points, direction.step, direction.parameters.size() - 1};
  };
  ObjValues values = values_of(file, surface);
  const double product = surface.rational ? multiply(values.values) : 0;
  const std::size_t first = file.points.size();
  const double error = add_basis_mesh(
      file, {*surface.u.basis, *surface.v.basis, mesh(surface.u), mesh(surface.v),
             surface.rational ? Weights::homogeneous : Weights::none, values.values, values.lines});
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = first + 3; surface.rational && k < file.points.size(); k += 4) {
    least = std::min(least, file.points[k]);
  }
  return error +
         product * stretch(*surface.u.basis) * stretch(*surface.v.basis) / least * (1 + 0x1p-40);
}

} // namespace

Count ObjDirection::points(ObjType type) const {
  const auto order = static_cast<std::size_t>(degree) + 1;
  if (type == ObjType::bspline) {
    return parameters.size() - order;
  }
  return Count(parameters.size() - 2) * step + order;
}

// Break points of bezier are knots that occur as often as the degree says, the first and the last
// one once more.
SplineDirection ObjDirection::spline(ObjType type) const {
  SplineDirection result{degree, *points(type).value(), parameters};
  if (type == ObjType::bezier) {
    result.knots = {parameters.front()};
    for (const double at : parameters) {
      result.knots.insert(result.knots.end(), static_cast<std::size_t>(degree), at);
    }
    result.knots.push_back(parameters.back());
  }
  return result;
}

ObjDirection obj_direction(ObjType type, const ObjBasis& basis) {
  ObjDirection direction;
  direction.degree = basis.degree;
  direction.step = static_cast<std::size_t>(basis.degree);
  switch (type) {
  case ObjType::bezier:
  case ObjType::bspline:
    return direction;
  case ObjType::cardinal:
    direction.step = 1;
    break;
  case ObjType::taylor:
    direction.step += 1;
    break;
  case ObjType::bmatrix:
    direction.step = basis.step;
    break;
  }
  direction.basis = std::make_shared<const BasisMatrix>(functions_of(type, basis));
  return direction;
}

void close_obj_surface(PatchFile& file, const ObjSurface& surface) {
  if (surface.has_bezier_points()) {
    const auto mesh = [](const ObjDirection& direction) {
      const std::size_t patches = direction.parameters.size() - 1;
      return MeshDirection{patches * direction.step + 1, direction.step, patches};
    };
    file.vertices.insert(file.vertices.end(), surface.vertices.begin(), surface.vertices.end());
    file.close_indexed_mesh(surface.u.degree, surface.v.degree,
                            surface.rational ? Weights::cartesian : Weights::none, mesh(surface.u),
                            mesh(surface.v));
    return;
  }
  if (surface.u.basis) {
    file.moved_error = std::max(file.moved_error, add_mesh(file, surface));
    return;
  }
  FileSpline spline;
  spline.line = surface.line;
  spline.u = surface.u.spline(surface.type);
  spline.v = surface.v.spline(surface.type);
  spline.u.range = surface.u.range;
  spline.v.range = surface.v.range;
  spline.weights = surface.rational ? Weights::cartesian : Weights::none;
  spline.points = values_of(file, surface).values;
  spline.merges_knots = surface.type == ObjType::bspline;
  file.close_spline(spline);
}

} // namespace simdbezier::tools
