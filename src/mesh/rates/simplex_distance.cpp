// See simplex_distance.hpp.
#include "src/mesh/rates/simplex_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simdbezier::detail {
namespace {

/// A bound may be above the largest distance found by this factor.
constexpr double kCloseEnough = 1.125;
/// Of one net; what is left then is bounded by its control points.
constexpr std::size_t kMostHalvings = 64;

} // namespace

void SimplexNet::resize(std::size_t new_degree, std::size_t new_components, bool is_triangle) {
  degree = new_degree;
  components = new_components;
  triangle = is_triangle;
  at.resize((degree + 1) * (is_triangle ? degree + 2 : 2) / 2 * (components + 1));
}

FlatSimplex::FlatSimplex(const SimplexNet& net) : components_(net.components) {
  const double* const first = net.point(0, 0);
  const double* const others[2] = {net.point(0, net.degree),
                                   net.triangle ? net.point(net.degree, 0) : first};
  for (std::size_t c = 0; c < components_; ++c) {
    origin_[c] = first[c] / first[components_];
    for (std::size_t k = 0; k < 2; ++k) {
      side_[k][c] = others[k][c] / others[k][components_] - origin_[c];
    }
  }
  dot_[0] = dot_[1] = dot_[2] = 0;
  for (std::size_t c = 0; c < components_; ++c) {
    dot_[0] += side_[0][c] * side_[0][c];
    dot_[1] += side_[0][c] * side_[1][c];
    dot_[2] += side_[1][c] * side_[1][c];
  }
}

double FlatSimplex::distance(const double* point) const {
  std::array<double, kMostComponents> q;
  double r[2] = {0, 0};
  for (std::size_t c = 0; c < components_; ++c) {
    q[c] = point[c] / point[components_] - origin_[c];
    r[0] += q[c] * side_[0][c];
    r[1] += q[c] * side_[1][c];
  }
  // The nearest point of the plane, or else of one of three sides. Whatever rounding does to the
  // choice, it is a point of the simplex whose distance is taken.
  const double determinant = dot_[0] * dot_[2] - dot_[1] * dot_[1];
  double s = (r[0] * dot_[2] - r[1] * dot_[1]) / determinant;
  double t = (r[1] * dot_[0] - r[0] * dot_[1]) / determinant;
  if (!(determinant > 0 && s >= 0 && t >= 0 && s + t <= 1)) {
    const auto along = [](double wanted, double all) {
      return all > 0 ? std::clamp(wanted / all, 0.0, 1.0) : 0.0;
    };
    const double third = along(r[1] - r[0] - dot_[1] + dot_[0], dot_[0] - 2 * dot_[1] + dot_[2]);
    const double places[3][2] = {
        {along(r[0], dot_[0]), 0}, {0, along(r[1], dot_[2])}, {1 - third, third}};
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : places) {
      const double square =
          a * (a * dot_[0] - 2 * r[0]) + b * (b * dot_[2] - 2 * r[1]) + 2 * a * b * dot_[1];
      if (square < least) {
        least = square;
        s = a;
        t = b;
      }
    }
  }
  double square = 0;
  for (std::size_t c = 0; c < components_; ++c) {
    const double d = q[c] - s * side_[0][c] - t * side_[1][c];
    square += d * d;
  }
  return std::sqrt(square);
}

double SimplexDistance::bound(const SimplexNet& net, const FlatSimplex& flat, double enough,
                              double stop, std::size_t levels) {
  levels_ = levels;
  flat_ = &flat;
  enough_ = enough;
  stop_ = stop;
  found_ = 0;
  halvings_ = 0;
  row_.resize((net.degree + 1) * (net.components + 1));
  return bound_piece(net, 0);
}

double SimplexDistance::bound_piece(const SimplexNet& piece, std::size_t level) {
  const std::size_t channels = piece.components + 1;
  double most = 0;
  for (std::size_t k = 0; k < piece.at.size(); k += channels) {
    most = std::max(most, flat_->distance(piece.at.data() + k));
  }
  if (most <= std::max(enough_, kCloseEnough * found_) || level == levels_ ||
      halvings_ == kMostHalvings) {
    enough_ = std::max(enough_, most);
    return most;
  }
  ++halvings_;
  SimplexNet(&halves)[2] = halves_[level];
  halve(piece, halves);
  const double* const middle =
      piece.triangle ? halves[0].point(piece.degree, 0) : halves[1].point(0, 0);
  found_ = std::max(found_, flat_->distance(middle));
  if (found_ > stop_) {
    return std::numeric_limits<double>::infinity();
  }
  most = bound_piece(halves[0], level + 1);
  return most <= stop_ ? std::max(most, bound_piece(halves[1], level + 1)) : most;
}

/// Halves row 0 and all that is parallel to it. Of a triangle, both halves have the new point as
/// their last row, so that sides are halved in turns.
void SimplexDistance::halve(const SimplexNet& piece, SimplexNet (&halves)[2]) {
  const std::size_t channels = piece.components + 1;
  for (SimplexNet& half : halves) {
    half.resize(piece.degree, piece.components, piece.triangle);
  }
  const auto put = [&](SimplexNet& half, std::size_t row, std::size_t i, const double* point) {
    std::copy_n(point, channels, half.point(row, i));
  };
  const std::size_t rows = piece.triangle ? piece.degree + 1 : 1;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t degree = piece.degree - row;
    std::copy_n(piece.point(row, 0), (degree + 1) * channels, row_.data());
    for (std::size_t step = 0; step <= degree; ++step) {
      const double* const last = row_.data() + (degree - step) * channels;
      if (piece.triangle) {
        put(halves[0], step, row, row_.data());
        put(halves[1], step, row, last);
      } else {
        put(halves[0], 0, step, row_.data());
        put(halves[1], 0, degree - step, last);
      }
      for (double* value = row_.data(); value < last; ++value) {
        *value = (*value + value[channels]) / 2;
      }
    }
  }
}

void cut_curve(double* points, std::size_t count, std::size_t step, std::size_t channels, double a,
               double b) {
  const auto mix = [&](double* to, const double* from, double share) {
    for (std::size_t c = 0; c < channels; ++c) {
      to[c] = (1 - share) * to[c] + share * from[c];
    }
  };
  for (std::size_t r = 1; r < count; ++r) { // from 0 to b
    for (std::size_t k = count - 1; k >= r; --k) {
      mix(points + k * step, points + (k - 1) * step, 1 - b);
    }
  }
  for (std::size_t r = 1; r < count; ++r) { // of that, from a to its end
    for (std::size_t k = 0; k + r < count; ++k) {
      mix(points + k * step, points + (k + 1) * step, a / b);
    }
  }
}

double NetCorner::motion(double s, double t) const {
  // The surface is the mean of control points by their weights times Bernstein polynomials.
  const auto basis = [](std::size_t degree, double x, double(&out)[kMostDegree + 1]) {
    out[0] = 1; // all are divided by the first one
    for (std::size_t k = 0; k < degree; ++k) {
      out[k + 1] = out[k] * x * static_cast<double>(degree - k) / static_cast<double>(k + 1);
    }
  };
  double along[kMostDegree + 1];
  double across[kMostDegree + 1];
  basis(columns - 1, s / (1 - s), along);
  basis(rows - 1, t / (1 - t), across);
  double sum = 0;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const double* const point = corner + static_cast<std::ptrdiff_t>(i) * steps[0] +
                                  static_cast<std::ptrdiff_t>(j) * steps[1];
      double square = 0;
      for (std::size_t c = 0; c < components; ++c) {
        const double d = point[c] / point[components] - corner[c] / corner[components];
        square += d * d;
      }
      sum += along[i] * across[j] * point[components] * std::sqrt(square);
    }
  }
  return sum / corner[components];
}

} // namespace simdbezier::detail
