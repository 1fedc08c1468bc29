// Nets and parameters of grids, and the same as scattered samples.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/support/evaluation.hpp"

namespace simdbezier::tests {

inline std::vector<Net> wavy_nets(std::size_t count) {
  std::vector<Net> nets(count);
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t k = 0; k < 16; ++k) {
      const double bump = std::sin(1.7 * static_cast<double>(k + 3 * n));
      nets[n].points[k] = {static_cast<double>(k % 4) + 0.2 * bump,
                           static_cast<double>(k / 4) - 0.1 * bump, bump};
    }
  }
  return nets;
}

/// (2i-N)/N, as the library documents uniform grids; one sample: off the middle.
template <typename T>
std::vector<T> centred_parameters(std::size_t count) {
  std::vector<T> x(count, static_cast<T>(0.25));
  const auto intervals = static_cast<T>(count - 1);
  for (std::size_t i = 0; count > 1 && i < count; ++i) {
    x[i] = (static_cast<T>(2 * i) - intervals) / intervals;
  }
  return x;
}

template <typename T>
SampleArrays<T> as_samples(std::size_t patches, const std::vector<T>& x, const std::vector<T>& y) {
  SampleArrays<T> samples;
  for (std::size_t p = 0; p < patches; ++p) {
    for (const T b : y) {
      for (const T a : x) {
        samples.add(p, a, b);
      }
    }
  }
  return samples;
}

} // namespace simdbezier::tests
