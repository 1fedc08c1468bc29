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

  /// The first patch's normals at all points, from sample `at` on; they have to stay where they
  /// are. reversed: they count with the other sign.
  NormalSums(std::size_t points, const Planes<T>& normals, std::size_t at, bool reversed) noexcept
      : points_(points), first_sign_(reversed ? T(-1) : T(1)) {
    for (std::size_t c = 0; c < 3; ++c) {
      first_[c] = normals.component[c] + at;
      for (std::size_t k = 0; k < points_; ++k) {
        sum_[c][k] = first_sign_ * first_[c][k];
      }
    }
  }
  /// Those of one more.
  void add(const Planes<T>& normals, std::size_t at, bool reversed) noexcept {
    const T sign = reversed ? T(-1) : T(1);
    for (std::size_t c = 0; c < 3; ++c) {
      const T* const values = normals.component[c] + at;
      for (std::size_t k = 0; k < points_; ++k) {
        sum_[c][k] += sign * values[k];
      }
    }
    ++terms_;
  }

  /// Writes their directions to every step-th place; a single term stays as it is, and so does the
  /// first one where the sum is less than a thousandth of what it could be.
  void finish(const Planes<T>& to, std::size_t place, std::size_t step) const noexcept {
    const T least = T(1e-3) * static_cast<T>(terms_);
    T inverse[kMost];
    T kept[kMost]; // the first one's sign where it stays, else 0
    for (std::size_t k = 0; k < points_; ++k) {
      const T square = sum_[0][k] * sum_[0][k] + sum_[1][k] * sum_[1][k] + sum_[2][k] * sum_[2][k];
      const T stays = terms_ > 1 && square >= least * least ? T(0) : T(1);
      inverse[k] = (T(1) - stays) / std::sqrt(square + stays);
      kept[k] = stays * first_sign_;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      T* const out = to.component[c] + place * step;
      if (step == 1) {
        for (std::size_t k = 0; k < points_; ++k) {
          out[k] = value(c, k, inverse[k], kept[k]);
        }
      } else {
        for (std::size_t k = 0; k < points_; ++k) {
          out[k * step] = value(c, k, inverse[k], kept[k]);
        }
      }
    }
  }

private:
  /// Never -0.
  [[nodiscard]] T value(std::size_t c, std::size_t k, T inverse, T kept) const noexcept {
    return sum_[c][k] * inverse + kept * first_[c][k] + T(0);
  }

  std::size_t points_;
  std::size_t terms_ = 1;
  T first_sign_;
  const T* first_[3] = {nullptr, nullptr, nullptr};
  T sum_[3][kMost];
};

} // namespace simdbezier::detail
