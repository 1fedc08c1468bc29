// Boxes and flatness of nets that are known: no larger than they should be, and bad input.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/nets/net_batches.hpp"

namespace simdbezier::tests::net_bounds_test {
namespace {

constexpr std::size_t kCount = 4;

// Control boxes are the control values themselves.
TEST(NetBounds, ControlBoxesAreExact) {
  for (const Shape& shape : all_shapes()) {
    if (shape.weights == Weights::homogeneous) {
      continue;
    }
    const Batch<float> batch = random_batch<float>(shape, kCount, 45);
    BoxValues<float> boxes(batch);
    ASSERT_TRUE(control_boxes(batch.nets(), boxes.out()));
    const auto components = static_cast<std::size_t>(shape.components);
    for (std::size_t p = 0; p < kCount; ++p) {
      for (std::size_t c = 0; c < components; ++c) {
        float low = batch.at(p, 0, 0, c);
        float high = low;
        for (int j = 0; j <= shape.degree_v; ++j) {
          for (int i = 0; i <= shape.degree_u; ++i) {
            low = std::min(low, batch.at(p, j, i, c));
            high = std::max(high, batch.at(p, j, i, c));
          }
        }
        EXPECT_EQ(boxes.low[p * components + c], low);
        EXPECT_EQ(boxes.high[p * components + c], high);
      }
    }
  }
}

// The excess over the surface's own box falls to a quarter with every level.
TEST(NetBounds, TightBoxesConverge) {
  Batch<double> batch({3, 3, 1, Weights::none}, 1); // z = u(1-u) + v(1-v), at most 1/2
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      batch.at(0, j, i, 0) =
          ((i == 1 || i == 2) ? 1.0 / 3 : 0) + ((j == 1 || j == 2) ? 1.0 / 3 : 0);
    }
  }
  BoxValues<double> boxes(batch);
  double excess = 1.0 / 3 - 1.0 / 6;
  for (int levels = 1; levels <= kMostBoxLevels; ++levels) {
    ASSERT_TRUE(tight_boxes(batch.nets(), levels, boxes.out()));
    excess /= 4;
    EXPECT_LE(boxes.high[0] - 0.5, 1.01 * excess) << levels;
    EXPECT_GE(boxes.high[0], 0.5);
  }
}

// A bilinear patch is flat up to the margin, whatever its degree and place; a bulge is not.
TEST(NetBounds, FlatnessIsSharp) {
  Batch<double> batch({5, 4, 3, Weights::none}, 1);
  for (int j = 0; j <= 4; ++j) {
    for (int i = 0; i <= 5; ++i) {
      batch.at(0, j, i, 0) = 1e6 + i / 5.0;
      batch.at(0, j, i, 1) = j / 4.0;
      batch.at(0, j, i, 2) = i / 5.0 * j / 4.0;
    }
  }
  double bound = -1;
  ASSERT_TRUE(flatness(batch.nets(), &bound));
  EXPECT_GT(bound, 0);
  EXPECT_LT(bound, 1e-9); // 1e6 + i / 5 is rounded by up to 6e-11
  batch.at(0, 2, 2, 2) += 0.5;
  ASSERT_TRUE(flatness(batch.nets(), &bound));
  EXPECT_NEAR(bound, 0.5, 1e-9);
}

// With equal weights a rational patch is the polynomial one; elevation makes its bound no larger.
TEST(NetBounds, FlatnessOfEqualWeights) {
  const Batch<double> plain = random_batch<double>({3, 3, 3, Weights::none}, kCount, 46);
  Batch<double> weighted({3, 3, 3, Weights::cartesian}, kCount);
  for (std::size_t p = 0; p < kCount; ++p) {
    for (int k = 0; k < 16; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        weighted.at(p, k / 4, k % 4, c) = plain.at(p, k / 4, k % 4, c);
      }
      weighted.at(p, k / 4, k % 4, 3) = 2.5;
    }
  }
  std::vector<double> polynomial(kCount);
  std::vector<double> rational(kCount);
  ASSERT_TRUE(flatness(plain.nets(), polynomial.data()));
  ASSERT_TRUE(flatness(weighted.nets(), rational.data()));
  for (std::size_t p = 0; p < kCount; ++p) {
    EXPECT_LE(rational[p], polynomial[p] * (1 + 1e-14));
    EXPECT_GE(rational[p], polynomial[p] / 2);
  }
}

// Control points on their bilinear patch do not make a rational patch flat: weights move its
// parameters. By hand, for weights 1 1 1 2: the largest N_kl / w_kl is (1/3, 0).
TEST(NetBounds, FlatnessSeesWeights) {
  Batch<float> batch({1, 1, 2, Weights::cartesian}, 1);
  for (int k = 0; k < 4; ++k) {
    batch.at(0, k / 2, k % 2, 0) = static_cast<float>(k % 2);
    batch.at(0, k / 2, k % 2, 1) = static_cast<float>(k / 2);
    batch.at(0, k / 2, k % 2, 2) = k == 3 ? 2.0F : 1.0F;
  }
  float bound = -1;
  ASSERT_TRUE(flatness(batch.nets(), &bound));
  EXPECT_GE(bound, 1.0 / 3);
  EXPECT_LE(bound, 1.0 / 3 + 1e-5);
}

TEST(NetBounds, OnePointIsFlat) {
  Batch<float> batch({3, 3, 3, Weights::none}, 1);
  std::fill(batch.values.begin(), batch.values.end(), 0.1F);
  float bound = -1;
  ASSERT_TRUE(flatness(batch.nets(), &bound));
  EXPECT_EQ(bound, 0);
}

TEST(NetBounds, BadInput) {
  Batch<float> batch = random_batch<float>({3, 3, 3, Weights::none}, 2, 47);
  BoxValues<float> boxes(batch);
  float flat[2] = {-1, -1};
  EXPECT_EQ(tight_boxes(batch.nets(), -1, boxes.out()).status, Status::bad_grid);
  EXPECT_EQ(tight_boxes(batch.nets(), kMostBoxLevels + 1, boxes.out()).status, Status::bad_grid);
  EXPECT_EQ(control_boxes(batch.nets(), {boxes.low.data(), nullptr}).status, Status::null_output);
  EXPECT_EQ(control_boxes(batch.nets(), {nullptr, boxes.low.data()}).status, Status::null_output);
  EXPECT_EQ(control_boxes(batch.nets(), {boxes.low.data(), boxes.low.data() + 5}).status,
            Status::overlapping_outputs);
  EXPECT_EQ(control_boxes(batch.nets(), {boxes.low.data(), batch.values.data() + 90}).status,
            Status::overlapping_outputs);
  EXPECT_EQ(flatness(batch.nets(), nullptr).status, Status::null_output);
  EXPECT_EQ(flatness(batch.nets(), batch.values.data()).status, Status::overlapping_outputs);
  EXPECT_EQ(control_boxes(ControlNets<float>{}, {nullptr, nullptr}).status, Status::ok);
  batch.values[48 + 5] = NAN;
  const Report report = flatness(batch.nets(), flat);
  EXPECT_EQ(report.status, Status::non_finite_input);
  EXPECT_EQ(report.item, 1U);
  EXPECT_EQ(report.point, 1);
  EXPECT_EQ(report.component, 2);
  EXPECT_EQ(flat[0], -1);
}

} // namespace
} // namespace simdbezier::tests::net_bounds_test
