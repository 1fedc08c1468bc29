// See axes.hpp.
#include "tests/properties/metamorphic/axes.hpp"

#include <functional>
#include <numeric>

namespace simdbezier::tests {
namespace {

[[nodiscard]] const char* curve_reason(const Cell& cell) {
  const bool second_parameter = cell.output == Output::dv || cell.output == Output::duv ||
                                cell.output == Output::dvv ||
                                cell.relation == Relation::transposed ||
                                cell.relation == Relation::reversed_v || cell.side < 2;
  if (second_parameter) {
    return "a curve has one parameter and two ends";
  }
  if (cell.output == Output::any_order) {
    return "curves have derivatives up to the second order";
  }
  if (cell.kind == Kind::collapsed_edge || cell.kind == Kind::collapsed_corner) {
    return "an end of a curve is a point anyway";
  }
  return nullptr;
}

[[nodiscard]] const char* output_reason(const Cell& cell) {
  const ShapeRow& shape = kShapeRows[cell.shape];
  const bool bent = cell.output == Output::normal || cell.output == Output::status ||
                    cell.output == Output::curvature;
  if (bent && (is_derivative_call(cell.call) || is_iso_call(cell.call))) {
    return "the call has no such output";
  }
  if (bent && shape.components != 3 && !(shape.is_curve() && shape.components == 2)) {
    return "normals and tangents need points in space";
  }
  if (cell.output == Output::any_order && !is_derivative_call(cell.call)) {
    return "the call has no such output";
  }
  const bool across = cell.call == Call::iso_u
                          ? cell.output == Output::du || cell.output == Output::duu
                          : cell.output == Output::dv || cell.output == Output::dvv;
  if (is_iso_call(cell.call) && (across || cell.output == Output::duv)) {
    return "an iso-curve has derivatives along itself only";
  }
  return nullptr;
}

[[nodiscard]] const char* relation_reason(const Cell& cell) {
  const ShapeRow& shape = kShapeRows[cell.shape];
  switch (cell.relation) {
  case Relation::permuted:
    return shape.components == 1 ? "one component has one order" : nullptr;
  case Relation::elevated:
    if (shape.degree_u == kMostDegree) {
      return "there is no higher degree";
    }
    return shape.weights == Weights::cartesian ? "elevated cartesian points would be rounded"
                                               : nullptr;
  case Relation::reweighted:
    return shape.weights == Weights::none && cell.shape != kMixedShape ? "there are no weights"
                                                                       : nullptr;
  default:
    return nullptr;
  }
}

} // namespace

std::size_t Cell::index() const {
  const std::array<std::size_t, kAxes> at{static_cast<std::size_t>(relation),
                                          static_cast<std::size_t>(call),
                                          shape,
                                          static_cast<std::size_t>(output),
                                          side,
                                          static_cast<std::size_t>(kind),
                                          static_cast<std::size_t>(origin),
                                          is_double ? 1U : 0U};
  std::size_t result = 0;
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    result = result * kAxisSizes[axis] + at[axis];
  }
  return result;
}

Cell cell_at(std::size_t index) {
  std::array<std::size_t, kAxes> at{};
  for (std::size_t axis = kAxes; axis-- > 0;) {
    at[axis] = index % kAxisSizes[axis];
    index /= kAxisSizes[axis];
  }
  return {static_cast<Relation>(at[0]),
          static_cast<Call>(at[1]),
          at[2],
          static_cast<Output>(at[3]),
          at[4],
          static_cast<Kind>(at[5]),
          static_cast<Origin>(at[6]),
          at[7] == 1};
}

std::size_t cell_count() {
  return std::accumulate(kAxisSizes.begin(), kAxisSizes.end(), std::size_t{1}, std::multiplies<>());
}

const char* impossible_because(const Cell& cell) {
  const bool mixed = cell.shape == kMixedShape;
  const bool curve = !mixed && kShapeRows[cell.shape].is_curve();
  if (curve != is_curve_call(cell.call)) {
    return "curves and patches have calls of their own";
  }
  if (mixed && is_iso_call(cell.call)) {
    return "iso-curves of a set need patches of one shape";
  }
  if (curve) {
    if (const char* const reason = curve_reason(cell)) {
      return reason;
    }
  }
  const char* const reason = output_reason(cell);
  return reason != nullptr ? reason : relation_reason(cell);
}

} // namespace simdbezier::tests
