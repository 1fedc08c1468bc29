// Arguments that make no sense, and what calls have to do with them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/inputs/fuzz_bytes.hpp"

namespace simdbezier::fuzz {

__extension__ using Wide = __int128;

inline constexpr std::ptrdiff_t kLastOffset = std::numeric_limits<std::ptrdiff_t>::max();

/// Strides around which arithmetic wraps, small ones that may make values share a place, and powers
/// of two of every magnitude, of either sign.
[[nodiscard]] inline std::ptrdiff_t hostile_stride(ByteSource& bytes) {
  static constexpr std::ptrdiff_t kStrides[] = {0,
                                                1,
                                                2,
                                                3,
                                                4,
                                                12,
                                                16,
                                                48,
                                                64,
                                                kLastOffset,
                                                -kLastOffset - 1,
                                                -kLastOffset,
                                                kLastOffset / 2,
                                                kLastOffset / 3,
                                                kLastOffset / 4,
                                                -(kLastOffset / 2),
                                                kLastOffset / 16 + 1,
                                                std::ptrdiff_t{1} << 62,
                                                std::ptrdiff_t{1} << 61,
                                                -(std::ptrdiff_t{1} << 60)};
  constexpr std::size_t kListed = std::size(kStrides);
  const std::size_t choice = bytes.below(256);
  if (choice >= 128) {
    const std::ptrdiff_t power = std::ptrdiff_t{1} << choice % 63;
    return bytes.flag() ? -power : power;
  }
  const std::ptrdiff_t stride = kStrides[choice % kListed];
  return stride > 0 && stride < 65 && bytes.flag() ? -stride : stride;
}

/// Counts that no memory holds, and none at all.
[[nodiscard]] inline std::size_t hostile_count(ByteSource& bytes) {
  static constexpr std::size_t kCounts[] = {0,
                                            std::size_t{1} << 52,
                                            std::size_t{1} << 58,
                                            std::size_t{1} << 61,
                                            std::size_t{1} << 62,
                                            std::size_t{1} << 63,
                                            static_cast<std::size_t>(-1),
                                            static_cast<std::size_t>(-1) / 3};
  return bytes.pick(kCounts);
}
inline constexpr std::size_t kLeastHostileCount = std::size_t{1} << 52;

[[nodiscard]] inline int hostile_integer(ByteSource& bytes) {
  static constexpr int kIntegers[] = {0,
                                      -1,
                                      16,
                                      17,
                                      1,
                                      15,
                                      3,
                                      std::numeric_limits<int>::max(),
                                      std::numeric_limits<int>::min(),
                                      1 << 30};
  return bytes.pick(kIntegers);
}

/// The offsets in elements, first and last included, that strided loops reach.
struct Reach {
  Wide lowest = 0;
  Wide highest = 0;

  void add(std::size_t extent, std::ptrdiff_t stride) {
    if (extent > 1) {
      const Wide reach = static_cast<Wide>(extent - 1) * stride;
      (reach < 0 ? lowest : highest) += reach;
    }
  }
  /// Whether an offset or the whole range exceeds what pointers can tell apart.
  [[nodiscard]] bool overflows(std::size_t value_bytes) const {
    return (highest - lowest + 1) * static_cast<Wide>(value_bytes) > kLastOffset;
  }
  [[nodiscard]] bool within(std::ptrdiff_t origin, std::size_t elements) const {
    return origin + lowest >= 0 && origin + highest < static_cast<Wide>(elements);
  }
};

/// Reach of nets whose degrees and components are sound.
template <typename S>
[[nodiscard]] Reach reach_of(const ControlNets<S>& nets) {
  Reach reach;
  reach.add(nets.count, nets.patch_stride);
  reach.add(static_cast<std::size_t>(nets.degree_v) + 1, nets.row_stride);
  reach.add(static_cast<std::size_t>(nets.degree_u) + 1, nets.point_stride);
  reach.add(static_cast<std::size_t>(nets.components) + (nets.weights == Weights::none ? 0 : 1),
            nets.component_stride);
  return reach;
}

[[nodiscard]] inline bool sound_integer(int value, int most) { return value >= 1 && value <= most; }

/// Replaces one to three members of a description of nets.
template <typename S>
void spoil(ByteSource& bytes, ControlNets<S>& nets) {
  for (std::size_t left = 1 + bytes.below(3); left > 0; --left) {
    switch (bytes.below(12)) {
    case 0:
      nets.points = nullptr;
      break;
    case 1:
      nets.count = hostile_count(bytes);
      break;
    case 2:
      nets.degree_u = hostile_integer(bytes);
      break;
    case 3:
      nets.degree_v = hostile_integer(bytes);
      break;
    case 4:
      nets.components = hostile_integer(bytes);
      break;
    case 5:
      nets.weights = static_cast<Weights>(bytes.byte());
      break;
    case 6:
    case 7:
      nets.patch_stride = hostile_stride(bytes);
      break;
    case 8:
    case 9:
      nets.row_stride = hostile_stride(bytes);
      break;
    case 10:
      nets.point_stride = hostile_stride(bytes);
      break;
    default:
      nets.component_stride = hostile_stride(bytes);
      break;
    }
  }
}

/// Curves as nets of two equal rows, and back.
template <typename S>
[[nodiscard]] ControlNets<S> as_nets(const ControlCurves<S>& curves) {
  return {curves.points,       curves.count,
          curves.degree,       1,
          curves.curve_stride, 0,
          curves.point_stride, curves.component_stride,
          curves.components,   curves.weights,
          curves.memory};
}
template <typename S>
[[nodiscard]] ControlCurves<S> as_curves(const ControlNets<S>& nets) {
  return {nets.points,       nets.count,        nets.degree_u,
          nets.patch_stride, nets.point_stride, nets.component_stride,
          nets.components,   nets.weights,      nets.memory};
}

/// The same places as an output.
template <typename S>
[[nodiscard]] MutableNets<S> as_output(const ControlNets<S>& nets) {
  const std::span<const S> memory = nets.memory;
  return {const_cast<S*>(nets.points),
          nets.count,
          nets.degree_u,
          nets.degree_v,
          nets.patch_stride,
          nets.row_stride,
          nets.point_stride,
          nets.component_stride,
          nets.components,
          nets.weights,
          {const_cast<S*>(memory.data()), memory.size()}};
}

/// What a call that only reads nets has to do with a description that knows its memory.
enum class Verdict : std::uint8_t {
  possible, ///< all values are there; strides may still make them share places
  refused,  ///< some error
  overflow  ///< size_overflow: nothing else is wrong
};

template <typename S>
[[nodiscard]] Verdict verdict_on(const ControlNets<S>& nets, bool curves = false) {
  if (!sound_integer(nets.degree_u, kMostDegree) || !sound_integer(nets.degree_v, kMostDegree) ||
      !sound_integer(nets.components, kMostComponents) || nets.weights > Weights::homogeneous) {
    return Verdict::refused;
  }
  if (nets.count == 0) {
    return Verdict::possible;
  }
  if (nets.points == nullptr || nets.count >= kLeastHostileCount) {
    return Verdict::refused;
  }
  const Reach reach = reach_of(nets);
  if (reach.overflows(sizeof(S))) {
    // Values that share a place are as good a reason.
    const bool shared = (nets.row_stride == 0 && !curves) || nets.point_stride == 0 ||
                        nets.component_stride == 0 || nets.patch_stride == 0;
    return shared ? Verdict::refused : Verdict::overflow;
  }
  return reach.within(nets.points - nets.memory.data(), nets.memory.size()) ? Verdict::possible
                                                                            : Verdict::refused;
}

} // namespace simdbezier::fuzz
