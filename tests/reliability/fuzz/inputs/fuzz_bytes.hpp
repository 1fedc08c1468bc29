// The fuzzer's bytes as the values that a target asks for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace simdbezier::fuzz {

/// Hands out bytes from first to last, and zeros once they have run out: zero therefore has to mean
/// the plainest choice everywhere, so that short inputs are small cases.
class ByteSource {
public:
  explicit ByteSource(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint8_t byte() {
    if (bytes_.empty()) {
      return 0;
    }
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }

  /// Any bit pattern of a number.
  template <typename N>
  [[nodiscard]] N raw() {
    std::uint8_t bits[sizeof(N)];
    for (std::uint8_t& b : bits) {
      b = byte();
    }
    N number;
    std::memcpy(&number, bits, sizeof number);
    return number;
  }

  /// 0 to limit - 1.
  [[nodiscard]] std::size_t below(std::size_t limit) {
    return limit <= 256 ? byte() % limit : raw<std::uint32_t>() % limit;
  }
  [[nodiscard]] int between(int first, int last) {
    return first + static_cast<int>(below(static_cast<std::size_t>(last - first) + 1));
  }
  [[nodiscard]] bool flag() { return (byte() & 1) != 0; }
  /// True for `of_256` of the values of a byte, the highest ones.
  [[nodiscard]] bool rarely(int of_256) { return byte() >= 256 - of_256; }

  template <typename N, std::size_t kCount>
  [[nodiscard]] N pick(const N (&choices)[kCount]) {
    return choices[below(kCount)];
  }

private:
  std::span<const std::uint8_t> bytes_;
};

/// Pseudo-random numbers where a seed has to stand for many values (Steele, Lea, Flood 2014).
class SplitMix {
public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  [[nodiscard]] std::size_t below(std::size_t limit) {
    return static_cast<std::size_t>(next() % limit);
  }
  /// [-1, 1)
  [[nodiscard]] double symmetric() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1; }

private:
  std::uint64_t state_;
};

} // namespace simdbezier::fuzz
