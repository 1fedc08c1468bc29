// What a usual patch of two rows and columns of cells at least consists of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "src/mesh/primitives/cell_patterns.hpp"
#include "src/mesh/primitives/linear_sides.hpp"

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

class UsualPatch {
protected:
  UsualPatch(const MeshData& mesh, std::size_t patch, const LinearSides& sides)
      : v0_(sides[0]), v1_(sides[1]), u0_(sides[2]), u1_(sides[3]), zones_(mesh, patch),
        nu_(mesh.nu[patch]), nv_(mesh.nv[patch]), inner_(mesh.inner[patch]),
        diagonals_(mesh.diagonals[patch]) {}

  /// The number of inner point (i, j), or what it would be at i = 0.
  [[nodiscard]] std::uint32_t inner(std::uint32_t i, std::uint32_t j) const {
    return inner_ + (j - 1) * (nu_ - 1) + i - 1;
  }

  /// Calls visit(j, pattern, falling) for all rows but the first and the last one; `pattern` is of
  /// RowPatterns. Bits 0 and 1 of `falling`: whether the first cell's diagonal falls, and the last
  /// one's.
  template <typename Index, typename Visit>
  __attribute__((always_inline)) void for_inner_rows(RowPatterns<Index>& patterns,
                                                     const Visit& visit) const {
    static_assert(Zone::low == Zone{0} && Zone::high == Zone{1});
    std::uint32_t j = 1;
    for (const ZoneEnd& zone : zone_ends(nv_)) {
      const std::uint32_t end = std::min(zone.end, nv_ - 1);
      if (j < end) {
        const std::uint32_t falling = diagonals_ >> 3 * zone.number & 7;
        const Index* const pattern = patterns.of(nu_, falling);
        for (; j < end; ++j) {
          visit(j, pattern, falling);
        }
      }
    }
  }

  const LinearSide& v0_;
  const LinearSide& v1_;
  const LinearSide& u0_;
  const LinearSide& u1_;
  CellZones zones_;
  std::uint32_t nu_;
  std::uint32_t nv_;

private:
  std::uint32_t inner_;
  std::uint32_t diagonals_;
};

} // namespace simdbezier::detail
