// Spline surfaces with any knots and weights: equal bits on all instruction sets and for any
// strides, control points inside of the hull of the spline's own, and those of the textbook where
// knots are uniform.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/require.hpp"
#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/checks/surface_reference.hpp"
#include "tests/reliability/fuzz/inputs/made_grids.hpp"
#include "tests/reliability/fuzz/inputs/made_nets.hpp"

namespace simdbezier::fuzz {
namespace {

template <typename T>
class SplineCase {
public:
  explicit SplineCase(ByteSource& bytes) : bytes_(bytes) {
    const std::uint8_t choice = bytes.byte();
    surface_.periodic_u = (choice & 1) != 0;
    surface_.periodic_v = (choice & 2) != 0;
    uniform_ = (choice & 4) != 0;
    surface_.components = components(bytes);
    surface_.weights = (choice & 64) != 0 ? weights(bytes) : Weights::none;
    if (!uniform_) {
      surface_.degree_u = bytes.between(1, (choice & 8) != 0 ? kMostDegree : 3);
      surface_.degree_v = bytes.between(1, 4);
    }
    surface_.rows = points(surface_.degree_v, surface_.periodic_v, 5);
    surface_.columns = points(surface_.degree_u, surface_.periodic_u, 20);
    if (!uniform_) {
      surface_.knots_u = knots(surface_.columns, surface_.degree_u, surface_.periodic_u, knots_u_);
      surface_.knots_v = knots(surface_.rows, surface_.degree_v, surface_.periodic_v, knots_v_);
      surface_.knot_tolerance = (choice & 16) != 0 ? bytes.raw<double>() : 0;
      if ((choice & 32) != 0) {
        surface_.u_range = {bytes.raw<double>(), bytes.raw<double>()};
      }
    }
    values_ =
        nets_of<T>(bytes, static_cast<int>(surface_.columns) - 1,
                   static_cast<int>(surface_.rows) - 1, surface_.components, surface_.weights, 1);
    const auto c = static_cast<std::ptrdiff_t>(values_.channels());
    surface_.points = values_.values.data();
    surface_.point_stride = c;
    surface_.row_stride = c * static_cast<std::ptrdiff_t>(surface_.columns);
  }

  void run() {
    const SpanCounts spans = span_count(surface_);
    if (spans.patches() == 0) {
      const auto none = MutableNets<T>::packed(nullptr, 0, surface_.degree_u, surface_.degree_v,
                                               surface_.components, surface_.weights);
      require(!to_bezier(surface_, none), "a spline without spans");
      return;
    }
    Nets<T> expected{surface_.degree_u,
                     surface_.degree_v,
                     surface_.components,
                     surface_.weights,
                     spans.patches(),
                     true,
                     {}};
    expected.values.assign(expected.count * expected.values_per_patch(), T(0));
    std::optional<Status> first;
    for (const Isa isa : available_isas()) {
      const Arrangement arrangement(bytes_);
      StridedNets<T> memory(expected, arrangement, placement(bytes_));
      const Status status =
          to_bezier(surface_, memory.view(), {}, with({}, isa, isa == Isa::avx2 ? 2 : 1)).status;
      memory.check_surroundings();
      require_status(status,
                     {Status::ok, Status::non_finite_input, Status::bad_knots, Status::bad_range,
                      Status::bad_tolerance, Status::bad_weight, Status::coefficient_overflow},
                     "to_bezier");
      require(!first || *first == status, "to_bezier has another status");
      if (status == Status::ok) {
        const std::vector<T> values = memory.values();
        if (first) {
          require_equal(values, expected.values, named("to_bezier gives other bits", isa));
        }
        expected.values = values;
      }
      first = status;
    }
    if (*first == Status::ok && values_.moderate) {
      judge(expected, spans);
    }
  }

private:
  std::size_t points(int degree, bool periodic, std::size_t more) {
    return static_cast<std::size_t>(degree) + (periodic ? 0 : 1) + bytes_.below(more);
  }

  /// Ascending ones mostly, which may be equal; now and then any bits.
  std::span<const double> knots(std::size_t count, int degree, bool periodic,
                                std::vector<double>& memory) {
    const std::size_t all = count + (periodic ? 1 : static_cast<std::size_t>(degree) + 1);
    double knot = 0;
    for (std::size_t k = 0; k < all; ++k) {
      const std::uint8_t step = bytes_.byte();
      knot = step == 255 ? bytes_.raw<double>() : knot + (step % 3 == 0 ? 0 : 1.0 / step);
      memory.push_back(knot);
    }
    return memory;
  }

  /// Control point k of the piece between knots: weights of the mesh's points 0 to 3 in sixths.
  static constexpr int kSixths[4][4] = {{1, 4, 1, 0}, {0, 4, 2, 0}, {0, 2, 4, 0}, {0, 1, 4, 1}};

  void judge(const Nets<T>& made, const SpanCounts& spans) const {
    const auto [low, high] = std::minmax_element(values_.values.begin(), values_.values.end());
    const T slack = 64 * std::numeric_limits<T>::epsilon() * std::max(-*low, *high) +
                    std::numeric_limits<T>::min();
    for (std::size_t p = 0; p < made.count; ++p) {
      for (int k = 0; k < static_cast<int>(made.points()); ++k) {
        const int columns = made.degree_u + 1;
        for (int c = 0; c < made.components; ++c) {
          const T value = made.point(p, k / columns, k % columns)[c];
          require(*low - slack <= value && value <= *high + slack,
                  "a piece of a B-spline leaves the hull");
          if (uniform_ && !made.rational()) {
            judge_value(value, p, k, c, spans);
          }
        }
      }
    }
  }

  void judge_value(T value, std::size_t patch, int point, int c, const SpanCounts& spans) const {
    Real exact = 0;
    Real size = 0;
    for (std::size_t k = 0; k < 16; ++k) {
      const std::size_t row = (patch / spans.u + k / 4) % surface_.rows;
      const std::size_t column = (patch % spans.u + k % 4) % surface_.columns;
      const auto at =
          static_cast<Real>(values_.point(0, static_cast<int>(row), static_cast<int>(column))[c]);
      exact += kSixths[point / 4][k / 4] * kSixths[point % 4][k % 4] * at / 36;
      size = std::max(size, std::fabs(at));
    }
    require(std::fabs(static_cast<Real>(value) - exact) <=
                8 * std::numeric_limits<T>::epsilon() * size + std::numeric_limits<T>::min(),
            "a piece of a B-spline has another control point");
  }

  ByteSource& bytes_;
  SplineSurface<T> surface_;
  bool uniform_ = false;
  std::vector<double> knots_u_;
  std::vector<double> knots_v_;
  Nets<T> values_;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_case<simdbezier::fuzz::SplineCase>(data, size);
}
