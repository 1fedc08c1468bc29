// The suite's gates as GoogleTest expectations.
#pragma once

#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/measure.hpp"

namespace simdbezier::tests {

[[nodiscard]] inline std::string describe(const std::string& family, Quantity quantity,
                                          const Metric& metric) {
  char text[200];
  std::snprintf(text, sizeof text, "%s %s: max %.3g, rms %.3g, worst at net %zu, x %a, y %a",
                family.c_str(), kQuantityNames[static_cast<std::size_t>(quantity)], metric.max,
                metric.rms(), metric.worst.net, metric.worst.x, metric.worst.y);
  return text;
}

/// G1 and G6: no error above its bound, no NaN, no normal of another length.
inline void expect_bounds(const std::string& family, const Measurement& measured) {
  for (const Quantity quantity :
       {Quantity::position, Quantity::du, Quantity::dv, Quantity::duu, Quantity::duv, Quantity::dvv,
        Quantity::normal, Quantity::gaussian, Quantity::mean, Quantity::principal}) {
    EXPECT_LE(measured[quantity].max_ratio, 1.0)
        << "G1, " << describe(family, quantity, measured[quantity]);
  }
  EXPECT_LE(measured[Quantity::limit].max, kLimitDegrees)
      << "G6, " << describe(family, Quantity::limit, measured[Quantity::limit]);
  EXPECT_EQ(measured.nan_values, 0u) << family;
  EXPECT_EQ(measured.bad_lengths, 0u) << family;
  EXPECT_EQ(measured.missed_limits, 0u) << family;
}

/// The evaluator's own bounds: the largest error / certificate of any quantity.
inline double expect_certificates(const std::string& family, const Measurement& measured) {
  double tightest = 0;
  for (const Quantity quantity : {Quantity::position, Quantity::du, Quantity::dv}) {
    const double ratio = measured[quantity].max_certificate_ratio;
    EXPECT_LE(ratio, 1.0) << "certificate, " << describe(family, quantity, measured[quantity]);
    tightest = std::max(tightest, ratio);
  }
  return tightest;
}

} // namespace simdbezier::tests
