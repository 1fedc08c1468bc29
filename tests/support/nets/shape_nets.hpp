// Random control nets of any shape, and byte-by-byte comparison of what was packed from them.
#pragma once

#include <cstddef>
#include <cstring>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

#include "src/storage/patch_storage.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests {

struct ShapeCase {
  int degree_u;
  int degree_v;
  int components = 3;
  Weights weights = Weights::none;

  [[nodiscard]] std::size_t channels() const {
    return static_cast<std::size_t>(components) + (weights == Weights::none ? 0 : 1);
  }
  [[nodiscard]] std::size_t points() const {
    return static_cast<std::size_t>((degree_u + 1) * (degree_v + 1));
  }
  [[nodiscard]] std::size_t values() const { return points() * channels(); }
};

inline std::ostream& operator<<(std::ostream& out, const ShapeCase& c) {
  constexpr const char* kNames[] = {"", " cartesian", " homogeneous"};
  return out << c.degree_u << "x" << c.degree_v << ", " << c.components
             << kNames[static_cast<int>(c.weights)];
}
inline std::string name_of(const ShapeCase& c) { return ::testing::PrintToString(c); }

/// Every degree, every kind of weights, unequal degrees, and all numbers of components that matter.
inline std::vector<ShapeCase> all_shapes() {
  std::vector<ShapeCase> cases;
  for (int n = 1; n <= kMostDegree; ++n) {
    cases.push_back({n, n});
    cases.push_back({n, 3, 2});
    cases.push_back({2, n, 3, Weights::cartesian});
    cases.push_back({n, (n + 6) % 15 + 1, 1, Weights::homogeneous});
  }
  for (const int components : {1, 2, 4, 7, kMostComponents}) {
    cases.push_back({3, 3, components});
    cases.push_back({4, 2, components, Weights::cartesian});
    cases.push_back({2, 6, components, Weights::homogeneous});
  }
  return cases;
}

/// Nets with random control values, packed; weights in [1/2, 2).
template <typename S>
struct RandomNets {
  std::vector<S> values;
  ControlNets<S> view;

  RandomNets(const ShapeCase& c, std::size_t count, std::uint64_t seed, double size = 1)
      : values(count * c.values()) {
    Random random(seed);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const bool weight = c.weights != Weights::none && k % c.channels() + 1 == c.channels();
      values[k] = static_cast<S>(weight ? random.between(0.5, 2) : size * random.symmetric());
    }
    view = ControlNets<S>::packed(values.data(), count, c.degree_u, c.degree_v, c.components,
                                  c.weights);
  }
  RandomNets(const RandomNets&) = delete;
  RandomNets& operator=(const RandomNets&) = delete;
};

/// The control points of patch `i` of one bucket are those of patch `k` of another, in one form.
template <typename T>
bool same_given_points(const detail::PatchStorage<T>& a, std::size_t i,
                       const detail::PatchStorage<T>& b, std::size_t k) {
  const std::size_t values = a.shape.control_values();
  return a.given.in_double == b.given.in_double && a.given.weights == b.given.weights &&
         std::memcmp(a.given.net(i * values).values, b.given.net(k * values).values,
                     values * a.given.value_bytes()) == 0;
}

/// All that was packed of patch `i` of one bucket has the bits of patch `k` of another.
template <typename T>
void expect_same_patch(const detail::PatchStorage<T>& a, std::size_t i,
                       const detail::PatchStorage<T>& b, std::size_t k, const std::string& what) {
  ASSERT_TRUE(a.shape == b.shape) << what;
  const auto same = [&](const T* x, const T* y, std::size_t n) {
    return x == nullptr || y == nullptr ? x == y
                                        : std::memcmp(x + i * n, y + k * n, n * sizeof(T)) == 0;
  };
  EXPECT_TRUE(same(a.coefficients, b.coefficients, a.shape.coefficients())) << what;
  EXPECT_TRUE(same(a.edges, b.edges, a.shape.edges())) << what;
  EXPECT_TRUE(same_given_points(a, i, b, k)) << what;
  EXPECT_TRUE(same(a.origins, b.origins, a.shape.origins())) << what;
  EXPECT_TRUE(same(a.normal_floor, b.normal_floor, a.shape.floors())) << what;
}

template <typename T>
void expect_same_sets(const PatchSet<T>& a, const PatchSet<T>& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t patch = 0; patch < a.size(); ++patch) {
    const detail::PatchPlace i = a.storage()->place(patch);
    const detail::PatchPlace k = b.storage()->place(patch);
    expect_same_patch(a.storage()->buckets[i.bucket], i.index, b.storage()->buckets[k.bucket],
                      k.index, what + ", patch " + std::to_string(patch));
  }
}

} // namespace simdbezier::tests
