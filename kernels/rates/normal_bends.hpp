// How much bicubic patches bend out of their tangent planes: lanes are patches. An estimate that
// proves nothing, as src/mesh/bounds/normal_bends.hpp has it for all kinds of patches.
#pragma once

#include "kernels/rates/cell_bounds.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Points or tangents of a cubic at 0, 1/2 or 1 (place 0, 1, 2), but for a factor.
template <typename V>
SIMDBEZIER_INLINE SpaceVector<V> cubic_point(const SpaceVector<V>* p, std::size_t step,
                                             std::size_t place) {
  const V three = broadcast<V>(ScalarOf<V>(3));
  return place == 0   ? p[0]
         : place == 2 ? p[3 * step]
                      : p[0] + p[3 * step] + three * (p[step] + p[2 * step]);
}
template <typename V>
SIMDBEZIER_INLINE SpaceVector<V> cubic_tangent(const SpaceVector<V>* p, std::size_t step,
                                               std::size_t place) {
  return place == 0   ? p[step] - p[0]
         : place == 2 ? p[3 * step] - p[2 * step]
                      : (p[3 * step] - p[0]) + (p[2 * step] - p[step]);
}

/// What second derivatives along the normal tell of small cells, in each quarter: the mean size of
/// those in its corners, four of 3 x 3 samples. Samples without a normal have none.
template <typename V>
struct NormalBends {
  V distance; ///< of the triangles from the surface, about
  V fewest;   ///< cells with the same distance, times that
  V steps[2]; ///< squares of the numbers of segments that there have to be, likewise
};
template <typename V>
SIMDBEZIER_KERNEL NormalBends<V> bends_of(const RateScratch<V>& scratch, const CellSteps<V>& step) {
  using T = ScalarOf<V>;
  const V zero = broadcast<V>(T(0));
  const V tiny = broadcast<V>(std::numeric_limits<T>::min());
  const V flat = broadcast<V>(T(16) * kRoundoff<T>);
  SecondTerms<V> at[9];
  for (std::size_t j = 0; j < 3; ++j) {
    SpaceVector<V> point[4];
    SpaceVector<V> along_v[4];
    for (std::size_t i = 0; i < 4; ++i) {
      point[i] = cubic_point<V>(scratch.points + i, 4, j);
      along_v[i] = cubic_tangent<V>(scratch.points + i, 4, j);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const SpaceVector<V> u = cubic_tangent<V>(point, 1, i);
      const SpaceVector<V> v = cubic_point<V>(along_v, 1, i);
      const SpaceVector<V> normal{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z,
                                  u.x * v.y - u.y * v.x};
      const V length = square_root(normal.square());
      const V least = flat * square_root(u.square()) * square_root(v.square());
      const V inverse =
          select_where<V>(length > larger_of<V>(least, tiny),
                          divide(broadcast<V>(T(0.25)), larger_of<V>(length, tiny)), zero);
      const SecondVectors<V>& second = scratch.nets.at[21 * j + 3 * i];
      at[3 * j + i] = {dot(normal, second.uu) * inverse, dot(normal, second.uv) * inverse,
                       dot(normal, second.vv) * inverse};
    }
  }
  SecondTerms<V> largest{zero, zero, zero};
  V most = zero;
  for (std::size_t k = 0; k < 4; ++k) {
    const SecondTerms<V>* const corner = at + k % 2 + 3 * (k / 2);
    const auto mean = [&](const auto& of) SIMDBEZIER_INLINE_LAMBDA { // however it is turned
      return (size_of<V>(of(corner[0])) + size_of<V>(of(corner[4]))) +
             (size_of<V>(of(corner[1])) + size_of<V>(of(corner[3])));
    };
    using Bend = SecondTerms<V>;
    const V uu = mean([](const Bend& b) SIMDBEZIER_INLINE_LAMBDA { return b.uu; });
    const V uv = mean([](const Bend& b) SIMDBEZIER_INLINE_LAMBDA { return b.uv; });
    const V vv = mean([](const Bend& b) SIMDBEZIER_INLINE_LAMBDA { return b.vv; });
    largest = {larger_of<V>(largest.uu, uu), larger_of<V>(largest.uv, uv),
               larger_of<V>(largest.vv, vv)};
    const auto bend = [&](V mixed) SIMDBEZIER_INLINE_LAMBDA {
      return mean([&](const Bend& b) SIMDBEZIER_INLINE_LAMBDA {
        return (b.uu * step.uu + b.vv * step.vv) + b.uv * mixed;
      });
    };
    most = larger_of<V>(most, smaller_of<V>(bend(step.uv), bend(zero - step.uv)));
  }
  most = larger_of<V>(larger_of<V>(largest.uu * step.uu, largest.vv * step.vv), most);
  const V eighth = broadcast<V>(T(0.125));
  const V both = square_root(largest.uu * largest.vv) + largest.uv;
  return {eighth * most, eighth * (both + both), {eighth * largest.uu, eighth * largest.vv}};
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
