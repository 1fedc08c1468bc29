// See derivative_nets.hpp.
#include "src/mesh/rates/derivative_nets.hpp"

#include <algorithm>

namespace simdbezier::detail {
namespace {

/// Differences of neighbours in one direction, times the degree.
void differentiate(const VectorNet& net, bool in_u, VectorNet& to) {
  const std::size_t step = in_u ? 1 : net.stride;
  const std::size_t length = in_u ? net.columns : net.rows;
  to.shape_like(net);
  if (length < 2) {
    to.columns = 1;
    to.rows = 1;
    to.at[0] = {};
    return;
  }
  (in_u ? to.columns : to.rows) -= 1;
  for (std::size_t j = 0; j < to.rows; ++j) {
    for (std::size_t i = 0; i < to.columns; ++i) {
      const std::size_t k = j * net.stride + i;
      to.at[k] = static_cast<double>(length - 1) * (net.at[k + step] - net.at[k]);
    }
  }
}

/// The lines of a net in one direction: vector i of line k stands at i * step + k * across. Loops
/// pass from line to line first, which do the same.
struct Lines {
  std::size_t points;
  std::size_t step;
  std::size_t count;
  std::size_t across;

  Lines(const VectorNet& net, bool in_u)
      : points(in_u ? net.columns : net.rows), step(in_u ? 1 : net.stride),
        count(in_u ? net.rows : net.columns), across(in_u ? net.stride : 1) {}
};

/// Sets the vectors to[k] = a from[k] + b next[k] of all lines.
void blend(const Lines& lines, double a, const ControlVector* from, double b,
           const ControlVector* next, ControlVector* to) {
  for (std::size_t k = 0; k < lines.count;
       ++k, from += lines.across, next += lines.across, to += lines.across) {
    *to = a * *from + b * *next;
  }
}

void copy_points(const Lines& lines, const ControlVector* from, ControlVector* to) {
  for (std::size_t k = 0; k < lines.count; ++k) {
    to[k * lines.across] = from[k * lines.across];
  }
}

/// Raises the degree in one direction by one. A point depends on those before it, so that going
/// backwards reads none that is raised already.
void raise_once(VectorNet& net, bool in_u) {
  const Lines lines(net, in_u);
  ControlVector* at = &net.at[lines.points * lines.step];
  copy_points(lines, at - lines.step, at);
  for (std::size_t i = lines.points - 1; i > 0; --i) {
    at -= lines.step;
    const double share = static_cast<double>(i) / static_cast<double>(lines.points);
    blend(lines, share, at - lines.step, 1 - share, at, at);
  }
  ++(in_u ? net.columns : net.rows);
}

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

void HullBox::include(const VectorNet& net) {
  for (const ControlVector& v : net.at) { // all of a patch's degrees
    for (std::size_t c = 0; c < 3; ++c) {
      low_[c] = std::min(low_[c], v.x[c] / v.x[3]);
      high_[c] = std::max(high_[c], v.x[c] / v.x[3]);
    }
    smallest_weight_ = std::min(smallest_weight_, v.x[3]);
  }
}

void HullBox::include(const HullBox& other) {
  for (std::size_t c = 0; c < 3; ++c) {
    low_[c] = std::min(low_[c], other.low_[c]);
    high_[c] = std::max(high_[c], other.high_[c]);
  }
  smallest_weight_ = std::min(smallest_weight_, other.smallest_weight_);
}

Hull HullBox::hull() const {
  constexpr double kRounding = 1 + 0x1p-40;
  Hull hull;
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    hull.middle[c] = low_[c] + (high_[c] - low_[c]) / 2;
    const double half = std::max(high_[c] - hull.middle[c], hull.middle[c] - low_[c]);
    square += half * half;
  }
  hull.radius = std::sqrt(square) * kRounding;
  hull.smallest_weight = smallest_weight_ / kRounding;
  return hull;
}

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

void form_second_nets(const VectorNet& net, SecondNets& to) {
  VectorNet first;
  differentiate(net, true, first);
  differentiate(first, true, to.uu);
  differentiate(first, false, to.uv);
  differentiate(net, false, first);
  differentiate(first, false, to.vv);
}

void cut_net(VectorNet& net, bool in_u, double t, bool keep_high) {
  const Lines lines(net, in_u);
  for (std::size_t level = 1; level < lines.points; ++level) {
    for (std::size_t i = 0; i + level < lines.points; ++i) {
      // The kept end is where values come to rest: each pass leaves one of them.
      const std::size_t at = keep_high ? i : lines.points - 1 - i;
      ControlVector* const to = &net.at[at * lines.step];
      blend(lines, 1 - t, keep_high ? to : to - lines.step, t, keep_high ? to + lines.step : to,
            to);
    }
  }
}

void halve_net(const VectorNet& net, bool in_u, VectorNet& low, VectorNet& high) {
  const Lines lines(net, in_u);
  low.shape_like(net);
  high = net;
  copy_points(lines, high.at.data(), low.at.data());
  for (std::size_t level = 1; level < lines.points; ++level) {
    for (std::size_t i = 0; i + level < lines.points; ++i) {
      ControlVector* const to = &high.at[i * lines.step];
      blend(lines, 0.5, to, 0.5, to + lines.step, to);
    }
    copy_points(lines, high.at.data(), &low.at[level * lines.step]);
  }
}

void raise_net(VectorNet& net, std::size_t columns, std::size_t rows) {
  while (net.columns < columns) {
    raise_once(net, true);
  }
  while (net.rows < rows) {
    raise_once(net, false);
  }
}

void raise_all(SecondNets& nets, const VectorNet& like) {
  raise_net(nets.uu, like.columns, like.rows);
  raise_net(nets.uv, like.columns, like.rows);
  raise_net(nets.vv, like.columns, like.rows);
}

void VectorPlanes::read(const VectorNet& net) {
  const std::size_t count = net.columns * net.rows;
  stride_ = (count + kListStep - 1) / kListStep * kListStep;
  values_.resize(4 * stride_);
  const std::size_t stride = stride_;
  double* to = values_.data();
  const auto put = [&](const ControlVector& v) {
    to[0] = v.x[0];
    to[stride] = v.x[1];
    to[2 * stride] = v.x[2];
    to[3 * stride] = v.x[3];
    ++to;
  };
  for (std::size_t j = 0; j < net.rows; ++j) {
    for (std::size_t i = 0; i < net.columns; ++i) {
      put(net(i, j));
    }
  }
  while (to != values_.data() + stride) {
    put({});
  }
}

} // namespace simdbezier::detail
