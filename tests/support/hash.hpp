// FNV-1a (64 bit) over the bits of results: equal hashes are how equal bits are reported.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace simdbezier::tests {

class Fnv1a {
public:
  void add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < size; ++k) {
      state_ = (state_ ^ bytes[k]) * 0x100000001b3ULL;
    }
  }

  /// Adds values by their bits. All NaN count as one: their payload and sign are not part of any
  /// contract (the sign of 0*inf differs between x86 and ARM).
  template <typename T>
  void add(T value) {
    if (value != value) {
      add_bytes("nan", 3);
    } else {
      add_bytes(&value, sizeof value);
    }
  }

  template <typename T>
  void add_all(std::span<const T> values) {
    for (const T value : values) {
      add(value);
    }
  }

  [[nodiscard]] std::uint64_t value() const { return state_; }

  [[nodiscard]] std::string text() const {
    char buffer[17];
    std::snprintf(buffer, sizeof buffer, "%016llx", static_cast<unsigned long long>(state_));
    return buffer;
  }

private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

/// True where two values have the same bits, or are both NaN.
template <typename T>
[[nodiscard]] bool same_bits(T a, T b) {
  using Bits = std::conditional_t<
      sizeof(T) == 8, std::uint64_t,
      std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint8_t>>; // floats, statuses
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b) || (a != a && b != b);
}

/// How many values of two arrays have other bits. One comparison of memory where all are the same.
template <typename T>
[[nodiscard]] std::size_t differing_bits(const T* a, const T* b, std::size_t count) {
  if (count == 0 || std::memcmp(a, b, count * sizeof(T)) == 0) {
    return 0;
  }
  std::size_t different = 0;
  for (std::size_t k = 0; k < count; ++k) {
    different += same_bits(a[k], b[k]) ? 0 : 1;
  }
  return different;
}

} // namespace simdbezier::tests
