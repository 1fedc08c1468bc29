// See normal_bends.hpp.
#include "src/mesh/bounds/normal_bends.hpp"

#include <algorithm>
#include <cmath>

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
              static_cast<double>(k / kDerivatives) / (kBendSamples - 1));
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
    ControlVector point = derivative(0, 0);
    const double weight = patch.rational ? point.x[3] : 1;
    // Of X - S w for the point S = X / w: the surface's own times w, but for tangents.
    const auto around = [&](std::size_t of_u, std::size_t of_v) {
      ControlVector v = derivative(of_u, of_v);
      for (std::size_t c = 0; patch.rational && c < 3; ++c) {
        v.x[c] -= point.x[c] / weight * v.x[3];
      }
      return Point3{{v.x[0], v.x[1], v.x[2]}};
    };
    const Point3 u = around(1, 0);
    const Point3 v = around(0, 1);
    const Point3 normal = cross(u, v);
    const double length = std::sqrt(dot(normal, normal)) * weight;
    if (length * length > 1e-12 * dot(u, u) * dot(v, v) * weight * weight) {
      at_[k] = {dot(normal, around(2, 0)) / length, dot(normal, around(1, 1)) / length,
                dot(normal, around(0, 2)) / length};
    }
  }
}

double NormalBends::at(const CellCounts& cells) const {
  const double u = 1.0 / cells.nu;
  const double v = 1.0 / cells.nv;
  const double mixed = 2 * u * v;
  double most = 0;
  for (std::size_t from_u = 0; from_u < 2; ++from_u) {
    for (std::size_t from_v = 0; from_v < 2; ++from_v) {
      double rising = 0;
      double falling = 0;
      for (std::size_t i = from_u; i <= from_u + 1; ++i) {
        for (std::size_t j = from_v; j <= from_v + 1; ++j) {
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
  Bend largest;
  for (const Bend& bend : at_) {
    largest = {std::max(largest.uu, std::fabs(bend.uu)), std::max(largest.uv, std::fabs(bend.uv)),
               std::max(largest.vv, std::fabs(bend.vv))};
  }
  const double limit = 8 * distance;
  return std::max({2 * (std::sqrt(largest.uu * largest.vv) + largest.uv) / limit,
                   std::sqrt(largest.uu / limit), std::sqrt(largest.vv / limit)});
}

} // namespace simdbezier::detail
