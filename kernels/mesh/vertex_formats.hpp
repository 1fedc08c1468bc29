// Vertex formats: lanes are vertices, values are doubles.
//
// Whole numbers come from products with reciprocals, to which a number is added that is so large
// that 16 bits remain behind the point. Where these bits say that roundings may decide, there is
// doubt, and the vertices are found again, by the quotients that define the formats.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "kernels/simd/extrema.hpp"
#include "kernels/simd/lanes.hpp"
#include "kernels/simd/transpose.hpp"
#include "src/tables/format_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A vertex's bytes in each lane.
using Words = VectorOf<std::uint64_t, sizeof(Wide)>::type;
using Quarters = VectorOf<std::uint16_t, sizeof(Wide)>::type;

SIMDBEZIER_INLINE Words words_of(Wide value) { return __builtin_bit_cast(Words, value); }
SIMDBEZIER_INLINE Wide wide_of(Words bits) { return __builtin_bit_cast(Wide, bits); }

/// A float for each lane; some more on SSE2.
using Floats = decltype(narrowed(Wide()));

SIMDBEZIER_INLINE Floats load_floats(const double* from) {
  return narrowed(load_vector<Wide>(from));
}
SIMDBEZIER_INLINE Floats load_floats(const float* from) {
  Floats values{};
  __builtin_memcpy(&values, from, kWideLanes * sizeof(float));
  return values;
}
SIMDBEZIER_INLINE Wide load_wide(const double* from) { return load_vector<Wide>(from); }
SIMDBEZIER_INLINE Wide load_wide(const float* from) { return widened(load_floats(from)); }

/// Joins components of kBits, of which component c begins at bit kFrom of value[c].
template <int kBits, int kFrom, std::size_t kCount>
SIMDBEZIER_INLINE Words join(const Words (&value)[kCount]) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
  Words joined{};
  for (int c = 0; c < static_cast<int>(kCount); ++c) {
    const int to = std::endian::native == std::endian::little ? kBits * c : 64 - kBits * (c + 1);
    joined |= to < kFrom ? value[c] >> (kFrom - to) & kMask << to
                         : (value[c] & kMask << kFrom) << (to - kFrom);
  }
  return joined;
}

// Whole numbers ----------------------------------------------------------------------------------

/// 1.5 * 2^36, behind whose point there are 16 bits.
inline constexpr double kPoint = 0x1.8p36;
/// Numbers are rounded by adding this and going downwards. It is two units of the last bit more
/// than a half, so that the fraction is 0 to 3 where a number is too near to a half.
inline constexpr double kHalf = 0.5 + 0x1p-15;

/// Whether any fraction is 0 to 3; that of nan is 0.
class Doubt {
public:
  SIMDBEZIER_INLINE void add(Words fixed) {
    const auto next = __builtin_bit_cast(Quarters, fixed);
    least_ = next < least_ ? next : least_;
  }
  SIMDBEZIER_INLINE bool any() const {
    const Wide one = broadcast<Wide>(1);
    const Words fraction = __builtin_bit_cast(Words, least_) & 0xfffc;
    return any_of<Wide>(wide_of(fraction | words_of(one)) == one);
  }

private:
  Quarters least_ = Quarters{} - 1;
};

/// Returns the nearest whole number within limits; halves upwards; the lower limit for nan.
SIMDBEZIER_INLINE Words to_whole(Wide value, Wide low, Wide high) {
  const Wide half = broadcast<Wide>(0.5);
  const Wide even = broadcast<Wide>(0x1.8p52);
  Wide x = value + half;
  x = smaller_of<Wide>(select_where<Wide>(x > low, x, low), high + half);
  const Wide near = (x + even) - even;
  const Wide above = select_where<Wide>(near > x, broadcast<Wide>(1), broadcast<Wide>(0));
  return words_of(near - above + broadcast<Wide>(kPoint));
}

// Formats. find<true>() is exact, find<false>() has doubts ---------------------------------------

template <std::size_t kCount>
struct FloatFormat {
  static constexpr std::size_t kBytes = 4 * kCount;
  static constexpr bool kDoubtful = false;
  template <typename Task>
  explicit FloatFormat(const Task&) {}
  template <bool kExact, typename T>
  SIMDBEZIER_INLINE void find(const T* const* plane, std::size_t k, Words* out, Doubt&) const {
    out[0] = join<32, 0>({bits(plane[0] + k), bits(plane[1] + k)});
    if constexpr (kCount > 2) {
      out[1] = join<32, 0>({bits(plane[2] + k)});
    }
  }

private:
  template <typename T>
  SIMDBEZIER_INLINE static Words bits(const T* from) {
    const Floats values = load_floats(from);
    typename VectorOf<std::uint32_t, sizeof(Wide) / 2>::type lanes;
    __builtin_memcpy(&lanes, &values, sizeof lanes);
    return __builtin_convertvector(lanes, Words);
  }
};

/// The nearest half-precision numbers, ties to even.
template <std::size_t kCount>
struct HalfFormat {
  static constexpr std::size_t kBytes = 2 * kCount;
  static constexpr bool kDoubtful = false;
  template <typename Task>
  explicit HalfFormat(const Task&) {}
  template <bool kExact, typename T>
  SIMDBEZIER_INLINE void find(const T* const* plane, std::size_t k, Words* out, Doubt&) const {
    Words halves[kCount];
    for (std::size_t c = 0; c < kCount; ++c) {
      halves[c] = half(load_wide(plane[c] + k));
    }
    out[0] = join<16, 0>(halves);
  }

private:
  SIMDBEZIER_INLINE static Words half(Wide value) {
    const Wide size = magnitude(value);
    const Words bits = words_of(size);
    const Words rounded = bits + ((std::uint64_t{1} << 41) - 1) + (bits >> 42 & 1);
    const Words infinite = Words{} + 0x7c00;
    Wide h = wide_of((rounded >> 42) - (std::uint64_t{1023 - 15} << 10)); // another bias
    // Below 2^-14, a multiple of 2^-24.
    h = select_where<Wide>(size < broadcast<Wide>(0x1p-14), size + broadcast<Wide>(0x1.8p28), h);
    h = select_where<Wide>(size < broadcast<Wide>(65520), h, wide_of(infinite));
    h = select_where<Wide>(size == size, h, wide_of(infinite | 0x200));
    return words_of(h) | (words_of(value) >> 48 & 0x8000);
  }
};

/// (value - low) / step as unorm16 or snorm16.
template <std::size_t kCount>
class StepFormat {
public:
  static constexpr std::size_t kBytes = 2 * kCount;
  static constexpr bool kDoubtful = true;
  template <typename T>
  SIMDBEZIER_INLINE explicit StepFormat(const detail::FormatTask<T>& task)
      : step_(broadcast<Wide>(task.box.step)) {
    const bool centred = task.format == VertexFormat::snorm16;
    const double inverse = 1 / task.box.step;
    inverse_ = broadcast<Wide>(inverse);
    least_ = broadcast<Wide>(centred ? -32767 : 0);
    most_ = broadcast<Wide>(centred ? 32767 : 65535);
    for (std::size_t c = 0; c < kCount; ++c) {
      const double first = task.box.low[c] * inverse;
      low_[c] = broadcast<Wide>(task.box.low[c]);
      shift_[c] = broadcast<Wide>(kHalf - first);
      if (!(__builtin_fabs(first) < 0x1p30)) {       // roundings may be large, or it is nan
        point_ = broadcast<Wide>(__builtin_nan("")); // which has a fraction of 0
      }
    }
  }
  template <bool kExact, typename T>
  SIMDBEZIER_INLINE void find(const T* const* plane, std::size_t k, Words* out,
                              Doubt& doubt) const {
    const Wide half = broadcast<Wide>(kHalf);
    Words fixed[kCount];
    for (std::size_t c = 0; c < kCount; ++c) {
      const Wide value = load_wide(plane[c] + k);
      if constexpr (kExact) {
        fixed[c] = to_whole(divide(value - low_[c], step_), least_, most_);
      } else {
        const Wide x = madd(value, inverse_, shift_[c]);
        fixed[c] = words_of(smaller_of(larger_of(x, least_ + half), most_ + half) + point_);
        doubt.add(fixed[c]);
      }
    }
    out[0] = join<16, 16>(fixed);
  }

private:
  Wide step_;
  Wide inverse_;
  Wide least_;
  Wide most_;
  Wide low_[kCount];
  Wide shift_[kCount];
  Wide point_ = broadcast<Wide>(kPoint);
};

/// Unit normals, or zero.
template <int kBits>
struct OctahedralFormat {
  static constexpr std::size_t kBytes = kBits / 4;
  static constexpr bool kDoubtful = true;
  template <typename Task>
  explicit OctahedralFormat(const Task&) {}
  template <bool kExact, typename T>
  SIMDBEZIER_INLINE void find(const T* const* plane, std::size_t k, Words* out,
                              Doubt& doubt) const {
    const Wide zero = broadcast<Wide>(0);
    const Wide one = broadcast<Wide>(1);
    const Wide scale = broadcast<Wide>(kBits == 16 ? 32767 : 127);
    const Wide n[3] = {load_wide(plane[0] + k), load_wide(plane[1] + k), load_wide(plane[2] + k)};
    const Wide size[2] = {magnitude(n[0]), magnitude(n[1])};
    const Wide sum = size[0] + size[1] + magnitude(n[2]);
    const Wide below = larger_of(zero - n[2], zero);
    const Wide inverse = divide(scale, sum);
    Words fixed[2];
    for (std::size_t c = 0; c < 2; ++c) {
      if constexpr (kExact) {
        const Wide own = select_where<Wide>(sum > zero, divide(n[c], sum), zero);
        const Wide other = select_where<Wide>(sum > zero, divide(n[1 - c], sum), zero);
        const Wide folded = with_sign_of(own, one - magnitude(other));
        fixed[c] =
            to_whole(scale * select_where<Wide>(n[2] < zero, folded, own), zero - scale, scale);
      } else {
        const Wide folded = (size[c] + below) * inverse;
        fixed[c] = words_of(with_sign_of(n[c], folded) + broadcast<Wide>(kPoint + kHalf));
        doubt.add(fixed[c]);
      }
    }
    out[0] = join<kBits, 16>(fixed);
  }

private:
  SIMDBEZIER_INLINE static Wide with_sign_of(Wide sign, Wide size) {
    return wide_of(words_of(size) | (words_of(sign) & std::uint64_t{1} << 63));
  }
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
