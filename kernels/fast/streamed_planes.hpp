// Rows that go straight to memory in order (StreamedOrder of grid/strategies.hpp), plane by plane:
// registers are turned to where lines are (simd/value_stream.hpp).
//
// In staging such rows lie across lines, and a store across two lines waits until all streaming
// stores before it have left, so that staging and arithmetic take their time one after the other.
// Rows come in order, one by one: their mirror images would have to be written backwards.
#pragma once

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/value_stream.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_AVX512)
/// One component of one patch: its columns, register by register, and its rows on edges. Lanes
/// behind the last column repeat it.
template <typename T, std::size_t kPlanes>
struct StreamedComponent {
  using V = vec<T>;
  static constexpr std::size_t kMost = detail::kMostStreamedRegisters;
  V q[kMost][kOrder];
  V dq[kMost][kOrder]; ///< of u derivatives
  Jet<V> lead[kMost];
  Jet<V> trail[kMost];

  SIMDBEZIER_PART void build(const GridTask<T>& task, const RowPiece<T>& piece,
                             const Component<T>& c) {
    for (std::size_t k = 0; k * kLanes<V> < task.nu; ++k) {
      const ColumnTile<1, true, false, V> tile(task.x, k * kLanes<V>, kLanes<V>, task.watertight);
      if constexpr (kPlanes == 1) {
        column_polynomial(c, tile.column, q[k]);
      } else {
        column_polynomial(c, tile.column, q[k], dq[k]);
      }
      if (piece.lead) {
        lead[k] = edge(c, tile, q[k], edge_of(piece.lead_kind));
      }
      if (piece.trail) {
        trail[k] = edge(c, tile, q[k], edge_of(piece.trail_kind));
      }
    }
  }

private:
  template <typename Tile>
  static SIMDBEZIER_PART Jet<V> edge(const Component<T>& c, const Tile& tile, const V (&q)[kOrder],
                                     std::size_t edge) {
    if constexpr (kPlanes == 1) {
      return {tile.edge_rows(c, edge), {}, {}};
    } else {
      return edge_jet(c, tile, q, edge);
    }
  }
};

/// Streams all patches of a task, whose rows have a register and more, and at most
/// kMostStreamedRegisters. Where a piece is whole patches, each plane's stream goes on from one
/// patch to the next one.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_KERNEL void stream_planes(const GridTask<T>& shared_task, const RowPiece<T>& piece) {
  using V = vec<T>;
  constexpr std::size_t kPlanes = kOutputs == detail::kPosition ? 1 : 3;
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const std::size_t nu = task.nu;
  const bool goes_on = piece.rows() * nu == task.patch_step;
  LineStream<V, true> streams[3 * kPlanes];
  StreamedComponent<T, kPlanes> component;
  PagesAhead<T> pages(shared_task, piece);
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    pages.come_to(patch);
    if (task.prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * nu;
    Component<T> given(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, given = given.next()) {
      component.build(task, piece, given);
      // row(k, y): the k-th register of the row at y.
      const auto put_plane = [&](Output output, LineStream<V, true>& kept, V Jet<V>::*member,
                                 const auto& row) SIMDBEZIER_INLINE_LAMBDA {
        LineStream<V, true> stream = kept;
        if (!goes_on || patch == 0) {
          stream.begin(task.out[output_index(output)].component[c] + at);
        }
        if (piece.lead) {
          stream.put_row(nu, [&](std::size_t k)
                                 SIMDBEZIER_INLINE_LAMBDA { return component.lead[k].*member; });
        }
        for (std::size_t j = 0; j < piece.middle.rows; ++j) {
          const auto y = piece.template point<1, V>(piece.middle.y + j);
          stream.put_row(nu, [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return row(k, y); });
        }
        if (piece.trail) {
          stream.put_row(nu, [&](std::size_t k)
                                 SIMDBEZIER_INLINE_LAMBDA { return component.trail[k].*member; });
        }
        if (!goes_on || patch + 1 == task.patch_count) {
          stream.finish();
        }
        kept = stream;
      };
      LineStream<V, true>* const stream = streams + kPlanes * c;
      put_plane(Output::position, stream[0], &Jet<V>::p,
                [&](std::size_t k, const RowPoint<V>& y)
                    SIMDBEZIER_INLINE_LAMBDA { return row_value(component.q[k], y); });
      if constexpr (kPlanes == 3) {
        put_plane(Output::du, stream[1], &Jet<V>::du,
                  [&](std::size_t k, const RowPoint<V>& y)
                      SIMDBEZIER_INLINE_LAMBDA { return row_value(component.dq[k], y); });
        put_plane(Output::dv, stream[2], &Jet<V>::dv,
                  [&](std::size_t k, const RowPoint<V>& y)
                      SIMDBEZIER_INLINE_LAMBDA { return row_slope(component.q[k], y); });
      }
    }
  }
}
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
