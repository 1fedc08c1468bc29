// See derivative_nets.hpp.
#include "src/mesh/derivative_nets.hpp"

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

template <typename S>
bool VectorPatch::read(const ControlNets<S>& nets, std::size_t patch) {
  const auto columns = static_cast<std::size_t>(nets.degree_u) + 1;
  const auto rows = static_cast<std::size_t>(nets.degree_v) + 1;
  const bool rational = nets.weights != Weights::none;
  net.resize(columns, rows);
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  smallest_weight = rational ? HUGE_VAL : 1;
  double largest_weight = rational ? 0 : 1;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const S* const values = nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride +
                              static_cast<std::ptrdiff_t>(j) * nets.row_stride +
                              static_cast<std::ptrdiff_t>(i) * nets.point_stride;
      ControlVector& to = net(i, j);
      to.x[3] = rational ? static_cast<double>(values[3 * nets.component_stride]) : 0;
      if (rational && !(to.x[3] > 0 && std::isfinite(to.x[3]))) {
        return false;
      }
      const double divisor = nets.weights == Weights::homogeneous ? to.x[3] : 1;
      for (std::size_t c = 0; c < 3; ++c) {
        to.x[c] =
            static_cast<double>(values[static_cast<std::ptrdiff_t>(c) * nets.component_stride]) /
            divisor;
        if (!std::isfinite(to.x[c])) {
          return false;
        }
        low[c] = std::min(low[c], to.x[c]);
        high[c] = std::max(high[c], to.x[c]);
      }
      if (rational) {
        smallest_weight = std::min(smallest_weight, to.x[3]);
        largest_weight = std::max(largest_weight, to.x[3]);
      }
    }
  }
  // Second derivatives do not change where the patch is moved; its middle is where values are
  // smallest.
  double middle[3];
  radius = 0;
  largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    middle[c] = low[c] + (high[c] - low[c]) / 2;
    radius += (high[c] - middle[c]) * (high[c] - middle[c]);
    largest = std::max({largest, std::fabs(low[c]), std::fabs(high[c])});
  }
  radius = rational ? std::sqrt(radius) * (1 + 0x1p-40) : 0;
  largest *= largest_weight;
  for (ControlVector& v : net.at) {
    for (std::size_t c = 0; c < 3; ++c) {
      v.x[c] = (v.x[c] - middle[c]) * (rational ? v.x[3] : 1);
    }
  }
  return std::isfinite(largest) && std::isfinite(radius);
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
