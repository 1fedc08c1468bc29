// See src/exact/normal_fallback.hpp.
#include "src/exact/normal_fallback.hpp"

#include <cmath>
#include <limits>

#include "src/exact/normal_series.hpp"

namespace simdbezier::detail {
namespace {

/// The weight's sign at a sample: 0 where it is too small to tell. The cross product of the
/// tangents is the series over its third power.
int weight_sign(const NormalQuestion& question) {
  if (!question.points().rational() || question.inside()) {
    return 1;
  }
  const BoundedField field = question.field();
  NormalSeries series(field, question);
  Bounded ignored[3];
  series.coefficient(0, ignored);
  const Bounded weight = series.weight();
  return weight.value > weight.error ? 1 : weight.value < -weight.error ? -1 : 0;
}

} // namespace

template <typename T>
SampleStatus resolve_normal(const NormalQuery<T>& query, T normal[3]) noexcept {
  return resolve_corner_normal(query, 0, normal);
}

template <typename T>
SampleStatus resolve_corner_normal(const NormalQuery<T>& query, unsigned sides,
                                   T normal[3]) noexcept {
  const auto x = static_cast<double>(query.x);
  const auto y = static_cast<double>(query.y);
  if (!std::isfinite(x) || !std::isfinite(y)) {
    normal[0] = normal[1] = normal[2] = std::numeric_limits<T>::quiet_NaN();
    return SampleStatus::non_finite;
  }
  NormalQuestion question(query.net, static_cast<std::size_t>(query.shape->degree_u),
                          static_cast<std::size_t>(query.shape->degree_v), x, y);
  for (const PatchEdge side : {PatchEdge::v0, PatchEdge::v1, PatchEdge::u0, PatchEdge::u1}) {
    if ((sides >> static_cast<unsigned>(side) & 1U) != 0) {
      question.merge_side(side);
    }
  }
  const LeadingTerm term =
      leading_term(question, 0, question.highest(), kLimitTolerance<T>,
                   [&](const auto& field) { return NormalSeries(field, question); });
  const int sign = term.order < 0 ? 0 : weight_sign(question);
  if (sign == 0) {
    normal[0] = normal[1] = normal[2] = T(0);
    return SampleStatus::degenerate;
  }
  const double* const n = term.vector;
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  const double inverse = sign / length;
  for (int c = 0; c < 3; ++c) {
    normal[c] = static_cast<T>(n[c] * inverse) + T(0);
  }
  return term.order == 0 ? SampleStatus::regular : SampleStatus::limit;
}

template SampleStatus resolve_normal(const NormalQuery<float>&, float[3]) noexcept;
template SampleStatus resolve_normal(const NormalQuery<double>&, double[3]) noexcept;
template SampleStatus resolve_corner_normal(const NormalQuery<float>&, unsigned, float[3]) noexcept;
template SampleStatus resolve_corner_normal(const NormalQuery<double>&, unsigned,
                                            double[3]) noexcept;

} // namespace simdbezier::detail
