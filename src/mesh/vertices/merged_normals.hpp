// One normal for a vertex that several patches have.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

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
  static Values square_root(const Values& values) noexcept {
    Values root = values; // g++ at -O1 warns of one that is set lane by lane
    for (std::size_t k = 0; k < kPoints; ++k) {
      root[k] = std::sqrt(root[k]);
    }
    return root;
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

  /// Writes the directions of some points to every step-th place; a single term stays as it is, and
  /// so does the first one where the sum is less than a thousandth of what it could be.
  void finish(std::size_t points, const Planes<T>& to, std::size_t place,
              std::size_t step) const noexcept {
    using Values = typename Block::Values;
    const T least = kLeastSum<T> * static_cast<T>(terms_);
    const Values square = sum_[0] * sum_[0] + sum_[1] * sum_[1] + sum_[2] * sum_[2];
    const Values zero = square - square; // squares of sums of unit vectors are finite
    const auto merges = square >= (terms_ > 1 ? least * least : std::numeric_limits<T>::infinity());
    const Values kept = merges ? zero : zero + T(1);
    const Values inverse = (T(1) - kept) / Block::square_root(square + kept);
    for (std::size_t c = 0; c < 3; ++c) {
      // never -0
      const Values value = sum_[c] * inverse + kept * first_[c] + T(0);
      Block::store(value, points, to.component[c] + place * step, step);
    }
  }

private:
  std::size_t terms_ = 1;
  typename Block::Values first_[3];
  typename Block::Values sum_[3];
};

} // namespace simdbezier::detail
