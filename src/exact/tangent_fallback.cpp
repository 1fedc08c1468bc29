// Tangents and how curves bend, along the parameter and as polynomials; see tangent_fallback.hpp.
#include "src/exact/tangent_fallback.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/exact/exact_points.hpp"
#include "src/exact/leading_term.hpp"
#include "src/exact/line_basis.hpp"
#include "src/exact/zero_everywhere.hpp"
#include "src/runtime/both_types.hpp"

namespace simdbezier::detail {
namespace {

/// A curve of up to three components, seen from a sample towards the curve's middle; from the
/// middle itself, upwards.
class TangentQuestion {
public:
  TangentQuestion(const GivenNet& net, std::size_t degree, std::size_t components, double x)
      : points_(net, degree + 1, components),
        degree_(degree), t_{x, x == 0 ? 0.5 : -x, kParameterU} {}

  [[nodiscard]] const ExactPoints& points() const { return points_; }
  [[nodiscard]] std::size_t degree() const { return degree_; }
  [[nodiscard]] const LineParameter& t() const { return t_; }

  /// The control point at the nearer end.
  [[nodiscard]] std::size_t nearest() const { return t_.x <= 0 ? 0 : degree_; }
  /// The order of the last coefficient that can be other than zero.
  [[nodiscard]] int highest() const {
    const auto n = static_cast<int>(degree_);
    return points_.rational() ? 2 * n - 1 : n - 1;
  }
  /// How many factors of a kind the terms of a coefficient have: points, weights or parameters u.
  [[nodiscard]] int factors(Quantity kind) const {
    const int weights = points_.rational() ? 2 : 0;
    return kind == kPoint ? 1 : kind == kParameterU ? highest() : weights;
  }

  [[nodiscard]] BoundedField field() const {
    return {points_.largest_point(), points_.largest_weight()};
  }
  [[nodiscard]] QuestionDigits digits() const {
    QuestionDigits all;
    points_.include_in(all.numbers[kPoint], all.numbers[kWeight]);
    t_.include_in(all.numbers[kParameterU]);
    all.coefficients = points_.digits(all.numbers[kPoint], all.numbers[kWeight]) +
                       (points_.rational() ? all.numbers[kWeight].digits() : 0) +
                       LineParameter::digits(all.numbers[kParameterU],
                                             static_cast<std::size_t>(factors(kParameterU))) +
                       4;
    return all;
  }

  /// Whether the curve is one point.
  [[nodiscard]] bool is_point() const { return detail::is_point(points_, degree_ + 1); }

private:
  ExactPoints points_;
  std::size_t degree_;
  LineParameter t_;
};

/// With C = h / w and primes for derivatives, over the degree n:
///     C' = n (w h' - w' h) / w^2,
/// whose numerator has the direction of C'. Without weights it is h'.
template <typename Field>
class TangentSeries {
  using Value = typename Field::Value;
  static constexpr std::size_t kMostTerms = kMostOrder;

public:
  TangentSeries(const Field& field, const TangentQuestion& question)
      : field_(field), order_(question.degree() + 1), rational_(question.points().rational()),
        basis_(field, question.t(), question.degree()) {
    for (std::size_t i = 0; i < order_; ++i) {
      question.points().place(field, i, question.nearest(), net_[i]);
    }
    for (std::size_t k = 0; k < order_; ++k) {
      sum_up(basis_.upper(), order_, 0, k, point_[k]);
      sum_up(basis_.lower(), order_ - 1, 1, k, slope_[k]);
    }
  }

  void coefficient(int order, Value vector[3]) const {
    const auto k = static_cast<std::size_t>(order);
    if (!rational_) {
      std::copy_n(slope_[k], 3, vector);
      return;
    }
    std::fill_n(vector, 3, field_.zero());
    for (std::size_t i = k < order_ ? 0 : k + 1 - order_; i <= k && i < order_; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        vector[c] = field_.multiply_add(point_[i][3], slope_[k - i][c], vector[c]);
        vector[c] = field_.subtract_product(slope_[i][3], point_[k - i][c], vector[c]);
      }
    }
  }
  /// The sample's weight; rational curves only.
  [[nodiscard]] const Value& weight() const { return point_[0][3]; }

private:
  using Table = typename LineBasis<Field>::Table;

  /// Coefficient k of sum_i D B_i, D the points, or (step 1) their differences.
  void sum_up(const Table& basis, std::size_t count, std::size_t step, std::size_t k,
              Value* sum) const {
    std::fill_n(sum, 4, field_.zero());
    for (std::size_t i = 0; k < count && i < count; ++i) {
      for (std::size_t c = 0; c < 4; ++c) {
        const Value d = step == 0 ? net_[i][c] : field_.subtract(net_[i + 1][c], net_[i][c]);
        sum[c] = field_.multiply_add(basis[i][k], d, sum[c]);
      }
    }
  }

  const Field& field_;
  std::size_t order_;
  bool rational_;
  LineBasis<Field> basis_;
  Value net_[kMostTerms][4];
  Value point_[kMostTerms][4];
  Value slope_[kMostTerms][4];
};

/// The question how a curve bends: it has the factors of two tangents.
class BendQuestion {
public:
  explicit BendQuestion(const TangentQuestion& tangent) : tangent_(tangent) {}

  [[nodiscard]] const TangentQuestion& tangent() const { return tangent_; }
  [[nodiscard]] BoundedField field() const { return tangent_.field(); }
  [[nodiscard]] QuestionDigits digits() const {
    QuestionDigits all = tangent_.digits();
    all.coefficients = 2 * all.coefficients + 8; // there are at most 31 products of orders below 32
    return all;
  }
  /// Whether the curve is a line.
  [[nodiscard]] bool is_zero() const {
    return is_straight(tangent_.points(), tangent_.degree() + 1);
  }

private:
  const TangentQuestion& tangent_;
};

/// G x G' for the numerator G of the tangent: coefficient b is the sum of (j - i) G_i x G_j over
/// i < j, i + j = b + 1.
template <typename Field>
class BendSeries {
  using Value = typename Field::Value;

public:
  BendSeries(const Field& field, const BendQuestion& question)
      : field_(field), highest_(question.tangent().highest()), tangent_(field, question.tangent()) {
  }

  void coefficient(int order, Value vector[3]) const {
    std::fill_n(vector, 3, field_.zero());
    for (int i = std::max(0, order + 1 - highest_); 2 * i < order + 1; ++i) {
      const int j = order + 1 - i;
      Value a[3];
      Value b[3];
      tangent_.coefficient(i, a);
      tangent_.coefficient(j, b);
      Value product[3] = {field_.zero(), field_.zero(), field_.zero()};
      add_cross(field_, a, b, product);
      const Value factor = field_.integer(static_cast<std::uint32_t>(j - i));
      for (std::size_t c = 0; c < 3; ++c) {
        vector[c] = field_.multiply_add(factor, product[c], vector[c]);
      }
    }
  }

private:
  const Field& field_;
  int highest_;
  TangentSeries<Field> tangent_;
};

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

SIMDBEZIER_OF_BOTH_TYPES(resolve_tangent);

} // namespace simdbezier::detail
