// The rows of a grid task, run by run: which edge a run is on, and which runs are mirror images.
#pragma once

#include "kernels/simd/vector.hpp"
#include "src/storage/bicubic_layout.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridTask;
using detail::RowKind;
using detail::RowRun;

SIMDBEZIER_PART bool is_edge(RowKind kind) {
  return kind == RowKind::edge_v0 || kind == RowKind::edge_v1;
}

SIMDBEZIER_PART std::size_t edge_of(RowKind kind) {
  return kind == RowKind::edge_v0 ? detail::kEdgeV0 : detail::kEdgeV1;
}

/// Whether the rows are pairs Y and -Y, from both ends on. Two rows at 0 are none: the sign of a
/// zero would depend on which of them is the mirror image.
template <typename T>
SIMDBEZIER_PART bool are_mirrored(const T* y, std::size_t rows) {
  bool mirrored = true;
  for (std::size_t k = 0; k < rows / 2 && mirrored; ++k) {
    mirrored = y[k] == -y[rows - 1 - k] && y[k] != T(0);
  }
  return mirrored;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
