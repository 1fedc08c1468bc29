#include "src/exact/tangent_fallback.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/exact/tangent_series.hpp"

namespace simdbezier::detail {
namespace {

double length(const double v[3]) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// The exponent of two by which a term's vector is to be multiplied, for a number of tangents in a
/// product.
int exponent_of(const TangentQuestion& question, const LeadingTerm& term, int tangents) {
  int sum = term.exponent;
  for (const Quantity kind : {kPoint, kWeight, kParameterU}) {
    sum += tangents * question.factors(kind) * term.units[kind];
  }
  return sum;
}

/// A product of numbers of any size: fraction times 2^exponent.
struct Product {
  double fraction = 1;
  int exponent = 0;

  void multiply(double factor) { fraction *= split(factor, 1); }
  void divide(double divisor) { fraction /= split(divisor, -1); }

private:
  double split(double number, int sign) {
    int shift = 0;
    const double part = std::frexp(number, &shift);
    exponent += sign * shift;
    return part;
  }
};

double weight_at(const TangentQuestion& question) {
  if (!question.points().rational()) {
    return 1;
  }
  const BoundedField field = question.field();
  return std::ldexp(TangentSeries(field, question).weight().value, -field.scale_exponent(kWeight));
}

double limit_curvature(const TangentQuestion& question, const LeadingTerm& tangent,
                       double tolerance) {
  const BendQuestion bend(question);
  const LeadingTerm term = leading_term(bend, 2 * tangent.order, 3 * tangent.order, tolerance,
                                        [&](const auto& field) { return BendSeries(field, bend); });
  if (term.order < 0) {
    return 0;
  }
  if (term.order < 3 * tangent.order) {
    return std::numeric_limits<double>::infinity();
  }
  const double w = weight_at(question);
  const double size = length(tangent.vector);
  Product curvature;
  curvature.exponent = exponent_of(question, term, 2) - 3 * exponent_of(question, tangent, 1);
  for (const double factor :
       {length(term.vector), w, w, question.points().numerator_factor(question.nearest())}) {
    curvature.multiply(factor);
  }
  for (const double divisor :
       {size, size, size, static_cast<double>(question.degree()), std::fabs(question.t().d)}) {
    curvature.divide(divisor);
  }
  return std::ldexp(curvature.fraction, curvature.exponent);
}

} // namespace

template <typename T>
void resolve_tangent(const TangentQuery<T>& query, TangentAnswer<T>& answer) {
  if (!std::isfinite(query.x)) {
    std::fill_n(answer.tangent, 3, std::numeric_limits<T>::quiet_NaN());
    answer.curvature = std::numeric_limits<T>::quiet_NaN();
    answer.status = SampleStatus::non_finite;
    return;
  }
  std::fill_n(answer.tangent, 3, T(0));
  answer.curvature = 0;
  answer.status = SampleStatus::degenerate;
  const TangentQuestion question(query.net, static_cast<std::size_t>(query.shape->degree),
                                 static_cast<std::size_t>(query.shape->components),
                                 static_cast<double>(query.x));
  constexpr double tolerance = kLimitTolerance<T>;
  const LeadingTerm term =
      leading_term(question, 0, question.highest(), tolerance,
                   [&](const auto& field) { return TangentSeries(field, question); });
  if (term.order < 0) {
    return;
  }
  const double inverse = 1 / length(term.vector);
  for (std::size_t c = 0; c < 3; ++c) {
    answer.tangent[c] = static_cast<T>(term.vector[c] * inverse) + T(0);
  }
  answer.curvature = static_cast<T>(limit_curvature(question, term, tolerance));
  answer.status = term.order == 0 ? SampleStatus::regular : SampleStatus::limit;
}

template void resolve_tangent(const TangentQuery<float>&, TangentAnswer<float>&);
template void resolve_tangent(const TangentQuery<double>&, TangentAnswer<double>&);

} // namespace simdbezier::detail
