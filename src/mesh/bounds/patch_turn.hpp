// The one of a patch's eight orientations in which it is looked at, so that results of a search do
// not depend on how the patch is given.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/mesh/bounds/bound_parts.hpp"
#include "src/mesh/bounds/vector_patch.hpp"

namespace simdbezier::detail {

/// A patch's directions are reversed, and then exchanged.
struct PatchTurn {
  bool reversed_u = false;
  bool reversed_v = false;
  bool transposed = false;

  /// That of the smallest sequence of control vectors, among those of no more columns than rows.
  [[nodiscard]] static PatchTurn canonical(const VectorNet& net);

  /// Of the turned net, of the one that is given.
  [[nodiscard]] const ControlVector& at(const VectorNet& net, std::size_t i, std::size_t j) const {
    const std::size_t u = transposed ? j : i;
    const std::size_t v = transposed ? i : j;
    return net(reversed_u ? net.columns - 1 - u : u, reversed_v ? net.rows - 1 - v : v);
  }
  [[nodiscard]] VectorPatch turned(const VectorPatch& patch) const;
  [[nodiscard]] RateFlags turned(RateFlags flags) const;
  /// From the patch to the turned one, and back.
  [[nodiscard]] CellCounts turned(const CellCounts& cells) const {
    return transposed ? CellCounts{cells.nv, cells.nu} : cells;
  }
  /// Whether diagonals that rise in the patch fall in the turned one.
  [[nodiscard]] bool exchanges_diagonals() const { return reversed_u != reversed_v; }
  /// The patch's zone, as in Zone, of one of the turned patch.
  [[nodiscard]] unsigned zone_of(unsigned turned_zone) const;
};

} // namespace simdbezier::detail
