// See separable_bound.hpp. With weights a_i b_j a patch is S = Y / (a b), and b is a constant along
// u. Its derivatives along u are, with G = Y' a - Y a',
//     S' = G / a^2,    S'' = (G' a - 2 G a') / a^3,
// polynomials over polynomials with positive Bernstein coefficients: written in one degree, the
// quotients of coefficients are the control points of a derivative, which lies in their hull. They
// are linear in the control points of S; along u and v at once, one direction is as constant for
// the other one as b is.
//
// Polynomials are held by scaled Bernstein coefficients, C(n,i) times the usual ones: a product is
// a convolution, and all factors of a derivative are whole numbers.
#include "src/mesh/bounds/separable_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace simdbezier::detail {
namespace {

constexpr std::size_t kOrders = kMostDegree + 1;

/// Of 300 roundings and fewer: those of a polynomial's coefficients, and of sums over a net.
constexpr double kCoefficientError = 300 * 0x1p-53;
/// Of a control point, in units of the patch's largest value.
constexpr double kPointError = 8 * 0x1p-53;
/// Weights that are farther from products are not taken for such.
constexpr double kMostDeparture = 1e-4;

/// A polynomial, beside the sum of the sizes of all terms of each coefficient, for rounding.
struct Polynomial {
  std::size_t degree;
  std::array<double, 3 * kOrders> at;
  std::array<double, 3 * kOrders> size;

  /// Zero.
  explicit Polynomial(std::size_t of_degree) : degree(of_degree) {
    std::fill_n(at.begin(), degree + 1, 0.0);
    std::fill_n(size.begin(), degree + 1, 0.0);
  }
};

Polynomial product(const Polynomial& f, const Polynomial& g) {
  Polynomial h(f.degree + g.degree);
  for (std::size_t i = 0; i <= f.degree; ++i) {
    for (std::size_t j = 0; j <= g.degree; ++j) {
      h.at[i + j] += f.at[i] * g.at[j];
      h.size[i + j] += f.size[i] * g.size[j];
    }
  }
  return h;
}

/// degree: 1 or more.
Polynomial derivative(const Polynomial& f) {
  Polynomial h(f.degree - 1);
  for (std::size_t i = 0; i <= h.degree; ++i) {
    const auto up = static_cast<double>(i + 1);
    const auto down = static_cast<double>(f.degree - i);
    h.at[i] = up * f.at[i + 1] - down * f.at[i];
    h.size[i] = up * f.size[i + 1] + down * f.size[i];
  }
  return h;
}

/// f - factor g, of one degree, written in the next degree.
Polynomial raised_difference(const Polynomial& f, double factor, const Polynomial& g) {
  Polynomial h(f.degree + 1);
  for (std::size_t i = 0; i <= f.degree; ++i) {
    const double value = f.at[i] - factor * g.at[i];
    const double size = f.size[i] + factor * g.size[i];
    for (const std::size_t k : {i, i + 1}) {
      h.at[k] += value;
      h.size[k] += size;
    }
  }
  return h;
}

/// The control points of a derivative along one direction: row k has the factors of the points.
struct DerivativeRows {
  std::size_t rows = 0;
  std::array<std::array<double, kOrders>, 3 * kOrders> factor;
  std::array<double, 3 * kOrders> size; ///< of a row's factors, all in all, for rounding

  void set_column(std::size_t i, const Polynomial& numerator, const Polynomial& denominator) {
    rows = numerator.degree + 1;
    for (std::size_t k = 0; k < rows; ++k) {
      factor[k][i] = numerator.at[k] / denominator.at[k];
      size[k] = (i == 0 ? 0 : size[k]) + numerator.size[k] / denominator.at[k];
    }
  }
};

/// The weights of one direction, and derivatives along it.
struct Direction {
  std::size_t order;
  std::array<double, kOrders> weight{};
  DerivativeRows first;
  DerivativeRows second;

  explicit Direction(std::size_t of_order) : order(of_order) {}

  void find_derivatives() {
    Polynomial a(order - 1);
    double binomial = 1;
    for (std::size_t i = 0; i < order; ++i) {
      a.at[i] = a.size[i] = binomial * weight[i];
      binomial = binomial * static_cast<double>(order - 1 - i) / static_cast<double>(i + 1);
    }
    const Polynomial slope = derivative(a);
    const Polynomial square = product(a, a);
    const Polynomial cube = product(square, a);
    for (std::size_t i = 0; i < order; ++i) {
      Polynomial point(a.degree); // a_i times the basis polynomial of a control point
      point.at[i] = point.size[i] = a.at[i];
      const Polynomial g =
          raised_difference(product(derivative(point), a), 1, product(point, slope));
      first.set_column(i, g, square);
      second.set_column(i, raised_difference(product(derivative(g), a), 2, product(g, slope)),
                        cube);
    }
  }
};

using Vector = std::array<double, 3>;

/// No vector is longer than so many times its largest component.
constexpr double kRootOfThree = 1.7320509;

/// Points of a patch, without weights, and what they may be off by.
struct Points {
  std::array<Vector, kOrders * kOrders> at; ///< as in VectorNet
  double largest = 0;
  double error = 0;
};

double length(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// The sum of factor[i] times the vector at from[i * step].
Vector combination(const std::array<double, kOrders>& factor, std::size_t order, const Vector* from,
                   std::size_t step) {
  Vector sum{};
  for (std::size_t i = 0; i < order; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += factor[i] * from[i * step][c];
    }
  }
  return sum;
}

/// What rounding may have taken from a vector whose factors have that size.
double doubt(double size, const Points& points) {
  return kRootOfThree * size * (kCoefficientError * points.largest + points.error);
}

/// The largest second derivative along one direction, in which points are `step` apart, over all
/// points of the other one.
double largest_along(const Direction& direction, std::size_t step, const Direction& other,
                     std::size_t other_step, const Points& points) {
  const DerivativeRows& rows = direction.second;
  double most = 0;
  for (std::size_t k = 0; k < rows.rows; ++k) {
    for (std::size_t j = 0; j < other.order; ++j) {
      const Vector found =
          combination(rows.factor[k], direction.order, points.at.data() + j * other_step, step);
      most = larger_bound(most, length(found) + doubt(rows.size[k], points));
    }
  }
  return most;
}

double largest_mixed(const Direction& u, const Direction& v, const Points& points) {
  double most = 0;
  std::array<Vector, kOrders> along_u;
  for (std::size_t k = 0; k < u.first.rows; ++k) {
    for (std::size_t j = 0; j < v.order; ++j) {
      along_u[j] = combination(u.first.factor[k], u.order, points.at.data() + j * u.order, 1);
    }
    for (std::size_t l = 0; l < v.first.rows; ++l) {
      const Vector found = combination(v.first.factor[l], v.order, along_u.data(), 1);
      most = larger_bound(most, length(found) + doubt(u.first.size[k] * v.first.size[l], points));
    }
  }
  return most;
}

} // namespace

double SeparableBound::at(const CellCounts& cells) const {
  const double u = step_slack(cells.nu) / cells.nu;
  const double v = step_slack(cells.nv) / cells.nv;
  return (uu * u * u + 2 * uv * u * v + vv * v * v) / 8 + off;
}

SeparableBound bound_separable(const VectorPatch& patch) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const VectorNet& net = patch.net;
  const double weight = net.at.front().x[3];
  const auto is_weight = [&](const ControlVector& w) { return w.x[3] == weight; };
  if (!patch.rational || std::all_of(net.at.begin(), net.at.end(), is_weight)) {
    return {kNone, kNone, kNone, kNone}; // polynomials have better bounds
  }
  Direction u(net.columns);
  Direction v(net.rows);
  for (std::size_t i = 0; i < u.order; ++i) {
    u.weight[i] = net(i, 0).x[3];
  }
  for (std::size_t j = 0; j < v.order; ++j) {
    v.weight[j] = net(0, j).x[3] / u.weight[0];
  }
  double departure = 0;
  for (std::size_t j = 0; j < v.order; ++j) {
    for (std::size_t i = 0; i < u.order; ++i) {
      departure =
          larger_bound(departure, std::fabs(net(i, j).x[3] / (u.weight[i] * v.weight[j]) - 1));
    }
    if (!(departure <= kMostDeparture)) {
      return {kNone, kNone, kNone, kNone};
    }
  }
  departure += 0x1p-50;
  Points points;
  for (std::size_t k = 0; k < net.at.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      points.at[k][c] = net.at[k].x[c] / net.at[k].x[3];
      points.largest = std::max(points.largest, std::fabs(points.at[k][c]));
    }
  }
  points.error = kPointError * patch.largest;
  u.find_derivatives();
  v.find_derivatives();
  // A weight that is off by a share d moves a point of the surface by d / (1 - d) of the diameter
  // at most, and so it does the corners of triangles. Points lie in a cube around their middle.
  const double diameter = 2 * kRootOfThree * points.largest;
  return {largest_along(u, 1, v, u.order, points), largest_mixed(u, v, points),
          largest_along(v, u.order, u, 1, points), 2 * departure / (1 - departure) * diameter};
}

} // namespace simdbezier::detail
