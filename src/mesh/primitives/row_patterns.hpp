// The numbers of the cells between two rows of inner points, kept for the widths that occur.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "src/mesh/primitives/cell_patterns.hpp"
#include "src/mesh/primitives/union_counts.hpp"

namespace simdbezier::detail {

/// Where a zone of the cells of a row, or of a column, ends.
struct ZoneEnd {
  std::uint32_t number; ///< its Zone as the number of a bit
  std::uint32_t end;
};
/// The zones of n cells in a row.
inline std::array<ZoneEnd, 3> zone_ends(std::uint32_t n) {
  const auto at = [](Zone zone, std::uint32_t end) {
    return ZoneEnd{static_cast<std::uint32_t>(zone), end};
  };
  return {at(Zone::low, n / 2), at(Zone::middle, n - n / 2), at(Zone::high, n)};
}

/// One thread's patterns, of patches that are turned or of those that are not. A pattern has the
/// numbers of all cells of a row, as if its inner points went on at both ends: how much larger they
/// are than that of the first one below. There are few, because they do not depend on the sides.
template <typename Index>
class RowPatterns {
public:
  explicit RowPatterns(bool turned) : turned_(turned) {}

  /// The pattern of rows of nu cells, up to UnionCounts::kMost; bit k of `zones`: whether the cells
  /// of a zone are falling.
  const Index* of(std::uint32_t nu, std::uint32_t zones) {
    Width& width = widths_[nu];
    const std::size_t numbers = std::size_t{6} * nu + CellRun<Index>::kNumbers;
    if (width.patterns == nullptr) {
      width.patterns = std::make_unique_for_overwrite<Index[]>(kZones * numbers);
    }
    Index* const pattern = width.patterns.get() + zones * numbers;
    if ((width.known >> zones & 1) == 0) {
      width.known |= 1U << zones;
      fill(nu, zones, pattern);
    }
    return pattern;
  }

private:
  static constexpr std::size_t kZones = 8;
  struct Width {
    std::unique_ptr<Index[]> patterns;
    std::uint32_t known = 0; ///< bit k: the pattern of zones k
  };

  void fill(std::uint32_t nu, std::uint32_t zones, Index* to) const {
    std::uint32_t begin = 0;
    for (const ZoneEnd& zone : zone_ends(nu)) {
      const bool falling = (zones >> zone.number & 1) != 0;
      const CellRun<Index> run(begin, begin + nu - 1, {1, 1}, falling, turned_);
      to = run.write(0, zone.end - begin, to);
      begin = zone.end;
    }
  }

  bool turned_;
  std::array<Width, UnionCounts::kMost + 1> widths_;
};

} // namespace simdbezier::detail
