// Registers put together from lanes of others, in an order that tables give.
#pragma once

#include <cstdint>

#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// An assembly says where the lanes of one register come from. A code of 0 to 15 is that lane of
/// the first register, 16 to 31 of the second, 32 to 47 of the third.
class Assembly {
public:
  Assembly() = default;
  explicit SIMDBEZIER_INLINE Assembly(const std::uint8_t codes[16])
      : index_(_mm512_maskz_cvtepu8_epi32(
            0xffff, _mm_loadu_si128(reinterpret_cast<const __m128i*>(codes)))),
        from_third_(_mm512_cmpge_epu32_mask(index_, _mm512_set1_epi32(32))) {}

  SIMDBEZIER_INLINE vec<float> operator()(vec<float> first, vec<float> second,
                                          vec<float> third) const {
    const __m512 both = _mm512_permutex2var_ps(first, index_, second);
    return vec<float>(_mm512_mask_permutexvar_ps(both, from_third_, index_, third));
  }
  /// This is operator() where all quads of the third register are alike: there is no second
  /// permutation across lanes, which would cost a multiply-add.
  SIMDBEZIER_INLINE vec<float> with_quad(vec<float> first, vec<float> second,
                                         vec<float> quad) const {
    const __m512 both = _mm512_permutex2var_ps(first, index_, second);
    return vec<float>(_mm512_mask_permutevar_ps(both, from_third_, quad, index_));
  }

private:
  __m512i index_; ///< permutations look at the bits that they need
  __mmask16 from_third_;
};
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
