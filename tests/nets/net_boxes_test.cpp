// Boxes contain the exact surface; flatness bounds the exact distance to the bilinear patch.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "tests/nets/net_batches.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::net_boxes_test {
namespace {

constexpr std::size_t kCount = 4;

template <typename T>
struct BoundFamily {
  const char* name;
  std::function<Batch<T>(Shape)> make;
};

/// Evenly spaced points, which are rounded: in computed arithmetic they are flat to the last bit,
/// while exactly they are not.
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
  static RunOptions options() {
    static_cast<void>(take_executed_isa()); // of calls before
    return {.threads = 1, .isa = isa()};
  }
  void expect_ok(const Report& report) { expect_ran(report.status, take_executed_isa()); }

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
};

TEST_P(NetBoundsTest, BoxesContainTheSurfaceFloat) { boxes_contain<float>(); }
TEST_P(NetBoundsTest, BoxesContainTheSurfaceDouble) { boxes_contain<double>(); }
TEST_P(NetBoundsTest, FlatnessBoundsTheDistanceFloat) { flatness_bounds<float>(); }
TEST_P(NetBoundsTest, FlatnessBoundsTheDistanceDouble) { flatness_bounds<double>(); }
INSTANTIATE_FOR_EVERY_ISA(NetBoundsTest);

} // namespace
} // namespace simdbezier::tests::net_boxes_test
