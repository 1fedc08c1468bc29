// Registers put together from lanes of others, in an order that tables give.
#pragma once

#include <cstdint>

#include "kernels/isa/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// Where the lanes of one register come from. A code of 0 to 15 is that lane of the first register,
/// 16 to 31 of the second, and from 32 on one of four values in memory.
class Assembly {
public:
  Assembly() = default;
  explicit SIMDBEZIER_INLINE Assembly(const std::uint8_t codes[16])
      : index_(_mm512_maskz_cvtepu8_epi32(
            0xffff, _mm_loadu_si128(reinterpret_cast<const __m128i*>(codes)))),
        from_memory_(_mm512_cmpge_epu32_mask(index_, _mm512_set1_epi32(32))) {}

  /// One permutation across lanes and one within quads.
  SIMDBEZIER_INLINE vec<float> operator()(vec<float> first, vec<float> second,
                                          vec<float> four_in_each_quad) const {
    const __m512 both = _mm512_permutex2var_ps(first, index_, second);
    return vec<float>(_mm512_mask_permutevar_ps(both, from_memory_, four_in_each_quad, index_));
  }

private:
  __m512i index_; ///< both permutations look at the bits that they need
  __mmask16 from_memory_;
};
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
