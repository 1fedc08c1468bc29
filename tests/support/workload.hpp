// The fixed work whose bits must not change: nets of several families, grids and scattered samples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tests/support/evaluation.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests {

/// Scattered samples in random order over all patches, boundary samples among them. Runs of one
/// patch alternate with single samples, so that every grouping of the call is reached.
template <typename T>
[[nodiscard]] SampleArrays<T> random_samples(std::size_t patches, std::size_t count) {
  Random random(21);
  SampleArrays<T> samples;
  std::size_t patch = 0;
  while (samples.patch.size() < count) {
    patch = random.below(patches);
    const std::size_t run = random.below(2) == 0 ? 1 : random.below(70);
    for (std::size_t k = 0; k < run && samples.patch.size() < count; ++k) {
      const T x = boundary_centred<T>(random);
      samples.add(patch, x, boundary_centred<T>(random));
    }
  }
  return samples;
}

/// Samples [first, first + count).
template <typename T>
[[nodiscard]] Samples<T> part_of(const SampleArrays<T>& all, std::size_t first, std::size_t count) {
  return {{all.patch.data() + first, count},
          {all.u.data() + first, count},
          {all.v.data() + first, count},
          Parameters::centred};
}

template <typename T>
inline constexpr Values<T> Curvatures<T>::*kCurvatureMembers[] = {
    &Curvatures<T>::gaussian, &Curvatures<T>::mean, &Curvatures<T>::minimum,
    &Curvatures<T>::maximum};

template <typename T>
void advance(Values<T>& values, std::size_t count) {
  values = values.wanted() ? Values<T>(values.first + count) : Values<T>();
}

/// Outputs moved on by `count` samples.
template <typename T>
[[nodiscard]] Outputs<T> advanced(Outputs<T> out, std::size_t count) {
  for (std::size_t g = 0; g < kVectorOutputs; ++g) {
    Vectors<T>& group = out[static_cast<Output>(g)];
    if (group.wanted()) {
      const auto elements = static_cast<std::ptrdiff_t>(count) * group.stride;
      group = {group.x + elements, group.y + elements, group.z + elements, group.stride};
    }
  }
  for (const auto member : kCurvatureMembers<T>) {
    advance(out.curvature.*member, count);
  }
  advance(out.status, count);
  return out;
}

/// Copies the first `count` samples of all that both outputs have to planes.
template <typename T>
void copy_samples(const Outputs<T>& from, const Outputs<T>& to, std::size_t count) {
  for (std::size_t g = 0; g < kVectorOutputs; ++g) {
    const Vectors<T>& source = from[static_cast<Output>(g)];
    const Vectors<T>& target = to[static_cast<Output>(g)];
    for (std::size_t k = 0; source.wanted() && target.wanted() && k < count; ++k) {
      const auto at = static_cast<std::ptrdiff_t>(k) * source.stride;
      target.x[k] = source.x[at];
      target.y[k] = source.y[at];
      target.z[k] = source.z[at];
    }
  }
  for (const auto member : kCurvatureMembers<T>) {
    const Values<T>& source = from.curvature.*member;
    const Values<T>& target = to.curvature.*member;
    if (source.wanted() && target.wanted()) {
      std::copy_n(source.first, count, target.first);
    }
  }
  std::copy_n(from.status.first, count, to.status.first);
}

/// The grids that exercise every strategy of the kernels.
inline constexpr std::pair<std::size_t, std::size_t> kWorkGrids[] = {
    {4, 4}, {5, 5}, {8, 8}, {9, 9}, {13, 6}, {16, 16}, {17, 17}, {21, 2}, {33, 33}, {40, 3}};

} // namespace simdbezier::tests
