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

template <typename Values>
Values roots_of(const Values& values) noexcept {
  Values roots = values; // g++ at -O1 warns of one that is set lane by lane
  for (std::size_t k = 0; k < sizeof values / sizeof values[0]; ++k) {
    roots[k] = std::sqrt(roots[k]);
  }
  return roots;
}

/// Turns sums of unit normals at a block of points into normals: sum * inverse + kept * first + 0,
/// never -0, where first is the first term. That is the sum's direction; a single term stays as it
/// is, and so does the first one where the sum is less than a thousandth of what it could be.
/// finish_sum() of the kernels for edges does the same operations. terms: of each sum.
template <typename Values>
void finish_sums(const Values (&first)[3], const Values (&sum)[3], const Values& terms,
                 Values (&normal)[3]) noexcept {
  using T = std::decay_t<decltype(terms[0])>;
  const Values square = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
  const Values least = kLeastSum<T> * terms;
  const Values zero = square - square; // squares of sums of unit vectors are finite
  const Values one = zero + T(1);
  const Values none = zero + std::numeric_limits<T>::infinity();
  const auto merges = square >= (terms > one ? least * least : none);
  const Values kept = merges ? zero : one;
  const Values inverse = (one - kept) / roots_of(square + kept);
  for (std::size_t c = 0; c < 3; ++c) {
    normal[c] = sum[c] * inverse + kept * first[c] + T(0);
  }
}

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
    typename Block::Values normal[3];
    finish_sums(first_, sum_, typename Block::Values{} + static_cast<T>(terms_), normal);
    for (std::size_t c = 0; c < 3; ++c) {
      Block::store(normal[c], points, to.component[c] + place * step, step);
    }
  }

private:
  std::size_t terms_ = 1;
  typename Block::Values first_[3];
  typename Block::Values sum_[3];
};

/// Calls f.operator()<count>() for a count from 1 to 4: g++ makes loops of unknown length longer
/// than so few values are worth.
template <typename F>
void with_known_count(std::size_t count, const F& f) {
  switch (count) {
  case 1:
    return f.template operator()<1>();
  case 2:
    return f.template operator()<2>();
  case 3:
    return f.template operator()<3>();
  default:
    return f.template operator()<4>();
  }
}

/// Samples at equal distances.
template <typename T>
struct SampleRun {
  const T* position; ///< of the first one
  const T* normal;
  std::size_t plane; ///< values from one component to the next
  std::ptrdiff_t step;
  T sign; ///< of normals

  /// Reads a component of the positions, or of the normals.
  template <std::size_t kPoints>
  void read(const T* first, std::size_t component, T (&to)[kPoints]) const noexcept {
    first += component * plane;
    for (std::size_t k = 0; k < kPoints; ++k, first += step) {
      to[k] = *first;
    }
  }
};

/// Sums of unit normals at single points. They wait until many are finished at once, since roots
/// and quotients of single ones take longer than all the rest.
template <typename T>
class WaitingSums {
public:
  [[nodiscard]] bool has_room(std::size_t points) const noexcept {
    return count_ + points <= kMost;
  }
  /// The first patch's normals at points with consecutive places.
  template <std::size_t kPoints>
  void put(const SampleRun<T>& run, std::size_t place) noexcept {
    for (std::size_t c = 0; c < 3; ++c) {
      T term[kPoints];
      run.read(run.normal, c, term);
      for (std::size_t k = 0; k < kPoints; ++k) {
        first_[c][count_ + k] = sum_[c][count_ + k] = run.sign * term[k];
      }
    }
    for (std::size_t k = 0; k < kPoints; ++k) {
      terms_[count_ + k] = 1;
      place_[count_ + k] = place + k;
    }
    count_ += kPoints;
  }
  /// Adds those of one more patch at the points that were put last.
  template <std::size_t kPoints>
  void add(const SampleRun<T>& run) noexcept {
    const std::size_t at = count_ - kPoints;
    for (std::size_t c = 0; c < 3; ++c) {
      T term[kPoints];
      run.read(run.normal, c, term);
      for (std::size_t k = 0; k < kPoints; ++k) {
        sum_[c][at + k] += run.sign * term[k];
      }
    }
    for (std::size_t k = 0; k < kPoints; ++k) {
      terms_[at + k] += 1;
    }
  }
  /// Writes the normals to their places of planes.
  void finish(const Planes<T>& to, std::size_t step) noexcept {
    using Block = PointBlock<T>;
    using Values = typename Block::Values;
    for (std::size_t k = 0; k < count_; k += Block::kPoints) {
      const Values first[3] = {Block::load(first_[0] + k), Block::load(first_[1] + k),
                               Block::load(first_[2] + k)};
      const Values sum[3] = {Block::load(sum_[0] + k), Block::load(sum_[1] + k),
                             Block::load(sum_[2] + k)};
      Values normal[3];
      finish_sums(first, sum, Block::load(terms_ + k), normal);
      for (std::size_t c = 0; c < 3; ++c) {
        Block::store(normal[c], Block::kPoints, sum_[c] + k, 1);
      }
    }
    for (std::size_t k = 0; k < count_; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        to.component[c][place_[k] * step] = sum_[c][k];
      }
    }
    count_ = 0;
  }

private:
  static constexpr std::size_t kMost = 64;

  std::size_t count_ = 0;
  T first_[3][kMost] = {}; // a block behind the last one is read as well
  T sum_[3][kMost] = {};
  T terms_[kMost] = {};
  std::size_t place_[kMost];
};

} // namespace simdbezier::detail
