// Triangles of cells whose sides may have further vertices, in room that is known to be there.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/mesh/layout/cells.hpp"
#include "src/mesh/primitives/cell_patterns.hpp"
#include "src/mesh/primitives/union_places.hpp"

namespace simdbezier::detail {

/// A leg of a cell in a corner of the patch, from the corner on.
struct CornerLeg {
  std::uint32_t corner;
  std::uint32_t zero; ///< the number that the corner would have as a point of the row
  std::uint32_t step;
  std::uint32_t segments;

  /// The leg's other end.
  [[nodiscard]] std::uint32_t far() const { return zero + segments * step; }
};

/// Its vertices one by one.
class CornerChain {
public:
  explicit CornerChain(const CornerLeg& leg) : segments_(leg.segments) {
    at_[0] = leg.corner;
    for (std::uint32_t k = 1; k <= segments_; ++k) {
      at_[k] = leg.zero + k * leg.step;
    }
  }
  [[nodiscard]] Leg leg() const { return Leg({at_, segments_}, false); }

private:
  std::uint32_t segments_;
  std::uint32_t at_[2 * UnionPlaces::kMost + 1];
};

/// Writes triangles with room behind them.
template <typename Index, bool kTurned>
class FanWriter {
public:
  explicit FanWriter(Index* to) : to_(to) {}

  [[nodiscard]] Index* end() const { return to_; }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    put(0, a, b, c);
    to_ += 3;
  }
  /// A half of a cell whose first leg is a chain: `n` segments from vertex `first` on.
  void fan_of_first(std::uint32_t first, std::uint32_t step, std::uint32_t n, std::uint32_t apex) {
    put(0, first, first + step, apex);
    put(1, first + step, first + 2 * step, apex);
    for (std::uint32_t k = 2; k < n; ++k) {
      put(k, first + k * step, first + (k + 1) * step, apex);
    }
    to_ += std::size_t{3} * n;
  }
  /// Writes the fan where the second leg is a chain.
  void fan_of_second(std::uint32_t first, std::uint32_t step, std::uint32_t n, std::uint32_t apex) {
    put(0, first, apex, first + step);
    put(1, apex, first + 2 * step, first + step);
    for (std::uint32_t k = 2; k < n; ++k) {
      put(k, apex, first + (k + 1) * step, first + k * step);
    }
    to_ += std::size_t{3} * n;
  }
  /// Writes the fan of the legs in a corner, towards the corner.
  void fan_of_first(const CornerLeg& leg, std::uint32_t apex) {
    fan_of_first(leg.far(), 0 - leg.step, leg.segments, apex);
    to_[kTurned ? -1 : -2] = static_cast<Index>(leg.corner);
  }
  void fan_of_second(const CornerLeg& leg, std::uint32_t apex) {
    fan_of_second(leg.far(), 0 - leg.step, leg.segments, apex);
    const bool single = leg.segments == 1;
    to_[(single != kTurned) ? -1 : -2] = static_cast<Index>(leg.corner);
  }
  /// The half of a cell that has the corner: cut_half() of its legs. One further vertex at most on
  /// either leg is usual: then three triangles are written, of which those count that are there.
  void corner_half(const CornerLeg& x, const CornerLeg& y) {
    if (x.segments > 2 || y.segments > 2) [[unlikely]] {
      *this = long_corner_half(x, y, *this);
      return;
    }
    const std::uint32_t x1 = x.zero + x.step;
    const std::uint32_t y1 = y.zero + y.step;
    const std::uint32_t x2 = x1 + x.step;
    const std::uint32_t y2 = y1 + y.step;
    put(0, x.corner, x1, y1);
    put(1, x1, x.segments == 2 ? x2 : y2, y1);
    put(2, x2, y2, y1);
    to_ += std::size_t{3} * (x.segments + y.segments - 1);
  }
  /// n cells side by side.
  void cells(const CellRun<Index>& run, std::uint32_t base, std::uint32_t n) {
    to_ = run.write(base, n, to_);
  }

private:
  /// It takes itself by value, since an object whose address is known elsewhere stays in memory.
  __attribute__((noinline)) static FanWriter long_corner_half(const CornerLeg& x,
                                                              const CornerLeg& y, FanWriter out) {
    const CornerChain chains[2] = {CornerChain(x), CornerChain(y)};
    cut_half(chains[0].leg(), chains[1].leg(), out);
    return out;
  }
  void put(std::size_t k, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    Index* const to = to_ + 3 * k;
    to[0] = static_cast<Index>(a);
    to[1] = static_cast<Index>(kTurned ? c : b);
    to[2] = static_cast<Index>(kTurned ? b : c);
  }

  Index* to_;
};

} // namespace simdbezier::detail
