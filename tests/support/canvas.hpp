// Memory for the outputs of a call that knows what must be in it afterwards, to the last byte:
// results where outputs lie, the poison it was filled with everywhere else.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/evaluation.hpp"

namespace simdbezier::tests {

/// The vector groups of Outputs, in their order there.
inline constexpr std::size_t kVectorGroups = kVectorOutputs;

template <typename T>
[[nodiscard]] std::array<Vectors<T>*, kVectorGroups> groups_of(Outputs<T>& out) {
  std::array<Vectors<T>*, kVectorGroups> groups{};
  for (std::size_t g = 0; g < kVectorGroups; ++g) {
    groups[g] = &out[static_cast<Output>(g)];
  }
  return groups;
}

/// Where Planes keeps that group.
[[nodiscard]] constexpr std::size_t plane_group(std::size_t group) {
  constexpr std::size_t kOf[kVectorGroups] = {0, 1, 2, 4, 5, 6, 3};
  return kOf[group];
}

/// Groups as bits in the order of Outputs.
using GroupSet = unsigned;
inline constexpr GroupSet kP = 1;
inline constexpr GroupSet kDu = 2;
inline constexpr GroupSet kDv = 4;
inline constexpr GroupSet kDuu = 8;
inline constexpr GroupSet kDuv = 16;
inline constexpr GroupSet kDvv = 32;
inline constexpr GroupSet kN = 64;
inline constexpr GroupSet kAllVectors = 127;

[[nodiscard]] constexpr bool holds(GroupSet groups, std::size_t group) {
  return (groups >> group & 1U) != 0;
}
[[nodiscard]] constexpr OutputSelection selection_of(GroupSet groups) {
  OutputSelection selection;
  for (std::size_t g = 0; g < kVectorGroups; ++g) {
    if (holds(groups, g)) {
      selection.add(static_cast<Output>(g));
    }
  }
  return selection;
}

/// One array of T between guards of at least 128 bytes; element 0 lies on a cache line.
template <typename T>
class Canvas {
public:
  static constexpr T kPoison = static_cast<T>(-777);
  static constexpr std::size_t kGuard = 128 / sizeof(T);

  explicit Canvas(std::size_t elements) { reset(elements); }

  /// Poisons the array anew, at another size where it has to be.
  void reset(std::size_t elements) {
    elements_ = elements;
    values_.assign(elements + 2 * kGuard + 64 / sizeof(T), kPoison);
    const auto address = reinterpret_cast<std::uintptr_t>(values_.data() + kGuard);
    first_ = kGuard + (64 - address % 64) % 64 / sizeof(T);
  }

  [[nodiscard]] T* at(std::size_t element) { return values_.data() + first_ + element; }
  [[nodiscard]] std::size_t size() const { return elements_; }
  [[nodiscard]] bool untouched() const {
    for (const T value : values_) {
      if (std::memcmp(&value, &kPoison, sizeof value) != 0) {
        return false;
      }
    }
    return true;
  }

  /// How many elements are not what they must be after a call with `out`, all of whose vectors lie
  /// in here, gave the first `count` samples of `reference`.
  [[nodiscard]] std::size_t defects(Outputs<T> out, const Planes<T>& reference, std::size_t count) {
    expected_.assign(values_.size(), kPoison);
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      const Vectors<T>& group = *groups_of(out)[g];
      if (!group.wanted()) {
        continue;
      }
      T* const planes[3] = {group.x, group.y, group.z};
      for (std::size_t c = 0; c < 3; ++c) {
        T* to = expected_.data() + (planes[c] - values_.data());
        const T* const from = reference.plane(plane_group(g), c);
        if (group.stride == 1) {
          std::copy_n(from, count, to);
          continue;
        }
        for (std::size_t k = 0; k < count; ++k) {
          to[static_cast<std::ptrdiff_t>(k) * group.stride] = from[k];
        }
      }
    }
    if (std::memcmp(values_.data(), expected_.data(), values_.size() * sizeof(T)) == 0) {
      return 0;
    }
    std::size_t defects = 0;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      defects += std::memcmp(&values_[k], &expected_[k], sizeof(T)) == 0 ? 0 : 1;
    }
    return defects;
  }

private:
  std::size_t elements_ = 0;
  std::size_t first_ = 0;
  std::vector<T> values_;
  std::vector<T> expected_;
};

} // namespace simdbezier::tests
