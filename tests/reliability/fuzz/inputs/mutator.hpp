// Inputs made of other inputs, the same ones in every run: what the replay of a target adds to its
// files. No more than a net for changes that break much; finding the rare case is the fuzzer's job.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/reliability/fuzz/inputs/fuzz_bytes.hpp"

namespace simdbezier::fuzz {

using Bytes = std::vector<std::uint8_t>;

class Mutator {
public:
  /// The seeds outlive it; there is at least one, which may be empty.
  explicit Mutator(const std::vector<Bytes>& seeds) : seeds_(seeds) {}

  [[nodiscard]] Bytes next() {
    // Binary formats have no seed that is near to everything: some inputs are noise.
    Bytes bytes = random_.below(8) == 0 ? noise(1 + random_.below(96)) : any_seed();
    for (std::size_t left = 1 + random_.below(6); left > 0; --left) {
      change(bytes);
    }
    bytes.resize(std::min(bytes.size(), kLongest));
    return bytes;
  }

private:
  static constexpr std::size_t kLongest = 4096;
  // Numbers that readers and sizes stumble over.
  static constexpr std::array<std::string_view, 12> kWords = {
      "0",          "-1",         "1e308",
      "1e-320",     "nan",        "inf",
      "2147483648", "4294967296", "18446744073709551615",
      "0x10",       "+-1",        "\xef\xbb\xbf"};

  [[nodiscard]] const Bytes& any_seed() { return seeds_[random_.below(seeds_.size())]; }

  [[nodiscard]] Bytes noise(std::size_t size) {
    Bytes bytes(size);
    for (std::uint8_t& byte : bytes) {
      byte = static_cast<std::uint8_t>(random_.next());
    }
    return bytes;
  }

  /// A piece of up to `most` bytes, as first index and length.
  [[nodiscard]] std::pair<std::ptrdiff_t, std::ptrdiff_t> piece(const Bytes& of, std::size_t most) {
    const std::size_t first = random_.below(of.size() + 1);
    const std::size_t length = random_.below(std::min(most, of.size() - first) + 1);
    return {static_cast<std::ptrdiff_t>(first), static_cast<std::ptrdiff_t>(length)};
  }

  template <typename From>
  void insert(Bytes& bytes, const From& from) {
    bytes.insert(bytes.begin() + piece(bytes, 0).first, from.begin(), from.end());
  }

  void change(Bytes& bytes) {
    switch (random_.below(6)) {
    case 0: // one byte
      if (!bytes.empty()) {
        bytes[random_.below(bytes.size())] = static_cast<std::uint8_t>(random_.next());
      }
      break;
    case 1: // one bit
      if (!bytes.empty()) {
        bytes[random_.below(bytes.size())] ^= static_cast<std::uint8_t>(1U << random_.below(8));
      }
      break;
    case 2: { // less
      const auto [first, length] = piece(bytes, 64);
      bytes.erase(bytes.begin() + first, bytes.begin() + first + length);
      break;
    }
    case 3: { // a part of another seed
      const Bytes& other = any_seed();
      const auto [first, length] = piece(other, 256);
      insert(bytes, Bytes(other.begin() + first, other.begin() + first + length));
      break;
    }
    case 4:
      insert(bytes, kWords[random_.below(kWords.size())]);
      break;
    default:
      insert(bytes, noise(1 + random_.below(8)));
      break;
    }
  }

  const std::vector<Bytes>& seeds_;
  SplitMix random_{1};
};

} // namespace simdbezier::fuzz
