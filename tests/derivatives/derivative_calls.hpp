// Helpers for calls of evaluate_derivatives: requests with memory of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/shape_nets.hpp"

namespace simdbezier::tests {

using OrderPair = std::pair<int, int>;

/// Every order up to the given ones.
[[nodiscard]] inline std::vector<OrderPair> orders_up_to(int most_u, int most_v) {
  std::vector<OrderPair> orders;
  for (int a = 0; a <= most_u; ++a) {
    for (int b = 0; b <= most_v; ++b) {
      orders.emplace_back(a, b);
    }
  }
  return orders;
}

/// `dimension` values a sample side by side, for each of several orders.
template <typename T>
struct DerivativeBuffers {
  std::size_t dimension;
  std::vector<std::vector<T>> values; ///< [order][sample * dimension + component]
  std::vector<PartialDerivative<T>> requests;

  DerivativeBuffers(const std::vector<OrderPair>& orders, std::size_t samples, std::size_t d)
      : dimension(d), values(orders.size(), std::vector<T>(samples * d, T(-777))) {
    for (std::size_t k = 0; k < orders.size(); ++k) {
      requests.push_back({orders[k].first, orders[k].second, vectors(values[k].data(), d)});
    }
  }
  static Vectors<T> vectors(T* first, std::size_t d) {
    return {first, d > 1 ? first + 1 : nullptr, d > 2 ? first + 2 : nullptr,
            static_cast<std::ptrdiff_t>(d)};
  }
  [[nodiscard]] std::span<const PartialDerivative<T>> list() const { return requests; }
};

/// Samples with memory of their own.
template <typename T>
struct SampleList {
  std::vector<std::uint32_t> patch;
  std::vector<T> u;
  std::vector<T> v;
  Parameters parameters = Parameters::centred;

  void add(std::size_t p, double x, double y) {
    patch.push_back(static_cast<std::uint32_t>(p));
    u.push_back(static_cast<T>(x));
    v.push_back(static_cast<T>(y));
  }
  [[nodiscard]] Samples<T> view() const { return {patch, u, v, parameters}; }
};

class DerivativeTest : public IsaTest {
protected:
  /// Samples<T> or Grid<T>.
  template <typename T, typename Where, typename How = CallOptions>
  void derivatives(const PatchSet<T>& set, const Where& where,
                   std::span<const PartialDerivative<T>> wanted, const How& options = {}) {
    run(options,
        [&](const How& forced) { return evaluate_derivatives(set, where, wanted, forced); });
  }
};

/// Twelve patches of four shapes.
template <typename T>
PatchSet<T> mixed_set() {
  const ShapeCase shapes[] = {{3, 3}, {7, 2, 3, Weights::cartesian}, {5, 9}, {3, 3}};
  std::vector<ControlNets<T>> entries;
  std::vector<std::unique_ptr<RandomNets<T>>> nets;
  for (const ShapeCase& shape : shapes) {
    nets.push_back(std::make_unique<RandomNets<T>>(shape, 3, nets.size() + 1));
    entries.push_back(nets.back()->view);
  }
  PatchSet<T> set;
  EXPECT_TRUE(pack(std::span<const ControlNets<T>>(entries), set));
  return set;
}

} // namespace simdbezier::tests
