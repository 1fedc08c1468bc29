// The cross product of a patch's tangents along a line of parameters, as a polynomial.
#pragma once

#include <algorithm>
#include <cstddef>

#include <simdbezier/control_nets.hpp>

#include "src/exact/exact_points.hpp"
#include "src/exact/leading_term.hpp"
#include "src/exact/line_basis.hpp"
#include "src/exact/zero_everywhere.hpp"

namespace simdbezier::detail {

/// A patch in space and the line from a sample to the patch's middle.
class NormalQuestion {
public:
  NormalQuestion(const GivenNet& net, std::size_t degree_u, std::size_t degree_v, double x,
                 double y)
      : points_(net, (degree_u + 1) * (degree_v + 1), 3), degree_u_(degree_u), degree_v_(degree_v),
        u_(LineParameter::to_middle(x, y, kParameterU)),
        v_(LineParameter::to_middle(y, x, kParameterV)) {}

  /// Makes the control points of a side one point, which the sample is nearest to.
  void merge_side(PatchEdge side) {
    const bool in_u = side == PatchEdge::v0 || side == PatchEdge::v1;
    const std::size_t last = in_u ? degree_u_ : degree_v_;
    const std::size_t first = side == PatchEdge::v1   ? degree_v_ * (degree_u_ + 1)
                              : side == PatchEdge::u1 ? degree_u_
                                                      : 0;
    for (std::size_t k = 0; k <= last; ++k) {
      points_.merge(first + k * (in_u ? 1 : degree_u_ + 1), nearest());
    }
  }

  [[nodiscard]] const ExactPoints& points() const { return points_; }
  [[nodiscard]] std::size_t degree_u() const { return degree_u_; }
  [[nodiscard]] std::size_t degree_v() const { return degree_v_; }
  [[nodiscard]] const LineParameter& u() const { return u_; }
  [[nodiscard]] const LineParameter& v() const { return v_; }

  [[nodiscard]] bool inside() const { return std::fabs(u_.x) <= 0.5 && std::fabs(v_.x) <= 0.5; }
  /// The control point that is nearest in parameters; beside an edge that is a point, that point.
  [[nodiscard]] std::size_t nearest() const {
    return nearest(v_.x, degree_v_) * (degree_u_ + 1) + nearest(u_.x, degree_u_);
  }
  /// The order of the last coefficient that can be other than zero.
  [[nodiscard]] int highest() const {
    const auto sum = static_cast<int>(degree_u_ + degree_v_);
    return points_.rational() ? 3 * sum - 2 : 2 * sum - 2;
  }

  [[nodiscard]] BoundedField field() const {
    return {points_.largest_point(), points_.largest_weight()};
  }
  [[nodiscard]] QuestionDigits digits() const {
    QuestionDigits all;
    points_.include_in(all.numbers[kPoint], all.numbers[kWeight]);
    u_.include_in(all.numbers[kParameterU]);
    v_.include_in(all.numbers[kParameterV]);
    const int net = points_.digits(all.numbers[kPoint], all.numbers[kWeight]);
    const int basis = LineParameter::digits(all.numbers[kParameterU], degree_u_) +
                      LineParameter::digits(all.numbers[kParameterV], degree_v_);
    // Differences have one digit more, cross products another, and there are three of these.
    all.coefficients = points_.rational()
                           ? 3 * basis + 2 * (net + 1) + all.numbers[kWeight].digits() + 1 + 4
                           : 2 * basis + 2 * (net + 1) + 1;
    return all;
  }

  /// Whether the patch is one point: doubles would form all coefficients to find that none is
  /// there. Most patches are told apart from a point by the first few of theirs.
  [[nodiscard]] bool is_point() const { return detail::is_point(points_, count()); }
  /// Whether there is no normal anywhere.
  [[nodiscard]] bool is_zero() const { return is_curve_like(points_, degree_u_, degree_v_); }

private:
  [[nodiscard]] std::size_t count() const { return (degree_u_ + 1) * (degree_v_ + 1); }
  static std::size_t nearest(double half_centred, std::size_t degree) {
    const double t = std::clamp(0.5 + half_centred, 0.0, 1.0);
    return static_cast<std::size_t>(t * static_cast<double>(degree) + 0.5);
  }

  ExactPoints points_;
  std::size_t degree_u_;
  std::size_t degree_v_;
  LineParameter u_;
  LineParameter v_;
};

/// With H = (h, w) homogeneous and subscripts for derivatives, over the degrees:
///     (w h_u - w_u h) x (w h_v - w_v h) = w ( w h_u x h_v + w_v h x h_u + w_u h_v x h ),
/// and the polynomial in brackets has the direction of du x dv wherever w > 0. Without weights it
/// is h_u x h_v. Everything is summed up from differences of control points, so that equal points
/// give zeros, coefficient by coefficient, as far as the caller asks.
template <typename Field>
class NormalSeries {
  using Value = typename Field::Value;
  static constexpr std::size_t kMostTerms = 2 * kMostOrder;

public:
  NormalSeries(const Field& field, const NormalQuestion& question)
      : field_(field), order_u_(question.degree_u() + 1), order_v_(question.degree_v() + 1),
        rational_(question.points().rational()), u_(field, question.u(), question.degree_u()),
        v_(field, question.v(), question.degree_v()) {
    const std::size_t origin = question.nearest();
    for (std::size_t k = 0; k < order_u_ * order_v_; ++k) {
      question.points().place(field, k, origin, net_[k]);
    }
  }

  /// Coefficients have to be asked for in order, from 0 on.
  void coefficient(int order, Value vector[3]) {
    const auto k = static_cast<std::size_t>(order);
    expand(k);
    if (!rational_) {
      clear(vector, 3);
      add_crosses(du_, dv_, k, vector);
      return;
    }
    clear(uv_[k], 3);
    clear(pu_[k], 3);
    clear(vp_[k], 3);
    add_crosses(du_, dv_, k, uv_[k]);
    add_crosses(point_, du_, k, pu_[k]);
    add_crosses(dv_, point_, k, vp_[k]);
    clear(vector, 3);
    for (std::size_t i = 0; i <= k && i < kMostTerms; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        vector[c] = field_.multiply_add(point_[i][3], uv_[k - i][c], vector[c]);
        vector[c] = field_.multiply_add(dv_[i][3], pu_[k - i][c], vector[c]);
        vector[c] = field_.multiply_add(du_[i][3], vp_[k - i][c], vector[c]);
      }
    }
  }

  /// The sample's weight, once coefficient 0 has been asked for; rational patches only.
  [[nodiscard]] const Value& weight() const { return point_[0][3]; }

private:
  /// Coefficients of a tangent, or of the surface: homogeneous, [order][channel].
  using Terms = Value[kMostTerms][4];
  using Table = typename LineBasis<Field>::Table;

  void clear(Value* values, std::size_t count) const { std::fill_n(values, count, field_.zero()); }
  [[nodiscard]] std::size_t channels() const { return rational_ ? 4 : 3; }

  /// The next coefficient of all of them.
  void expand(std::size_t k) {
    if (k >= kMostTerms) {
      return;
    }
    sum_up(u_.lower(), order_u_ - 1, v_.upper(), order_v_, 1, k, du_[k]);
    sum_up(u_.upper(), order_u_, v_.lower(), order_v_ - 1, order_u_, k, dv_[k]);
    if (rational_) {
      sum_up(u_.upper(), order_u_, v_.upper(), order_v_, 0, k, point_[k]);
    }
  }

  /// Coefficient k of sum_j sum_i D B_i B_j, D the net's points, or (step) their differences.
  void sum_up(const Table& u, std::size_t count_u, const Table& v, std::size_t count_v,
              std::size_t step, std::size_t k, Value* sum) const {
    clear(sum, 4);
    for (std::size_t j = 0; j < count_v; ++j) {
      for (std::size_t i = 0; i < count_u; ++i) {
        Value factor = field_.zero();
        for (std::size_t b = 0; b <= k && b < count_v; ++b) {
          if (k - b < count_u) {
            factor = field_.multiply_add(u[i][k - b], v[j][b], factor);
          }
        }
        if (field_.vanishes(factor)) {
          continue;
        }
        const Value* const at = net_[j * order_u_ + i];
        for (std::size_t c = 0; c < channels(); ++c) {
          const Value d = step == 0 ? at[c] : field_.subtract(at[4 * step + c], at[c]);
          sum[c] = field_.multiply_add(factor, d, sum[c]);
        }
      }
    }
  }

  /// Adds coefficient k of a x b.
  void add_crosses(const Terms& a, const Terms& b, std::size_t k, Value* sum) const {
    for (std::size_t i = 0; i <= k; ++i) {
      if (i < kMostTerms && k - i < kMostTerms) {
        add_cross(field_, a[i], b[k - i], sum);
      }
    }
  }

  const Field& field_;
  std::size_t order_u_;
  std::size_t order_v_;
  bool rational_;
  LineBasis<Field> u_;
  LineBasis<Field> v_;
  Value net_[kMostOrder * kMostOrder][4];
  Terms du_;
  Terms dv_;
  Terms point_;
  Value uv_[3 * kMostTerms][3]; ///< cross products
  Value pu_[3 * kMostTerms][3];
  Value vp_[3 * kMostTerms][3];
};

} // namespace simdbezier::detail
