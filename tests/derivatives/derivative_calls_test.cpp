// Calls of evaluate_derivatives: grids, mixed sets, threads, layouts, parameters that are not
// finite.
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "tests/derivatives/derivative_calls.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::derivative_calls_test {
namespace {

const std::vector<OrderPair> kOrders = {{0, 0}, {3, 1}, {0, 4}, {2, 2}, {15, 0}, {6, 7}};

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// The grid's samples one by one; u and v as the grid has them.
template <typename T>
SampleList<T> samples_of_grid(const std::vector<T>& u, const std::vector<T>& v,
                              std::size_t first_patch, std::size_t patches) {
  SampleList<T> list;
  list.parameters = Parameters::unit;
  for (std::size_t p = 0; p < patches; ++p) {
    for (const T y : v) {
      for (const T x : u) {
        list.add(first_patch + p, x, y);
      }
    }
  }
  return list;
}

class DerivativeCalls : public DerivativeTest {
protected:
  template <typename T>
  void grid_is_scattered() {
    const PatchSet<T> set = mixed_set<T>();
    const std::vector<T> u = {0, T(0.3), T(0.5), 1, T(0.7), T(0.99), T(1.5)};
    const std::vector<T> v = {1, T(0.1), T(0.5), T(0.25), 0};
    CallOptions options;
    options.first_patch = 2;
    options.patch_count = 9;
    const SampleList<T> samples = samples_of_grid(u, v, 2, 9);
    DerivativeBuffers<T> of_grid(kOrders, samples.patch.size(), 3);
    DerivativeBuffers<T> of_samples(kOrders, samples.patch.size(), 3);
    const Grid<T> grid{u.size(), v.size(), u.data(), v.data(), Parameters::unit};
    derivatives(set, grid, of_grid.list(), options);
    derivatives(set, samples.view(), of_samples.list());
    for (std::size_t d = 0; d < kOrders.size(); ++d) {
      EXPECT_TRUE(same_bits(of_grid.values[d], of_samples.values[d])) << "derivative " << d;
    }
  }
};

TEST_P(DerivativeCalls, a_grid_is_its_samples) {
  grid_is_scattered<float>();
  grid_is_scattered<double>();
}

/// Positions and first derivatives of a uniform grid, whose parameters are divisions of their own.
TEST_P(DerivativeCalls, uniform_grids_are_those_of_evaluate) {
  const PatchSet<float> set = mixed_set<float>();
  const auto uniform = Grid<float>::uniform(11, 7);
  const std::size_t count = set.size() * 77;
  const std::vector<OrderPair> orders = {{0, 0}, {1, 0}, {0, 1}};
  DerivativeBuffers<float> found(orders, count, 3);
  DerivativeBuffers<float> expected(orders, count, 3);
  Outputs<float> out;
  out.position = expected.requests[0].out;
  out.du = expected.requests[1].out;
  out.dv = expected.requests[2].out;
  grid(set, uniform, out);
  derivatives(set, uniform, found.list());
  for (std::size_t d = 0; d < orders.size(); ++d) {
    EXPECT_TRUE(same_bits(found.values[d], expected.values[d])) << "derivative " << d;
  }
}

/// Bits are the same for any number of threads, any layout, and any other derivatives beside them.
TEST_P(DerivativeCalls, bits_hang_on_the_sample_only) {
  const PatchSet<double> set = mixed_set<double>();
  const auto uniform = Grid<double>::uniform(17, 13);
  const std::size_t count = set.size() * 17 * 13;
  DerivativeBuffers<double> expected(kOrders, count, 3);
  derivatives(set, uniform, expected.list());
  for (const int threads : {1, 2, 3, 7}) {
    CallOptions options;
    options.threads = threads;
    DerivativeBuffers<double> found(kOrders, count, 3);
    derivatives(set, uniform, found.list(), options);
    for (std::size_t d = 0; d < kOrders.size(); ++d) {
      EXPECT_TRUE(same_bits(found.values[d], expected.values[d])) << threads << " threads, " << d;
    }
  }
  for (std::size_t d = 0; d < kOrders.size(); ++d) {
    std::vector<double> planes(3 * count);
    const PartialDerivative<double> alone[] = {
        {kOrders[d].first, kOrders[d].second,
         Vectors<double>{&planes[count - 1], &planes[2 * count - 1], &planes[3 * count - 1], -1}}};
    derivatives(set, uniform, std::span<const PartialDerivative<double>>(alone));
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_EQ(planes[c * count + count - 1 - k], expected.values[d][3 * k + c])
            << "derivative " << d << " alone, backwards, sample " << k;
      }
    }
  }
}

/// Two derivatives as members of one vertex; nothing between them is touched.
TEST_P(DerivativeCalls, vertices) {
  const PatchSet<float> set = mixed_set<float>();
  const auto uniform = Grid<float>::uniform(5, 6);
  const std::size_t count = set.size() * 30;
  const std::vector<OrderPair> orders = {{3, 0}, {1, 2}};
  DerivativeBuffers<float> expected(orders, count, 3);
  derivatives(set, uniform, expected.list());
  std::vector<float> vertices(8 * count, -777.0F);
  const PartialDerivative<float> members[] = {{3, 0, Vectors<float>::xyz(vertices.data(), 8)},
                                              {1, 2, Vectors<float>::xyz(&vertices[4], 8)}};
  derivatives(set, uniform, std::span<const PartialDerivative<float>>(members));
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(vertices[8 * k + c], expected.values[0][3 * k + c]);
      ASSERT_EQ(vertices[8 * k + 4 + c], expected.values[1][3 * k + c]);
    }
    ASSERT_EQ(vertices[8 * k + 3], -777.0F);
    ASSERT_EQ(vertices[8 * k + 7], -777.0F);
  }
}

/// Nan where a parameter is not finite, even of derivatives that are constant; the neighbours,
/// which share its register, are what they are without it.
TEST_P(DerivativeCalls, parameters_that_are_not_finite) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const PatchSet<float> set = mixed_set<float>();
  SampleList<float> clean;
  SampleList<float> dirty;
  for (std::size_t k = 0; k < 60; ++k) {
    const double x = static_cast<double>(k % 7) / 3 - 1;
    const double y = static_cast<double>(k % 5) / 2 - 1;
    clean.add(k / 5, x, y);
    dirty.add(k / 5, x, y);
    if (k % 4 == 0) {
      (k % 8 == 0 ? dirty.u : dirty.v).back() = k % 3 == 0   ? kNan
                                                : k % 3 == 1 ? kInfinity
                                                             : -kInfinity;
    }
  }
  DerivativeBuffers<float> expected(kOrders, 60, 3);
  DerivativeBuffers<float> found(kOrders, 60, 3);
  derivatives(set, clean.view(), expected.list());
  derivatives(set, dirty.view(), found.list());
  for (std::size_t d = 0; d < kOrders.size(); ++d) {
    for (std::size_t k = 0; k < 180; ++k) {
      if (k / 3 % 4 == 0) {
        ASSERT_TRUE(std::isnan(found.values[d][k])) << "derivative " << d << ", value " << k;
      } else {
        ASSERT_EQ(found.values[d][k], expected.values[d][k]) << "derivative " << d;
      }
    }
  }
}
INSTANTIATE_FOR_EVERY_ISA(DerivativeCalls);

} // namespace
} // namespace simdbezier::tests::derivative_calls_test
