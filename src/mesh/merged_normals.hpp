// One normal for a vertex that several patches have.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// Sums of unit normals at up to kMost points, whose terms are added patch by patch.
template <typename T>
class NormalSums {
public:
  static constexpr std::size_t kMost = 32;

  explicit NormalSums(std::size_t points) noexcept : points_(points) {}

  /// Normals of one patch at all points; reversed: they count with the other sign.
  void add(const Planes<T>& normals, std::size_t at, bool reversed) noexcept {
    const T sign = reversed ? T(-1) : T(1);
    for (std::size_t c = 0; c < 3; ++c) {
      const T* const values = normals.component[c] + at;
      if (terms_ == 0) {
        for (std::size_t k = 0; k < points_; ++k) {
          first_[c][k] = sum_[c][k] = sign * values[k] + T(0);
        }
      } else {
        for (std::size_t k = 0; k < points_; ++k) {
          sum_[c][k] += sign * values[k];
        }
      }
    }
    ++terms_;
  }

  /// Their directions; a single term stays as it is, and so does the first one where the sum is
  /// less than a thousandth of what it could be.
  void finish() noexcept {
    if (terms_ < 2) {
      return;
    }
    const T least = T(1e-3) * static_cast<T>(terms_);
    for (std::size_t k = 0; k < points_; ++k) {
      const T x = sum_[0][k];
      const T y = sum_[1][k];
      const T z = sum_[2][k];
      const T square = x * x + y * y + z * z;
      const bool long_enough = square >= least * least;
      const T inverse = T(1) / std::sqrt(long_enough ? square : T(1));
      sum_[0][k] = long_enough ? x * inverse : first_[0][k];
      sum_[1][k] = long_enough ? y * inverse : first_[1][k];
      sum_[2][k] = long_enough ? z * inverse : first_[2][k];
    }
  }
  [[nodiscard]] const T* component(std::size_t c) const noexcept { return sum_[c]; }

private:
  std::size_t points_;
  std::size_t terms_ = 0;
  T sum_[3][kMost];
  T first_[3][kMost];
};

} // namespace simdbezier::detail
