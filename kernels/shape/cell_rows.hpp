// The rows of a grid by the cells that they are in, for patches of any shape.
#pragma once

#include "kernels/poly/row_runs.hpp"
#include "kernels/shape/shape_cell.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename T>
struct ShapeRow {
  T y;
  T local;          ///< y in its cell
  std::size_t at;   ///< its first sample in the patch
  std::size_t edge; ///< v = const of its cell that it is on, or kEdges
  bool outside;
};

/// At most so many rows are evaluated together.
inline constexpr std::size_t kRowGroup = 8;

/// Rows of one row of cells.
template <typename T>
struct CellRows {
  static constexpr std::size_t kMost = 256;

  std::size_t count = 0;
  std::size_t together = 0; ///< equal parts of them, of 4 to kRowGroup rows
  std::size_t edges = 0;    ///< rows on edges, from the end of `row` back
  /// The last row stands kRowGroup - 1 times more behind itself, so that groups are whole.
  ShapeRow<T> row[kMost + kRowGroup];

  [[nodiscard]] SIMDBEZIER_PART const ShapeRow<T>& edge_row(std::size_t k) const {
    return row[kMost + kRowGroup - 1 - k];
  }
};

/// The rows of a task, as many at a time as there is room for. edges_apart: rows on edges v = const
/// need nothing of their columns.
template <typename T>
class RowsByCell {
public:
  SIMDBEZIER_PART RowsByCell(const GridTask<T>& task, std::size_t cells, bool edges_apart)
      : cells_(cells), edges_apart_(edges_apart) {
    for (std::size_t r = 0; r < task.run_count; ++r) {
      rows_ += task.runs[r].rows;
    }
  }

  [[nodiscard]] SIMDBEZIER_PART std::size_t rows() const { return rows_; }
  [[nodiscard]] SIMDBEZIER_PART const CellRows<T>& of_cell(std::size_t cell) const {
    return of_cell_[cell];
  }

  /// Takes the rows [first, first + kMost), as far as they exist.
  SIMDBEZIER_KERNEL void take(const GridTask<T>& task, std::size_t first) {
    of_cell_[0].count = of_cell_[0].edges = of_cell_[1].count = of_cell_[1].edges = 0;
    const std::size_t end = first + CellRows<T>::kMost;
    std::size_t row = 0; // the run's first
    for (std::size_t r = 0; r < task.run_count; ++r) {
      const RowRun<T> run = task.runs[r];
      for (std::size_t j = first > row ? first - row : 0; j < run.rows && row + j < end; ++j) {
        add(task, run.y[j], (row + j) * task.nu, run.kind == RowKind::outside);
      }
      row += run.rows;
    }
    for (CellRows<T>& cell : of_cell_) {
      for (std::size_t k = 0; k < kRowGroup - 1 && cell.count > 0; ++k) {
        cell.row[cell.count + k] = cell.row[cell.count - 1];
      }
      cell.together = cell.count < 4 ? 4 : even_share(cell.count, kRowGroup);
    }
  }

private:
  SIMDBEZIER_PART void add(const GridTask<T>& task, T y, std::size_t at, bool outside) {
    const bool high = cells_ == 2 && !(y < T(0));
    const T local = cells_ == 1 ? y : cell_parameter(y);
    const std::size_t edge = task.watertight ? edge_of_cell(local) : kEdges;
    CellRows<T>& cell = of_cell_[high ? 1 : 0];
    const bool apart = edges_apart_ && edge < kEdges;
    cell.row[apart ? CellRows<T>::kMost + kRowGroup - 1 - cell.edges++ : cell.count++] = {
        y, local, at, edge, outside};
  }

  std::size_t cells_;
  bool edges_apart_;
  std::size_t rows_ = 0;
  CellRows<T> of_cell_[2];
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
