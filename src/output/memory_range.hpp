// Bytes that a call reads or writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace simdbezier::detail {

/// A range of bytes by its first address. All that compares addresses of the caller's memory goes
/// through these functions: they subtract addresses modulo 2^64, and never add to one, because
/// strides may lead past either end of the address space, where sums begin again at 0.
class MemoryRange {
public:
  constexpr MemoryRange() noexcept = default;
  /// No bytes where `first` is null.
  MemoryRange(const void* first, std::size_t size) noexcept
      : begin_(reinterpret_cast<std::uintptr_t>(first)), bytes_(first == nullptr ? 0 : size) {}
  template <typename T>
  MemoryRange(std::span<const T> values) noexcept // NOLINT: implicit on purpose
      : MemoryRange(values.data(), values.size_bytes()) {}
  /// From `lowest` bytes of an address on to before `highest`, which is not less.
  MemoryRange(const void* address, std::ptrdiff_t lowest, std::ptrdiff_t highest) noexcept
      : begin_(reinterpret_cast<std::uintptr_t>(address) + static_cast<std::uintptr_t>(lowest)),
        bytes_(static_cast<std::size_t>(highest) - static_cast<std::size_t>(lowest)) {}

  [[nodiscard]] bool empty() const noexcept { return bytes_ == 0; }
  /// Whether both have a byte in common. Nothing meets a range of no bytes, wherever it begins.
  [[nodiscard]] bool meets(const MemoryRange& other) const noexcept {
    return !empty() && !other.empty() &&
           (other.begin_ - begin_ < bytes_ || begin_ - other.begin_ < other.bytes_);
  }
  [[nodiscard]] bool contains(const MemoryRange& other) const noexcept {
    const std::uintptr_t before = other.begin_ - begin_;
    return before <= bytes_ && other.bytes_ <= bytes_ - before;
  }
  /// Whether it ends where the other one begins, or before; false where it would lead past the end
  /// of the address space.
  [[nodiscard]] bool precedes(const MemoryRange& other) const noexcept {
    return begin_ <= other.begin_ && other.begin_ - begin_ >= bytes_;
  }

private:
  std::uintptr_t begin_ = 0;
  std::size_t bytes_ = 0;
};

} // namespace simdbezier::detail
