// Bytes that a call reads or writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace simdbezier::detail {

struct MemoryRange {
  const void* begin = nullptr;
  std::size_t bytes = 0; ///< 0 where begin is null: nothing meets it

  constexpr MemoryRange() noexcept = default;
  constexpr MemoryRange(const void* first, std::size_t size) noexcept
      : begin(first), bytes(first == nullptr ? 0 : size) {}
  template <typename T>
  constexpr MemoryRange(std::span<const T> values) noexcept // NOLINT: implicit on purpose
      : MemoryRange(values.data(), values.size_bytes()) {}

  [[nodiscard]] bool meets(const MemoryRange& other) const noexcept {
    const auto a = reinterpret_cast<std::uintptr_t>(begin);
    const auto b = reinterpret_cast<std::uintptr_t>(other.begin);
    return a < b + other.bytes && b < a + bytes;
  }
};

} // namespace simdbezier::detail
