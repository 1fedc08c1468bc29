// Samples that vertices are made of.
#pragma once

#include <cstddef>
#include <cstring>

#include "src/tables/sample_record.hpp"

namespace simdbezier::detail {

/// Four values. Functions do not take or return them, since not every processor has registers for
/// doubles.
template <typename T>
struct FourOf {
  typedef T type __attribute__((vector_size(4 * sizeof(T))));
};

/// Values of 16 bytes, one for each of some points: compilers have poor code for comparisons and
/// shuffles of more than every processor's registers hold.
template <typename T>
struct PointBlock {
  static constexpr std::size_t kPoints = 16 / sizeof(T);
  typedef T Values __attribute__((vector_size(16)));
};

/// Turns the vectors of a block's points into their components.
template <typename T, typename Values>
void turn_to_components(const typename FourOf<T>::type* row, Values (&component)[3]) noexcept {
  Values half[4];
  std::memcpy(half, row, PointBlock<T>::kPoints * sizeof *row);
  if constexpr (PointBlock<T>::kPoints == 2) {
    component[0] = __builtin_shufflevector(half[0], half[2], 0, 2);
    component[1] = __builtin_shufflevector(half[0], half[2], 1, 3);
    component[2] = __builtin_shufflevector(half[1], half[3], 0, 2);
  } else {
    const Values xy01 = __builtin_shufflevector(half[0], half[1], 0, 4, 1, 5);
    const Values xy23 = __builtin_shufflevector(half[2], half[3], 0, 4, 1, 5);
    const Values z01 = __builtin_shufflevector(half[0], half[1], 2, 6, 2, 6);
    const Values z23 = __builtin_shufflevector(half[2], half[3], 2, 6, 2, 6);
    component[0] = __builtin_shufflevector(xy01, xy23, 0, 1, 4, 5);
    component[1] = __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7);
    component[2] = __builtin_shufflevector(z01, z23, 0, 1, 4, 5);
  }
}
/// Turns the components of a block's points into vectors, whose fourth value is the third one.
template <typename T, typename Values>
void turn_to_vectors(const Values (&component)[3], typename FourOf<T>::type* row) noexcept {
  const auto& [x, y, z] = component;
  Values half[4];
  if constexpr (PointBlock<T>::kPoints == 2) {
    half[0] = __builtin_shufflevector(x, y, 0, 2);
    half[1] = __builtin_shufflevector(z, z, 0, 0);
    half[2] = __builtin_shufflevector(x, y, 1, 3);
    half[3] = __builtin_shufflevector(z, z, 1, 1);
  } else {
    const Values xy01 = __builtin_shufflevector(x, y, 0, 4, 1, 5);
    const Values xy23 = __builtin_shufflevector(x, y, 2, 6, 3, 7);
    half[0] = __builtin_shufflevector(xy01, z, 0, 1, 4, 4);
    half[1] = __builtin_shufflevector(xy01, z, 2, 3, 5, 5);
    half[2] = __builtin_shufflevector(xy23, z, 0, 1, 6, 6);
    half[3] = __builtin_shufflevector(xy23, z, 2, 3, 7, 7);
  }
  std::memcpy(row, half, sizeof half);
}

/// One sample; what is not wanted may be anything. The fourth values are numbers without a meaning,
/// so that vectors are read and summed whole.
template <typename T>
struct VertexSample {
  typename FourOf<T>::type position;
  typename FourOf<T>::type normal;
};
static_assert(sizeof(VertexSample<float>) == kSampleRecord * sizeof(float));

/// Samples at equal distances.
template <typename T>
struct SampleRun {
  const VertexSample<T>* first;
  std::ptrdiff_t step;
  T sign; ///< of normals
};

} // namespace simdbezier::detail
