// See curve/tangent_fallback.hpp. Rare samples only, so one readable scalar path for all of them.
#include "kernels/curve/tangent_fallback.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simdbezier::detail {
namespace {

struct Vector {
  double c[3] = {0, 0, 0};
};

double dot(const Vector& a, const Vector& b) {
  return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
}

double length(const Vector& a) { return std::sqrt(dot(a, a)); }

Vector cross(const Vector& a, const Vector& b) {
  return {{a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2],
           a.c[0] * b.c[1] - a.c[1] * b.c[0]}};
}

/// A derivative, of a size around 1, below which it is taken for rounding noise: far above the
/// noise of differences in double, far below what float control points can say.
constexpr double kNoise = 0x1p-40;

/// The derivatives of a curve at one parameter, relative to powers of two that make them about 1.
class Derivatives {
public:
  template <typename T>
  explicit Derivatives(const TangentQuery<T>& query)
      : degree_(query.shape->degree), rational_(query.shape->rational),
        x_(static_cast<double>(query.x)) {
    read(query);
    for (int order = 0; order <= kOrders; ++order) {
      differentiate(order);
    }
  }

  /// Binary exponent by which positions and derivatives have been scaled down.
  [[nodiscard]] int exponent() const { return exponent_; }
  /// Whether all control points are one.
  [[nodiscard]] bool is_point() const { return is_point_; }
  /// A rational curve has derivatives of all orders; those that exist of a polynomial of its degree
  /// are enough to tell its first one apart from zero.
  [[nodiscard]] int orders() const { return rational_ ? kOrders : std::min(degree_, kOrders); }
  /// C^(order) over a bound of its size, n!/(n-order)! 2^(order-1) differences.
  [[nodiscard]] Vector relative(int order) const {
    Vector a = at_[order];
    for (double& value : a.c) {
      value /= bound_[order];
    }
    return a;
  }
  [[nodiscard]] const Vector& at(int order) const { return at_[order]; }

private:
  static constexpr int kOrders = 2 * kMostDegree;

  template <typename T>
  void read(const TangentQuery<T>& query) {
    const CurveShape& shape = *query.shape;
    const std::size_t channels = shape.channels();
    const auto components = std::min<std::size_t>(static_cast<std::size_t>(shape.components), 3);
    const std::size_t near = x_ <= 0 ? 0 : static_cast<std::size_t>(degree_);
    double largest = 0;
    for (std::size_t i = 0; i < shape.order(); ++i) {
      for (std::size_t c = 0; c < components; ++c) {
        point_[i].c[c] =
            query.net.coordinate(i, channels, c) - query.net.coordinate(near, channels, c);
        largest = std::max(largest, std::fabs(point_[i].c[c]));
      }
      weight_[i] = shape.rational ? query.net.value((i + 1) * channels - 1) : 1.0;
    }
    is_point_ = largest == 0;
    exponent_ = is_point_ ? 0 : std::ilogb(largest);
    double most = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < shape.order(); ++i) {
      most = std::max(most, weight_[i]);
      least = std::min(least, weight_[i]);
    }
    for (std::size_t i = 0; i < shape.order(); ++i) {
      weight_[i] /= most;
      for (double& value : point_[i].c) {
        value = std::ldexp(value, -exponent_) * weight_[i];
      }
    }
    spread_ = most / least;
  }

  /// The order-th derivative of sum_i b_i B_i: differences, then de Casteljau's algorithm.
  template <typename Get>
  double polynomial(int order, Get get) const {
    if (order > degree_) {
      return 0;
    }
    double b[kMostOrder];
    for (int i = 0; i <= degree_; ++i) {
      b[i] = get(i);
    }
    double factor = 1;
    for (int k = 0; k < order; ++k) {
      factor *= degree_ - k;
      for (int i = 0; i < degree_ - k; ++i) {
        b[i] = b[i + 1] - b[i];
      }
    }
    const double t = 0.5 + x_;
    const double s = 0.5 - x_;
    for (int last = degree_ - order; last > 0; --last) {
      for (int i = 0; i < last; ++i) {
        b[i] = s * b[i] + t * b[i + 1];
      }
    }
    return factor * b[0];
  }

  /// w C = h, differentiated: C^(k) = (h^(k) - sum_i binomial(k,i) w^(i) C^(k-i)) / w.
  void differentiate(int order) {
    bound_[order] =
        order == 0 ? 1
                   : 2 * bound_[order - 1] *
                         (rational_ ? degree_ * spread_ * order : std::max(degree_ - order + 1, 1));
    weight_at_[order] =
        rational_ ? polynomial(order, [this](int i) { return weight_[i]; }) : (order == 0 ? 1 : 0);
    for (std::size_t c = 0; c < 3; ++c) {
      double value = polynomial(order, [this, c](int i) { return point_[i].c[c]; });
      double binomial = 1;
      for (int i = 1; rational_ && i <= order; ++i) {
        binomial = binomial * (order - i + 1) / i;
        value -= binomial * weight_at_[i] * at_[order - i].c[c];
      }
      at_[order].c[c] = value / weight_at_[0];
    }
  }

  int degree_;
  bool rational_;
  double x_;
  int exponent_ = 0;
  bool is_point_ = false;
  double spread_ = 1;         ///< largest weight over the smallest
  Vector point_[kMostOrder];  ///< homogeneous
  double weight_[kMostOrder]; ///< at most 1
  double weight_at_[kOrders + 1];
  double bound_[kOrders + 1];
  Vector at_[kOrders + 1];
};

double factorial(int n) {
  double product = 1;
  for (int k = 2; k <= n; ++k) {
    product *= k;
  }
  return product;
}

/// Of the curve scaled by 2^-exponent; first: C^(r).
double limit_curvature(const Derivatives& derivatives, int r) {
  const Vector& first = derivatives.at(r);
  for (int s = r + 1; s <= derivatives.orders(); ++s) {
    const double area = length(cross(derivatives.relative(r), derivatives.relative(s)));
    const bool parallel = area <= kNoise * length(derivatives.relative(r));
    if (parallel && r == 1 && s == 2) {
      // A plain formula: what it gives is small, and as good as any.
      return length(cross(first, derivatives.at(2))) / (dot(first, first) * length(first));
    }
    if (!parallel) {
      if (s != 2 * r) {
        return s < 2 * r ? std::numeric_limits<double>::infinity() : 0.0;
      }
      const double size = length(first);
      const double power = factorial(r - 1) * factorial(r - 1) / factorial(s - 1) * (s - r);
      return length(cross(first, derivatives.at(s))) * power / (size * size * size);
    }
  }
  return 0;
}

} // namespace

template <typename T>
void resolve_tangent(const TangentQuery<T>& query, TangentAnswer<T>& answer) {
  if (std::isnan(query.x)) {
    std::fill_n(answer.tangent, 3, std::numeric_limits<T>::quiet_NaN());
    answer.curvature = std::numeric_limits<T>::quiet_NaN();
    answer.status = SampleStatus::non_finite;
    return;
  }
  std::fill_n(answer.tangent, 3, T(0));
  answer.curvature = 0;
  answer.status = SampleStatus::degenerate;
  const Derivatives derivatives(query);
  if (derivatives.is_point()) {
    return;
  }
  int r = 1;
  while (r <= derivatives.orders() && length(derivatives.relative(r)) <= kNoise) {
    ++r;
  }
  if (r > derivatives.orders()) {
    return;
  }
  const Vector direction = derivatives.relative(r);
  const double size = length(direction);
  if (!std::isfinite(size)) {
    return; // a pole, far outside of the curve
  }
  const bool backwards = query.x > 0 && r % 2 == 0;
  for (std::size_t c = 0; c < 3; ++c) {
    answer.tangent[c] =
        static_cast<T>((backwards ? -direction.c[c] : direction.c[c]) / size) + T(0);
  }
  answer.curvature =
      static_cast<T>(std::ldexp(limit_curvature(derivatives, r), -derivatives.exponent()));
  answer.status = r == 1 ? SampleStatus::regular : SampleStatus::limit;
}

template void resolve_tangent(const TangentQuery<float>&, TangentAnswer<float>&);
template void resolve_tangent(const TangentQuery<double>&, TangentAnswer<double>&);

} // namespace simdbezier::detail
