// One normal for a vertex that several patches have.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

#include "src/tables/mesh_table.hpp"

namespace simdbezier::detail {

/// Points whose values fill a register. g++ unrolls loops of this length before it looks for
/// vectors, and then finds none.
template <typename T>
struct PointBlock {
  static constexpr std::size_t kPoints = 16 / sizeof(T);
  typedef T Values __attribute__((vector_size(16)));

  static Values load(const T* from) noexcept {
    Values values;
    std::memcpy(&values, from, sizeof values);
    return values;
  }
  /// The first `points` values, to every step-th place.
  static void store(const Values& values, std::size_t points, T* to, std::size_t step) noexcept {
    if (points >= kPoints && step == 1) {
      std::memcpy(to, &values, sizeof values);
      return;
    }
    for (std::size_t k = 0; k < points && k < kPoints; ++k) {
      to[k * step] = values[k];
    }
  }
  /// Every second value.
  static Values load_even(const T* from) noexcept {
    const Values low = load(from);
    const Values high = load(from + kPoints);
    if constexpr (kPoints == 4) {
      return __builtin_shufflevector(low, high, 0, 2, 4, 6);
    } else {
      return __builtin_shufflevector(low, high, 0, 2);
    }
  }
};

/// Turns sums of unit normals into normals: sum * inverse + kept * first + 0, where first is the
/// first term. That is the sum's direction; a single term stays as it is, and so does the first one
/// where the sum is less than a thousandth of what it could be. finish_sum() of the kernels for
/// edges does the same operations. Values are those of one point, or of a block of points.
template <typename Values>
struct MergedScale {
  Values inverse;
  Values kept; ///< 1 where the first term stays, else 0

  /// square: of the sum's length.
  template <typename T>
  MergedScale(const Values& square, T terms) noexcept {
    const T least = kLeastSum<T> * terms;
    const Values zero = square - square; // squares of sums of unit vectors are finite
    const auto merges = square >= (terms > 1 ? least * least : std::numeric_limits<T>::infinity());
    kept = merges ? zero : zero + T(1);
    inverse = (T(1) - kept) / root_of(square + kept);
  }

private:
  static Values root_of(const Values& values) noexcept {
    if constexpr (std::is_arithmetic_v<Values>) {
      return std::sqrt(values);
    } else {
      Values roots = values; // g++ at -O1 warns of one that is set lane by lane
      for (std::size_t k = 0; k < sizeof values / sizeof values[0]; ++k) {
        roots[k] = std::sqrt(roots[k]);
      }
      return roots;
    }
  }
};

/// Sums of unit normals at the points of a block, whose terms are added patch by patch. A whole
/// block is read from every plane, however few points are wanted.
template <typename T>
class NormalSums {
public:
  using Block = PointBlock<T>;

  /// The first patch's normals, from sample `at` on. reversed: they count with the other sign.
  NormalSums(const Planes<T>& normals, std::size_t at, bool reversed) noexcept {
    const T sign = reversed ? T(-1) : T(1);
    for (std::size_t c = 0; c < 3; ++c) {
      first_[c] = sum_[c] = sign * Block::load(normals.component[c] + at);
    }
  }
  /// Adds those of one more patch.
  void add(const Planes<T>& normals, std::size_t at, bool reversed) noexcept {
    const T sign = reversed ? T(-1) : T(1);
    for (std::size_t c = 0; c < 3; ++c) {
      sum_[c] += sign * Block::load(normals.component[c] + at);
    }
    ++terms_;
  }

  /// Writes the normals of some points to every step-th place.
  void finish(std::size_t points, const Planes<T>& to, std::size_t place,
              std::size_t step) const noexcept {
    using Values = typename Block::Values;
    const Values square = sum_[0] * sum_[0] + sum_[1] * sum_[1] + sum_[2] * sum_[2];
    const MergedScale<Values> scale(square, static_cast<T>(terms_));
    for (std::size_t c = 0; c < 3; ++c) {
      // never -0
      const Values value = sum_[c] * scale.inverse + scale.kept * first_[c] + T(0);
      Block::store(value, points, to.component[c] + place * step, step);
    }
  }

private:
  std::size_t terms_ = 1;
  typename Block::Values first_[3];
  typename Block::Values sum_[3];
};

/// The sum of unit normals at one point.
template <typename T>
class NormalSum {
public:
  NormalSum(const T (&normal)[3], bool reversed) noexcept {
    const T sign = reversed ? T(-1) : T(1);
    for (std::size_t c = 0; c < 3; ++c) {
      first_[c] = sum_[c] = sign * normal[c];
    }
  }
  void add(const T (&normal)[3], bool reversed) noexcept {
    const T sign = reversed ? T(-1) : T(1);
    for (std::size_t c = 0; c < 3; ++c) {
      sum_[c] += sign * normal[c];
    }
    terms_ += 1;
  }
  void finish(T (&normal)[3]) const noexcept {
    const MergedScale<T> scale(sum_[0] * sum_[0] + sum_[1] * sum_[1] + sum_[2] * sum_[2], terms_);
    for (std::size_t c = 0; c < 3; ++c) {
      normal[c] = sum_[c] * scale.inverse + scale.kept * first_[c] + T(0); // never -0
    }
  }

private:
  T first_[3];
  T sum_[3];
  T terms_ = 1;
};

} // namespace simdbezier::detail
