// What a usual patch of two rows and columns of cells at least consists of.
#pragma once

#include "src/mesh/primitives/linear_sides.hpp"
#include "src/mesh/primitives/row_patterns.hpp"

namespace simdbezier::detail {

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
