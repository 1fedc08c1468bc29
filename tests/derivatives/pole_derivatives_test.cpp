// Derivatives of rational patches that have a side which is one point: on all four sides, with all
// forms of weights, by every call, around every origin, against the oracle and the certificate.
//
// The checks of collapsed_edges_test.cpp are exact but say nothing about derivatives across such a
// side, and random nets have no such sides.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/derivatives/derivative_calls.hpp"
#include "tests/derivatives/derivative_oracle.hpp"
#include "tests/derivatives/pole_nets.hpp"
#include "tests/support/evaluation.hpp"

namespace simdbezier::tests::pole_derivatives_test {
namespace {

constexpr ShapeCase kShapes[] = {
    {1, 1, 3, Weights::cartesian}, {2, 2, 3, Weights::cartesian},   {2, 2, 3, Weights::homogeneous},
    {3, 3, 3, Weights::cartesian}, {3, 3, 3, Weights::homogeneous}, {3, 5, 3, Weights::homogeneous},
    {7, 4, 3, Weights::cartesian}, {7, 4, 3, Weights::homogeneous}, {2, 6, 3, Weights::cartesian},
};

/// Where a set's origin is. The shift has few bits, too.
struct Placement {
  double distance;
  bool local_origin;
  double shift[3];
};
constexpr Placement kPlacements[] = {
    {0, false, {0, 0, 0}},  {0, true, {0, 0, 0}},        {0, false, {0.5, -3, 2.25}},
    {512, true, {0, 0, 0}}, {512, true, {500, 512, -3}},
};

/// Corners, edges, the seams of patches that are cut, the inside; exact in both formats.
constexpr double kParameters[] = {-1, -0.40625, 0, 0.71875, 1};
constexpr std::size_t kN = std::size(kParameters);
constexpr std::size_t kSamples = kN * kN;
constexpr int kMostOrder = 3;

/// Orders (du, dv) of the groups of Planes; 3 is the normal.
constexpr std::pair<std::size_t, std::size_t> kOrders[] = {{0, 0}, {1, 0}, {0, 1}, {},
                                                           {2, 0}, {1, 1}, {0, 2}};

using Oracle = std::vector<std::vector<DerivativeOracle>>; ///< [sample][component]

struct Example {
  PoleCase pole;
  Placement place;
  std::vector<double> values;
  Oracle oracle;
};

Example make_example(const PoleCase& pole, const Placement& place, std::uint64_t seed) {
  Example example{pole, place, pole_values(pole, seed), Oracle(kSamples)};
  const std::vector<double> moved = moved_values(pole.shape, example.values, place.shift);
  for (std::size_t k = 0; k < kSamples; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      example.oracle[k].push_back(exact_derivatives(moved, pole.shape, 0, i, kMostOrder, kMostOrder,
                                                    kParameters[k % kN], kParameters[k / kN]));
    }
  }
  return example;
}

/// Every shape on every side with all weights, each of them in three of the five places. Made once
/// for all instruction sets: the oracle is what takes time.
const std::vector<Example>& examples() {
  static const std::vector<Example> all = [] {
    std::vector<Example> result;
    std::size_t turn = 0;
    for (const ShapeCase& shape : kShapes) {
      for (int side = 0; side < 4; ++side) {
        for (const bool equal : {false, true}) {
          for (std::size_t k = 0; k < 3; ++k) {
            const Placement& place = kPlacements[turn++ % std::size(kPlacements)];
            result.push_back(make_example({shape, side, equal, place.distance}, place, turn));
          }
        }
      }
    }
    return result;
  }();
  return all;
}

class PoleDerivatives : public DerivativeTest {
protected:
  template <typename T>
  void check(const Example& example) {
    const PoleCase& c = example.pole;
    const Placement& place = example.place;
    const Oracle& oracle = example.oracle;
    const std::vector<T> points(example.values.begin(), example.values.end());
    PackOptions options{.local_origin = place.local_origin, .isa = isa()};
    std::copy_n(place.shift, 3, options.relative_to);
    PatchSet<T> set;
    expect_packed(pack(ControlNets<T>::packed(points.data(), 1, c.shape.degree_u, c.shape.degree_v,
                                              c.shape.components, c.shape.weights),
                       set, options));
    SampleList<T> samples;
    for (const double y : kParameters) {
      for (const double x : kParameters) {
        samples.add(0, x, y);
      }
    }
    const Planes<T> planes = by_grid(set);
    check_planes(c, planes, set, oracle);
    check_planes(c, by_scattered(set, samples), set, oracle);
    check_other_grids(set, planes);
    check_orders(c, set, samples, oracle);
  }

  template <typename T>
  Grid<T> parameters() {
    static const std::vector<T> values(std::begin(kParameters), std::end(kParameters));
    return {kN, kN, values.data(), values.data(), Parameters::centred};
  }

  template <typename T>
  Planes<T> by_grid(const PatchSet<T>& set) {
    Planes<T> planes(kSamples, {.second = true});
    grid(set, parameters<T>(), planes.outputs());
    return planes;
  }

  template <typename T>
  Planes<T> by_scattered(const PatchSet<T>& set, const SampleList<T>& samples) {
    Planes<T> planes(kSamples, {.second = true});
    scattered(set, samples.view(), planes.outputs());
    return planes;
  }

  /// Errors are relative to what the oracle says; T's unit roundoff times about 1.5 times what
  /// random nets were measured to need.
  template <typename T>
  static double allowed(const ShapeCase& c, double size) {
    constexpr double kUnit = std::numeric_limits<T>::epsilon() / 2;
    return ((c.degree_u + c.degree_v) / 2.0 + 4) * 2 * kUnit * size;
  }

  template <typename T>
  void check_planes(const PoleCase& c, const Planes<T>& planes, const PatchSet<T>& set,
                    const Oracle& oracle) {
    const ErrorBounds bounds = error_bounds(set, 0, isa());
    const double* const certified[] = {bounds.position, bounds.du, bounds.dv};
    for (std::size_t k = 0; k < kSamples; ++k) {
      for (const std::size_t group : {0U, 1U, 2U, 4U, 5U, 6U}) {
        const auto [a, b] = kOrders[group];
        for (std::size_t i = 0; i < 3; ++i) {
          const DerivativeOracle& o = oracle[k][i];
          const DoubleDouble found = static_cast<double>(planes.at(group, i, k));
          const double error = abs(found - o.value[a][b]).to_double();
          ASSERT_LE(error, allowed<T>(c.shape, o.size[a][b]))
              << c << ", order " << a << "," << b << ", sample " << k << ", component " << i << ": "
              << found.hi << " for " << o.value[a][b].hi;
          if (group < 3) {
            ASSERT_LE(error, certified[group][i]) << c << ", group " << group << ", sample " << k;
          }
        }
      }
    }
  }

  /// Tiles and per-patch grids have a grid's bits.
  template <typename T>
  void check_other_grids(const PatchSet<T>& set, const Planes<T>& expected) {
    std::size_t received = 0;
    const TileFormat format{
        .outputs = {Output::position, Output::du, Output::dv, Output::duu, Output::duv}};
    tiles(set, parameters<T>(), format, TileFunction<T>([&](const Tile<T>& tile) {
            for (std::size_t k = 0; k < tile.samples; ++k) {
              const std::size_t at = tile.first_row * kN + k;
              EXPECT_EQ(tile.out.du.x[static_cast<std::ptrdiff_t>(k) * tile.out.du.stride],
                        expected.at(1, 0, at));
              EXPECT_EQ(tile.out.duv.y[static_cast<std::ptrdiff_t>(k) * tile.out.duv.stride],
                        expected.at(5, 1, at));
            }
            received += tile.samples;
          }));
    EXPECT_EQ(received, kSamples);

    constexpr std::uint32_t kSize = 3;
    Planes<T> small(kSize * kSize, {.second = true});
    Planes<T> alone(kSize * kSize, {.second = true});
    patch_grids(set, {{&kSize, 1}, {&kSize, 1}}, small.outputs());
    grid(set, Grid<T>::uniform(kSize, kSize), alone.outputs());
    EXPECT_EQ(differing_values(small, alone), 0U);
  }

  template <typename T>
  void check_orders(const PoleCase& c, const PatchSet<T>& set, const SampleList<T>& samples,
                    const Oracle& oracle) {
    const std::vector<OrderPair> orders = orders_up_to(kMostOrder, kMostOrder);
    DerivativeBuffers<T> of_samples(orders, kSamples, 3);
    DerivativeBuffers<T> of_grid(orders, kSamples, 3);
    derivatives(set, samples.view(), of_samples.list());
    derivatives(set, parameters<T>(), of_grid.list());
    EXPECT_EQ(of_samples.values, of_grid.values) << c;
    for (std::size_t d = 0; d < orders.size(); ++d) {
      const auto a = static_cast<std::size_t>(orders[d].first);
      const auto b = static_cast<std::size_t>(orders[d].second);
      for (std::size_t k = 0; k < kSamples * 3; ++k) {
        const DerivativeOracle& o = oracle[k / 3][k % 3];
        const DoubleDouble found = static_cast<double>(of_samples.values[d][k]);
        ASSERT_LE(abs(found - o.value[a][b]).to_double(), allowed<T>(c.shape, o.size[a][b]))
            << c << ", order " << a << "," << b << ", sample " << k / 3 << ", component " << k % 3
            << ": " << found.hi << " for " << o.value[a][b].hi;
      }
    }
  }
};

TEST_P(PoleDerivatives, are_those_of_the_surface) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(testing::Message()
                 << example.pole << (example.place.local_origin ? ", local origin" : "")
                 << ", relative to " << example.place.shift[0]);
    check<float>(example);
    check<double>(example);
    if (HasFatalFailure()) {
      return;
    }
  }
}
INSTANTIATE_FOR_EVERY_ISA(PoleDerivatives);

} // namespace
} // namespace simdbezier::tests::pole_derivatives_test
