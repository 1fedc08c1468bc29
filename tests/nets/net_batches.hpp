// Batches of control nets of any shape as tests hold them, and exact points on their surfaces.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include <gmpxx.h>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/hash.hpp"
#include "tests/support/nets/net.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests {

using Rational = mpq_class;

struct Shape {
  int degree_u = 3;
  int degree_v = 3;
  int components = 3;
  Weights weights = Weights::none;

  [[nodiscard]] std::string name() const {
    const char* const forms[] = {"", "Cartesian", "Homogeneous"};
    return "Degree" + std::to_string(degree_u) + "x" + std::to_string(degree_v) + "Components" +
           std::to_string(components) + forms[static_cast<int>(weights)];
  }
};
inline void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name(); }

/// What the operations are tried on.
inline const std::vector<Shape>& all_shapes() {
  static const std::vector<Shape> shapes = {
      {3, 3, 3, Weights::none},        {1, 1, 3, Weights::none},
      {2, 5, 1, Weights::none},        {15, 1, 2, Weights::none},
      {15, 15, 1, Weights::none},      {4, 3, 16, Weights::none},
      {3, 3, 3, Weights::cartesian},   {7, 2, 3, Weights::cartesian},
      {3, 3, 3, Weights::homogeneous}, {1, 6, 2, Weights::homogeneous},
      {15, 3, 1, Weights::cartesian}};
  return shapes;
}

/// `count` nets of one shape, packed.
template <typename T>
struct Batch {
  Shape shape;
  std::size_t count = 0;
  std::vector<T> values;

  Batch() = default;
  Batch(Shape of, std::size_t nets) : shape(of), count(nets), values(nets * net_values(), T(-77)) {}

  [[nodiscard]] std::size_t channels() const {
    return static_cast<std::size_t>(shape.components) + (shape.weights == Weights::none ? 0 : 1);
  }
  [[nodiscard]] std::size_t net_values() const {
    return static_cast<std::size_t>((shape.degree_u + 1) * (shape.degree_v + 1)) * channels();
  }
  [[nodiscard]] ControlNets<T> nets() const {
    return ControlNets<T>::packed(values.data(), count, shape.degree_u, shape.degree_v,
                                  shape.components, shape.weights);
  }
  [[nodiscard]] MutableNets<T> out() {
    return MutableNets<T>::packed(values.data(), count, shape.degree_u, shape.degree_v,
                                  shape.components, shape.weights);
  }
  [[nodiscard]] const T& at(std::size_t patch, int j, int i, std::size_t c) const {
    return values[index(patch, j, i, c)];
  }
  [[nodiscard]] T& at(std::size_t patch, int j, int i, std::size_t c) {
    return values[index(patch, j, i, c)];
  }
  [[nodiscard]] bool is_weight(std::size_t c) const {
    return c == static_cast<std::size_t>(shape.components);
  }

private:
  [[nodiscard]] std::size_t index(std::size_t patch, int j, int i, std::size_t c) const {
    return patch * net_values() +
           static_cast<std::size_t>(j * (shape.degree_u + 1) + i) * channels() + c;
  }
};

/// Values uniform in [-1,1) times `scale`, moved by `offset`; weights between 1/4 and 4.
template <typename T>
[[nodiscard]] Batch<T> random_batch(Shape shape, std::size_t count, std::uint64_t seed,
                                    double scale = 1, double offset = 0) {
  Random random(seed);
  Batch<T> batch(shape, count);
  const std::size_t channels = batch.channels();
  for (std::size_t k = 0; k < batch.values.size(); k += channels) {
    double weight = 1;
    if (shape.weights != Weights::none) {
      weight = random.between(0.25, 4);
      batch.values[k + channels - 1] = static_cast<T>(weight);
    }
    const double factor = shape.weights == Weights::homogeneous ? weight : 1;
    for (std::size_t c = 0; c < static_cast<std::size_t>(shape.components); ++c) {
      const double value = scale * random.symmetric() + offset;
      batch.values[k + c] = static_cast<T>(value * factor);
    }
  }
  return batch;
}

/// Small integers, so that most arithmetic on them is exact; weights are powers of two.
template <typename T>
[[nodiscard]] Batch<T> integer_batch(Shape shape, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Batch<T> batch(shape, count);
  for (std::size_t k = 0; k < batch.values.size(); ++k) {
    const bool weight = shape.weights != Weights::none &&
                        k % batch.channels() == static_cast<std::size_t>(shape.components);
    batch.values[k] = static_cast<T>(weight ? 1 << random.below(3) : random.integer(-60, 60));
  }
  return batch;
}

[[nodiscard]] inline Rational rational(double value) { return Rational(value); }
template <typename T>
[[nodiscard]] Rational rational_of(T value) {
  return Rational(static_cast<double>(value));
}

/// C(n,i) t^i (1-t)^(n-i).
[[nodiscard]] inline std::vector<Rational> exact_bernstein(int degree, const Rational& t) {
  std::vector<Rational> weights;
  for (int i = 0; i <= degree; ++i) {
    mpz_class binomial;
    mpz_bin_uiui(binomial.get_mpz_t(), static_cast<unsigned long>(degree),
                 static_cast<unsigned long>(i));
    Rational weight(binomial);
    for (int k = 0; k < degree; ++k) {
      weight *= k < i ? t : Rational(1 - t);
    }
    weights.push_back(weight);
  }
  return weights;
}

/// The surface point of one patch, without rounding.
template <typename T>
[[nodiscard]] std::vector<Rational> exact_point(const Batch<T>& batch, std::size_t patch,
                                                const Rational& u, const Rational& v) {
  const Shape& shape = batch.shape;
  const auto components = static_cast<std::size_t>(shape.components);
  const std::vector<Rational> bu = exact_bernstein(shape.degree_u, u);
  const std::vector<Rational> bv = exact_bernstein(shape.degree_v, v);
  std::vector<Rational> sum(components);
  Rational weights = 0;
  for (int j = 0; j <= shape.degree_v; ++j) {
    for (int i = 0; i <= shape.degree_u; ++i) {
      const Rational b = bu[static_cast<std::size_t>(i)] * bv[static_cast<std::size_t>(j)];
      const Rational w = shape.weights == Weights::none
                             ? Rational(1)
                             : rational_of(batch.at(patch, j, i, components));
      const Rational factor = shape.weights == Weights::cartesian ? Rational(b * w) : b;
      for (std::size_t c = 0; c < components; ++c) {
        sum[c] += factor * rational_of(batch.at(patch, j, i, c));
      }
      weights += b * w;
    }
  }
  for (Rational& value : sum) {
    value /= weights;
  }
  return sum;
}

/// max |P| over one patch: what errors are relative to.
template <typename T>
[[nodiscard]] double largest_value(const Batch<T>& batch, std::size_t patch) {
  double largest = 0;
  const auto components = static_cast<std::size_t>(batch.shape.components);
  for (int j = 0; j <= batch.shape.degree_v; ++j) {
    for (int i = 0; i <= batch.shape.degree_u; ++i) {
      for (std::size_t c = 0; c < components; ++c) {
        const double w = batch.shape.weights == Weights::homogeneous
                             ? static_cast<double>(batch.at(patch, j, i, components))
                             : 1;
        largest = std::max(largest, std::abs(static_cast<double>(batch.at(patch, j, i, c)) / w));
      }
    }
  }
  return largest;
}

/// Values with different bits.
template <typename T>
[[nodiscard]] std::size_t differing(const std::vector<T>& a, const std::vector<T>& b) {
  if (a.size() != b.size()) {
    return std::max(a.size(), b.size());
  }
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    count += same_bits(a[k], b[k]) ? 0U : 1U;
  }
  return count;
}

/// Boxes of a batch.
template <typename T>
struct BoxValues {
  explicit BoxValues(const Batch<T>& batch)
      : low(batch.count * static_cast<std::size_t>(batch.shape.components)), high(low) {}
  Boxes<T> out() { return {low.data(), high.data()}; }
  std::vector<T> low, high;
};

} // namespace simdbezier::tests
