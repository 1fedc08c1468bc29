#include "src/exact/normal_fallback.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "src/exact/normal_series.hpp"
#include "src/runtime/both_types.hpp"

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

/// What is known of the patch that a thread has asked about last: whether it has no normal
/// anywhere, which is decided at its first sample that seems to have none. The answer depends on
/// control points alone, and these are compared as a whole, so that it holds whatever has become of
/// the patch's memory since.
class LastPatch {
public:
  void look_at(const GivenNet& net, const NetShape& shape) {
    const std::size_t bytes = shape.control_values() * net.all->value_bytes();
    if (shape != shape_ || net.all->in_double != in_double_ || net.all->weights != weights_ ||
        std::memcmp(net.values, values_, bytes) != 0) {
      shape_ = shape;
      in_double_ = net.all->in_double;
      weights_ = net.all->weights;
      std::memcpy(values_, net.values, bytes);
      known_ = Known::nothing;
    }
  }
  void learn(const NormalQuestion& question) {
    if (known_ == Known::nothing) {
      known_ = question.is_zero() ? Known::zero : Known::other;
    }
  }
  [[nodiscard]] bool is_zero() const { return known_ == Known::zero; }

private:
  enum class Known : std::uint8_t { nothing, zero, other };

  NetShape shape_{0, 0, 0, false};
  bool in_double_ = false;
  Weights weights_ = Weights::none;
  Known known_ = Known::nothing;
  unsigned char values_[kMostOrder * kMostOrder * 4 * sizeof(double)] = {};
};

thread_local LastPatch last_patch;

/// A question whose is_zero() is remembered, unless sides have been made points.
class SampleQuestion : public NormalQuestion {
public:
  SampleQuestion(const GivenNet& net, const NetShape& shape, double x, double y, unsigned sides)
      : NormalQuestion(net, static_cast<std::size_t>(shape.degree_u),
                       static_cast<std::size_t>(shape.degree_v), x, y),
        remembered_(sides == 0) {
    for (const PatchEdge side : {PatchEdge::v0, PatchEdge::v1, PatchEdge::u0, PatchEdge::u1}) {
      if ((sides >> static_cast<unsigned>(side) & 1U) != 0) {
        merge_side(side);
      }
    }
  }
  [[nodiscard]] bool is_zero() const {
    if (!remembered_) {
      return NormalQuestion::is_zero();
    }
    last_patch.learn(*this);
    return last_patch.is_zero();
  }

private:
  bool remembered_;
};

/// The direction of a coefficient.
template <typename T>
SampleStatus put_direction(const LeadingTerm& term, int sign, T normal[3]) {
  const double* const n = term.vector;
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  const double inverse = sign / length;
  for (int c = 0; c < 3; ++c) {
    normal[c] = static_cast<T>(n[c] * inverse) + T(0);
  }
  return term.order == 0 ? SampleStatus::regular : SampleStatus::limit;
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
  normal[0] = normal[1] = normal[2] = T(0);
  last_patch.look_at(query.net, *query.shape);
  if (sides == 0 && last_patch.is_zero()) {
    return SampleStatus::degenerate;
  }
  const SampleQuestion question(query.net, *query.shape, x, y, sides);
  // Which homogeneous points are one depends on the sample in the last digits: asked before
  // anything else, the answer is the same whichever sample comes first.
  if (query.net.all->weights == Weights::homogeneous && question.is_zero()) {
    return SampleStatus::degenerate;
  }
  const LeadingTerm term =
      leading_term(question, 0, question.highest(), kLimitTolerance<T>,
                   [&polynomial = static_cast<const NormalQuestion&>(question)](const auto& field) {
                     return NormalSeries(field, polynomial);
                   });
  if (term.order < 0) {
    static_cast<void>(question.is_zero()); // so that it is known of the next sample
    return SampleStatus::degenerate;
  }
  const int sign = weight_sign(question);
  if (sign == 0) {
    return SampleStatus::degenerate;
  }
  return put_direction(term, sign, normal);
}

SIMDBEZIER_OF_BOTH_TYPES(resolve_normal);
SIMDBEZIER_OF_BOTH_TYPES(resolve_corner_normal);

} // namespace simdbezier::detail
