// The first two coefficients of NormalSeries for polynomial patches, in plain doubles: nearly all
// samples that need a second look are decided by one of them, in a quarter of the time.
//
// Source: N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, chapter 3.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/exact/leading_term.hpp"
#include "src/exact/line_basis.hpp"
#include "src/storage/given_points.hpp"

namespace simdbezier::detail {

/// Differences of the control points of a polynomial patch, which BoundedField has brought to a
/// size of about 1.
class ScaledNet {
public:
  /// [point][component] to the next point in u, and in v.
  using Differences = double[kMostOrder * kMostOrder][3];

  void read(const GivenNet& net, std::size_t columns, std::size_t rows) {
    double largest = 0;
    for (std::size_t k = 0; k < 3 * columns * rows; ++k) {
      largest = std::max(largest, std::fabs(net.value(k)));
    }
    const BoundedField field(largest, 0);
    is_usual_ = true;
    for (std::size_t k = 0; k < columns * rows; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto at = [&](std::size_t point) {
          return field.number(kPoint, net.value(3 * point + c)).value;
        };
        const double point = at(k);
        along_u_[k][c] = (k + 1) % columns == 0 ? 0 : usual(at(k + 1) - point);
        along_v_[k][c] = k / columns + 1 == rows ? 0 : usual(at(k + columns) - point);
      }
    }
  }
  /// Whether no difference is so small that products with it could underflow.
  [[nodiscard]] bool is_usual() const { return is_usual_; }
  [[nodiscard]] const Differences& along_u() const { return along_u_; }
  [[nodiscard]] const Differences& along_v() const { return along_v_; }

private:
  double usual(double difference) {
    is_usual_ = is_usual_ && (difference == 0 || std::fabs(difference) >= 0x1p-60);
    return difference;
  }

  Differences along_u_;
  Differences along_v_;
  bool is_usual_ = false;
};

/// The values are those of NormalSeries, operation by operation; its bounds are replaced by one for
/// each sum, from the sum of the terms' sizes. Where something could underflow, or a sample is
/// outside of the patch, nothing is said.
class NormalStart {
public:
  NormalStart(const ScaledNet& net, std::size_t degree_u, std::size_t degree_v,
              const LineParameter& u, const LineParameter& v)
      : net_(net), u_(u, degree_u), v_(v, degree_v), columns_(degree_u + 1), rows_(degree_v + 1),
        unit_(kTwiceUnit * static_cast<double>(3 * (degree_u + degree_v) + 4 + columns_ * rows_)) {}

  /// The first coefficient that is not zero, if it is one of these two and certain.
  [[nodiscard]] bool find(double tolerance, LeadingTerm& term) {
    if (!net_.is_usual() || !u_.is_usual() || !v_.is_usual()) {
      return false;
    }
    u_.expand();
    v_.expand();
    return find_in_doubles(*this, 0, 1, tolerance, term) && term.order >= 0;
  }

  /// Order 0 and then 1.
  void coefficient(int order, Bounded vector[3]) {
    sum_up(u_.lower(), columns_ - 1, v_.upper(), rows_, net_.along_u(), order, du_[order]);
    sum_up(u_.upper(), columns_, v_.lower(), rows_ - 1, net_.along_v(), order, dv_[order]);
    const BoundedField field(1, 1);
    std::fill_n(vector, 3, BoundedField::zero());
    for (int i = 0; i <= order; ++i) {
      add_cross(field, du_[i], dv_[order - i], vector);
    }
  }

private:
  /// A factor of 2 covers the roundings of the bound itself.
  static constexpr double kTwiceUnit = 0x1p-52;
  /// Smaller factors are left to the general way, so that no product underflows: polynomials of
  /// degree 15 are at least this to the power of 15, or 0.
  static constexpr double kSmallest = 0x1p-28;

  /// Coefficients 0 and 1 in tau of all Bernstein polynomials of one degree, and what the sizes of
  /// the terms of coefficient 1 come to; those of coefficient 0 are not negative. Polynomial i has
  /// the place i + 1, between zeros.
  struct Polynomials {
    double value[kMostOrder + 1];
    double slope[kMostOrder + 1];
    double slope_size[kMostOrder + 1];
  };

  /// As LineBasis.
  class Basis {
  public:
    Basis(const LineParameter& at, std::size_t degree)
        : degree_(degree), low_(0.5 - at.x), high_(0.5 + at.x), step_(at.d) {}

    [[nodiscard]] bool is_usual() const {
      return is_usual(low_) && is_usual(high_) && is_usual(std::fabs(step_));
    }
    [[nodiscard]] const Polynomials& upper() const { return upper_; } ///< of degree n
    [[nodiscard]] const Polynomials& lower() const { return lower_; } ///< of degree n - 1

    void expand() {
      const double step_size = std::fabs(step_);
      std::fill_n(upper_.value, degree_ + 2, 0.0);
      std::fill_n(upper_.slope, degree_ + 2, 0.0);
      std::fill_n(upper_.slope_size, degree_ + 2, 0.0);
      upper_.value[1] = 1;
      for (std::size_t n = 1; n <= degree_; ++n) {
        if (n == degree_) {
          std::copy_n(upper_.value, n + 1, lower_.value);
          std::copy_n(upper_.slope, n + 1, lower_.slope);
          std::copy_n(upper_.slope_size, n + 1, lower_.slope_size);
        }
        double* const value = upper_.value + 1;
        double* const slope = upper_.slope + 1;
        double* const size = upper_.slope_size + 1;
        for (std::size_t i = n + 1; i-- > 0;) {
          const double before = value[static_cast<std::ptrdiff_t>(i) - 1];
          const double slope_before = slope[static_cast<std::ptrdiff_t>(i) - 1];
          const double size_before = size[static_cast<std::ptrdiff_t>(i) - 1];
          slope[i] = slope[i] * low_ - value[i] * step_ + slope_before * high_ + before * step_;
          size[i] = size[i] * low_ + size_before * high_ + (value[i] + before) * step_size;
          value[i] = value[i] * low_ + before * high_;
        }
      }
    }

  private:
    [[nodiscard]] static bool is_usual(double value) { return value == 0 || value >= kSmallest; }

    std::size_t degree_;
    double low_;
    double high_;
    double step_;
    Polynomials upper_;
    Polynomials lower_;
  };

  /// Coefficient k of sum_j sum_i D B_i B_j.
  void sum_up(const Polynomials& u, std::size_t count_u, const Polynomials& v, std::size_t count_v,
              const ScaledNet::Differences& differences, int k, Bounded sum[3]) const {
    double x = 0;
    double y = 0;
    double z = 0;
    double size[3] = {0, 0, 0};
    for (std::size_t j = 1; j <= count_v; ++j) {
      for (std::size_t i = 1; i <= count_u; ++i) {
        const double factor =
            k == 0 ? u.value[i] * v.value[j] : u.slope[i] * v.value[j] + u.value[i] * v.slope[j];
        const double factor_size =
            k == 0 ? factor : u.slope_size[i] * v.value[j] + u.value[i] * v.slope_size[j];
        if (factor_size == 0) {
          continue;
        }
        const double* const d = differences[(j - 1) * columns_ + i - 1];
        x += factor * d[0];
        y += factor * d[1];
        z += factor * d[2];
        size[0] += factor_size * std::fabs(d[0]);
        size[1] += factor_size * std::fabs(d[1]);
        size[2] += factor_size * std::fabs(d[2]);
      }
    }
    sum[0] = {x, unit_ * size[0]};
    sum[1] = {y, unit_ * size[1]};
    sum[2] = {z, unit_ * size[2]};
  }

  const ScaledNet& net_;
  Basis u_;
  Basis v_;
  std::size_t columns_;
  std::size_t rows_;
  double unit_;
  Bounded du_[2][3];
  Bounded dv_[2][3];
};

} // namespace simdbezier::detail
