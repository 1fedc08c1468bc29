// The places of the points of one rate among those of two rates, kept for the pairs that occur
// often.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "src/mesh/layout/edge_union.hpp"

namespace simdbezier::detail {

/// One thread's tables for small rates.
class UnionPlaces {
public:
  static constexpr std::uint32_t kMost = 63;

  /// For i = 0 .. rate: the segments before i / rate on an edge of both rates, which have at most
  /// kMost each.
  const std::uint32_t* of(std::uint32_t rate, std::uint32_t other) {
    const std::uint32_t*& known = known_[rate * (kMost + 1) + other];
    if (known == nullptr) {
      known = fill(rate, other);
    }
    return known;
  }

private:
  static constexpr std::size_t kBlock = 2048;

  const std::uint32_t* fill(std::uint32_t rate, std::uint32_t other) {
    if (blocks_.empty() || used_ + rate + 1 > kBlock) {
      blocks_.push_back(std::make_unique<std::uint32_t[]>(kBlock));
      used_ = 0;
    }
    std::uint32_t* const places = blocks_.back().get() + used_;
    used_ += rate + 1;
    EdgeRates rates;
    include_rate(rates, rate);
    include_rate(rates, other);
    std::vector<std::uint32_t> scratch;
    union_places(rates, rate, scratch, {places, rate + std::size_t{1}});
    return places;
  }

  std::vector<std::unique_ptr<std::uint32_t[]>> blocks_;
  std::size_t used_ = 0;
  std::array<const std::uint32_t*, (kMost + 1) * (kMost + 1)> known_{};
};

} // namespace simdbezier::detail
