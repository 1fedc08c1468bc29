// Output layouts that a caller may choose, and the memory that goes with them.
#pragma once

#include <bit>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tests/support/canvas.hpp"

namespace simdbezier::tests {

/// Groups side by side in one vertex of `stride` elements, the first of them `first` elements into
/// it, the rest `pitch` elements apart in the order given.
struct VertexCase {
  const char* name;
  std::ptrdiff_t stride;
  std::vector<std::size_t> order; ///< groups by their place in Outputs
  std::ptrdiff_t first = 0;
  std::ptrdiff_t pitch = 3;
};

/// How the three planes of a group are told from one another.
enum class PlaneOrder : std::uint8_t { xyz, zyx };

[[nodiscard]] inline std::span<const VertexCase> vertex_cases() {
  static const std::vector<VertexCase> cases = {
      {"xyz", 3, {0}},
      {"padded", 4, {0}},
      {"normals", 3, {6}},
      {"position_normal", 6, {0, 6}},
      {"normal_position", 6, {6, 0}},
      {"position_normal_gap", 8, {0, 6}},
      {"position_normal_gap_before", 8, {0, 6}, 2},
      {"position_normal_gap_between", 8, {0, 6}, 0, 5},
      {"position_tangents", 9, {0, 1, 2}},
      {"tangents_position_normal", 12, {2, 1, 0, 6}},
      {"seconds", 9, {3, 4, 5}},
      {"twist_alone", 7, {4}, 2},
      {"all", 21, {0, 1, 2, 3, 4, 5, 6}},
      {"all_shuffled", 21, {6, 3, 0, 5, 2, 4, 1}},
      {"all_gaps", 32, {5, 1, 6, 0, 4, 2, 3}, 3, 4},
      {"backwards", -3, {0}},
      {"backwards_vertices", -6, {6, 0}},
      {"backwards_gaps", -11, {0, 3, 1}, 1},
  };
  return cases;
}

/// The smallest element of an array of vertices is 0.
[[nodiscard]] inline std::size_t vertex_elements(const VertexCase& layout, std::size_t count) {
  const auto stride = static_cast<std::size_t>(layout.stride < 0 ? -layout.stride : layout.stride);
  return count * stride;
}

template <typename T>
[[nodiscard]] Outputs<T> vertex_outputs(const VertexCase& layout, std::size_t count, T* lowest,
                                        PlaneOrder order = PlaneOrder::xyz) {
  Outputs<T> out;
  T* const first =
      layout.stride < 0 ? lowest + static_cast<std::ptrdiff_t>(count - 1) * -layout.stride : lowest;
  for (std::size_t m = 0; m < layout.order.size(); ++m) {
    T* const member = first + layout.first + static_cast<std::ptrdiff_t>(m) * layout.pitch;
    Vectors<T> group = Vectors<T>::xyz(member, layout.stride);
    if (order == PlaneOrder::zyx) {
      std::swap(group.x, group.z);
    }
    *groups_of(out)[layout.order[m]] = group;
  }
  return out;
}

/// Every component in a plane of its own, 128 bytes or more from the next. Plane k starts
/// shift + k * step elements (modulo a cache line of floats) after a cache line.
struct PlaneCase {
  const char* name;
  GroupSet groups;
  std::ptrdiff_t stride;
  std::size_t step;
};

inline constexpr PlaneCase kPlaneCases[] = {
    {"planes", kP, 1, 0},
    {"planes_staggered", kP, 1, 3},
    {"planes_position_normal", kP | kN, 1, 0},
    {"planes_first", kP | kDu | kDv, 1, 5},
    {"planes_seconds", kDuu | kDvv, 1, 1},
    {"planes_all", kAllVectors, 1, 0},
    {"planes_all_staggered", kAllVectors, 1, 7},
    {"planes_of_every_second", kP | kDuv, 2, 1},
    {"planes_backwards", kP | kDv | kN, -1, 1},
};

[[nodiscard]] inline std::size_t plane_pitch(const PlaneCase& layout, std::size_t count) {
  const std::size_t stride = layout.stride < 0 ? 1 : static_cast<std::size_t>(layout.stride);
  return (count * stride + 15) / 16 * 16 + 16 + 32; // room for the shift, and 128 bytes
}
[[nodiscard]] inline std::size_t plane_elements(const PlaneCase& layout, std::size_t count) {
  return 3 * static_cast<std::size_t>(std::popcount(layout.groups)) * plane_pitch(layout, count);
}

template <typename T>
[[nodiscard]] Outputs<T> plane_outputs(const PlaneCase& layout, std::size_t count,
                                       std::size_t shift, T* lowest) {
  Outputs<T> out;
  std::size_t plane = 0;
  const auto next = [&] {
    T* const first =
        lowest + plane * plane_pitch(layout, count) + (shift + plane * layout.step) % 16;
    ++plane;
    return layout.stride < 0 ? first + (count - 1) : first;
  };
  for (std::size_t g = 0; g < kVectorGroups; ++g) {
    if (holds(layout.groups, g)) {
      T* const x = next();
      T* const y = next();
      *groups_of(out)[g] = {x, y, next(), layout.stride};
    }
  }
  return out;
}

} // namespace simdbezier::tests
