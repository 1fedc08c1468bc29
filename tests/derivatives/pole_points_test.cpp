// Which homogeneous sides are points is decided from the values as given, up to their own roundings
// (src/storage/one_point.hpp), and not after moving, which rounds once more. Certificates hold
// either way.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/derivatives/derivative_oracle.hpp"
#include "tests/derivatives/pole_nets.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::pole_points_test {
namespace {

constexpr ShapeCase kShapes[] = {{2, 2, 3, Weights::homogeneous},
                                 {3, 3, 3, Weights::homogeneous},
                                 {3, 5, 3, Weights::homogeneous},
                                 {7, 4, 3, Weights::homogeneous}};
constexpr std::size_t kN = 5;

class PolePoints : public IsaTest {
protected:
  /// test(case) for all shapes and sides.
  void for_every_side(const std::function<void(const PoleCase&)>& test) {
    for (const ShapeCase& shape : kShapes) {
      for (int side = 0; side < 4; ++side) {
        SCOPED_TRACE(testing::Message() << shape << ", side " << side);
        test({shape, side, false, 0});
      }
    }
  }

  /// Everything is within the certificate; on the side, derivatives along it are zero if
  /// `collapsed`.
  template <typename T>
  void expect_certified(const PoleCase& c, const std::vector<T>& values, bool collapsed,
                        const PackOptions& options) {
    PatchSet<T> set;
    expect_packed(pack(ControlNets<T>::packed(values.data(), 1, c.shape.degree_u, c.shape.degree_v,
                                              c.shape.components, c.shape.weights),
                       set, options));
    Planes<T> planes(kN * kN, {.second = true});
    grid(set, Grid<T>::uniform(kN, kN), planes.outputs());
    const ErrorBounds bounds = error_bounds(set, 0, isa());
    for (std::size_t k = 0; k < kN * kN; ++k) {
      const std::size_t i = k % kN;
      const std::size_t j = k / kN;
      const std::size_t across = c.along_u() ? j : i;
      const bool on_side = across == (c.side % 2 == 0 ? 0 : kN - 1);
      const double x = static_cast<double>(i) / 2 - 1;
      const double y = static_cast<double>(j) / 2 - 1;
      for (std::size_t component = 0; component < 3; ++component) {
        const DerivativeOracle exact = exact_derivatives(values, c.shape, 0, component, 1, 1, x, y);
        const auto error = [&](std::size_t group, const DoubleDouble& value, double shift) {
          const DoubleDouble found = static_cast<double>(planes.at(group, component, k));
          return abs(found + DoubleDouble(shift) - value).to_double();
        };
        const double shift = options.relative_to[component];
        EXPECT_LE(error(0, exact.value[0][0], shift), bounds.position[component]) << "sample " << k;
        EXPECT_LE(error(1, exact.value[1][0], 0), bounds.du[component]) << "sample " << k;
        EXPECT_LE(error(2, exact.value[0][1], 0), bounds.dv[component]) << "sample " << k;
        if (on_side && collapsed) {
          EXPECT_EQ(planes.at(c.along_u() ? 1 : 2, component, k), 0) << "sample " << k;
          EXPECT_EQ(planes.at(c.along_u() ? 4 : 6, component, k), 0) << "sample " << k;
        }
      }
    }
  }
};

/// A weight, and a coordinate times it, whose quotient rounds to that coordinate.
struct Factors {
  double weight;
  double product;
};
Factors rounded_factors(double coordinate, Random& random) {
  for (;;) {
    const double weight = random.between(1, 2);
    const double product = coordinate * weight;
    if (product / weight == coordinate) {
      return {weight, product};
    }
  }
}

// The first component is one value after division everywhere, so that it has no bound but that of
// its rounding; the side is a point after division, and none where its coordinates differ by twice
// as much as those of one point may.
TEST_P(PolePoints, are_points_up_to_roundings) {
  Random random(91);
  for (const bool apart : {false, true}) {
    for_every_side([&](const PoleCase& c) {
      std::vector<double> values;
      for (int j = 0; j <= c.shape.degree_v; ++j) {
        for (int i = 0; i <= c.shape.degree_u; ++i) {
          const Factors factors = rounded_factors(1.0 / 3, random);
          const double step = apart && (i + j) % 2 != 0 ? 0x1p-48 : 0;
          const double other = c.on_side(j, i) ? 1 + step : random.symmetric();
          values.insert(values.end(), {factors.product, other * factors.product,
                                       other * factors.product, factors.weight});
        }
      }
      for (const bool origins : {false, true}) {
        expect_certified(c, values, !apart, {.local_origin = origins, .isa = isa()});
      }
    });
  }
}

/// Coordinates are n / 3, which no format holds, with weights 3 k: sides are points exactly.
template <typename T>
std::vector<T> thirds(const PoleCase& c, int distance, Random& random) {
  std::vector<T> values;
  for (int j = 0; j <= c.shape.degree_v; ++j) {
    for (int i = 0; i <= c.shape.degree_u; ++i) {
      const int k = random.integer(1, 4);
      for (int component = 0; component < 3; ++component) {
        const int n = distance + (c.on_side(j, i) ? component + 1 : random.integer(-9, 9));
        values.push_back(static_cast<T>(n * k));
      }
      values.push_back(static_cast<T>(3 * k));
    }
  }
  return values;
}

template <typename T>
using PoleTest = std::function<void(const PoleCase&, const std::vector<T>&, const PackOptions&)>;
template <typename T>
void for_every_origin(const PoleCase& c, Isa isa, Random& random, const PoleTest<T>& test) {
  for (const int distance : {0, 1 << 20}) {
    for (const bool origins : {false, true}) {
      for (const double shift : {0.0, 0.5, 0.1}) {
        SCOPED_TRACE(testing::Message() << "distance " << distance << ", origins " << origins
                                        << ", relative to " << shift);
        test(c, thirds<T>(c, distance, random),
             {.local_origin = origins, .relative_to = {shift, shift, shift}, .isa = isa});
      }
    }
  }
}

TEST_P(PolePoints, are_found_where_no_format_holds_them) {
  Random random(92);
  for_every_side([&](const PoleCase& c) {
    for_every_origin<float>(c, isa(), random,
                            [&](const PoleCase& pole, const auto& values, const auto& options) {
                              expect_certified(pole, values, true, options);
                            });
    for_every_origin<double>(c, isa(), random,
                             [&](const PoleCase& pole, const auto& values, const auto& options) {
                               expect_certified(pole, values, true, options);
                             });
  });
}

// Products at the ends of double's range, where their low parts would be lost.
TEST_P(PolePoints, are_found_at_the_ends_of_the_range) {
  Random random(93);
  for (const double size : {0x1p-600, 0x1p520}) {
    for_every_side([&](const PoleCase& c) {
      std::vector<double> values = thirds<double>(c, 0, random);
      for (double& value : values) {
        value *= size;
      }
      expect_certified(c, values, true, {.isa = isa()});
    });
  }
}

// Curves likewise: slopes are exactly zero, and the certificate covers what that changes.
TEST(PoleCurves, are_points_up_to_roundings) {
  Random random(94);
  for (const bool exactly : {false, true}) {
    std::vector<double> values;
    for (int i = 0; i <= 3; ++i) {
      const Factors factors = rounded_factors(1.0 / 3, random);
      const double k = random.integer(1, 9);
      for (int component = 0; component < 2; ++component) {
        values.push_back(exactly ? k : factors.product);
      }
      values.push_back(exactly ? 3 * k : factors.weight);
    }
    const auto curve = ControlCurves<double>::packed(values.data(), 1, 3, 2, Weights::homogeneous);
    for (const bool origins : {false, true}) {
      CurveSet<double> set;
      PackOptions options{.local_origin = origins, .relative_to = {0.1, 0.1}};
      ASSERT_TRUE(pack(curve, set, options));
      double slope[2] = {-777, -777};
      CurveOutputs<double> out;
      out.d1 = {&slope[0], &slope[1], nullptr, 1};
      const double middle = 0.375;
      ASSERT_EQ(evaluate(set, CurveGrid<double>{1, &middle}, out), Status::ok);
      const ShapeCase as_patch{3, 1, 2, Weights::homogeneous};
      std::vector<double> twice = values;
      twice.insert(twice.end(), values.begin(), values.end());
      const double exact = exact_derivatives(twice, as_patch, 0, 0, 1, 0, 2 * middle - 1, 0.0)
                               .value[1][0]
                               .to_double();
      EXPECT_EQ(exact == 0, exactly);
      EXPECT_EQ(slope[0], 0) << "for " << exact;
      EXPECT_LE(std::abs(slope[0] - exact), error_bounds(set, 0).d1[0]);
    }
  }
}
INSTANTIATE_FOR_EVERY_ISA(PolePoints);

} // namespace
} // namespace simdbezier::tests::pole_points_test
