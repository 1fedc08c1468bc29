// Registers some of whose lanes read one table in memory, and the others another one.
#pragma once

#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Tables of eight entries: the lanes of a mask read the first, the others the second.
template <typename V>
class TwoTables {
  using T = ScalarOf<V>;

public:
  explicit SIMDBEZIER_INLINE TwoTables(MaskOf<V> first) : first_(first) {}
  /// Returns entry i.
  SIMDBEZIER_INLINE V entry(const T* first, const T* second, std::size_t i) const {
    return select_where<V>(first_, broadcast<V>(first[i]), broadcast<V>(second[i]));
  }
  /// This is PairSelector::replace() by entries i and i + 1.
  SIMDBEZIER_INLINE V replace(const PairSelector<V>& pairs, V inside, const T* first,
                              const T* second, std::size_t i) const {
    return select_where<V>(first_, pairs.replace(inside, first + i),
                           pairs.replace(inside, second + i));
  }

private:
  MaskOf<V> first_;
};

#if defined(SIMDBEZIER_KERNELS_AVX512)
// Both tables are in one register, of which each entry is one permutation: broadcasts from memory,
// two for each entry, would take as long as all else that columns take.
template <>
class TwoTables<vec<float>> {
  using V = vec<float>;

public:
  explicit SIMDBEZIER_INLINE TwoTables(MaskOf<V> first)
      : table_(_mm512_maskz_set1_epi32(static_cast<__mmask16>(~__mmask16(first)), 8)) {}
  SIMDBEZIER_INLINE V entry(const float* first, const float* second, std::size_t i) const {
    return V(_mm512_permutexvar_ps(behind(table_, i), tables(first, second)));
  }
  SIMDBEZIER_INLINE V replace(const PairSelector<V>& pairs, V inside, const float* first,
                              const float* second, std::size_t i) const {
    const __m512i lane = behind(_mm512_add_epi32(table_, pairs.index()), i);
    return V(_mm512_mask_permutexvar_ps(inside, pairs.lanes(), lane, tables(first, second)));
  }

private:
  static SIMDBEZIER_INLINE __m512i behind(__m512i lane, std::size_t i) {
    return _mm512_add_epi32(lane, _mm512_set1_epi32(static_cast<int>(i)));
  }
  static SIMDBEZIER_INLINE __m512 tables(const float* first, const float* second) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(first)),
                              _mm256_loadu_ps(second), 1);
  }

  __m512i table_; ///< where a lane's table starts
};
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
