#include "bench/subjects/patches.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace simdbezier_bench {
namespace {

/// SplitMix64: each value takes one chain of multiplications, and any index can be a seed.
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15U + 1) {}

  /// Returns a number that is uniform in [-1, 1).
  double next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
  }

private:
  std::uint64_t state_;
};

struct Vector {
  double x, y, z;
};

Vector unit(Vector a) {
  const double scale = 1 / std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
  return {a.x * scale, a.y * scale, a.z * scale};
}

Vector random_direction(Random& random) {
  for (;;) {
    const Vector a{random.next(), random.next(), random.next()};
    const double square = a.x * a.x + a.y * a.y + a.z * a.z;
    if (square > 0.01 && square < 1) {
      return unit(a);
    }
  }
}

Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns a unit vector across `a`, made with the axis that `a` is furthest from.
Vector across(Vector a) {
  const bool x_is_small = std::abs(a.x) < 0.5;
  return unit(cross(a, x_is_small ? Vector{1, 0, 0} : Vector{0, 1, 0}));
}

template <typename T>
void fill_net(std::size_t index, BatchShape shape, T* net) {
  Random random(index);
  const Vector origin{random.next(), random.next(), random.next()};
  const Vector a = random_direction(random);
  const Vector b = across(a);
  const double o[3] = {origin.x, origin.y, origin.z};
  const double along_u[3] = {a.x, a.y, a.z};
  const double along_v[3] = {b.x, b.y, b.z};
  const int m = shape.degree_u;
  const int n = shape.degree_v;
  const double displacement = 0.1 * (3.0 / std::max(m, n)); // a tenth, exactly, for bicubic nets
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= m; ++i) {
      for (int c = 0; c < 3; ++c) {
        *net++ = static_cast<T>(o[c] + along_u[c] * i / m + along_v[c] * j / n +
                                displacement * random.next());
      }
      if (shape.rational) {
        *net++ = static_cast<T>(1.25 + 0.75 * random.next());
      }
    }
  }
}

/// Converts one cubic from Bernstein to powers, in place.
void to_powers(double* b, int stride) {
  const double b0 = b[0];
  const double b1 = b[stride];
  const double b2 = b[2 * stride];
  const double b3 = b[3 * stride];
  b[stride] = 3 * (b1 - b0);
  b[2 * stride] = 3 * (b0 - 2 * b1 + b2);
  b[3 * stride] = (b3 - b0) + 3 * (b1 - b2);
}

} // namespace

template <typename T>
std::vector<T> random_nets(std::size_t count, BatchShape shape) {
  const std::size_t values = values_per_patch(shape);
  std::vector<T> nets(count * values);
  for (std::size_t patch = 0; patch < count; ++patch) {
    fill_net(patch, shape, nets.data() + patch * values);
  }
  return nets;
}

template <typename T>
std::vector<T> power_basis(const std::vector<T>& nets) {
  std::vector<T> coefficients(nets.size());
  for (std::size_t first = 0; first < nets.size(); first += kValuesPerPatch) {
    for (std::size_t c = 0; c < 3; ++c) {
      double b[16]; // [j][i], then [power of v][power of u]
      for (std::size_t k = 0; k < 16; ++k) {
        b[k] = static_cast<double>(nets[first + 3 * k + c]);
      }
      for (int k = 0; k < 4; ++k) {
        to_powers(b + 4 * k, 1);
      }
      for (int k = 0; k < 4; ++k) {
        to_powers(b + k, 4);
      }
      for (std::size_t k = 0; k < 16; ++k) {
        coefficients[first + 12 * (k / 4) + 4 * c + k % 4] = static_cast<T>(b[k]);
      }
    }
  }
  return coefficients;
}

std::vector<double> random_units(std::size_t count, std::uint64_t seed) {
  Random random(~seed); // far from the nets' seeds
  std::vector<double> values(count);
  for (double& value : values) {
    value = 0.5 + 0.5 * random.next();
  }
  return values;
}

template <typename T>
std::vector<T> uniform_parameters(std::size_t n) {
  std::vector<T> values(n);
  for (std::size_t i = 0; i < n; ++i) {
    values[i] = static_cast<T>(static_cast<double>(i) / static_cast<double>(n - 1));
  }
  return values;
}

template std::vector<float> random_nets<float>(std::size_t, BatchShape);
template std::vector<double> random_nets<double>(std::size_t, BatchShape);
template std::vector<float> power_basis<float>(const std::vector<float>&);
template std::vector<double> power_basis<double>(const std::vector<double>&);
template std::vector<float> uniform_parameters<float>(std::size_t);
template std::vector<double> uniform_parameters<double>(std::size_t);

} // namespace simdbezier_bench
