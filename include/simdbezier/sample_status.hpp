// What was found at one sample of a surface or a curve.
#pragma once

#include <cstdint>

namespace simdbezier {

/// How a sample's normal was found. `limit` and `degenerate` are reported only if normals or
/// curvatures are asked for (of curves: tangents or curvatures).
///
/// Let N(t) be du x dv on the way from the sample's centred parameters, as rounded, to the patch's
/// middle: at (x, y) (1 - t), and from the middle itself at (t, t). The normal has the direction of
/// the first Taylor coefficient of N in t that is not zero. Which one that is, is decided exactly,
/// for the control points as given to pack(). If it is not the very first, the angular error of the
/// normal is at most 10^-3 degree in float and 10^-9 in double.
enum class SampleStatus : std::uint8_t {
  regular,    ///< the first coefficient, du x dv itself, is not zero
  limit,      ///< du x dv is zero, a later coefficient is not: the normal's limit
  degenerate, ///< all coefficients are zero; the zero vector was written
  non_finite  ///< a parameter was nan or infinite; the outputs are nan
};

} // namespace simdbezier
