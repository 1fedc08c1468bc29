// Sides of patches as curves: their points, parts, and parameters.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "src/mesh/net_points.hpp"
#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {

/// A value for each control point of a side. Nothing is allocated, so that sides can be compared
/// where a lack of memory could not be reported.
template <typename Value>
class SideValues {
public:
  void push_back(const Value& value) noexcept { values_[size_++] = value; }
  void clear() noexcept { size_ = 0; }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] Value* begin() noexcept { return values_.data(); }
  [[nodiscard]] Value* end() noexcept { return begin() + size_; }
  [[nodiscard]] const Value* begin() const noexcept { return values_.data(); }
  [[nodiscard]] const Value* end() const noexcept { return begin() + size_; }
  [[nodiscard]] const Value& front() const noexcept { return values_[0]; }
  [[nodiscard]] const Value& back() const noexcept { return values_[size_ - 1]; }
  [[nodiscard]] const Value& operator[](std::size_t k) const noexcept { return values_[k]; }

private:
  std::size_t size_ = 0;
  std::array<Value, kMostOrder> values_{};
};

/// The control points of one side, in its direction; weights of 1 where there are none.
struct SideNet {
  SideValues<Point3> points;
  SideValues<double> weights;

  /// The largest distance of any control point from a point; nan where one is nan.
  [[nodiscard]] double reach(const Point3& from) const noexcept {
    double most = 0;
    for (const Point3& point : points) {
      const double distance = length(point - from);
      most = distance <= most || std::isnan(most) ? most : distance;
    }
    return most;
  }
};

/// A curve that is evaluated by de Casteljau's algorithm in homogeneous form.
class SideCurve {
public:
  explicit SideCurve(const SideNet& net) : order_(net.points.size()) {
    for (std::size_t k = 0; k < order_; ++k) {
      const auto& x = net.points[k].x;
      const double w = net.weights[k];
      given_[k] = {w * x[0], w * x[1], w * x[2], w};
    }
  }

  /// Calls visit(t) where the curve comes near a point: the closest places between neighbouring
  /// samples, found by Newton's method with tangents.
  template <typename Visit>
  void for_nearest(const Point3& point, const Visit& visit) const {
    const std::size_t samples = 8 * order_;
    const auto parameter = [&](std::size_t k) {
      return static_cast<double>(k) / static_cast<double>(samples);
    };
    const auto distance = [&](std::size_t k) {
      return k > samples ? HUGE_VAL : length(at(parameter(k)) - point);
    };
    double before = HUGE_VAL;
    double own = distance(0);
    for (std::size_t k = 0; k <= samples; ++k) {
      const double next = distance(k + 1);
      if (own <= before && own <= next) {
        const double low = parameter(k == 0 ? 0 : k - 1);
        const double high = parameter(std::min(k + 1, samples));
        visit(nearest(point, parameter(k), low, high));
      }
      before = own;
      own = next;
    }
  }

  [[nodiscard]] Point3 at(double t) const {
    Point3 slope;
    return at(t, slope);
  }

  /// The part from t0 to t1, in this direction.
  [[nodiscard]] SideNet part(double t0, double t1) const {
    SideNet net;
    for (std::size_t k = 0; k < order_; ++k) { // the blossom at t1 k times, else at t0
      Row row = given_;
      for (std::size_t left = order_; left > 1; --left) {
        reduce(row, left, order_ - left < k ? t1 : t0);
      }
      net.points.push_back(point_of(row[0]));
      net.weights.push_back(row[0][3]);
    }
    return net;
  }

private:
  using Values = std::array<double, 4>;
  using Row = std::array<Values, kMostOrder>;

  static Point3 point_of(const Values& x) { return {x[0] / x[3], x[1] / x[3], x[2] / x[3]}; }
  /// From `count` points to one less.
  static void reduce(Row& row, std::size_t count, double t) {
    for (std::size_t i = 0; i + 1 < count; ++i) {
      for (std::size_t c = 0; c < 4; ++c) {
        row[i][c] = (1 - t) * row[i][c] + t * row[i + 1][c];
      }
    }
  }

  Point3 at(double t, Point3& slope) const {
    Row row;
    std::copy_n(given_.begin(), order_, row.begin());
    for (std::size_t left = order_; left > 2; --left) {
      reduce(row, left, t);
    }
    const Values ends[2] = {row[0], row[1]};
    reduce(row, 2, t);
    const Point3 point = point_of(row[0]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double rise = ends[1][c] - ends[0][c] - point.x[c] * (ends[1][3] - ends[0][3]);
      slope.x[c] = static_cast<double>(order_ - 1) * rise / row[0][3];
    }
    return point;
  }

  [[nodiscard]] double nearest(const Point3& point, double t, double low, double high) const {
    constexpr int kSteps = 40;
    for (int k = 0; k < kSteps; ++k) {
      Point3 slope;
      const Point3 way = point - at(t, slope);
      const double step = dot(way, slope) / dot(slope, slope);
      const double next = std::clamp(std::isfinite(step) ? t + step : t, low, high);
      if (next == t) {
        break;
      }
      t = next;
    }
    return t;
  }

  std::size_t order_;
  Row given_{}; ///< w x, w y, w z, w
};

} // namespace simdbezier::detail
