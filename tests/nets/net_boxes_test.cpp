// Boxes contain the exact surface and are no larger than they should be; flatness bounds the exact
// distance to the bilinear patch.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "tests/nets/net_batches.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests {
namespace {

constexpr std::size_t kCount = 4;

template <typename T>
struct BoxValues {
  explicit BoxValues(const Batch<T>& batch)
      : low(batch.count * static_cast<std::size_t>(batch.shape.components)), high(low) {}
  Boxes<T> out() { return {low.data(), high.data()}; }
  std::vector<T> low, high;
};

template <typename T>
struct BoundFamily {
  const char* name;
  std::function<Batch<T>(Shape)> make;
};

/// Evenly spaced points, as rounded: what is computed finds them flat to the last bit, which they
/// are not.
template <typename T>
Batch<T> even_batch(Shape shape) {
  Batch<T> batch(shape, kCount);
  for (std::size_t k = 0; k < batch.values.size(); ++k) {
    const std::size_t point = k % batch.net_values() / batch.channels();
    const auto i = static_cast<int>(point) % (shape.degree_u + 1);
    const bool weight = shape.weights != Weights::none && batch.is_weight(k % batch.channels());
    batch.values[k] = weight ? T(1) : static_cast<T>(i) / static_cast<T>(shape.degree_u);
  }
  return batch;
}

/// One weight of every net is `ratio` times the others.
template <typename T>
Batch<T> heavy_batch(Shape shape, double ratio) {
  Batch<T> batch = random_batch<T>(shape, kCount, 43);
  if (shape.weights != Weights::none) {
    for (std::size_t p = 0; p < kCount; ++p) {
      for (std::size_t c = 0; c < batch.channels(); ++c) {
        if (shape.weights == Weights::homogeneous || batch.is_weight(c)) {
          T& value = batch.at(p, 0, shape.degree_u, c);
          value = static_cast<T>(static_cast<double>(value) * ratio);
        }
      }
    }
  }
  return batch;
}

template <typename T>
std::vector<BoundFamily<T>> families() {
  constexpr double kFar = sizeof(T) == 4 ? 1e6 : 1e14;
  constexpr double kTiny =
      sizeof(T) == 4 ? 1e-38 : 1e-307; // all of it near or below the normal range
  return {
      {"random", [](Shape s) { return random_batch<T>(s, kCount, 41); }},
      {"far", [](Shape s) { return random_batch<T>(s, kCount, 42, 1, kFar); }},
      {"tiny", [](Shape s) { return random_batch<T>(s, kCount, 42, kTiny); }},
      {"huge", [](Shape s) { return random_batch<T>(s, kCount, 42, 1 / kTiny / 16); }},
      {"even", [](Shape s) { return even_batch<T>(s); }},
      {"heavy", [](Shape s) { return heavy_batch<T>(s, 1e4); }},
      {"light", [](Shape s) { return heavy_batch<T>(s, kTiny); }},
      {"point", [](Shape s) {
         Batch<T> batch = random_batch<T>(s, kCount, 44, 1, kFar);
         for (std::size_t k = 0; k < batch.values.size(); ++k) {
           if (s.weights != Weights::cartesian || !batch.is_weight(k % batch.channels())) {
             batch.values[k] =
                 batch.values[k / batch.net_values() * batch.net_values() + k % batch.channels()];
           }
         }
         return batch;
       }}};
}

std::vector<Rational> samples() {
  return {Rational(0),    Rational(1, 16), Rational(1, 3),
          Rational(1, 2), Rational(5, 7),  Rational(1)};
}

class NetBoundsTest : public IsaTest {
protected:
  Options options() {
    executed_ = Isa::automatic;
    return {.threads = 1, .isa = isa(), .executed = &executed_};
  }
  void expect_ok(const NetReport& report) { expect_ran(report.status, executed_); }

  template <typename T>
  void boxes_contain() {
    for (const BoundFamily<T>& family : families<T>()) {
      for (const Shape& shape : all_shapes()) {
        SCOPED_TRACE(std::string(family.name) + ", " + shape.name());
        const Batch<T> batch = family.make(shape);
        BoxValues<T> control(batch);
        expect_ok(control_boxes(batch.nets(), control.out(), options()));
        std::vector<BoxValues<T>> tight(3, BoxValues<T>(batch));
        for (int levels = 0; levels < 3; ++levels) {
          expect_ok(tight_boxes(batch.nets(), levels, tight[static_cast<std::size_t>(levels)].out(),
                                options()));
        }
        EXPECT_EQ(differing(tight[0].low, control.low) + differing(tight[0].high, control.high),
                  0U);
        for (const BoxValues<T>& boxes : tight) {
          for (std::size_t k = 0; k < boxes.low.size(); ++k) {
            ASSERT_GE(boxes.low[k], control.low[k]);
            ASSERT_LE(boxes.high[k], control.high[k]);
          }
        }
        const std::size_t patches = shape.degree_u + shape.degree_v > 20 ? 1 : kCount;
        for (std::size_t p = 0; p < patches; ++p) {
          for (const Rational& u : samples()) {
            for (const Rational& v : samples()) {
              const auto point = exact_point(batch, p, u, v);
              for (std::size_t c = 0; c < point.size(); ++c) {
                const std::size_t k = p * point.size() + c;
                for (const BoxValues<T>& boxes : tight) {
                  ASSERT_LE(rational_of(boxes.low[k]), point[c]);
                  ASSERT_GE(rational_of(boxes.high[k]), point[c]);
                }
              }
            }
          }
        }
      }
    }
  }

  template <typename T>
  void flatness_bounds() {
    for (const BoundFamily<T>& family : families<T>()) {
      for (const Shape& shape : all_shapes()) {
        SCOPED_TRACE(std::string(family.name) + ", " + shape.name());
        const Batch<T> batch = family.make(shape);
        std::vector<T> bound(kCount, T(-1));
        expect_ok(flatness(batch.nets(), bound.data(), options()));
        const std::size_t patches = shape.degree_u + shape.degree_v > 20 ? 1 : kCount;
        for (std::size_t p = 0; p < patches; ++p) {
          if (std::isinf(bound[p])) {
            continue;
          }
          const std::vector<Rational> corner[4] = {
              exact_point(batch, p, 0, 0), exact_point(batch, p, 1, 0), exact_point(batch, p, 0, 1),
              exact_point(batch, p, 1, 1)};
          for (const Rational& u : samples()) {
            for (const Rational& v : samples()) {
              const auto point = exact_point(batch, p, u, v);
              Rational squares = 0;
              for (std::size_t c = 0; c < point.size(); ++c) {
                const Rational below = (1 - u) * corner[0][c] + u * corner[1][c];
                const Rational above = (1 - u) * corner[2][c] + u * corner[3][c];
                const Rational distance = point[c] - ((1 - v) * below + v * above);
                squares += distance * distance;
              }
              ASSERT_LE(squares, rational_of(bound[p]) * rational_of(bound[p]));
            }
          }
        }
      }
    }
  }

private:
  Isa executed_ = Isa::automatic;
};

TEST_P(NetBoundsTest, BoxesContainTheSurfaceFloat) { boxes_contain<float>(); }
TEST_P(NetBoundsTest, BoxesContainTheSurfaceDouble) { boxes_contain<double>(); }
TEST_P(NetBoundsTest, FlatnessBoundsTheDistanceFloat) { flatness_bounds<float>(); }
TEST_P(NetBoundsTest, FlatnessBoundsTheDistanceDouble) { flatness_bounds<double>(); }
INSTANTIATE_FOR_EVERY_ISA(NetBoundsTest);

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

// A bilinear patch is flat but for the margin, whatever its degree and place; a bulge is not.
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
  const NetReport report = flatness(batch.nets(), flat);
  EXPECT_EQ(report.status, Status::non_finite_input);
  EXPECT_EQ(report.patch, 1U);
  EXPECT_EQ(report.point, 1);
  EXPECT_EQ(report.component, 2);
  EXPECT_EQ(flat[0], -1);
}

} // namespace
} // namespace simdbezier::tests
