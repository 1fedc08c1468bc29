// Numbers with a first-order bound on the error of their computation, in units of u: the running
// error analysis that the published bounds come from.
#pragma once

#include <cmath>

namespace simdbezier::tests {

/// A computed value. The rounding of a row's Y*Y is one and the same wherever it is used, so that
/// its parts add up with their signs; all other roundings add up in size.
struct Tracked {
  double value = 0;
  double error = 0;     ///< of all roundings but that of the square
  double by_square = 0; ///< what a relative error of u in the square comes to

  [[nodiscard]] double bound() const { return error + std::abs(by_square); }
};

/// The arithmetic of a class: one rounding an operation, two a multiply-add without fusion.
struct TrackedArithmetic {
  bool fma;

  [[nodiscard]] Tracked madd(Tracked a, Tracked b, Tracked c) const {
    const Tracked exact = exact_product(a, b);
    return rounded({exact.value + c.value,
                    exact.error + c.error + (fma ? 0 : std::abs(exact.value)),
                    exact.by_square + c.by_square});
  }
  [[nodiscard]] Tracked product(Tracked a, Tracked b) const { return rounded(exact_product(a, b)); }
  [[nodiscard]] Tracked square(Tracked a) const {
    return {a.value * a.value, 0, a.value * a.value};
  }
  [[nodiscard]] Tracked tripled(Tracked a) const { return product({3}, a); }
  [[nodiscard]] Tracked sum(Tracked a, Tracked b) const {
    return rounded({a.value + b.value, a.error + b.error, a.by_square + b.by_square});
  }
  [[nodiscard]] Tracked twice(Tracked a) const {
    return {2 * a.value, 2 * a.error, 2 * a.by_square};
  }

private:
  [[nodiscard]] static Tracked rounded(Tracked a) {
    a.error += std::abs(a.value);
    return a;
  }
  [[nodiscard]] static Tracked exact_product(Tracked a, Tracked b) {
    return {a.value * b.value, a.error * std::abs(b.value) + b.error * std::abs(a.value),
            a.by_square * b.value + b.by_square * a.value};
  }
};

} // namespace simdbezier::tests
