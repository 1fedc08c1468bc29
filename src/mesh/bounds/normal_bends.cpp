#include "src/mesh/bounds/normal_bends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/mesh/net_points.hpp"

namespace simdbezier::detail {
namespace {

constexpr std::size_t kDerivatives = 3; ///< from none to the second

/// Of all Bernstein polynomials of one degree at t.
void put_basis(double* b, std::size_t degree, std::size_t derivative, double t) {
  std::fill_n(b, degree + 1, 0.0);
  if (derivative > degree) {
    return;
  }
  b[0] = 1;
  for (std::size_t n = 1; n <= degree; ++n) {
    const bool differs = n + derivative > degree;
    for (std::size_t i = n + 1; i-- > 0;) {
      const double before = i > 0 ? b[i - 1] : 0;
      b[i] = differs ? static_cast<double>(n) * (before - b[i]) : (1 - t) * b[i] + t * before;
    }
  }
}

std::vector<double> basis_values(std::size_t points) {
  std::vector<double> all(kBendSamples * kDerivatives * points);
  for (std::size_t k = 0; k < kBendSamples * kDerivatives; ++k) {
    put_basis(all.data() + k * points, points - 1, k % kDerivatives,
              (static_cast<double>(k / kDerivatives) + 0.5) / kBendSamples);
  }
  return all;
}

ControlVector mean(const double* factors, const ControlVector* from, std::size_t count) {
  ControlVector sum{};
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t c = 0; c < 4; ++c) {
      sum.x[c] += factors[k] * from[k].x[c];
    }
  }
  return sum;
}

/// A derivative of X - S w for the point S = X / w: the surface's own times w, but for tangents.
Point3 around(const ControlVector& at, const ControlVector& derivative) {
  const double share = derivative.x[3] / at.x[3];
  return {{derivative.x[0] - at.x[0] * share, derivative.x[1] - at.x[1] * share,
           derivative.x[2] - at.x[2] * share}};
}

/// The largest second derivative of a side out of its tangents, at samples.
double side_bend(const double* factors, const ControlVector* first, std::size_t step,
                 std::size_t count) {
  std::array<ControlVector, kMostDegree + 1> points;
  for (std::size_t i = 0; i < count; ++i) {
    points[i] = first[i * step];
  }
  double most = 0;
  for (std::size_t k = 0; k < kBendSamples; ++k, factors += kDerivatives * count) {
    const ControlVector at = mean(factors, points.data(), count);
    const Point3 tangent = around(at, mean(factors + count, points.data(), count));
    const Point3 second = around(at, mean(factors + 2 * count, points.data(), count));
    const Point3 bend = cross(tangent, second);
    const double square = dot(tangent, tangent);
    most = square > 0 ? std::max(most, std::sqrt(dot(bend, bend) / square) / at.x[3]) : most;
  }
  return most;
}

} // namespace

BendSamples::BendSamples(std::size_t columns, std::size_t rows)
    : columns_(columns), rows_(rows), along_u_(basis_values(columns)),
      along_v_(basis_values(rows)) {}

NormalBends::NormalBends(const BendSamples& samples, const VectorPatch& patch) {
  const VectorNet& net = patch.net;
  std::array<std::array<ControlVector, kMostDegree + 1>, kDerivatives> column;
  for (std::size_t k = 0; k < at_.size(); ++k) {
    if (k % kBendSamples == 0) {
      for (std::size_t d = 0; d < kDerivatives; ++d) {
        for (std::size_t j = 0; j < net.rows; ++j) {
          column[d][j] =
              mean(&samples.along_u_[(k / kBendSamples * kDerivatives + d) * net.columns],
                   &net(0, j), net.columns);
        }
      }
    }
    const auto derivative = [&](std::size_t of_u, std::size_t of_v) {
      return mean(&samples.along_v_[(k % kBendSamples * kDerivatives + of_v) * net.rows],
                  column[of_u].data(), net.rows);
    };
    const ControlVector point = derivative(0, 0);
    const double weight = point.x[3];
    const auto vector = [&](std::size_t of_u, std::size_t of_v) {
      return around(point, derivative(of_u, of_v));
    };
    const Point3 u = vector(1, 0);
    const Point3 v = vector(0, 1);
    const Point3 normal = cross(u, v);
    const double length = std::sqrt(dot(normal, normal)) * weight;
    if (length * length > 1e-12 * dot(u, u) * dot(v, v) * weight * weight) {
      at_[k] = {dot(normal, vector(2, 0)) / length, dot(normal, vector(1, 1)) / length,
                dot(normal, vector(0, 2)) / length};
    }
  }
  for (const bool end : {false, true}) {
    const double u =
        side_bend(samples.along_u_.data(), &net(0, end ? net.rows - 1 : 0), 1, net.columns);
    const double v = side_bend(samples.along_v_.data(), &net(end ? net.columns - 1 : 0, 0),
                               net.columns, net.rows);
    side_uu_ = std::max(side_uu_, u);
    side_vv_ = std::max(side_vv_, v);
  }
}

double NormalBends::at(double u, double v) const {
  constexpr std::size_t kHalf = kBendSamples / 2;
  const double mixed = 2 * u * v;
  double most = std::max(side_uu_ * u * u, side_vv_ * v * v);
  for (std::size_t from_u = 0; from_u < kBendSamples; from_u += kHalf) {
    for (std::size_t from_v = 0; from_v < kBendSamples; from_v += kHalf) {
      double rising = 0;
      double falling = 0;
      for (std::size_t i = from_u; i < from_u + kHalf; ++i) {
        for (std::size_t j = from_v; j < from_v + kHalf; ++j) {
          const Bend& bend = at_[i * kBendSamples + j];
          const double uu = bend.uu * u * u;
          const double vv = bend.vv * v * v;
          const double uv = bend.uv * mixed;
          most = std::max({most, std::fabs(uu), std::fabs(vv)});
          rising = std::max(rising, std::fabs(uu + uv + vv));
          falling = std::max(falling, std::fabs(uu - uv + vv));
        }
      }
      most = std::max(most, std::min(rising, falling));
    }
  }
  return most / 8;
}

double NormalBends::fewest(double distance) const {
  double least = std::numeric_limits<double>::infinity();
  for (int k = -4; k <= 4; ++k) { // cells of several shapes
    const double shape = std::scalbn(1.0, k);
    const double cells = at(1 / shape, shape) / distance;
    const double root = std::sqrt(cells);
    least = std::min(least, std::max(root * shape, 1.0) * std::max(root / shape, 1.0));
  }
  return least;
}

} // namespace simdbezier::detail
