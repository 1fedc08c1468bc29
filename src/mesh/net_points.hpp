// Control points as points in space, whatever their form.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <simdbezier/control_nets.hpp>

namespace simdbezier::detail {

struct Point3 {
  double x[3];
};

inline Point3 operator-(const Point3& a, const Point3& b) noexcept {
  return {a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]};
}
inline Point3 operator+(const Point3& a, const Point3& b) noexcept {
  return {a.x[0] + b.x[0], a.x[1] + b.x[1], a.x[2] + b.x[2]};
}
inline double dot(const Point3& a, const Point3& b) noexcept {
  return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}
inline Point3 cross(const Point3& a, const Point3& b) noexcept {
  return {a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
          a.x[0] * b.x[1] - a.x[1] * b.x[0]};
}
inline bool is_finite(const Point3& a) noexcept { // a sum of large values would overflow
  return std::isfinite(a.x[0]) && std::isfinite(a.x[1]) && std::isfinite(a.x[2]);
}

/// Whether length() is above 0.
inline bool has_length(const Point3& a) noexcept {
  const bool has_square = dot(a, a) > 0;
  return has_square || (is_finite(a) && (a.x[0] != 0 || a.x[1] != 0 || a.x[2] != 0));
}

/// Scaled by a power of two, so that its largest value is between 1 and 2; vectors of 0 and those
/// that are not finite stay as they are.
inline Point3 scaled_to_one(const Point3& a, int& exponent) noexcept {
  const double largest = std::max({std::fabs(a.x[0]), std::fabs(a.x[1]), std::fabs(a.x[2])});
  exponent = 0;
  if (!(largest > 0) || !is_finite(a)) {
    return a;
  }
  exponent = std::ilogb(largest);
  return {std::scalbn(a.x[0], -exponent), std::scalbn(a.x[1], -exponent),
          std::scalbn(a.x[2], -exponent)};
}

/// The length of a vector, scaled where squares of very small or large values vanish or overflow.
inline double length(const Point3& a) noexcept {
  const double square = dot(a, a);
  if (square > 0x1p-900 && square < 0x1p900) {
    return std::sqrt(square);
  }
  int exponent = 0;
  const Point3 scaled = scaled_to_one(a, exponent);
  return std::scalbn(std::sqrt(dot(scaled, scaled)), exponent);
}

template <typename S>
const S* values_at(const ControlNets<S>& nets, std::size_t patch, std::ptrdiff_t i,
                   std::ptrdiff_t j) noexcept {
  return nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride +
         j * nets.row_stride + i * nets.point_stride;
}

/// Asks for a bicubic net before its turn: where nets are read one after the other, each would be
/// waited for.
template <typename S>
void ask_for_net(const ControlNets<S>& nets, std::size_t patch) noexcept {
  for (std::size_t k = 0; k < 48; k += 64 / sizeof(S)) {
    __builtin_prefetch(values_at(nets, patch, 0, 0) + k);
  }
}

/// A control point in space whose values begin somewhere.
template <typename S>
Point3 point_of(const ControlNets<S>& nets, const S* values) noexcept {
  Point3 point;
  for (std::ptrdiff_t c = 0; c < 3; ++c) {
    point.x[c] = static_cast<double>(values[c * nets.component_stride]);
  }
  if (nets.weights == Weights::homogeneous) {
    const auto divisor = static_cast<double>(values[3 * nets.component_stride]);
    for (double& x : point.x) {
      x /= divisor;
    }
  }
  return point;
}

/// The weight of a control point whose values begin somewhere; 1 where points have none.
template <typename S>
S weight_of(const ControlNets<S>& nets, const S* values) noexcept {
  return nets.weights == Weights::none ? S(1) : values[3 * nets.component_stride];
}

/// Control point i, j in space.
template <typename S>
Point3 point_at(const ControlNets<S>& nets, std::size_t patch, std::ptrdiff_t i,
                std::ptrdiff_t j) noexcept {
  return point_of(nets, values_at(nets, patch, i, j));
}

/// Calls visit for all control points of a patch.
template <typename S, typename Visit>
void for_points(const ControlNets<S>& nets, std::size_t patch, const Visit& visit) {
  for (std::ptrdiff_t j = 0; j <= nets.degree_v; ++j) {
    for (std::ptrdiff_t i = 0; i <= nets.degree_u; ++i) {
      visit(point_at(nets, patch, i, j));
    }
  }
}

/// The smallest box of some points.
class PointBox {
public:
  void include(const Point3& point) noexcept {
    for (std::size_t c = 0; c < 3; ++c) {
      low_[c] = std::min(low_[c], point.x[c]);
      high_[c] = std::max(high_[c], point.x[c]);
    }
  }
  [[nodiscard]] double low(std::size_t c) const noexcept { return low_[c]; }
  [[nodiscard]] double high(std::size_t c) const noexcept { return high_[c]; }
  [[nodiscard]] double middle(std::size_t c) const noexcept {
    return low_[c] + (high_[c] - low_[c]) / 2;
  }
  /// Whether a point is inside, or as near as a distance in each coordinate.
  [[nodiscard]] bool reaches(const Point3& point, double distance) const noexcept {
    bool near = true;
    for (std::size_t c = 0; c < 3; ++c) {
      near = near && point.x[c] >= low_[c] - distance && point.x[c] <= high_[c] + distance;
    }
    return near;
  }
  /// The longest side of the box; nan where a value is nan.
  [[nodiscard]] double longest() const noexcept {
    return std::max({high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]});
  }
  [[nodiscard]] double diagonal() const noexcept {
    return length(Point3{{std::max(high_[0] - low_[0], 0.0), std::max(high_[1] - low_[1], 0.0),
                          std::max(high_[2] - low_[2], 0.0)}});
  }

private:
  double low_[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high_[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
};

} // namespace simdbezier::detail
