// What is measured of patches, one patch a lane; see MeasureKernels.
#pragma once

#include <limits>

#include "kernels/simd/extrema.hpp"
#include "kernels/simd/transpose.hpp"
#include "src/storage/bicubic_layout.hpp"
#include "src/tables/net_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T>
void sum_kernel(const T* coefficients, std::size_t stride, std::size_t terms, const double* factors,
                double (*sums)[detail::kMeasured]) {
  for (std::size_t p = 0; p < detail::kMeasured; p += kWideLanes) {
    for (std::size_t c = 0; c < detail::kComponents; ++c) {
      const T* from[kWideLanes];
      for (std::size_t lane = 0; lane < kWideLanes; ++lane) {
        from[lane] = coefficients + (p + lane) * stride + c * terms;
        __builtin_prefetch(from[lane] + detail::kMeasured * stride); // would be waited for
      }
      Wide sum(0.0);
      std::size_t k = 0;
      for (; k + kTransposed <= terms; k += kTransposed) {
        Wide values[kTransposed];
        load_transposed(from[0] + k, static_cast<std::ptrdiff_t>(stride), values);
        for (std::size_t i = 0; i < kTransposed; ++i) {
          sum = sum + Wide(factors[k + i]) * magnitude(values[i]);
        }
      }
      for (; k < terms; ++k) {
        const Wide value = load_each(from, static_cast<std::ptrdiff_t>(k));
        sum = sum + Wide(factors[k]) * magnitude(value);
      }
      store_vector<Wide>(sums[c] + p, sum);
    }
  }
}

template <typename T>
void depth_kernel(const T* nets, std::ptrdiff_t stride, const double* eye, const double* axis,
                  double* nearest, double* farthest) {
  for (std::size_t p = 0; p < detail::kMeasured; p += kWideLanes) {
    const T* from = nets + static_cast<std::ptrdiff_t>(p) * stride;
    Wide low(std::numeric_limits<double>::infinity());
    Wide high(-std::numeric_limits<double>::infinity());
    Wide depth(0.0);
    // Values go by threes, blocks by eights: in between, nothing is divided at run time.
    for (std::size_t half = 0; half < 2; ++half) {
#pragma GCC unroll 3
      for (std::size_t block = 0; block < detail::kComponents; ++block, from += kTransposed) {
        Wide values[kTransposed];
        load_transposed(from, stride, values);
        for (std::size_t k = 0; k < kTransposed; ++k) {
          const std::size_t c = (block * kTransposed + k) % detail::kComponents;
          const Wide part = (values[k] - Wide(eye[c])) * Wide(axis[c]);
          depth = c == 0 ? part : depth + part;
          if (c == 2) {
            low = smaller_of<Wide>(depth, low);
            high = larger_of<Wide>(depth, high);
          }
        }
      }
    }
    store_vector<Wide>(nearest + p, low);
    store_vector<Wide>(farthest + p, high);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
