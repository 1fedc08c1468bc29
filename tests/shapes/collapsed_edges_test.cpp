// Sides of rational patches that are points: positions and derivatives along them are exact.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "tests/derivatives/derivative_calls.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/shaped_nets.hpp"

namespace simdbezier::tests::collapsed_edges_test {
namespace {

constexpr std::size_t kN = 9;

/// Sides are those of side_point(): v = 0, v = 1, u = 0, u = 1.
[[nodiscard]] bool along_u(int side) { return side < 2; }

/// Sample i of kN along a side of a kN x kN grid.
[[nodiscard]] std::size_t sample_on(int side, std::size_t i) {
  const std::size_t fixed = side % 2 == 0 ? 0 : kN - 1;
  return along_u(side) ? fixed * kN + i : i * kN + fixed;
}

/// A dish with weights in a ratio whose side is its first point.
[[nodiscard]] Net dish_with_pole(Degrees degrees, int side, Random& random, double ratio = 4) {
  Net net = shaped_net(degrees, [&](int j, int i) {
    const double x = 2.0 * i / degrees.u - 0.9;
    const double y = 2.0 * j / degrees.v - 1.2;
    return Vector3{x, y, 0.3 * x * x - 0.2 * y * y + 0.1 * x * y + 0.01 * random.symmetric()};
  });
  const int last = along_u(side) ? degrees.u : degrees.v;
  for (int k = 1; k <= last; ++k) {
    side_point(net, side, k) = side_point(net, side, 0);
  }
  return weighted(std::move(net), ratio, random);
}

constexpr Degrees kDegrees[] = {{2, 2}, {3, 3}, {1, 2}, {5, 4}, {8, 7}, {2, 9}, {6, 1}};

class CollapsedEdgeTest : public DerivativeTest {
protected:
  /// test(net, side, options) for every shape, side and choice of origins.
  template <typename T>
  void for_every_pole(const std::function<void(const Net&, int, const PackOptions&)>& test) {
    Random random(81);
    for (const Degrees& degrees : kDegrees) {
      for (int side = 0; side < 4; ++side) {
        const Net net = rounded_to<T>(dish_with_pole(degrees, side, random));
        for (const bool origins : {false, true}) {
          SCOPED_TRACE(testing::Message() << degrees.u << " x " << degrees.v << ", side " << side
                                          << (origins ? ", local origins" : ""));
          test(net, side, {.local_origin = origins, .isa = isa()});
        }
      }
    }
  }

  template <typename T>
  void expect_points(const Net& given, int side, const PackOptions& options) {
    Net net = given;
    const PatchSet<T> set = packed<T>(std::span(&net, 1), options);
    Planes<T> by_grid(kN * kN, {true, true, true, true, true, true});
    grid(set, Grid<T>::uniform(kN, kN), by_grid.outputs());
    SampleArrays<T> samples;
    for (const Parameters2<T>& at : grid_parameters<T>(kN, kN)) {
      samples.add(0, at.x, at.y);
    }
    Planes<T> by_scattered(kN * kN, {true, true, true, true, true, true});
    scattered(set, samples.view(Parameters::centred), by_scattered.outputs());
    for (const Planes<T>* planes : {&by_grid, &by_scattered}) {
      for (std::size_t i = 0; i < kN; ++i) {
        expect_point(*planes, sample_on(side, i), side, side_point(net, side, 0));
      }
    }
  }

  template <typename T>
  void expect_point(const Planes<T>& planes, std::size_t k, int side, const Vector3& point) {
    const std::size_t first = along_u(side) ? 1 : 2; // du or dv
    const std::size_t across = 3 - first;
    const std::size_t second = along_u(side) ? 4 : 6;
    double slope = 0;
    double normal = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(static_cast<double>(planes.at(0, c, k)), point[c]) << "sample " << k;
      EXPECT_EQ(planes.at(first, c, k), 0) << "sample " << k;
      EXPECT_EQ(planes.at(second, c, k), 0) << "sample " << k;
      slope += std::abs(static_cast<double>(planes.at(across, c, k)));
      normal += std::pow(static_cast<double>(planes.at(3, c, k)), 2);
    }
    EXPECT_GT(slope, 0.01) << "sample " << k;
    EXPECT_NEAR(normal, 1, 1e-5) << "sample " << k;
    EXPECT_EQ(planes.status()[k], SampleStatus::limit) << "sample " << k;
    for (std::size_t which = 0; which < 4; ++which) {
      EXPECT_TRUE(std::isnan(planes.curvature(which, k))) << "sample " << k;
    }
  }

  /// Where one weight is by far the largest, others are lost beside it, and the weight along the
  /// side might be computed as zero: that is a matter of chance, which many nets are given.
  template <typename T>
  void expect_zero_slopes(double ratio) {
    Random random(84);
    for (const Degrees& degrees : {Degrees{2, 2}, {3, 3}, {2, 4}, {5, 5}, {7, 8}, {1, 15}}) {
      for (int k = 0; k < 160; ++k) {
        const int side = k % 4;
        const Net net = rounded_to<T>(dish_with_pole(degrees, side, random, ratio));
        const PatchSet<T> set =
            packed<T>(std::span(&net, 1), {.local_origin = k / 4 % 2 == 1, .isa = isa()});
        Planes<T> planes(kN * kN, {true, true, true, true, true, false});
        grid(set, Grid<T>::uniform(kN, kN), planes.outputs());
        const OrderPair order = along_u(side) ? OrderPair{1, 0} : OrderPair{0, 1};
        DerivativeBuffers<T> buffers({order}, kN * kN, 3);
        derivatives(set, Grid<T>::uniform(kN, kN), buffers.list());
        for (std::size_t i = 0; i < kN; ++i) {
          const std::size_t at = sample_on(side, i);
          for (std::size_t c = 0; c < 3; ++c) {
            const T found[] = {planes.at(along_u(side) ? 1 : 2, c, at),
                               planes.at(along_u(side) ? 4 : 6, c, at),
                               buffers.values[0][3 * at + c]};
            for (const T slope : found) {
              ASSERT_EQ(slope, 0) << degrees.u << " x " << degrees.v << ", side " << side
                                  << ", net " << k << ", sample " << i;
            }
          }
        }
      }
    }
  }

  /// Along the side of any order, and the boundary curve, which has the patch's bits.
  template <typename T>
  void expect_points_elsewhere(const Net& given, int side, const PackOptions& options) {
    Net net = given;
    const PatchSet<T> set = packed<T>(std::span(&net, 1), options);
    const std::vector<OrderPair> orders = along_u(side) ? std::vector<OrderPair>{{1, 0}, {4, 0}}
                                                        : std::vector<OrderPair>{{0, 1}, {0, 4}};
    DerivativeBuffers<T> buffers(orders, kN * kN, 3);
    derivatives(set, Grid<T>::uniform(kN, kN), buffers.list());
    const std::vector<T> points = packed_points<T>(std::span(&net, 1));
    CurveSet<T> curves;
    constexpr PatchEdge kEdgesOf[] = {PatchEdge::v0, PatchEdge::v1, PatchEdge::u0, PatchEdge::u1};
    ASSERT_TRUE(pack(boundary_curves(control_nets<T>(std::span(&net, 1), points), kEdgesOf[side]),
                     curves, options));
    std::vector<T> positions(3 * kN);
    CurveOutputs<T> out;
    out.position = Vectors<T>::xyz(positions.data());
    Options call;
    call.isa = isa();
    ASSERT_EQ(evaluate(curves, CurveGrid<T>::uniform(kN), out, call), Status::ok);
    for (std::size_t i = 0; i < kN; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(buffers.values[0][3 * sample_on(side, i) + c], 0) << "sample " << i;
        EXPECT_EQ(buffers.values[1][3 * sample_on(side, i) + c], 0) << "sample " << i;
        EXPECT_EQ(static_cast<double>(positions[3 * i + c]), side_point(net, side, 0)[c])
            << "sample " << i;
      }
    }
  }
};

TEST_P(CollapsedEdgeTest, IsAPointFloat) {
  for_every_pole<float>(
      [&](const Net& net, int side, const PackOptions& o) { expect_points<float>(net, side, o); });
}
TEST_P(CollapsedEdgeTest, IsAPointDouble) {
  for_every_pole<double>(
      [&](const Net& net, int side, const PackOptions& o) { expect_points<double>(net, side, o); });
}
TEST_P(CollapsedEdgeTest, IsAPointForOtherCallsFloat) {
  for_every_pole<float>([&](const Net& net, int side, const PackOptions& o) {
    expect_points_elsewhere<float>(net, side, o);
  });
}
TEST_P(CollapsedEdgeTest, IsAPointForOtherCallsDouble) {
  for_every_pole<double>([&](const Net& net, int side, const PackOptions& o) {
    expect_points_elsewhere<double>(net, side, o);
  });
}

TEST_P(CollapsedEdgeTest, IsAPointWhateverItsWeights) {
  for (const double ratio : {1e5, 1e8}) {
    expect_zero_slopes<float>(ratio);
  }
  for (const double ratio : {1e9, 1e12}) {
    expect_zero_slopes<double>(ratio);
  }
}

// Several patches a register: those that have no such side are what they are alone.
TEST_P(CollapsedEdgeTest, LeavesNeighboursAlone) {
  Random random(82);
  std::vector<Net> nets;
  for (int k = 0; k < 19; ++k) {
    Net net = dish_with_pole({3, 2}, k % 4, random);
    if (k % 3 != 0) {
      side_point(net, k % 4, 1)[0] += 0.125; // not a point any more
    }
    nets.push_back(rounded_to<float>(net));
  }
  const PatchSet<float> together = packed<float>(nets, {.isa = isa()});
  Planes<float> all(nets.size() * kN * kN);
  grid(together, Grid<float>::uniform(kN, kN), all.outputs());
  for (std::size_t p = 0; p < nets.size(); ++p) {
    Planes<float> alone(kN * kN);
    grid(packed<float>(std::span(&nets[p], 1), {.isa = isa()}), Grid<float>::uniform(kN, kN),
         alone.outputs());
    for (std::size_t group = 0; group < 4; ++group) {
      for (std::size_t k = 0; k < kN * kN; ++k) {
        EXPECT_EQ(all.vector(group, p * kN * kN + k), alone.vector(group, k)) << "patch " << p;
      }
    }
    const auto side = static_cast<int>(p % 4);
    const std::array<float, 3> slope = alone.vector(along_u(side) ? 1 : 2, sample_on(side, 4));
    EXPECT_EQ(slope == (std::array<float, 3>{}), p % 3 == 0) << "patch " << p;
  }
}

// Far from the origin, double points may be equal as floats and still have a derivative.
TEST_P(CollapsedEdgeTest, PointsThatOnlyRoundToOneAreNotOne) {
  Random random(83);
  Net net = dish_with_pole({2, 2}, 0, random);
  net.at(0, 1)[0] += 0x1p-7;
  net.at(0, 2)[0] += 0x1p-6;
  net.weights.assign(net.weights.size(), 1);
  net = translated(std::move(net), {0x1p20, 0x1p20, 0x1p20});
  ASSERT_EQ(static_cast<float>(net.at(0, 0)[0]), static_cast<float>(net.at(0, 2)[0]));
  const std::vector<double> points = packed_points<double>(std::span(&net, 1));
  PatchSet<float> set;
  expect_packed(pack(control_nets<double>(std::span(&net, 1), points), set,
                     {.local_origin = true, .isa = isa()}));
  Planes<float> planes(kN * kN);
  grid(set, Grid<float>::uniform(kN, kN), planes.outputs());
  for (std::size_t i = 0; i < kN; ++i) {
    EXPECT_NEAR(planes.at(1, 0, i), 0x1p-6, 0x1p-20) << "sample " << i;
  }
}
INSTANTIATE_FOR_EVERY_ISA(CollapsedEdgeTest);

} // namespace
} // namespace simdbezier::tests::collapsed_edges_test
