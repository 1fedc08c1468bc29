// Numbers as the binary formats have them, on every machine.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace simdbezier::tools {

/// Stores a number at any address, least significant byte first.
template <typename T>
void store_little(void* to, T value) {
  auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) {
    std::ranges::reverse(bytes);
  }
  std::memcpy(to, bytes.data(), bytes.size());
}

/// What store_little() has stored.
template <typename T>
[[nodiscard]] T load_little(const void* from) {
  std::array<std::byte, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, bytes.size());
  if constexpr (std::endian::native == std::endian::big) {
    std::ranges::reverse(bytes);
  }
  return std::bit_cast<T>(bytes);
}

} // namespace simdbezier::tools
