// The results of a batch beside those of the related batch: what should be equal, up to which
// bound.
#pragma once

#include <vector>

#include "tests/properties/metamorphic/meta_bounds.hpp"
#include "tests/properties/metamorphic/table.hpp"

namespace simdbezier::tests {

/// One net of a batch and its place in the table.
struct MetaEntry {
  std::size_t shape = 0; ///< row of kShapeRows
  Kind kind = Kind::regular;
  std::size_t side = 0;
  MetaNet net;
};

/// Compares every sample of every net, fills the cells of each net's own side.
void compare(const Comparison& what, const std::vector<MetaEntry>& entries, const MetaBatch& batch,
             const Sheet& sheet, const MetaBatch& other, const Sheet& related_sheet, Table& table);

} // namespace simdbezier::tests
