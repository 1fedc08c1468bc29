#include "src/mesh/bounds/chord_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simdbezier::detail {
namespace {

/// Of one net; what is left then is bounded by its control points.
constexpr std::size_t kMostHalvings = 64;

} // namespace

void CurveNet::resize(std::size_t new_degree, std::size_t new_components) {
  degree = new_degree;
  components = new_components;
  at.resize((degree + 1) * (components + 1));
}

Chord::Chord(const CurveNet& net) : components_(net.components) {
  const double* const first = net.point(0);
  const double* const last = net.point(net.degree);
  for (std::size_t c = 0; c < components_; ++c) {
    origin_[c] = first[c] / first[components_];
    along_[c] = last[c] / last[components_] - origin_[c];
    square_ += along_[c] * along_[c];
  }
}

double Chord::distance(const double* point) const {
  std::array<double, kMostComponents> q;
  double dot = 0;
  for (std::size_t c = 0; c < components_; ++c) {
    q[c] = point[c] / point[components_] - origin_[c];
    dot += q[c] * along_[c];
  }
  // Whatever rounding does to it, it is a point of the segment whose distance is taken.
  const double nearest = square_ > 0 ? std::clamp(dot / square_, 0.0, 1.0) : 0;
  double square = 0;
  for (std::size_t c = 0; c < components_; ++c) {
    const double d = q[c] - nearest * along_[c];
    square += d * d;
  }
  return std::sqrt(square);
}

double ChordDistance::bound(const CurveNet& net, const Chord& chord, double enough, double stop) {
  chord_ = &chord;
  enough_ = enough;
  stop_ = stop;
  found_ = 0;
  halvings_ = 0;
  return bound_piece(net, 0);
}

double ChordDistance::bound_piece(const CurveNet& piece, std::size_t level) {
  const std::size_t channels = piece.components + 1;
  double most = 0;
  for (std::size_t k = 0; k <= piece.degree; ++k) {
    most = std::max(most, chord_->distance(piece.point(k)));
  }
  if (most <= std::max(enough_, kCloseEnough * found_) || level == kDeepest ||
      halvings_ == kMostHalvings) {
    enough_ = std::max(enough_, most);
    return most;
  }
  ++halvings_;
  CurveNet(&halves)[2] = halves_[level];
  halves[0].resize(piece.degree, piece.components);
  halves[1] = piece;
  halve_rows(halves[1].at.data(), halves[0].at.data(), piece.degree + 1, channels, channels);
  found_ = std::max(found_, chord_->distance(halves[1].point(0)));
  if (found_ > stop_) {
    return std::numeric_limits<double>::infinity();
  }
  most = bound_piece(halves[0], level + 1);
  return most <= stop_ ? std::max(most, bound_piece(halves[1], level + 1)) : most;
}

void halve_rows(double* rows, double* first, std::size_t count, std::size_t step,
                std::size_t width) {
  for (std::size_t r = 0; r < count; ++r) {
    std::copy_n(rows, width, first + r * step);
    for (std::size_t k = 0; k + r + 1 < count; ++k) {
      double* const row = rows + k * step;
      for (std::size_t c = 0; c < width; ++c) {
        row[c] = (row[c] + row[c + step]) / 2;
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
