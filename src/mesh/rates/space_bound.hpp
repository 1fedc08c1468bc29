// Bounds on cells of patches whose weights are far apart: the distances of point sets, for which it
// does not matter how fast parameters move along the surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/mesh/rates/bound_parts.hpp"
#include "src/mesh/rates/simplex_distance.hpp"
#include "src/mesh/rates/vector_patch.hpp"

namespace simdbezier::detail {

/// Whether the bound by second derivatives may ask for far too many cells.
bool has_spread_weights(const VectorPatch& patch);

/// The bound of one patch. In its own scale, as others are.
class SpaceBound {
public:
  /// Of a rational patch, which has to stay. flags: as in TopologyData.
  SpaceBound(const VectorPatch& patch, std::uint8_t flags);

  /// The certificate of cells; infinite where it is above `stop`, and where there are too many
  /// cells to look at each of them. It may be as coarse as `enough`, and is then the same for
  /// turned patches but for rounding. may_fall: whether diagonals may run from (1,0) to (0,1).
  CertifiedCells certify(const CellCounts& cells, double stop, double enough = 0,
                         bool may_fall = true);
  /// Few cells that hold, but fewer than `usual`; with an infinite bound where there are none.
  CertifiedCells choose(const CellCounts& usual, double stop, std::uint32_t most);

private:
  /// Cells of one zone in one direction.
  struct Range {
    std::uint32_t begin;
    std::uint32_t end;
  };
  static Range range_of(unsigned place, std::uint32_t n);
  bool misses(const CellCounts& cells, double stop);
  double bound_range(const Range& u, const Range& v, const CellCounts& cells, bool falling,
                     double enough, double stop);
  double bound_cell(std::uint32_t i, std::uint32_t j, const CellCounts& cells, bool falling,
                    double enough, double stop);
  double bound_halves(std::uint32_t i, std::uint32_t j, const CellCounts& cells, bool falling,
                      double enough, double stop);
  void take_half(unsigned flip, SimplexNet& half) const;
  void take_side(const SimplexNet& half, std::size_t side);
  void take_row(std::uint32_t j, std::uint32_t nv);
  void take_cell(std::uint32_t i, std::uint32_t nu);
  void even_out();
  double motion(std::uint32_t i, std::uint32_t j, const CellCounts& cells) const;

  std::size_t columns_;
  std::size_t rows_;
  std::uint8_t flags_;
  double work_;
  double doubt_;
  std::vector<double> net_;    ///< homogeneous points, [j][i][4]
  std::vector<double> strip_;  ///< a row of cells
  std::vector<double> cell_;   ///< one cell
  std::vector<double> raised_; ///< the factors of a cell's points in those of its triangle
  SimplexNet halves_[2];
  SimplexNet side_;
  SimplexDistance distance_;
  std::array<double, 2> misses_[2] = {}; ///< where cells with either diagonal did not hold
  double looked_at_ = 0;                 ///< cells
};

} // namespace simdbezier::detail
