// Registers put together from lanes of others, in an order that tables give.
#pragma once

#include <cstdint>

#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// An assembly says where the lanes of one register come from. A code of 0 to 15 is that lane of
/// the first register, 16 to 31 of the second, 32 to 47 of the third, 48 to 63 of a fourth one.
class Assembly {
public:
  Assembly() = default;
  /// offset is added to all codes.
  explicit SIMDBEZIER_INLINE Assembly(const std::uint8_t codes[16], int offset = 0)
      : index_(_mm512_maskz_add_epi32(
            0xffff,
            _mm512_maskz_cvtepu8_epi32(0xffff,
                                       _mm_loadu_si128(reinterpret_cast<const __m128i*>(codes))),
            _mm512_set1_epi32(offset))),
        from_third_on_(_mm512_cmpge_epu32_mask(index_, _mm512_set1_epi32(32))) {}

  SIMDBEZIER_INLINE vec<float> operator()(vec<float> first, vec<float> second, vec<float> third,
                                          vec<float> fourth) const {
    const __m512 low = _mm512_permutex2var_ps(first, index_, second);
    const __m512 high = _mm512_permutex2var_ps(third, index_, fourth);
    return vec<float>(_mm512_mask_blend_ps(from_third_on_, low, high));
  }
  /// Of three registers, the third of which has the same quad four times: there is no second
  /// permutation across lanes, which would cost a multiply-add.
  SIMDBEZIER_INLINE vec<float> with_quad(vec<float> first, vec<float> second,
                                         vec<float> quad) const {
    const __m512 both = _mm512_permutex2var_ps(first, index_, second);
    return vec<float>(_mm512_mask_permutevar_ps(both, from_third_on_, quad, index_));
  }

private:
  __m512i index_; ///< permutations look at the bits that they need
  __mmask16 from_third_on_;
};
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
