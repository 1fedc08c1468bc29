// See vector_patch.hpp.
#include "src/mesh/bounds/vector_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simdbezier::detail {
namespace {

/// The control point in space that begins at `values`, and its weight; false where one of them is
/// not finite, or the weight not positive.
template <typename S>
bool read_point(const ControlNets<S>& nets, const S* values, ControlVector& to) {
  const std::ptrdiff_t step = nets.component_stride;
  to.x[3] = nets.weights == Weights::none ? 1 : static_cast<double>(values[3 * step]);
  const double divisor = nets.weights == Weights::homogeneous ? to.x[3] : 1;
  bool finite = to.x[3] > 0 && std::isfinite(to.x[3]);
  for (std::ptrdiff_t c = 0; c < 3; ++c) {
    to.x[c] = static_cast<double>(values[c * step]) / divisor;
    finite = finite && std::isfinite(to.x[c]);
  }
  return finite;
}

} // namespace

template <typename S>
bool VectorPatch::read(const ControlNets<S>& nets, std::size_t patch) {
  rational = nets.weights != Weights::none;
  net.resize(static_cast<std::size_t>(nets.degree_u) + 1,
             static_cast<std::size_t>(nets.degree_v) + 1);
  const S* const first = nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride;
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  double largest_weight = 0;
  for (std::size_t j = 0; j < net.rows; ++j) {
    for (std::size_t i = 0; i < net.columns; ++i) {
      ControlVector& to = net(i, j);
      if (!read_point(nets,
                      first + static_cast<std::ptrdiff_t>(j) * nets.row_stride +
                          static_cast<std::ptrdiff_t>(i) * nets.point_stride,
                      to)) {
        return false;
      }
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], to.x[c]);
        high[c] = std::max(high[c], to.x[c]);
      }
      largest_weight = std::max(largest_weight, to.x[3]);
    }
  }
  // Moving a patch does not change its second derivatives, and around its middle values are
  // smallest.
  largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    largest = std::max({largest, std::fabs(low[c]), std::fabs(high[c])});
  }
  scale = largest > 0 ? power_of_two_below(largest) : PowerOfTwo();
  const PowerOfTwo down = scale.inverse();
  const PowerOfTwo weight_down = power_of_two_below(largest_weight).inverse();
  largest = largest * down;
  double middle[3];
  for (std::size_t c = 0; c < 3; ++c) {
    const double least = low[c] * down;
    middle[c] = least + (high[c] * down - least) / 2;
  }
  for (ControlVector& v : net.at) {
    v.x[3] = v.x[3] * weight_down;
    for (std::size_t c = 0; c < 3; ++c) {
      v.x[c] = (v.x[c] * down - middle[c]) * v.x[3];
    }
  }
  largest *= largest_weight * weight_down;
  return true;
}

template bool VectorPatch::read(const ControlNets<float>&, std::size_t);
template bool VectorPatch::read(const ControlNets<double>&, std::size_t);

void VectorPatch::shrink_to_point() {
  std::fill(net.at.begin(), net.at.end(), ControlVector{{0, 0, 0, 1}});
  largest = 0;
  scale = PowerOfTwo();
}

double VectorPatch::in_space(double bound) const {
  const double scaled = bound * scale;
  return bound > 0 && scaled < std::numeric_limits<double>::min()
             ? std::nextafter(scaled, std::numeric_limits<double>::infinity())
             : scaled;
}

} // namespace simdbezier::detail
