// A small generator with fixed output: std:: distributions differ between standard libraries, and
// committed hashes and thresholds must not.
#pragma once

#include <cstdint>

namespace simdbezier::tests {

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  /// Uniform in [0,1), a multiple of 2^-53.
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform in [-1,1).
  double symmetric() { return 2 * unit() - 1; }

  double between(double low, double high) { return low + (high - low) * unit(); }

  /// Uniform in {0, …, count-1}; the bias of 2^-64 does not matter here.
  std::uint64_t below(std::uint64_t count) { return bits() % count; }

  /// An integer in [low, high].
  int integer(int low, int high) {
    return low + static_cast<int>(below(static_cast<std::uint64_t>(high - low) + 1));
  }

  double sign() { return (bits() >> 63) != 0 ? -1.0 : 1.0; }

private:
  std::uint64_t state_;
};

} // namespace simdbezier::tests
