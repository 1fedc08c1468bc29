// Polynomials in rational numbers, and the Bernstein basis expanded in powers.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/support/oracle/exact_rational.hpp"

namespace simdbezier::tests {

using Polynomial = std::vector<Rational>; // [power]
using Table = std::vector<Polynomial>;

[[nodiscard]] inline Polynomial times(const Polynomial& a, const Polynomial& b) {
  Polynomial result(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      result[i + k] += a[i] * b[k];
    }
  }
  return result;
}

/// [i]: the Bernstein polynomial B_i of degree n in powers of a cell's half-centred parameter X.
[[nodiscard]] inline Table bernstein(int n, int cells, int cell) {
  // u = (cell + X + 1/2) / cells
  const Polynomial u{Rational(2 * cell + 1, 2 * cells), Rational(1, cells)};
  const Polynomial rest{1 - u[0], -u[1]};
  Table result;
  Rational binomial = 1;
  for (int i = 0; i <= n; ++i) {
    Polynomial b{binomial};
    for (int k = 0; k < n; ++k) {
      b = times(b, k < i ? u : rest);
    }
    result.push_back(b);
    binomial *= Rational(n - i, i + 1);
  }
  return result;
}

/// sum_i values[i * step] B_i
[[nodiscard]] inline Polynomial expansion(const Table& basis, const Rational* values,
                                          std::size_t step) {
  Polynomial result(basis.size());
  for (std::size_t i = 0; i < basis.size(); ++i) {
    for (std::size_t k = 0; k < basis.size(); ++k) {
      result[k] += values[i * step] * basis[i][k];
    }
  }
  return result;
}

} // namespace simdbezier::tests
