#include <tools/formats/iges/boundary.hpp>

#include <algorithm>

#include <tools/formats/iges/kinds.hpp>
#include <tools/formats/iges/parameters.hpp>
#include <tools/formats/surfaces/parameter_boundary.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kMostNested = 16;
constexpr std::size_t kMostIndex = std::size_t{1} << 31;

/// The curves of a boundary.
class Boundary {
public:
  explicit Boundary(IgesRecords& records) : records_(records) {}

  /// Appends a curve's control points; false where it is of another kind.
  bool append(std::size_t curve, std::size_t depth = 0) {
    const IgesEntity& entity = records_.entities[curve];
    if (entity.matrix != 0 || depth > kMostNested) {
      return false;
    }
    switch (entity.type) {
    case iges_composite_curve:
      return composite(curve, depth);
    case iges_line: {
      IgesParameters parameters(records_, curve);
      return points(parameters, 2, 3);
    }
    case iges_path:
      return path(curve);
    case iges_spline_curve:
      return spline(curve);
    default:
      return false;
    }
  }

  [[nodiscard]] std::optional<PatchInterval> rectangle() const { return boundary_.rectangle(); }

private:
  bool composite(std::size_t curve, std::size_t depth) {
    IgesParameters parameters(records_, curve);
    const std::size_t count = parameters.integer("the number of curves", 1, kMostIndex);
    for (std::size_t k = 0; k < count; ++k) {
      const auto part = parameters.pointer("the number of a curve");
      if (!part || !append(*part, depth + 1)) {
        return false;
      }
    }
    return true;
  }

  /// Reads points of two or three numbers, of which the first two are u and v.
  bool points(IgesParameters& parameters, std::size_t count, std::size_t numbers,
              bool is_curved = false) {
    std::vector<ParameterBoundary::Point> points;
    for (std::size_t k = 0; k < count; ++k) {
      points.push_back({parameters.real("u of a point"), parameters.real("v of a point")});
      parameters.skip(numbers - 2, "a coordinate");
    }
    boundary_.append(points, is_curved);
    return true;
  }

  bool path(std::size_t curve) {
    IgesParameters parameters(records_, curve);
    const std::int32_t form = records_.entities[curve].form;
    if (form != 11 && form != 12 && form != 63) {
      return false;
    }
    const std::size_t kind = parameters.integer("the kind of points, 1 or 2", 1, 2);
    const std::size_t count = parameters.integer("the number of points", 2, kMostIndex);
    parameters.skip(kind == 1 ? 1 : 0, "a height");
    return points(parameters, count, kind + 1);
  }

  // The control points say where the curve is: its ends are the first and the last one where the
  // knots there occur as often as they can and the curve is all of it.
  bool spline(std::size_t curve) {
    IgesParameters parameters(records_, curve);
    const std::size_t last = parameters.integer("the largest index of points", 1, kMostIndex);
    const std::size_t degree = parameters.integer("the degree of a curve", 1, last);
    parameters.skip(4, "a flag of the curve, 0 or 1");
    std::vector<double> knots;
    for (std::size_t k = 0; k < last + degree + 2; ++k) {
      knots.push_back(parameters.real("a knot"));
    }
    for (std::size_t k = 0; k <= last; ++k) {
      parameters.weight();
    }
    points(parameters, last + 1, 3, degree > 1);
    const double begin = parameters.real("where the curve begins");
    const double end = parameters.real("where the curve ends");
    return std::ranges::is_sorted(knots) && knots[0] == knots[degree] &&
           knots[last + 1] == knots.back() && begin == knots[0] && end == knots.back();
  }

  IgesRecords& records_;
  ParameterBoundary boundary_;
};

std::size_t surface_pointer(IgesParameters& parameters) {
  constexpr const char* kWhat = "the number of a surface (entity 128 or 114)";
  const auto surface = parameters.pointer(kWhat);
  if (!surface) {
    parameters.fail(kWhat);
  }
  return *surface;
}

bool is(const IgesRecords& records, std::optional<std::size_t> entity, std::uint32_t type) {
  return entity && records.entities[*entity].type == type;
}

IgesTrimmed read_trimmed(IgesRecords& records, std::size_t entity) {
  IgesParameters parameters(records, entity);
  IgesTrimmed result;
  result.surface = surface_pointer(parameters);
  const bool bounded = parameters.integer("a flag of the boundary, 0 or 1", 0, 1) == 1;
  result.known = parameters.integer("the number of inner boundaries", 0, kMostIndex) == 0;
  if (!bounded) {
    return result;
  }
  const auto boundary = parameters.pointer("the number of a boundary (entity 142)");
  if (!is(records, boundary, iges_curve_on_surface)) {
    result.known = false;
    return result;
  }
  IgesParameters curve(records, *boundary);
  curve.skip(2, "the curve's surface");
  if (const auto in_parameters = curve.pointer("the number of a curve")) {
    result.curves.push_back(*in_parameters);
  }
  result.known = result.known && !result.curves.empty();
  return result;
}

/// Reads the curves in the plane of parameters of a boundary's sides, each of which has `before`
/// numbers in front of their count and `each` in front of every one.
void read_sides(IgesParameters& sides, std::size_t before, std::size_t each, IgesTrimmed& to) {
  const std::size_t count = sides.integer("the number of curves", 1, kMostIndex);
  for (std::size_t k = 0; k < count; ++k) {
    sides.skip(before, "a curve and its direction");
    const std::size_t parts = sides.integer("the number of parameter curves", 0, kMostIndex);
    to.known = to.known && parts > 0;
    for (std::size_t part = 0; part < parts; ++part) {
      sides.skip(each, "a flag of a parameter curve");
      if (const auto curve = sides.pointer("the number of a parameter curve")) {
        to.curves.push_back(*curve);
      }
    }
  }
}

IgesTrimmed read_face(IgesRecords& records, std::size_t entity) {
  IgesParameters parameters(records, entity);
  IgesTrimmed result;
  result.surface = surface_pointer(parameters);
  const bool one = parameters.integer("the number of loops", 1, kMostIndex) == 1;
  parameters.skip(1, "a flag of the outer loop");
  const auto loop = parameters.pointer("the number of a loop (entity 508)");
  result.known = one && is(records, loop, iges_loop);
  if (result.known) {
    IgesParameters edges(records, *loop);
    read_sides(edges, 4, 1, result);
  }
  return result;
}

IgesTrimmed read_bounded(IgesRecords& records, std::size_t entity) {
  IgesParameters parameters(records, entity);
  IgesTrimmed result;
  result.known = parameters.integer("the kind of boundaries, 0 or 1", 0, 1) == 1;
  result.surface = surface_pointer(parameters);
  const bool one = parameters.integer("the number of boundaries", 1, kMostIndex) == 1;
  const auto boundary = parameters.pointer("the number of a boundary (entity 141)");
  result.known = result.known && one && is(records, boundary, iges_boundary);
  if (!result.known) {
    return result;
  }
  IgesParameters curves(records, *boundary);
  curves.skip(3, "the boundary's surface");
  read_sides(curves, 2, 0, result);
  return result;
}

} // namespace

IgesTrimmed read_iges_trimmed(IgesRecords& records, std::size_t entity) {
  switch (records.entities[entity].type) {
  case iges_trimmed_surface:
    return read_trimmed(records, entity);
  case iges_face:
    return read_face(records, entity);
  default:
    return read_bounded(records, entity);
  }
}

std::optional<PatchInterval> iges_rectangle(IgesRecords& records,
                                            const std::vector<std::size_t>& curves) {
  Boundary boundary(records);
  for (const std::size_t curve : curves) {
    if (!boundary.append(curve)) {
      return std::nullopt;
    }
  }
  return boundary.rectangle();
}

} // namespace simdbezier::tools
