// What a usual patch consists of: rates from 2 to 63, and sides whose vertices follow each other.
#pragma once

#include "src/mesh/primitives/cell_patterns.hpp"
#include "src/mesh/primitives/linear_sides.hpp"

namespace simdbezier::detail {

class UsualPatch {
protected:
  UsualPatch(const MeshData& mesh, std::size_t patch, const LinearSides& sides)
      : v0_(sides[0]), v1_(sides[1]), u0_(sides[2]), u1_(sides[3]), zones_(mesh, patch),
        nu_(mesh.nu[patch]), nv_(mesh.nv[patch]), inner_(mesh.inner[patch]) {}

  /// The number of inner point (i, j), or what it would be at i = 0.
  [[nodiscard]] std::uint32_t inner(std::uint32_t i, std::uint32_t j) const {
    return inner_ + (j - 1) * (nu_ - 1) + i - 1;
  }

  /// The row's cells from i on, in the first row (j = 0) or the last one, of which the points on
  /// the side follow each other.
  template <typename Index, bool kTurned>
  [[nodiscard]] CellRun<Index> border_cells(std::uint32_t i, std::uint32_t j, bool falling) const {
    const LinearSide& side = j == 0 ? v0_ : v1_;
    const VertexSteps steps{j == 0 ? side.step : 1, j == 0 ? 1 : side.step};
    const std::uint32_t below = j == 0 ? side.at(i) : inner(i, j);
    const std::uint32_t above = j == 0 ? inner(i, 1) : side.at(i);
    return {below, above, steps, falling, kTurned};
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
};

/// Inner cells from vertex 0 on, of a patch whose rows have nu - 1 inner points.
template <typename Index, bool kTurned>
class InnerCells {
public:
  explicit InnerCells(std::uint32_t nu)
      : runs_{{0, nu - 1, {1, 1}, false, kTurned}, {0, nu - 1, {1, 1}, true, kTurned}} {}
  [[nodiscard]] const CellRun<Index>& run(bool falling) const { return runs_[falling ? 1 : 0]; }

private:
  CellRun<Index> runs_[2];
};

} // namespace simdbezier::detail
