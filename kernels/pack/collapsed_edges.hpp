// Edges of rational patches whose control points are all one: a pole of a sphere, the tip of a
// cone.
//
// Such an edge stays where it is whatever its weights, but evaluated as h / w its derivative is the
// difference of two equal products, each rounded: noise instead of zero, and with it curvatures.
// It is therefore packed as what it is, the point with a weight of 1. All that kernels make of an
// edge depends on its own values only, so they need not know.
#pragma once

#include "kernels/kernel_table.hpp"
#include "kernels/pack/formulas.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::kEdges;

/// Sums up how far the points of each edge are apart, and packs those anew that are points.
/// The points are compared as they are, not as rounded to T: far from the origin an edge can be
/// shorter than they tell and yet have a derivative. In homogeneous form, quotients are compared.
class CollapsedEdges {
public:
  explicit CollapsedEdges(const detail::NetShape& shape)
      : order_u_(shape.order_u()), order_v_(shape.order_v()),
        wanted_(shape.rational && shape.degree_v > 0) {
    for (Wide& length : length_) {
      length = Wide(0.0);
    }
  }

  /// One component of the control points, Cartesian, [j][i].
  void add(const Wide* points) {
    if (wanted_) {
      const std::size_t last_row = (order_v_ - 1) * order_u_;
      add_edge(detail::kEdgeV0, points, 1, order_u_);
      add_edge(detail::kEdgeV1, points + last_row, 1, order_u_);
      add_edge(detail::kEdgeU0, points, order_u_, order_v_);
      add_edge(detail::kEdgeU1, points + (order_u_ - 1), order_u_, order_v_);
    }
  }

  /// To be called when all else of the patches [first, first + count) has been written.
  template <typename Task>
  void pack(const Task& task, std::size_t first, std::size_t count) const {
    if (!wanted_) {
      return;
    }
    for (std::size_t e = 0; e < kEdges; ++e) {
      if (all_of<Wide>(length_[e] > Wide(0.0))) {
        continue;
      }
      alignas(64) double lengths[kWideLanes];
      store_vector<Wide>(lengths, length_[e]);
      for (std::size_t p = 0; p < count; ++p) {
        if (lengths[p] == 0) {
          pack_edge(task, first + p, e);
        }
      }
    }
  }

private:
  SIMDBEZIER_INLINE void add_edge(std::size_t edge, const Wide* points, std::size_t step,
                                  std::size_t order) {
    for (std::size_t k = 1; k < order; ++k) {
      length_[edge] = length_[edge] + magnitude(points[k * step] - points[0]);
    }
  }

  /// Which side of a cell an edge is: of which direction, and at its end.
  struct Side {
    bool along_u;
    std::size_t end;

    explicit Side(std::size_t edge)
        : along_u(edge == detail::kEdgeV0 || edge == detail::kEdgeV1),
          end(edge == detail::kEdgeV1 || edge == detail::kEdgeU1 ? 1 : 0) {}
    /// The edge's first (which = 0) or last corner.
    [[nodiscard]] std::size_t corner(std::size_t which) const {
      return along_u ? detail::corner_index(which, end) : detail::corner_index(end, which);
    }
  };

  /// In every cell that has a part of it.
  template <typename Task>
  __attribute__((noinline, cold)) static void pack_edge(const Task& task, std::size_t patch,
                                                        std::size_t edge) {
    const detail::NetShape& shape = task.shape;
    const Side side(edge);
    const std::size_t cells_u = shape.cells_u();
    const std::size_t across = side.along_u ? shape.cells_v() : cells_u;
    for (std::size_t cell = 0; cell < shape.cells(); ++cell) {
      const std::size_t place = side.along_u ? cell / cells_u : cell % cells_u;
      if (place == side.end * (across - 1)) {
        pack_cell_edge(task, patch, cell, edge);
      }
    }
  }

  template <typename Task>
  static void pack_cell_edge(const Task& task, std::size_t patch, std::size_t cell,
                             std::size_t edge) {
    using T = std::remove_pointer_t<decltype(task.edges)>;
    const detail::NetShape& shape = task.shape;
    const Side side(edge);
    // The point: where the edge begins, in the first cell that has a part of it.
    T* const first = task.edges + patch * shape.edges() +
                     (side.along_u ? cell - cell % shape.cells_u() : cell % shape.cells_u()) *
                         shape.cell_edges() +
                     shape.corners_at();
    T* const edges = task.edges + patch * shape.edges() + cell * shape.cell_edges();
    const auto components = static_cast<std::size_t>(shape.components);
    for (std::size_t c = 0; c < shape.channels(); ++c) {
      T* const powers = edges + c * shape.edge_powers() * kEdges + edge;
      for (std::size_t k = 0; k < shape.edge_powers(); ++k) {
        powers[k * kEdges] = T(0);
      }
      if (c == components) {
        powers[0] = T(1);
        continue;
      }
      const T point = first[c * 4 + side.corner(0)];
      if (task.origins == nullptr) {
        powers[0] = point;
      } else {
        T* const origins = task.origins + patch * shape.origins() + cell * shape.cell_origins();
        origins[c * detail::kOriginsPerComponent + detail::kEdgeOriginsAt + edge] = point;
      }
      T* const corners = edges + shape.corners_at() + c * 4;
      corners[side.corner(0)] = corners[side.corner(1)] = point;
    }
  }

  std::size_t order_u_;
  std::size_t order_v_;
  bool wanted_;
  Wide length_[kEdges];
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
