// Rates and polylines where weights are far apart, against dense samples by sums of the test's own.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/flatten.hpp>
#include <simdbezier/rates.hpp>

#include "tests/mesh/support/sampled_patch.hpp"

namespace simdbezier::tests::spread_weights_test {
namespace {

using LongPoint = std::array<long double, 3>;

/// The squared distance of a point from a triangle that may be thin, so that the foot on its plane
/// is not known well: from the nearest one of that foot and points of the sides.
double far_from(const LongPoint& point, const std::array<LongPoint, 3>& triangle) {
  const auto dot = [](const LongPoint& a, const LongPoint& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const auto minus = [](const LongPoint& a, const LongPoint& b) {
    return LongPoint{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto left = [&](const LongPoint& d, long double s, const LongPoint& e, long double t,
                        const LongPoint& f) {
    const LongPoint rest = {d[0] - s * e[0] - t * f[0], d[1] - s * e[1] - t * f[1],
                            d[2] - s * e[2] - t * f[2]};
    return dot(rest, rest);
  };
  long double least = HUGE_VALL;
  for (std::size_t k = 0; k < 3; ++k) {
    const LongPoint e = minus(triangle[(k + 1) % 3], triangle[k]);
    const LongPoint f = minus(triangle[(k + 2) % 3], triangle[k]);
    const LongPoint d = minus(point, triangle[k]);
    const long double along = dot(e, e) > 0 ? std::clamp(dot(d, e) / dot(e, e), 0.0L, 1.0L) : 0;
    least = std::min(least, left(d, along, e, 0, f));
    const long double all = dot(e, e) * dot(f, f) - dot(e, f) * dot(e, f);
    const long double s = (dot(d, e) * dot(f, f) - dot(d, f) * dot(e, f)) / all;
    const long double t = (dot(d, f) * dot(e, e) - dot(d, e) * dot(e, f)) / all;
    if (all > 0 && s >= 0 && t >= 0 && s + t <= 1) {
      least = std::min(least, left(d, s, e, t, f));
    }
  }
  return static_cast<double>(least);
}

constexpr double kWeights[] = {10, 100, 1e3, 1e4, 1e5, 1e6};

/// Places in a cell, from 0 to 1, that are dense at its ends: there, surfaces run fast.
std::vector<double> places(int powers) {
  std::vector<double> all = {0, 1, 0.25, 0.5, 0.75};
  double near = 0.25;
  for (int k = 0; k < powers; ++k, near /= 2) {
    all.insert(all.end(), {near / 2, near * 0.7, 1 - near / 2, 1 - near * 0.7});
  }
  return all;
}

/// A quarter of a conic: x, y, z and the weight of each point.
std::vector<double> arc(double weight) { return {1, 0, 0, 1, 1, 1, 0, weight, 0, 1, 0, 1}; }

/// The largest distance of a curve's samples from its polyline of n segments, or one above `stop`.
double found_deviation(const std::vector<double>& points, std::uint32_t n, double stop) {
  static const std::vector<double> kPlaces = places(24);
  const int degree = static_cast<int>(points.size() / 4) - 1;
  const auto at = [&](long double u) {
    const std::vector<long double> b = bernstein(degree, u);
    long double sum[4] = {};
    for (std::size_t i = 0; i < b.size(); ++i) {
      const long double w = b[i] * points[4 * i + 3];
      for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += w * points[4 * i + c];
      }
      sum[3] += w;
    }
    return LongPoint{sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]};
  };
  double worst = 0;
  for (std::uint32_t i = 0; i < n && worst <= stop * stop; ++i) {
    const LongPoint a = at(static_cast<long double>(i) / n);
    const LongPoint b = at(static_cast<long double>(i + 1) / n);
    for (const double place : kPlaces) {
      const LongPoint p = at((i + static_cast<long double>(place)) / n);
      worst = std::max(worst, far_from(p, {a, b, b}));
    }
  }
  return std::sqrt(worst);
}

/// The same points from the other end; three times as heavy; a thousand times as large and far
/// away; raised to the next degree.
enum class Change { none, reversed, heavy, large, raised };

std::vector<double> changed(std::vector<double> points, Change change) {
  const std::size_t count = points.size() / 4;
  std::vector<double> raised(points.size() + 4);
  for (std::size_t i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    const double* const before = i > 0 ? &points[4 * (i - 1)] : nullptr;
    const double* const at = i < count ? &points[4 * i] : nullptr;
    const double a = before != nullptr ? share * before[3] : 0;
    const double b = at != nullptr ? (1 - share) * at[3] : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      raised[4 * i + c] =
          ((before != nullptr ? a * before[c] : 0) + (at != nullptr ? b * at[c] : 0)) / (a + b);
    }
    raised[4 * i + 3] = a + b;
  }
  if (change == Change::raised) {
    return raised;
  }
  std::vector<double> result = points;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const double x = points[4 * (change == Change::reversed ? count - 1 - i : i) + c];
      result[4 * i + c] = change == Change::heavy && c == 3   ? 3 * x
                          : change == Change::large && c != 3 ? 1000 * x + 700
                                                              : x;
    }
  }
  return result;
}

TEST(SpreadWeights, arcs_have_at_most_four_times_the_segments_they_need) {
  for (const double weight : kWeights) {
    for (const double relative : {0.1, 0.02, 1e-2, 1e-3, 1e-4}) {
      for (const Change change :
           {Change::none, Change::reversed, Change::heavy, Change::large, Change::raised}) {
        SCOPED_TRACE("weight " + std::to_string(weight) + ", tolerance " +
                     std::to_string(relative) + ", change " +
                     std::to_string(static_cast<int>(change)));
        const std::vector<double> points = changed(arc(weight), change);
        const int degree = static_cast<int>(points.size() / 4) - 1;
        const double tolerance = relative * (change == Change::large ? 1000 : 1);
        std::array<std::uint32_t, 1> count{};
        std::array<double, 1> deviation{};
        ASSERT_TRUE(choose_polylines(
            ControlCurves<double>::packed(std::span(points), degree, 3, Weights::cartesian),
            {tolerance}, count, deviation));
        const std::uint32_t chosen = count[0] - 1;
        EXPECT_LE(deviation[0], tolerance);
        EXPECT_LE(found_deviation(points, chosen, HUGE_VAL), deviation[0]);
        for (std::uint32_t n = 1; 4 * n < chosen; ++n) {
          EXPECT_GT(found_deviation(points, n, tolerance), tolerance) << chosen << " chosen, " << n;
        }
      }
    }
  }
}

TEST(SpreadWeights, flat_arcs_of_both_precisions_are_as_close_as_certified) {
  for (const double weight : {10.0, 1e3}) {
    const std::vector<double> points = arc(weight);
    const auto curves = ControlCurves<double>::packed(std::span(points), 2, 3, Weights::cartesian);
    const Polylines<double> fine = flatten<double>(curves, 0.02);
    const Polylines<float> coarse = flatten<float>(curves, 0.02);
    ASSERT_TRUE(fine);
    EXPECT_LE(fine.points.size(), 9U);
    EXPECT_LE(fine.deviation, 0.02);
    ASSERT_TRUE(coarse);
    EXPECT_LE(coarse.points.size(), 9U);
  }
}

/// Weights that are products, or one heavy point.
enum class Form { cylinder, octant, one_direction, heavy_inside, heavy_corner };

TestPatch patch_of(Form form, double weight, Change change, bool transposed) {
  constexpr double kArc[3][2] = {{1, 0}, {1, 1}, {0, 1}};
  const double along[] = {1, weight, 1};
  const bool cylinder = form == Form::cylinder;
  const bool heavy = form == Form::heavy_inside || form == Form::heavy_corner;
  const int rows = cylinder ? 2 : heavy ? 4 : 3;
  const int columns = heavy ? 4 : 3;
  std::vector<double> values;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const bool here = form == Form::heavy_inside ? i == 1 && j == 2 : i == 0 && j == 0;
      if (heavy) {
        values.insert(values.end(),
                      {i / 3.0, j / 3.0, 0.3 * std::sin(1.3 * i + j * j), here ? weight : 1});
      } else if (cylinder) {
        values.insert(values.end(), {kArc[i][0], kArc[i][1], 2.0 * j, along[i]});
      } else {
        const double across = form == Form::octant ? along[j] : j == 1 ? std::sqrt(0.5) : 1;
        values.insert(values.end(), {kArc[i][0] * kArc[j][0], kArc[i][1] * kArc[j][0], kArc[j][1],
                                     along[i] * across});
      }
    }
  }
  values = change == Change::raised ? values : changed(values, change);
  TestPatch patch{"form " + std::to_string(static_cast<int>(form)) + ", weight " +
                      std::to_string(weight) + ", change " +
                      std::to_string(static_cast<int>(change)) + (transposed ? " transposed" : ""),
                  columns - 1, rows - 1, Weights::cartesian, values};
  if (transposed) {
    std::swap(patch.degree_u, patch.degree_v);
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        std::copy_n(&values[static_cast<std::size_t>(4 * (j * columns + i))], 4,
                    &patch.values[static_cast<std::size_t>(4 * (i * rows + j))]);
      }
    }
  }
  return patch;
}

/// The largest distance of samples of a patch from cells with diagonals of one kind: 0 rising, 1
/// falling, 2 both through the middle; or one above `stop`.
double found_deviation(const TestPatch& patch, std::uint32_t nu, std::uint32_t nv, int diagonals,
                       double stop) {
  static const std::vector<double> kPlaces = places(8);
  std::vector<std::array<LongPoint, 3>> triangles;
  const auto vertex = [&](std::uint32_t i, std::uint32_t j) {
    return patch.at(static_cast<long double>(i) / nu, static_cast<long double>(j) / nv);
  };
  for (std::uint32_t j = 0; j < nv; ++j) {
    for (std::uint32_t i = 0; i < nu; ++i) {
      const LongPoint p[] = {vertex(i, j), vertex(i + 1, j), vertex(i, j + 1),
                             vertex(i + 1, j + 1)};
      const bool falls = diagonals == 2 ? (2 * i < nu) != (2 * j < nv) : diagonals == 1;
      triangles.push_back({p[0], p[1], falls ? p[2] : p[3]});
      triangles.push_back({p[falls ? 1 : 0], p[3], p[2]});
    }
  }
  double worst = 0;
  for (const double v : kPlaces) {
    for (const double u : kPlaces) {
      const LongPoint p = patch.at<long double>(u, v);
      double least = HUGE_VAL;
      for (std::size_t k = 0; k < triangles.size() && least > worst; ++k) {
        least = std::min(least, far_from(p, triangles[k]));
      }
      worst = std::max(worst, least);
      if (worst > stop * stop) {
        return std::sqrt(worst);
      }
    }
  }
  return std::sqrt(worst);
}

Choice choose(const TestPatch& patch, double tolerance) {
  Choice choice;
  RateOptions options;
  options.tolerance = tolerance;
  const ControlNets<double> nets = patch.nets();
  EXPECT_EQ(choose_rates(nets, topology_of(patch), options, choice.out()).status, Status::ok)
      << patch.name;
  return choice;
}

TEST(SpreadWeights, patches_have_at_most_four_times_the_cells_they_need) {
  for (const Form form : {Form::cylinder, Form::octant, Form::one_direction}) {
    for (const double weight : kWeights) {
      for (const double relative : {0.1, 1e-2}) {
        for (const Change change : {Change::none, Change::reversed, Change::heavy, Change::large}) {
          const bool transposed = change == Change::reversed || change == Change::heavy;
          const TestPatch patch = patch_of(form, weight, change, transposed);
          SCOPED_TRACE(patch.name);
          const double tolerance = relative * (change == Change::large ? 1000 : 1);
          const Choice choice = choose(patch, tolerance);
          const std::uint32_t chosen = choice.nu[0] * choice.nv[0];
          EXPECT_LE(choice.deviation[0], tolerance);
          for (std::uint32_t nu = 1; 4 * nu < chosen; ++nu) {
            for (std::uint32_t nv = 1; 4 * nu * nv < chosen; ++nv) {
              for (const int diagonals : {0, 1, 2}) {
                EXPECT_GT(found_deviation(patch, nu, nv, diagonals, tolerance), tolerance)
                    << chosen << " chosen, " << nu << " x " << nv;
              }
            }
          }
        }
      }
    }
  }
}

// Whatever cells there are, and wherever one point is heavy.
TEST(SpreadWeights, certificates_hold) {
  for (const Form form : {Form::cylinder, Form::octant, Form::one_direction, Form::heavy_inside,
                          Form::heavy_corner}) {
    for (const double weight : kWeights) {
      for (const Change change : {Change::none, Change::reversed}) {
        const TestPatch patch = patch_of(form, weight, change, change == Change::none);
        SCOPED_TRACE(patch.name);
        const ControlNets<double> nets = patch.nets();
        const std::span<const ControlNets<double>> sets(&nets, 1);
        const Topology topology = topology_of(patch);
        for (const std::array<std::uint32_t, 2> rates :
             {std::array{1U, 1U}, {2U, 2U}, {1U, 3U}, {5U, 4U}, {12U, 2U}}) {
          std::array<double, 1> deviation{};
          ASSERT_EQ(certify_grids(sets, rates[0], rates[1], {}, deviation).status, Status::ok);
          EXPECT_LE(found_deviation(patch, rates[0], rates[1], 0, HUGE_VAL), deviation[0]);
        }
        const Choice choice = choose(patch, 0.1);
        Choice certified = choice;
        certified.deviation[0] = 0;
        ASSERT_EQ(certify_rates(nets, topology, {}, certified.out()).status, Status::ok);
        EXPECT_LE(certified.deviation[0], 0.1);
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::spread_weights_test
