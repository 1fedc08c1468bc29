// See derivative_nets.hpp.
#include "src/mesh/rates/derivative_nets.hpp"

#include <algorithm>

namespace simdbezier::detail {
namespace {

/// Differences of neighbours in one direction, times the degree.
void differentiate(const VectorNet& net, bool in_u, VectorNet& to) {
  const std::size_t step = in_u ? 1 : net.columns;
  const std::size_t length = in_u ? net.columns : net.rows;
  if (length < 2) {
    to.resize(1, 1);
    to.at[0] = {};
    return;
  }
  VectorNet result;
  result.resize(in_u ? net.columns - 1 : net.columns, in_u ? net.rows : net.rows - 1);
  for (std::size_t j = 0; j < result.rows; ++j) {
    for (std::size_t i = 0; i < result.columns; ++i) {
      const std::size_t k = j * net.columns + i;
      result(i, j) = static_cast<double>(length - 1) * (net.at[k + step] - net.at[k]);
    }
  }
  to = std::move(result);
}

/// One line of a net.
struct Line {
  ControlVector* first;
  std::size_t step;
  std::size_t count;

  [[nodiscard]] ControlVector& operator[](std::size_t k) const { return first[k * step]; }
};

template <typename Visit>
void for_lines(VectorNet& net, bool in_u, const Visit& visit) {
  const std::size_t lines = in_u ? net.rows : net.columns;
  for (std::size_t k = 0; k < lines; ++k) {
    visit(in_u ? Line{&net(0, k), 1, net.columns} : Line{&net(k, 0), net.columns, net.rows});
  }
}

void raise_direction(VectorNet& net, bool in_u, std::size_t count) {
  while ((in_u ? net.columns : net.rows) < count) {
    VectorNet raised;
    raised.resize(net.columns + (in_u ? 1 : 0), net.rows + (in_u ? 0 : 1));
    const std::size_t lines = in_u ? net.rows : net.columns;
    for (std::size_t k = 0; k < lines; ++k) {
      const Line from =
          in_u ? Line{&net(0, k), 1, net.columns} : Line{&net(k, 0), net.columns, net.rows};
      const Line to = in_u ? Line{&raised(0, k), 1, raised.columns}
                           : Line{&raised(k, 0), raised.columns, raised.rows};
      for (std::size_t i = 0; i < to.count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(from.count);
        to[i] = i == 0            ? from[0]
                : i == from.count ? from[i - 1]
                                  : share * from[i - 1] + (1 - share) * from[i];
      }
    }
    net = std::move(raised);
  }
}

} // namespace

void HullBox::include(const VectorNet& net) {
  for (const ControlVector& v : net.at) {
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
  exponent = largest > 0 ? std::ilogb(largest) : 0;
  largest = std::scalbn(largest, -exponent);
  const int weight_exponent = std::ilogb(largest_weight);
  for (ControlVector& v : net.at) {
    v.x[3] = std::scalbn(v.x[3], -weight_exponent);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double least = std::scalbn(low[c], -exponent);
    const double middle = least + (std::scalbn(high[c], -exponent) - least) / 2;
    for (ControlVector& v : net.at) {
      v.x[c] = (std::scalbn(v.x[c], -exponent) - middle) * v.x[3];
    }
  }
  largest *= std::scalbn(largest_weight, -weight_exponent);
  return true;
}

template bool VectorPatch::read(const ControlNets<float>&, std::size_t);
template bool VectorPatch::read(const ControlNets<double>&, std::size_t);

void form_second_nets(const VectorNet& net, SecondNets& to) {
  VectorNet du;
  VectorNet dv;
  differentiate(net, true, du);
  differentiate(net, false, dv);
  differentiate(du, true, to.uu);
  differentiate(du, false, to.uv);
  differentiate(dv, false, to.vv);
}

void cut_net(VectorNet& net, bool in_u, double t, bool keep_high) {
  for_lines(net, in_u, [&](const Line& line) {
    for (std::size_t level = 1; level < line.count; ++level) {
      for (std::size_t k = 0; k + level < line.count; ++k) {
        // The kept end is where values come to rest: each pass leaves one of them.
        const std::size_t at = keep_high ? k : line.count - 1 - k;
        const ControlVector& a = keep_high ? line[at] : line[at - 1];
        const ControlVector& b = keep_high ? line[at + 1] : line[at];
        line[at] = (1 - t) * a + t * b;
      }
    }
  });
}

void raise_net(VectorNet& net, std::size_t columns, std::size_t rows) {
  raise_direction(net, true, columns);
  raise_direction(net, false, rows);
}

} // namespace simdbezier::detail
