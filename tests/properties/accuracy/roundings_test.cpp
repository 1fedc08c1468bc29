// The counts of roundings that certificates are made of, against the steps of the evaluation.
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "src/certificate/certificate_sums.hpp"
#include "tests/properties/accuracy/judge/tracked.hpp"
#include "tests/support/even_odd_model.hpp"

namespace simdbezier::tests::roundings_test {
namespace {

/// k! / (k - order)!: what the power k becomes in a derivative at 1.
[[nodiscard]] double falling(std::size_t k, std::size_t order) {
  double product = 1;
  for (std::size_t step = 0; step < order; ++step) {
    product *= static_cast<double>(k - step);
  }
  return product;
}

/// How often t^k alone is rounded, for t = 1.
[[nodiscard]] double counted(bool fma, std::size_t degree, std::size_t order, std::size_t k) {
  std::vector<Tracked> c(degree + 1);
  c[k].value = 1;
  const EvenOddJet<Tracked> jet =
      even_odd(TrackedArithmetic{fma}, std::span<const Tracked>(c), Tracked{1});
  const Tracked results[] = {jet.value, jet.slope, jet.half_second};
  return results[order].bound() * (order == 2 ? 2 : 1) / falling(k, order);
}

TEST(RoundingsTest, EvenAndOddPartsAreCounted) {
  for (const bool fma : {false, true}) {
    for (std::size_t degree = 3; degree <= 5; ++degree) {
      const simdbezier::detail::DirectionRoundings roundings{degree + 1, false, fma};
      for (std::size_t order = 0; order <= 2; ++order) {
        for (std::size_t k = 0; k <= degree; ++k) {
          const double steps = k < order ? 0 : std::ceil(counted(fma, degree, order, k) - 1e-9);
          EXPECT_EQ(roundings.derivative(order, k), steps)
              << "degree " << degree << ", order " << order << ", power " << k << ", fma " << fma;
        }
      }
    }
  }
}

// Edges v = const have no sums of their own in certificates: those of the matrix cover them, with
// what rows of any degree round.
TEST(RoundingsTest, ColumnsAndRowsCoverEdges) {
  for (const bool fma : {false, true}) {
    for (std::size_t degree_u = 1; degree_u <= 15; ++degree_u) {
      for (std::size_t degree_v = 1; degree_v <= 15; ++degree_v) {
        const simdbezier::detail::DirectionRoundings edge{degree_u + 1, degree_u > 5, fma};
        const simdbezier::detail::DirectionRoundings column{degree_u + 1, degree_u > 5, fma, true};
        const simdbezier::detail::DirectionRoundings row{degree_v + 1, degree_v > 5, fma};
        for (std::size_t order = 0; order <= 1; ++order) {
          for (std::size_t k = order; k <= degree_u; ++k) {
            EXPECT_LE(edge.derivative(order, k), column.derivative(order, k) + row.value(0))
                << degree_u << " x " << degree_v << ", order " << order << ", power " << k;
          }
        }
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::roundings_test
