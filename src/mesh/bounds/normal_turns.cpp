// See group_bound.hpp: how far the normals of a control net turn.
//
// The cross products of a cell's sides are the normals that the surface would have at the cell's
// corners if each cell of the net were a bilinear patch. The angles between each normal and the
// next one are added up along rows, and along columns.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/mesh/bounds/group_bound.hpp"
#include "src/mesh/net_points.hpp"

namespace simdbezier::detail {
namespace {

/// The angle of (x, y), where y is not below 0, to a few units in the last place: atan2() may have
/// another last bit in another C library, and rates would depend on it.
double angle_of(double x, double y) {
  const double most = std::max(std::fabs(x), y);
  const bool steep = y >= std::fabs(x); // counted from the y axis
  double t = most > 0 ? (steep ? x : y) / most : 0;
  for (int halving = 0; halving < 2; ++halving) {
    t /= 1 + std::sqrt(1 + t * t);
  }
  double series = 0; // of the arctangent; |t| is at most tan(pi / 16)
  for (int k = 21; k > 0; k -= 2) {
    series = 1.0 / k - t * t * series;
  }
  const double angle = 4 * t * series;
  return !(most > 0) ? 0
         : steep     ? std::numbers::pi / 2 - angle
         : x < 0     ? std::numbers::pi - angle
                     : angle;
}

/// Angles between vectors that follow each other; those without a direction are passed over.
class TurnSum {
public:
  void add(const Point3& next) {
    if (!(dot(next, next) > 0)) {
      return;
    }
    const Point3 n = cross(last_, next);
    sum_ += angle_of(dot(last_, next), std::sqrt(dot(n, n)));
    last_ = next;
  }
  [[nodiscard]] double sum() const { return sum_; }

private:
  Point3 last_{};
  double sum_ = 0;
};

} // namespace

std::array<double, 2> GroupBound::normal_turns(std::size_t lane) const {
  const VectorPatch& patch = patches_[lane];
  const auto difference = [&](std::size_t i, std::size_t j, std::size_t to_i, std::size_t to_j) {
    const ControlVector& a = patch.net(i, j);
    const ControlVector& b = patch.net(to_i, to_j);
    Point3 d;
    for (std::size_t c = 0; c < 3; ++c) {
      d.x[c] = patch.rational ? b.x[c] / b.x[3] - a.x[c] / a.x[3] : b.x[c] - a.x[c];
    }
    return d;
  };
  const std::size_t sizes[2] = {patch.net.columns, patch.net.rows};
  std::array<double, 2> turns{};
  for (std::size_t along = 0; along < 2; ++along) {
    // (s, t): s along, t across; that normals of columns point the other way changes no angle.
    const auto leg = [&](std::size_t s, std::size_t t, std::size_t to_s, std::size_t to_t) {
      return along == 0 ? difference(s, t, to_s, to_t) : difference(t, s, to_t, to_s);
    };
    for (std::size_t t = 0; t + 1 < sizes[1 - along]; ++t) {
      for (const std::size_t row : {t, t + 1}) {
        TurnSum sum;
        for (std::size_t s = 0; s + 1 < sizes[along]; ++s) {
          const Point3 forward = leg(s, row, s + 1, row);
          sum.add(cross(forward, leg(s, t, s, t + 1)));
          sum.add(cross(forward, leg(s + 1, t, s + 1, t + 1)));
        }
        turns[along] = std::max(turns[along], sum.sum());
      }
    }
  }
  return turns;
}

} // namespace simdbezier::detail
