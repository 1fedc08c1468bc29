// Bounds on cells by the distances of point sets, for which it does not matter how fast parameters
// move along the surface.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/mesh/bounds/bound_parts.hpp"
#include "src/mesh/bounds/cell_graph.hpp"
#include "src/mesh/bounds/normal_bends.hpp"
#include "src/mesh/bounds/vector_patch.hpp"

namespace simdbezier::detail {

/// The largest weight over the smallest one.
double weight_spread(const VectorPatch& patch);

/// What cells are looked for.
struct SpaceSearch {
  CellCounts usual;   ///< there are to be fewer than these
  CellCounts least;   ///< the fewest segments in each direction
  std::uint32_t most; ///< the most segments in a direction
  double t;           ///< the largest bound
  bool thorough;      ///< whether it may take 0.1 s, however few cells there may be
};

/// The bound of one patch. In its own scale, as others are.
class SpaceBound {
public:
  /// Of a patch, which is copied. flags: as in TopologyData.
  SpaceBound(const VectorPatch& patch, RateFlags flags)
      : SpaceBound(PatchTurn::canonical(patch.net), patch, flags) {}

  /// The certificate of cells; infinite where it is above `stop`, and where looking at all of them
  /// takes too long. It may be as coarse as `enough`. may_fall: whether diagonals
  /// may run from (1,0) to (0,1).
  CertifiedCells certify(const CellCounts& cells, double stop, double enough = 0,
                         bool may_fall = true);
  /// Few cells that hold; with an infinite bound where there are none. bends: those of the patch,
  /// which tell how many that may be.
  CertifiedCells choose(const SpaceSearch& search, const NormalBends& bends);

private:
  SpaceBound(const PatchTurn& turn, const VectorPatch& patch, RateFlags flags)
      : SpaceBound(turn.turned(patch), turn.turned(flags), turn) {}
  SpaceBound(const VectorPatch& turned, RateFlags flags, const PatchTurn& turn);

  /// Cells of one zone in one direction.
  struct Range {
    std::uint32_t begin;
    std::uint32_t end;
  };
  /// One cell's bound while it is looked for.
  struct Look {
    CellGraph graph;
    double enough;
    double stop;
    GraphDistance cut = {}; ///< of what vertices of neighbours may be
    double sides = 0;       ///< what sides ask for where they are inside of the triangles
    double found = 0;       ///< what points of the surface alone ask for
    std::size_t halvings = 0;

    /// How far such vertices move points across the axis.
    [[nodiscard]] double shift() const { return std::max(cut.outside, cut.inside); }
    [[nodiscard]] double total(const GraphDistance& piece) const;
    [[nodiscard]] double side_total(const GraphDistance& piece) const;
    [[nodiscard]] double distance(const GraphDistance& piece, double along, double across) const;
  };
  /// One side of a cell.
  struct SideLook {
    std::size_t side; ///< as the graph counts them
    std::size_t points;
    bool is_cut;      ///< whether neighbours may have vertices on it
    double found = 0; ///< what points of the side alone ask for
    std::size_t halvings = 0;
  };
  /// Parameters where a cell with either diagonal did not hold.
  using Miss = std::array<std::array<double, 2>, 2>;
  static constexpr std::size_t kMostMisses = 8;

  CertifiedCells look_at(const CellCounts& cells, double stop, double enough, bool may_fall);
  static Range range_of(unsigned place, std::uint32_t n);
  bool misses(const CellCounts& cells, double stop);
  double bound_range(const Range& u, const Range& v, const CellCounts& cells, bool falling,
                     double enough, double stop, std::array<double, 2>& miss);
  double bound_cell(std::uint32_t i, std::uint32_t j, const CellCounts& cells, bool falling,
                    double enough, double stop);
  [[nodiscard]] double radius() const;
  double bound_triangles(std::uint32_t i, std::uint32_t j, const CellCounts& cells, bool falling,
                         double enough, double stop);
  double bound_piece(Look& look, std::size_t level, std::size_t depth);
  GraphDistance bound_side(Look& look, SideLook& side, std::size_t level, std::size_t depth);
  void bound_sides(const bool (&is_cut)[4], bool falling, Look& look);
  const double* turned_middle();
  bool halve_along_u(const double* net, bool across) const;
  void take_row(std::uint32_t j, std::uint32_t nv);
  void take_cell(std::uint32_t i, std::uint32_t nu);
  double motion(std::uint32_t i, std::uint32_t j, const CellCounts& cells, double little) const;
  /// Nets of pieces of the cell, the turned cell's being the first.
  [[nodiscard]] double* piece(std::size_t level) { return pieces_.data() + level * net_.size(); }

  static constexpr std::size_t kDeepest = 48;

  PatchTurn turn_; ///< all that follows is of the turned patch
  std::size_t columns_;
  std::size_t rows_;
  RateFlags flags_;
  double work_;
  double spread_; ///< of weights
  double doubt_;
  std::vector<double> net_;    ///< homogeneous points, [j][i][4]
  std::vector<double> strip_;  ///< a row of cells
  std::vector<double> cell_;   ///< one cell
  double radius_ = 0;          ///< of the cell
  std::vector<double> pieces_; ///< in the axes of a graph
  std::vector<Miss> misses_;   ///< the latest first
  double looked_at_ = 0;       ///< pieces
  double most_looks_ = 0;
};

} // namespace simdbezier::detail
