// The published bounds against the running-error formulas they come from.
//
// A running-error formula is a sum of absolute values of terms linear in the control net (in the
// hodograph, for derivatives), hence convex: its maximum over all nets with |b| <= 1 lies at nets
// of 1 and -1. All of them are tried, on a grid of parameters with the corner (1,1), where the
// maximum is; mirrored nets make x, y >= 0 enough.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/bicubic_bounds.hpp"
#include "tests/properties/accuracy/judge/tracked.hpp"
#include "tests/support/even_odd_model.hpp"

namespace simdbezier::tests::bicubic_bounds_test {
namespace {

/// A polynomial's value, slope and half second derivative.
using Jet = EvenOddJet<Tracked>;
using Cubic = std::array<Tracked, 4>;

/// Columns: Horner's rule and synthetic division.
[[nodiscard]] Jet column(bool fma, const Cubic& a, double at) {
  const TrackedArithmetic in{fma};
  const Tracked x{at};
  const Tracked r2 = in.madd(a[3], x, a[2]);
  const Tracked r1 = in.madd(r2, x, a[1]);
  const Tracked s1 = in.madd(a[3], x, r2);
  return {in.madd(r1, x, a[0]), in.madd(s1, x, r1), in.madd(a[3], x, s1)};
}

/// Rows: even and odd parts.
[[nodiscard]] Jet row(bool fma, const Cubic& a, double y) {
  return even_odd(TrackedArithmetic{fma}, std::span<const Tracked>(a), Tracked{y});
}

using Points = std::array<std::array<double, 4>, 4>; // [j][i]

[[nodiscard]] std::array<double, 4> centred_coefficients(const std::array<double, 4>& b) {
  return {((b[0] + b[3]) + 3 * (b[1] + b[2])) / 8, 3 * ((b[3] - b[0]) + (b[2] - b[1])) / 8,
          3 * ((b[0] - b[1]) + (b[3] - b[2])) / 8, ((b[3] - b[0]) - 3 * (b[2] - b[1])) / 8};
}

struct Bounds {
  double position = 0;
  double inner = 0; ///< the derivative by the variable of the columns, which come first
  double outer = 0; ///< and by that of the rows
  double duu = 0;
  double duv = 0;
  double dvv = 0;
};

/// The running-error bounds at one net and parameter; each coefficient is rounded once.
[[nodiscard]] Bounds running_errors(bool fma, const Points& points, double x, double y) {
  std::array<Cubic, 4> columns; // [l][k], x^k y^l
  std::array<std::array<double, 4>, 4> rows;
  for (std::size_t j = 0; j < 4; ++j) {
    rows[j] = centred_coefficients(points[j]);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const auto powers = centred_coefficients({rows[0][k], rows[1][k], rows[2][k], rows[3][k]});
    for (std::size_t l = 0; l < 4; ++l) {
      columns[l][k] = {powers[l], std::abs(powers[l])};
    }
  }
  Cubic values;
  Cubic slopes;
  Cubic half_seconds;
  for (std::size_t l = 0; l < 4; ++l) {
    const Jet jet = column(fma, columns[l], x);
    values[l] = jet.value;
    slopes[l] = jet.slope;
    half_seconds[l] = jet.half_second;
  }
  const Jet outer = row(fma, values, y);
  const Jet slope = row(fma, slopes, y);
  // dS/du = 2 dS/dx, d2S/du2 = 4 d2S/dx2
  return {outer.value.bound(),     2 * slope.value.bound(),
          2 * outer.slope.bound(), 8 * row(fma, half_seconds, y).value.bound(),
          4 * slope.slope.bound(), 8 * outer.half_second.bound()};
}

/// The net of all values 1 or -1 given by the bits.
[[nodiscard]] Points signs(unsigned bits) {
  Points points;
  for (unsigned k = 0; k < 16; ++k) {
    points[k / 4][k % 4] = ((bits >> k) & 1) != 0 ? -1 : 1;
  }
  return points;
}

/// A net whose hodograph in u has the values 1 or -1 given by 12 bits.
[[nodiscard]] Points integrated(unsigned bits) {
  Points points{};
  for (unsigned k = 0; k < 12; ++k) {
    const double step = (((bits >> k) & 1) != 0 ? -1 : 1) / 3.0;
    points[k / 3][k % 3 + 1] = points[k / 3][k % 3] + step;
  }
  return points;
}

/// A net whose second hodograph in u has the values 1 or -1 given by 8 bits.
[[nodiscard]] Points integrated_twice(unsigned bits) {
  Points points{};
  for (unsigned k = 0; k < 8; ++k) {
    auto& row = points[k / 2];
    const double bend = (((bits >> k) & 1) != 0 ? -1 : 1) / 6.0;
    row[k % 2 + 2] = 2 * row[k % 2 + 1] - row[k % 2] + bend;
  }
  return points;
}

/// A net whose mixed hodograph has the values 1 or -1 given by 9 bits.
[[nodiscard]] Points integrated_in_both(unsigned bits) {
  Points points{};
  for (unsigned k = 0; k < 9; ++k) {
    const std::size_t j = k / 3;
    const std::size_t i = k % 3;
    const double twist = (((bits >> k) & 1) != 0 ? -1 : 1) / 9.0;
    points[j + 1][i + 1] = points[j + 1][i] + points[j][i + 1] - points[j][i] + twist;
  }
  return points;
}

[[nodiscard]] Points transposed(const Points& points) {
  Points result;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      result[j][i] = points[i][j];
    }
  }
  return result;
}

constexpr double kGrid[] = {0, 0.5, 0.75, 0.9, 1};

[[nodiscard]] Bounds largest_errors(bool fma) {
  Bounds largest;
  for (const double x : kGrid) {
    for (const double y : kGrid) {
      for (unsigned bits = 0; bits < 0x8000; ++bits) { // a net and its negative are alike
        largest.position =
            std::max(largest.position, running_errors(fma, signs(bits), x, y).position);
      }
      for (unsigned bits = 0; bits < 0x800; ++bits) {
        const Points net = integrated(bits);
        largest.inner = std::max(largest.inner, running_errors(fma, net, x, y).inner);
        largest.outer = std::max(largest.outer, running_errors(fma, transposed(net), x, y).outer);
      }
      for (unsigned bits = 0; bits < 0x100; ++bits) {
        const Points net = integrated_twice(bits);
        const Points twisted = integrated_in_both(bits); // bit 8 clear: up to the sign
        largest.duu = std::max(largest.duu, running_errors(fma, net, x, y).duu);
        largest.duv = std::max(largest.duv, running_errors(fma, twisted, x, y).duv);
        largest.dvv = std::max(largest.dvv, running_errors(fma, transposed(net), x, y).dvv);
      }
    }
  }
  return largest;
}

struct BoundCase {
  const char* name;
  bool fma;
};

class BoundTest : public ::testing::TestWithParam<BoundCase> {};

// The error is not above the published bound, and not so far below it that the bound says nothing.
TEST_P(BoundTest, CoversTheRunningError) {
  const bool fma = GetParam().fma;
  const Bounds found = largest_errors(fma);
  EXPECT_LE(found.position, position_bound(fma));
  EXPECT_GT(found.position, position_bound(fma) - 2);
  const double derivative = std::max(found.inner, found.outer);
  EXPECT_LE(derivative, derivative_bound(fma));
  EXPECT_GT(derivative, derivative_bound(fma) - 2);
  const double second = std::max({found.duu, found.duv, found.dvv});
  EXPECT_LE(second, second_derivative_bound(fma));
  EXPECT_GT(second, second_derivative_bound(fma) - 2);
  std::printf("%s: position %.2f, inner derivative %.2f, outer derivative %.2f, duu %.2f, "
              "duv %.2f, dvv %.2f\n",
              GetParam().name, found.position, found.inner, found.outer, found.duu, found.duv,
              found.dvv);
}

INSTANTIATE_TEST_SUITE_P(Classes, BoundTest,
                         ::testing::Values(BoundCase{"fma", true}, BoundCase{"nofma", false}),
                         [](const auto& row) { return std::string(row.param.name); });

} // namespace
} // namespace simdbezier::tests::bicubic_bounds_test
