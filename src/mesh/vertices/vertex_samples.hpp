// Samples that vertices are made of.
#pragma once

#include <cstddef>

#include "src/tables/sample_record.hpp"

namespace simdbezier::detail {

/// Four values. Functions do not take or return them, since not every processor has registers for
/// doubles.
template <typename T>
struct FourOf {
  typedef T type __attribute__((vector_size(4 * sizeof(T))));
};

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
