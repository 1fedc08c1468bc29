// Memory for planes that begin at given places of cache lines.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace simdbezier::tests {

/// Around each plane is a line or more of values that are nobody's.
template <typename T>
class PlacedPlanes {
public:
  PlacedPlanes(std::size_t planes, std::size_t count)
      : count_(count), pitch_((count / kLine + 4) * kLine),
        memory_(planes * pitch_ + 3 * kLine, kPoison) {
    const auto behind_line = reinterpret_cast<std::uintptr_t>(memory_.data()) / sizeof(T) % kLine;
    first_ = 2 * kLine - behind_line;
  }

  /// shift: values behind the beginning of a line, fewer than a line.
  [[nodiscard]] T* at(std::size_t plane, std::size_t shift) {
    return memory_.data() + first_ + plane * pitch_ + shift;
  }
  /// Whether the plane holds these values, bit for bit. Poisons it again.
  [[nodiscard]] bool take(T* plane, const T* values) const {
    const bool equal = std::memcmp(plane, values, count_ * sizeof(T)) == 0;
    std::fill_n(plane, count_, kPoison);
    return equal;
  }
  /// Whether nothing was written but what was taken.
  [[nodiscard]] bool is_poison() const {
    return std::all_of(memory_.begin(), memory_.end(), [](T value) { return value == kPoison; });
  }

private:
  static constexpr std::size_t kLine = 64 / sizeof(T);
  static constexpr T kPoison = T(-7.7e7);

  std::size_t count_;
  std::size_t pitch_;
  std::vector<T> memory_;
  std::size_t first_;
};

} // namespace simdbezier::tests
