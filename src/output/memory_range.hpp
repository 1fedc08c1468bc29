// Bytes that a call reads or writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace simdbezier::detail {

struct MemoryRange {
  const void* begin = nullptr;
  std::size_t bytes = 0; ///< 0 where begin is null

  constexpr MemoryRange() noexcept = default;
  constexpr MemoryRange(const void* first, std::size_t size) noexcept
      : begin(first), bytes(first == nullptr ? 0 : size) {}
  template <typename T>
  constexpr MemoryRange(std::span<const T> values) noexcept // NOLINT: implicit on purpose
      : MemoryRange(values.data(), values.size_bytes()) {}

  /// Whether both have a byte in common. Nothing meets a range of no bytes, wherever it begins.
  [[nodiscard]] bool meets(const MemoryRange& other) const noexcept {
    const auto a = reinterpret_cast<std::uintptr_t>(begin);
    const auto b = reinterpret_cast<std::uintptr_t>(other.begin);
    return a < b + other.bytes && b < a + bytes && bytes > 0 && other.bytes > 0;
  }
  /// Whether it ends where the other one begins, or before; false where it would lead past the end
  /// of the address space.
  [[nodiscard]] bool precedes(const MemoryRange& other) const noexcept {
    const auto a = reinterpret_cast<std::uintptr_t>(begin);
    const auto b = reinterpret_cast<std::uintptr_t>(other.begin);
    return a <= b && b - a >= bytes;
  }
};

} // namespace simdbezier::detail
