// Bounds of very small and very large models are those of usual ones, times the scale.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/flatten.hpp>
#include <simdbezier/mesh.hpp>

namespace simdbezier::tests::scale_test {
namespace {

constexpr int kExponents[] = {-900, -565, -300, 300, 665, 900};

struct Shape {
  int degree;
  Weights weights;
};
constexpr Shape kShapes[] = {
    {2, Weights::none}, {4, Weights::none}, {2, Weights::cartesian}, {3, Weights::homogeneous}};

std::vector<double> values_of(const Shape& shape, int exponent) {
  std::vector<double> values;
  for (int j = 0; j <= shape.degree; ++j) {
    for (int i = 0; i <= shape.degree; ++i) {
      const double w = shape.weights == Weights::none ? 1 : 1 + 0.25 * ((i + j) % 2);
      const double divisor = shape.weights == Weights::homogeneous ? 1 / w : 1;
      for (const double x : {1.0 * i, 1.0 * j, std::sin(1.0 * i + 2.0 * j)}) {
        values.push_back(std::scalbn(x / divisor, exponent));
      }
      if (shape.weights != Weights::none) {
        values.push_back(w);
      }
    }
  }
  return values;
}

TEST(MeshScale, certificates_and_rates_go_with_it) {
  for (const Shape& shape : kShapes) {
    const auto plan_of = [&](int exponent, bool uniform) {
      const std::vector<double> values = values_of(shape, exponent);
      const auto nets = ControlNets<double>::packed(values.data(), 1, shape.degree, shape.degree, 3,
                                                    shape.weights);
      MeshOptions options;
      if (uniform) {
        options.nu = options.nv = 4;
      } else {
        options.relative_tolerance = 1e-3;
      }
      return plan_mesh<double>(nets, options);
    };
    for (const bool uniform : {false, true}) {
      const MeshPlan<double> usual = plan_of(0, uniform);
      ASSERT_EQ(usual.report.status, Status::ok);
      EXPECT_GT(usual.deviation, 0);
      for (const int exponent : kExponents) {
        SCOPED_TRACE(exponent);
        const MeshPlan<double> plan = plan_of(exponent, uniform);
        ASSERT_EQ(plan.report.status, Status::ok);
        EXPECT_EQ(plan.diagonal, std::scalbn(usual.diagonal, exponent));
        EXPECT_EQ(plan.cells_u, usual.cells_u);
        EXPECT_EQ(plan.cells_v, usual.cells_v);
        EXPECT_NEAR(std::scalbn(plan.deviation, -exponent), usual.deviation,
                    1e-9 * usual.deviation);
      }
    }
  }
}

TEST(MeshScale, polylines_go_with_it) {
  for (const bool rational : {false, true}) {
    const auto lines_of = [&](int exponent) {
      std::vector<double> values;
      for (int i = 0; i < 5; ++i) {
        values.push_back(std::scalbn(1.0 * i, exponent));
        values.push_back(std::scalbn(std::sin(2.0 * i), exponent));
        values.push_back(0);
        if (rational) {
          values.push_back(1 + 0.25 * (i % 2));
        }
      }
      const auto curves = ControlCurves<double>::packed(
          values.data(), 1, 4, 3, rational ? Weights::cartesian : Weights::none);
      return flatten<double>(curves, std::scalbn(1e-3, exponent));
    };
    const Polylines<double> usual = lines_of(0);
    ASSERT_EQ(usual.report.status, Status::ok);
    for (const int exponent : kExponents) {
      SCOPED_TRACE(exponent);
      const Polylines<double> lines = lines_of(exponent);
      ASSERT_EQ(lines.report.status, Status::ok);
      EXPECT_EQ(lines.first, usual.first);
      EXPECT_NEAR(std::scalbn(lines.deviation, -exponent), usual.deviation, 1e-9 * usual.deviation);
    }
  }
}

TEST(MeshScale, a_model_that_is_one_point_has_relative_tolerances) {
  const std::vector<double> values(48, 2.0);
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  MeshOptions options;
  options.relative_tolerance = 1e-3;
  const MeshPlan<float> plan = plan_mesh<float>(nets, options);
  EXPECT_EQ(plan.report.status, Status::ok);
  EXPECT_LT(plan.deviation, 1e-5);
}

/// Two sheets side by side with a gap of a tenth between them.
TEST(MeshScale, points_and_snapping_go_with_it) {
  for (const int exponent : {0, -500, -550, -700, -1000, 550, 1000}) {
    SCOPED_TRACE(exponent);
    std::vector<double> values;
    for (int patch = 0; patch < 2; ++patch) {
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          for (const double x : {3.1 * patch + i, 1.0 * j, i == 1 || i == 2 ? 0.5 : 0}) {
            values.push_back(std::scalbn(x, exponent));
          }
        }
      }
    }
    const auto nets = ControlNets<double>::packed(std::span<const double>(values));
    for (const double snap : {0.05, 0.2}) {
      MeshOptions options;
      options.nu = options.nv = 64;
      options.topology.snap = std::scalbn(snap, exponent);
      options.topology.point_size = std::scalbn(1e-6, exponent);
      const MeshPlan<double> plan = plan_mesh<double>(nets, options);
      ASSERT_EQ(plan.report.status, Status::ok);
      EXPECT_EQ(plan.counts.collapsed_sides, 0U);
      EXPECT_EQ(plan.counts.snapped_sides, snap > 0.1 ? 2U : 0U);
      EXPECT_EQ(std::scalbn(plan.deviations[1], -exponent) >= 0.0999, snap > 0.1);
    }
  }
}

TEST(MeshScale, a_model_that_is_nearly_one_point_has_the_tolerance_that_is_asked_for) {
  // All but one point: its size is far below the tolerance, and below what its vertices are off.
  std::vector<double> values(48, 1000.0);
  values[15] += 1e-12;
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  const std::array<double, 1> own = {0.1};
  struct Case {
    const char* name;
    MeshOptions options;
    Status status;
  };
  std::vector<Case> cases(6);
  cases[0] = {"tolerance", {}, Status::ok};
  cases[0].options.rates.tolerance = 0.1;
  cases[1] = {"tolerances", {}, Status::ok};
  cases[1].options.rates.tolerances = own;
  cases[2] = {"pixels", {}, Status::ok};
  cases[2].options.pixels = 1;
  cases[2].options.camera.eye = {1000, 1000, 2000};
  cases[3] = {"angle", {}, Status::ok};
  cases[3].options.rates.normal_degrees = 6;
  cases[4] = {"below the vertices' errors", {}, Status::bad_tolerance};
  cases[4].options.rates.tolerance = 1e-9;
  cases[5] = {"the smaller of two", {}, Status::bad_tolerance};
  cases[5].options.rates.tolerances = own;
  cases[5].options.rates.tolerance = 1e-9;
  for (const Case& each : cases) {
    SCOPED_TRACE(each.name);
    const MeshPlan<float> plan = plan_mesh<float>(nets, each.options);
    EXPECT_EQ(plan.report.status, each.status);
    EXPECT_LE(plan.deviation, 0.1);
  }
}

TEST(MeshScale, errors_below_zero_are_refused) {
  const std::vector<double> values = values_of({3, Weights::none}, 0);
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  Topology topology;
  ASSERT_EQ(find_topology(nets, topology), Status::ok);
  std::vector<std::uint32_t> nu(1, 1);
  std::vector<std::uint32_t> nv(1, 1);
  std::vector<std::uint16_t> diagonals(1);
  for (const double error : {-1.0, -1e-300, std::numeric_limits<double>::quiet_NaN()}) {
    const std::vector<double> errors = {error};
    RateOptions options;
    options.tolerance = 0.1;
    options.errors = errors;
    EXPECT_EQ(choose_rates<double>({&nets, 1}, topology, options, {nu, nv, diagonals, {}}).status,
              Status::bad_tolerance);
    EXPECT_EQ(certify_rates<double>({&nets, 1}, topology, errors, {nu, nv, diagonals, {}}).status,
              Status::bad_tolerance);
  }
}

TEST(MeshAttributes, have_as_many_components_as_the_set_has_behind_the_first) {
  const std::vector<double> values = values_of({3, Weights::none}, 0);
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  MeshOptions options;
  options.nu = options.nv = 3;
  const MeshPlan<float> plan = plan_mesh<float>(nets, options);
  ASSERT_EQ(plan.report.status, Status::ok);
  std::vector<float> to(3 * plan.layout.size().vertices, 77.0F);
  const auto status_of = [&](const Vectors<float>& out, int first) {
    return evaluate_mesh_attributes(plan.set, plan.layout, out, first);
  };
  EXPECT_EQ(status_of(Vectors<float>::xyz(to.data(), 3), 0), Status::ok);
  EXPECT_EQ(status_of(Vectors<float>::xyz(to.data(), 3), 1), Status::extra_z);
  EXPECT_EQ(status_of(Vectors<float>::pairs(to.data(), 3), 1), Status::ok);
  EXPECT_EQ(status_of(Vectors<float>::pairs(to.data(), 3), 2), Status::extra_y);
}

/// The largest value of sum l_i l_j q_ij / 2 over a triangle, q being the terms of its edges.
long double bound_of(long double a, long double b, long double c) {
  const long double largest = std::max({a, b, c});
  if (2 * largest >= a + b + c) {
    return largest / 8;
  }
  return a * b * c / (4 * (a * b + b * c + c * a) - 2 * (a * a + b * b + c * c));
}

/// (u, v, 0) + ratio u^2 a + v^2 c, which has one bound everywhere, with the angle between unit
/// vectors a and c.
template <typename T>
std::vector<T> bent(double ratio, double angle) {
  constexpr double kLinear[] = {0, 1.0 / 3, 2.0 / 3, 1};
  constexpr double kSquare[] = {0, 0, 1.0 / 3, 1};
  std::vector<T> values;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double a = ratio * kSquare[i];
      values.push_back(static_cast<T>(kLinear[i] + a * std::sin(angle)));
      values.push_back(static_cast<T>(kLinear[j]));
      values.push_back(static_cast<T>(kSquare[j] + a * std::cos(angle)));
    }
  }
  return values;
}

template <typename T>
double certified_cell(const std::vector<T>& values) {
  const auto nets = ControlNets<T>::packed(std::span<const T>(values));
  Topology topology;
  EXPECT_EQ(find_topology(nets, topology), Status::ok);
  std::vector<std::uint32_t> one(1, 1);
  std::vector<std::uint16_t> diagonals(1);
  std::vector<double> deviation(1);
  EXPECT_EQ(certify_rates<T>({&nets, 1}, topology, {}, {one, one, diagonals, deviation}).status,
            Status::ok);
  return deviation[0];
}

TEST(MeshScale, certificates_hold_where_a_patch_bends_far_more_one_way) {
  for (const double ratio : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    for (int k = 0; k <= 60; ++k) {
      const double angle = 0.05 * k;
      const std::vector<float> rounded = bent<float>(ratio, angle);
      const double in_float = certified_cell(rounded);
      const double in_double = certified_cell(std::vector<double>(rounded.begin(), rounded.end()));
      EXPECT_GE(in_float, in_double) << ratio << ", angle " << angle;
      EXPECT_LE(in_float, in_double * 1.0001);
      const auto a = static_cast<long double>(ratio);
      const long double d =
          std::sqrt(1 + a * a + 2 * a * std::cos(static_cast<long double>(angle)));
      const double exact = certified_cell(bent<double>(ratio, angle));
      EXPECT_GE(exact, static_cast<double>(2 * bound_of(a, 1, d)) * (1 - 1e-15));
    }
  }
}

} // namespace
} // namespace simdbezier::tests::scale_test
