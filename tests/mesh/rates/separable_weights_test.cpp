// Rates of patches whose weights are products of one factor a column and one a row, such as those
// of cylinders, spheres and tori, against dense samples.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/rates.hpp>

#include "src/mesh/bounds/separable_bound.hpp"
#include "tests/mesh/support/sampled_patch.hpp"

namespace simdbezier::tests::separable_weights_test {
namespace {

enum class Form { any, cylinder, cone };

/// departure: how far weights may be from products.
TestPatch random_patch(unsigned seed, double departure) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  TestPatch patch;
  patch.weights = seed % 2 == 0 ? Weights::cartesian : Weights::homogeneous;
  const Form form = static_cast<Form>(seed / 2 % 3);
  patch.degree_u = 1 + static_cast<int>(random() % 5);
  patch.degree_v = form == Form::any ? 1 + static_cast<int>(random() % 5) : 1;
  const double far = seed % 5 == 0 ? 1e4 : 0; // where points have fewer digits
  const double spread = 1.5 * std::fabs(uniform(random));
  std::vector<double> across;
  for (int j = 0; j <= patch.degree_v; ++j) {
    across.push_back(std::exp(spread * uniform(random)));
  }
  std::vector<std::array<double, 4>> along;
  for (int i = 0; i <= patch.degree_u; ++i) {
    along.push_back(
        {i + uniform(random), 2 * uniform(random), 0, std::exp(spread * uniform(random))});
  }
  for (int j = 0; j <= patch.degree_v; ++j) {
    for (int i = 0; i <= patch.degree_u; ++i) {
      const auto& [x, y, z, weight] = along[static_cast<std::size_t>(i)];
      const double shrink = form == Form::cone ? 1 - 0.9 * j : 1;
      const double bend = form == Form::any ? uniform(random) : 0;
      const Point p = {far + shrink * x, y * shrink + bend, z + 3 * j + bend};
      const double w =
          weight * across[static_cast<std::size_t>(j)] * (1 + departure * uniform(random));
      const double factor = patch.weights == Weights::homogeneous ? w : 1;
      patch.values.insert(patch.values.end(), {factor * p[0], factor * p[1], factor * p[2], w});
    }
  }
  patch.name = "patch " + std::to_string(seed) + ", departure " + std::to_string(departure);
  return patch;
}

Choice choose(const TestPatch& patch, double tolerance) {
  Choice choice;
  RateOptions options;
  options.tolerance = tolerance;
  const ControlNets<double> nets = patch.nets();
  EXPECT_EQ(choose_rates(std::span<const ControlNets<double>>(&nets, 1), topology_of(patch),
                         options, choice.out())
                .status,
            Status::ok);
  return choice;
}

TEST(SeparableWeights, certificates_hold) {
  for (const double departure : {0.0, 1e-7, 5e-5, 1e-3}) { // the last ones are no products
    for (unsigned seed = 0; seed < 40; ++seed) {
      const TestPatch patch = random_patch(seed, departure);
      SCOPED_TRACE(patch.name);
      const Topology topology = topology_of(patch);
      const ControlNets<double> nets = patch.nets();
      const std::span<const ControlNets<double>> sets(&nets, 1);
      for (const std::array<std::uint32_t, 2> rates :
           {std::array{1U, 1U}, {1U, 3U}, {5U, 1U}, {4U, 3U}, {12U, 2U}}) {
        Choice choice;
        choice.nu[0] = rates[0];
        choice.nv[0] = rates[1];
        ASSERT_EQ(certify_rates(sets, topology, {}, choice.out()).status, Status::ok);
        EXPECT_LE(found_deviation(patch, topology, choice), choice.deviation[0]);
        choice.diagonals[0] = 0;
        ASSERT_EQ(certify_grids(sets, rates[0], rates[1], {}, choice.deviation).status, Status::ok);
        EXPECT_LE(found_deviation(patch, topology, choice), choice.deviation[0]);
      }
      const Choice chosen = choose(patch, 0.1);
      EXPECT_LE(chosen.deviation[0], 0.1);
      if (chosen.nu[0] * chosen.nv[0] <= 150) {
        EXPECT_LE(found_deviation(patch, topology, chosen), chosen.deviation[0]);
      }
    }
  }
}

/// A quarter of a cylinder, of radius 1 and height 2.
TestPatch cylinder(Weights form) {
  TestPatch patch{"cylinder", 2, 1, form, {}};
  const double w = std::sqrt(0.5);
  for (const double z : {0.0, 2.0}) {
    for (const std::array<double, 3> p :
         {std::array{1.0, 0.0, 1.0}, {1.0, 1.0, w}, {0.0, 1.0, 1.0}}) {
      const double factor = form == Weights::homogeneous ? p[2] : 1;
      patch.values.insert(patch.values.end(), {factor * p[0], factor * p[1], factor * z, p[2]});
    }
  }
  return patch;
}

using LongPoint = std::array<long double, 3>;

/// The largest lengths of second derivatives in uu, uv and vv, by differences of points that are
/// 2^-12 apart, which errs by about 1e-5 of them.
std::array<double, 3> found_derivatives(const TestPatch& patch) {
  constexpr long double kStep = 0x1p-12L;
  std::array<double, 3> most{};
  for (int j = 0; j <= 16; ++j) {
    for (int i = 0; i <= 16; ++i) {
      const long double u = 2 * kStep + (1 - 4 * kStep) * i / 16;
      const long double v = 2 * kStep + (1 - 4 * kStep) * j / 16;
      const auto at = [&](int du, int dv) { return patch.at(u + kStep * du, v + kStep * dv); };
      const LongPoint points[] = {at(-1, 0), at(1, 0),  at(0, -1), at(0, 1), at(-1, -1),
                                  at(1, -1), at(-1, 1), at(1, 1),  at(0, 0)};
      long double squares[3] = {};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto x = [&](std::size_t k) { return points[k][c]; };
        const long double uu = x(0) + x(1) - 2 * x(8);
        const long double uv = (x(4) + x(7) - x(5) - x(6)) / 4;
        const long double vv = x(2) + x(3) - 2 * x(8);
        squares[0] += uu * uu;
        squares[1] += uv * uv;
        squares[2] += vv * vv;
      }
      for (std::size_t d = 0; d < 3; ++d) {
        most[d] = std::max(most[d], static_cast<double>(std::sqrt(squares[d]) / (kStep * kStep)));
      }
    }
  }
  return most;
}

/// The patch as the bound takes it, in its own place and size.
detail::VectorPatch vectors_of(const TestPatch& patch) {
  detail::VectorPatch vectors;
  vectors.rational = true;
  vectors.net.resize(static_cast<std::size_t>(patch.degree_u) + 1,
                     static_cast<std::size_t>(patch.degree_v) + 1);
  for (std::size_t k = 0; k < vectors.net.at.size(); ++k) {
    const double* const p = &patch.values[4 * k];
    const double factor = patch.weights == Weights::homogeneous ? 1 : p[3];
    vectors.net.at[k] = {{factor * p[0], factor * p[1], factor * p[2], p[3]}};
    for (const double x : vectors.net.at[k].x) {
      vectors.largest = std::max(vectors.largest, std::fabs(x));
    }
  }
  return vectors;
}

// Control points of derivatives are a hull of them, and not a far larger one.
TEST(SeparableWeights, second_derivatives_are_bounded) {
  std::array<std::vector<double>, 3> ratios;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const TestPatch patch = random_patch(seed, 0);
    SCOPED_TRACE(patch.name);
    const std::array<double, 3> found = found_derivatives(patch);
    const detail::SeparableBound bound = detail::bound_separable(vectors_of(patch));
    const double bounds[] = {bound.uu, bound.uv, bound.vv};
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_GE(bounds[d], found[d] * (1 - 1e-3) - 1e-6) << d;
      if (found[d] > 1e-3) {
        ratios[d].push_back(bounds[d] / found[d]);
      }
    }
  }
  for (std::vector<double>& all : ratios) {
    ASSERT_GT(all.size(), 20U);
    std::sort(all.begin(), all.end());
    EXPECT_LT(all[all.size() / 2], 2);
  }
}

// The largest deviation of a bilinear saddle from its two triangles is a quarter of its twist.
TEST(SeparableWeights, terms_add_up) {
  EXPECT_GE((detail::SeparableBound{8, 0, 0, 0}.at({2, 1})), 0.25);
  EXPECT_GE((detail::SeparableBound{0, 1, 0, 0}.at({1, 1})), 0.25);
  EXPECT_GE((detail::SeparableBound{0, 0, 8, 1}.at({1, 2})), 1.25);
  EXPECT_LE((detail::SeparableBound{8, 4, 8, 0}.at({1, 1})), 3.001);
}

// Weights may be off from products by what rounding does to them, which moves points by as much.
TEST(SeparableWeights, departures_from_products_count) {
  TestPatch patch = random_patch(6, 0);
  const double off = detail::bound_separable(vectors_of(patch)).off;
  EXPECT_LT(off, 1e-12);
  patch.values.back() *= 1 + 1e-5; // a Cartesian weight
  const detail::SeparableBound moved = detail::bound_separable(vectors_of(patch));
  EXPECT_GT(moved.off, 1e-5);
  EXPECT_LT(moved.off, 1e-2);
  patch.values.back() *= 1.01;
  EXPECT_EQ(detail::bound_separable(vectors_of(patch)).off, HUGE_VAL);
}

// An arc of angle a has the sagitta a^2 / 8: rates go with the root of the tolerance, and one cell
// is enough along the ruling.
TEST(SeparableWeights, cylinders_have_cells_of_their_full_height) {
  for (const Weights form : {Weights::cartesian, Weights::homogeneous}) {
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
      const Choice choice = choose(cylinder(form), tolerance);
      const double needed = std::acos(0.0) / std::sqrt(8 * tolerance);
      EXPECT_EQ(choice.nv[0], 1U);
      EXPECT_GE(choice.nu[0], needed * 0.99);
      EXPECT_LE(choice.nu[0], needed * 1.25 + 1);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::separable_weights_test
