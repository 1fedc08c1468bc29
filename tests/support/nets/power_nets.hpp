// Control nets of polynomials that are given by their powers at a point.
#pragma once

#include <algorithm>

#include "tests/support/nets/shaped_nets.hpp"

namespace simdbezier::tests {

[[nodiscard]] inline Vector3 plus(const Vector3& a, double factor, const Vector3& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

[[nodiscard]] inline double choose(int n, int k) {
  double result = k < 0 || k > n ? 0 : 1;
  for (int i = 0; i < k; ++i) {
    result = result * (n - i) / (i + 1);
  }
  return result;
}

/// Control value i of C(n, a) (u - u0)^a as a polynomial of degree n: its blossom, in which nothing
/// is rounded where u0 has few bits.
[[nodiscard]] inline double power_value(int n, int a, int i, double u0) {
  double sum = 0;
  for (int k = 0; k <= a; ++k) {
    double term = choose(i, k) * choose(n - i, a - k);
    for (int f = 0; f < a; ++f) {
      term *= f < k ? 1 - u0 : -u0;
    }
    sum += term;
  }
  return sum;
}

/// sum_ab coefficient(a, b) C(m, a) (u - u0)^a C(n, b) (v - v0)^b, powers up to the third.
template <typename Coefficient>
[[nodiscard]] Net net_of_powers(Degrees degrees, double u0, double v0, Coefficient coefficient) {
  Net net = shaped_net(degrees, [](int, int) { return Vector3{}; });
  for (int a = 0; a <= std::min(degrees.u, 3); ++a) {
    for (int b = 0; b <= std::min(degrees.v, 3); ++b) {
      const Vector3 c = coefficient(a, b);
      for (int j = 0; j <= degrees.v; ++j) {
        for (int i = 0; i <= degrees.u; ++i) {
          const double factor = power_value(degrees.u, a, i, u0) * power_value(degrees.v, b, j, v0);
          net.at(j, i) = plus(net.at(j, i), factor, c);
        }
      }
    }
  }
  return net;
}

} // namespace simdbezier::tests
