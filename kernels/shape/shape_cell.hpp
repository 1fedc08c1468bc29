// Cells of a patch, and a register of columns of them; see net_shape.hpp.
#pragma once

#include "kernels/poly/sample_jets.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::NetShape;

/// Columns of a patch: where in which cell they are.
template <typename V>
struct CellColumns {
  Column<V> local; ///< places in the cell, and which of them are on its edges
  MaskOf<V> low;   ///< in the cell of lower u
  bool any_low;
  bool any_high;

  SIMDBEZIER_PART CellColumns(V half_centred, std::size_t cells, bool watertight)
      : local(cells == 1 ? half_centred : cell_parameter(half_centred), watertight),
        low(half_centred < broadcast<V>(ScalarOf<V>(0))), any_low(cells == 1 || any_of<V>(low)),
        any_high(cells == 2 && !all_of<V>(low)) {}
};

/// Returns the edge v = const of its cell that a local parameter is on, or kEdges where it is on
/// none.
template <typename T>
SIMDBEZIER_PART std::size_t edge_of_cell(T local) {
  return local == T(-0.5) ? detail::kEdgeV0 : local == T(0.5) ? detail::kEdgeV1 : kEdges;
}

/// What the positions of columns are relative to, in sets with origins and where points are.
template <typename V>
struct ColumnOrigins {
  V position[3];
  /// A lane on an edge u = const has its values relative to the edge's origin, and its derivatives
  /// by u to the patch's: what to add to the one for the other. Rational patches only, where the
  /// quotient rule needs both.
  V to_patch[3];
};

/// The packed values of a cell.
template <typename T>
struct Cell {
  const T* coefficients;
  const T* edges;
  const T* origins; ///< null where the set has none
};

/// Returns a cell of a patch. Task is any that holds the arrays of a set.
template <typename T, typename Task>
SIMDBEZIER_PART Cell<T> cell_of(const Task& task, const NetShape& shape, std::size_t patch,
                                std::size_t index) {
  const std::size_t at = patch * shape.cells() + index;
  return {task.coefficients + at * shape.cell_coefficients(), task.edges + at * shape.cell_edges(),
          task.origins == nullptr ? nullptr : task.origins + at * shape.cell_origins()};
}

/// Two cells side by side in u (or the same one twice).
template <typename T>
struct CellRow {
  Cell<T> low;
  Cell<T> high;

  SIMDBEZIER_PART CellRow(Cell<T> of_low, Cell<T> of_high) : low(of_low), high(of_high) {}
  template <typename Task>
  SIMDBEZIER_PART CellRow(const Task& task, const NetShape& shape, std::size_t patch,
                          std::size_t row)
      : low(cell_of<T>(task, shape, patch, row * shape.cells_u())),
        high(cell_of<T>(task, shape, patch, row * shape.cells_u() + shape.cells_u() - 1)) {}
};

/// Which values of a cell belong to which output: up to three components, then the weight.
/// kComponents: as many as the compiler knows there are, or 0.
template <bool kRational, std::size_t kComponents>
struct Channels {
  static constexpr std::size_t kMost = kComponents == 0 ? 3 : kComponents;
  static constexpr std::size_t kWeight = kMost;
  static constexpr std::size_t kSlots = kMost + (kRational ? 1 : 0);

  SIMDBEZIER_PART Channels(const NetShape& shape, std::size_t first_component)
      : first_(first_component),
        count_(static_cast<std::size_t>(shape.components) - first_component),
        weight_(static_cast<std::size_t>(shape.components)) {}
  /// Returns the packed channel of a slot.
  SIMDBEZIER_PART std::size_t channel(std::size_t slot) const {
    return slot == kWeight ? weight_ : first_ + slot;
  }

  /// Whether a slot belongs to a component of the patch, or to its weight.
  SIMDBEZIER_PART bool exists(std::size_t slot) const {
    return kComponents != 0 || slot < count_ || slot == kWeight;
  }
  /// Whether there are three components from the first one on, at least.
  SIMDBEZIER_PART bool are_three() const { return kMost == 3 && (kComponents != 0 || count_ > 2); }
  /// Calls f(slot) for the components. Calls are unrolled only where their number is known, because
  /// that keeps polynomials in registers: it is much code.
  template <typename F>
  SIMDBEZIER_INLINE void for_components(const F& f) const {
    for_slots<kMost>(f);
  }
  /// Calls f(slot) for the components, and f(kWeight) in the end.
  template <typename F>
  SIMDBEZIER_INLINE void for_channels(const F& f) const {
    for_slots<kSlots>(f);
  }

private:
  template <std::size_t kCount, typename F>
  SIMDBEZIER_INLINE void for_slots(const F& f) const {
    if constexpr (kComponents != 0) {
      repeat<kCount>(f);
    } else {
      for (std::size_t slot = 0; slot < kCount; ++slot) {
        if (exists(slot)) {
          f(slot);
        }
      }
    }
  }

  std::size_t first_;
  std::size_t count_;
  std::size_t weight_;
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
