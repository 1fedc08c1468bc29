// What the curves of a set have in common, and how they are packed. Kernels include this file, so
// that it includes no containers.
//
// Parameters are half-centred, X = t - 1/2, and curves of degree 6 and more have two cells, as the
// directions of patches have (net_shape.hpp). All that a cell's positions need lies side by side,
// component after component: a batch of cubics is read from memory once, at 18 values a curve.
#pragma once

#include <cstddef>

#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {

/// Layouts, in elements of T:
///   values          [curve][cell][channel]{ powers 0 … degree of X, start, end, origin }
///   given points    [curve][i][channel], see given_points.hpp
/// Channels: the components, then the weight. Start and end are the cell's end points; the origin
/// exists in sets that were packed with local origins, and is what the powers are relative to.
struct CurveShape {
  int degree = 3;
  int components = 3;
  bool rational = false;
  bool origins = false;

  [[nodiscard]] constexpr std::size_t order() const { return static_cast<std::size_t>(degree) + 1; }
  [[nodiscard]] constexpr std::size_t channels() const {
    return static_cast<std::size_t>(components) + (rational ? 1 : 0);
  }
  [[nodiscard]] constexpr std::size_t cells() const { return degree > kMostWholeDegree ? 2 : 1; }
  [[nodiscard]] constexpr std::size_t ends_at() const { return order(); }
  [[nodiscard]] constexpr std::size_t origin_at() const { return order() + 2; }
  [[nodiscard]] constexpr std::size_t channel_values() const { return order() + (origins ? 3 : 2); }
  [[nodiscard]] constexpr std::size_t cell_values() const { return channels() * channel_values(); }
  [[nodiscard]] constexpr std::size_t values() const { return cells() * cell_values(); }
  [[nodiscard]] constexpr std::size_t control_values() const { return order() * channels(); }
};

} // namespace simdbezier::detail
