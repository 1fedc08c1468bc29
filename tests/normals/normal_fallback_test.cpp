// The second look at normals, for every degree and with weights: against surfaces whose normals are
// known, cubics raised to higher degrees, and patches that have none.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/normals/fallback_surface.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests::normal_fallback_test {
namespace {

/// A bicubic cap whose edge v = 0 is a pole.
Surface cap(std::uint64_t seed) {
  Random random(seed);
  Surface surface(3, 3, false);
  for (int j = 0; j <= 3; ++j) {
    for (int i = 0; i <= 3; ++i) {
      const double spread = j + 0.2 * (j > 0 ? random.symmetric() : 0);
      surface.at(j, i) = {0.3 * spread * (i - 1.5), spread, 5 + 0.1 * j * j};
    }
  }
  return surface;
}

constexpr double kParameters[] = {-0.5, -0.499999, -0.3, 0, 0.2, 0.5};

template <typename T>
void expect_degrees_to_agree(double tolerance) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Surface cubic = cap(seed);
    Surface higher = cubic;
    for (int degree = 4; degree <= kMostDegree; ++degree) {
      higher = raised_u(higher);
      if (degree % 2 == 0) {
        higher = exchanged(raised_u(exchanged(higher)));
      }
      Surface weighted = higher; // weights that are all the same change nothing
      weighted.shape.rational = true;
      std::fill(weighted.weights.begin(), weighted.weights.end(), 3.0);
      for (const double x : kParameters) {
        for (const double y : kParameters) {
          const Answer expected = resolve<T>(cubic, x, y);
          for (const Surface& other : {higher, weighted}) {
            const Answer found = resolve<T>(other, x, y);
            EXPECT_EQ(found.status, expected.status) << degree << " at " << x << ", " << y;
            EXPECT_LE(degrees_between(found.normal, expected.normal), tolerance)
                << degree << " at " << x << ", " << y;
          }
        }
      }
    }
  }
}

TEST(NormalFallback, raised_degrees_have_the_same_normals) {
  expect_degrees_to_agree<double>(1e-3);
}

/// An octant of the unit sphere as a rational biquadratic patch: its pole is the edge v = 1, where
/// all points are the same and their weights are not.
Surface octant() {
  Surface surface(2, 2, true);
  const double half = std::sqrt(0.5);
  const double circle[3][2] = {{1, 0}, {1, 1}, {0, 1}};
  const double weights[3] = {1, half, 1};
  for (int j = 0; j <= 2; ++j) {
    for (int i = 0; i <= 2; ++i) {
      surface.at(j, i) = {circle[j][0] * circle[i][0], circle[j][0] * circle[i][1], circle[j][1]};
      surface.weights[surface.index(j, i)] = weights[j] * weights[i];
    }
  }
  return surface;
}

/// Where the octant is at (u, v).
Point on_sphere(double u, double v) {
  const auto quarter = [](double t) {
    const double b[3] = {(1 - t) * (1 - t), 2 * t * (1 - t) * std::sqrt(0.5), t * t};
    const double w = b[0] + b[1] + b[2];
    return std::array<double, 2>{(b[0] + b[1]) / w, (b[1] + b[2]) / w};
  };
  const auto [east, north] = quarter(u);
  const auto [radius, height] = quarter(v);
  return {radius * east, radius * north, height};
}

template <typename T>
void expect_sphere(double tolerance) {
  Surface surface = octant();
  for (int degree = 2; degree <= kMostDegree; ++degree) {
    for (const double x : kParameters) {
      for (const double y : kParameters) {
        const Answer found = resolve<T>(surface, x, y);
        const Point expected = on_sphere(0.5 + static_cast<double>(static_cast<T>(x)),
                                         0.5 + static_cast<double>(static_cast<T>(y)));
        EXPECT_LE(degrees_between(found.normal, expected), tolerance)
            << degree << " at " << x << ", " << y;
        EXPECT_EQ(found.status, y == 0.5 ? SampleStatus::limit : SampleStatus::regular)
            << degree << " at " << x << ", " << y;
      }
    }
    surface = degree % 2 == 0 ? raised_u(surface) : exchanged(raised_u(exchanged(surface)));
  }
}

TEST(NormalFallback, a_sphere_has_its_radii_for_normals) {
  expect_sphere<double>(1e-3);
  // Rounded control points are those of another surface.
  expect_sphere<float>(0.01);
}

TEST(NormalFallback, far_from_the_origin_poles_stay_poles) {
  Surface surface = octant();
  for (Point& point : surface.points) {
    for (double& value : point) {
      value += 4096; // exact
    }
  }
  for (const double x : kParameters) {
    const Answer found = resolve<float>(surface, x, 0.5);
    EXPECT_EQ(found.status, SampleStatus::limit);
    EXPECT_LE(degrees_between(found.normal, {0, 0, 1}), 1e-3) << x;
  }
}

TEST(NormalFallback, large_weight_ratios_and_scales) {
  for (const double ratio : {1e-4, 1e4}) {
    for (const double scale : {0x1p-60, 1.0, 0x1p60}) {
      Surface plane(5, 2, true);
      for (int j = 0; j <= 2; ++j) {
        for (int i = 0; i <= 5; ++i) {
          plane.at(j, i) = {scale * (i + 0.1 * j), scale * j, scale};
          plane.weights[plane.index(j, i)] = scale * ((i + j) % 2 == 0 ? 1 : ratio);
        }
      }
      for (const double x : kParameters) {
        for (const double y : kParameters) {
          const Answer found = resolve<double>(plane, x, y);
          EXPECT_LE(degrees_between(found.normal, {0, 0, 1}), 1e-6)
              << ratio << " " << x << " " << y;
          EXPECT_EQ(found.status, SampleStatus::regular) << ratio << " " << scale;
        }
      }
    }
  }
}

/// Squares of what is summed up leave the range of doubles, on one side or the other.
TEST(NormalFallback, of_any_size) {
  for (int exponent = -500; exponent <= 500; exponent += 50) {
    const double size = std::ldexp(1.0, exponent);
    Surface corner(1, 1, false);
    corner.points = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {1, 1, 0}};
    const Answer small = resolve<double>(corner, -0.5, -0.5);
    EXPECT_EQ(small.status, SampleStatus::regular) << exponent;
    EXPECT_EQ(small.normal, (Point{0, 0, 1})) << exponent;
    corner.shape.rational = true;
    corner.weights = {size, 1, 1, 1 / size};
    EXPECT_EQ(resolve<double>(corner, -0.5, -0.5).normal, (Point{0, 0, 1})) << exponent;
  }
}

TEST(NormalFallback, far_outside_of_the_patch) {
  for (const int degree : {1, 3, 15}) {
    Surface plane(degree, degree, false);
    for (int j = 0; j <= degree; ++j) {
      for (int i = 0; i <= degree; ++i) {
        plane.at(j, i) = {1.0 * i + 0.25 * j, 2.0 * j, 0};
      }
    }
    for (const double x : {2.0, 1e3, 1e20, 1e60}) {
      const Answer found = resolve<double>(plane, x, 1.5 * x);
      EXPECT_EQ(found.status, SampleStatus::regular) << degree << " at " << x;
      EXPECT_EQ(std::fabs(found.normal[2]), 1) << degree << " at " << x;
    }
  }
}

/// The nets are lines in general position, which sums of doubles leave.
TEST(NormalFallback, lines_in_space_have_none) {
  for (const bool rational : {false, true}) {
    for (const int degree : {1, 3, 5, 15}) {
      Surface line(degree, degree, rational);
      for (std::size_t k = 0; k < line.points.size(); ++k) {
        const double t = std::floor(static_cast<double>(k * k % 17)) / 64;
        line.points[k] = {3 * t, 5 * t - 1, 2 - 7 * t};
        line.weights[k] = 1 + static_cast<double>(k % 3) / 3;
      }
      EXPECT_EQ(resolve<double>(line, 0.3, 0.1).status, SampleStatus::degenerate) << degree;
      line.points[1][0] += 0x1p-30; // no longer one
      const Answer found = resolve<double>(line, 0.3, 0.1);
      EXPECT_NE(found.status, SampleStatus::degenerate) << degree;
    }
  }
}

/// All points but the first are on a line through the origin: not a line, and a flat corner.
TEST(NormalFallback, rays_from_the_origin_are_no_line) {
  Surface patch(1, 1, false);
  patch.points = {{1, 0, 0}, {3, 9, 21}, {5, 15, 35}, {0, 0, 0}};
  const Answer found = resolve<double>(patch, 0.5, 0.5);
  EXPECT_EQ(found.status, SampleStatus::limit);
  EXPECT_NEAR(found.normal[0], 0, 1e-15);
  EXPECT_NEAR(std::fabs(found.normal[1]), 7 / std::sqrt(58.0), 1e-15);
}

TEST(NormalFallback, points_and_lines_have_none) {
  for (const bool rational : {false, true}) {
    for (int degree = 1; degree <= kMostDegree; ++degree) {
      Surface point(degree, 16 - degree, rational);
      Surface line = point;
      for (std::size_t k = 0; k < point.points.size(); ++k) {
        point.points[k] = {1, 2, 3};
        line.points[k] = {1, 2, static_cast<double>(k)};
        point.weights[k] = line.weights[k] = 1 + static_cast<double>(k % 3);
      }
      for (const Surface& surface : {point, line}) {
        const Answer found = resolve<double>(surface, 0.25, -0.5);
        EXPECT_EQ(found.status, SampleStatus::degenerate) << degree << rational;
        EXPECT_EQ(found.normal, (Point{0, 0, 0})) << degree << rational;
      }
      const Answer nowhere = resolve<double>(line, std::numeric_limits<double>::quiet_NaN(), 0);
      EXPECT_EQ(nowhere.status, SampleStatus::non_finite);
      EXPECT_TRUE(std::isnan(nowhere.normal[2]));
    }
  }
}

/// Two points lie beside all others by the last bit of a coordinate.
TEST(NormalFallback, what_is_nearly_a_point_has_one) {
  for (const bool rational : {false, true}) {
    for (const int degree : {1, 3, 8, 15}) {
      Surface patch(degree, 16 - degree, rational);
      for (std::size_t k = 0; k < patch.points.size(); ++k) {
        patch.points[k] = {1.0 / 3, 2.0 / 7, 3};
        patch.weights[k] = 1 + static_cast<double>(k % 3) / 3;
      }
      double& x = patch.points.back()[0];
      double& y = patch.points[patch.points.size() - 2][1];
      x = std::nextafter(x, 1.0);
      y = std::nextafter(y, 1.0);
      for (const double at : {0.25, 0.5}) {
        const Answer found = resolve<double>(patch, at, at);
        EXPECT_NE(found.status, SampleStatus::degenerate) << degree << rational << at;
        EXPECT_NEAR(std::fabs(found.normal[2]), 1, 1e-15) << degree << rational << at;
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::normal_fallback_test
