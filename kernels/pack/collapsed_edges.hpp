// Edges of rational patches whose control points are all one (src/storage/one_point.hpp) are packed
// around their point, as sets with local origins are: docs/accuracy.md, "Edges that are points".
//
// An edge u = const keeps its weights, by which kernels divide derivatives across it as well.
// An edge v = const without an origin is the point with a weight of 1: from such edges, kernels
// take only the point and derivatives along it, so they need not know that it is a point.
#pragma once

#include <algorithm>
#include <limits>

#include "kernels/pack/double_double.hpp"
#include "src/storage/bicubic_layout.hpp"
#include "src/storage/one_point.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::kEdges;

/// Finds the edges of a group of patches that are points, and packs them anew.
template <typename T, typename S>
class CollapsedEdges {
  using Task = detail::PackTask<T, S>;

public:
  explicit CollapsedEdges(const Task& task) : task_(task), wanted_(task.shape.rational) {}

  /// Finds the edges of patches [first, first + count), whose control points have been stored.
  void find(std::size_t first, std::size_t count) {
    first_ = first;
    count_ = count;
    for (std::size_t e = 0; e < kEdges; ++e) {
      any_[e] = false;
      for (std::size_t p = 0; p < kWideLanes; ++p) {
        const bool point = wanted_ && p < count && is_point(first + p, e);
        points_[e][p] = point ? 1 : 0;
        any_[e] = any_[e] || point;
      }
    }
  }

  [[nodiscard]] bool any(std::size_t edge) const { return any_[edge]; }
  /// Returns the patches whose edge is a point.
  [[nodiscard]] MaskOf<Wide> which(std::size_t edge) const {
    return load_vector<Wide>(points_[edge]) > Wide(0.0);
  }

  /// Packs these edges, when all else of the patches has been written.
  void pack() const {
    for (std::size_t e = 0; e < kEdges; ++e) {
      for (std::size_t p = 0; any_[e] && p < count_; ++p) {
        if (points_[e][p] != 0) {
          pack_edge(first_ + p, e);
        }
      }
    }
  }

private:
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

  /// The control points of an edge, as given.
  struct EdgePoints {
    const S* first;
    std::size_t step; ///< in values
    std::size_t count;
    std::size_t channels;

    EdgePoints(const Task& task, std::size_t patch, std::size_t edge)
        : channels(task.shape.channels()) {
      const detail::NetShape& shape = task.shape;
      const Side side(edge);
      const std::size_t point = side.along_u ? side.end * (shape.order_v() - 1) * shape.order_u()
                                             : side.end * (shape.order_u() - 1);
      first = task.control_points + patch * shape.control_values() + point * channels;
      step = (side.along_u ? 1 : shape.order_u()) * channels;
      count = side.along_u ? shape.order_u() : shape.order_v();
    }
    [[nodiscard]] auto weight(std::size_t k) const { return first[k * step + channels - 1]; }
  };

  [[nodiscard]] bool is_point(std::size_t patch, std::size_t edge) const {
    const EdgePoints points(task_, patch, edge);
    return detail::are_one_point(points.first, static_cast<std::ptrdiff_t>(points.step),
                                 points.count, task_.shape.channels() - 1, 1, task_.nets.weights);
  }

  /// The cells that an edge passes, from its first to its last one.
  struct EdgeCells {
    std::size_t first;
    std::size_t step;
    std::size_t count;

    EdgeCells(const detail::NetShape& shape, const Side& side)
        : first(side.along_u ? side.end * (shape.cells_v() - 1) * shape.cells_u()
                             : side.end * (shape.cells_u() - 1)),
          step(side.along_u ? 1 : shape.cells_u()),
          count(side.along_u ? shape.cells_u() : shape.cells_v()) {}
    [[nodiscard]] std::size_t at(std::size_t k) const { return first + k * step; }
  };

  /// Packs the edge in every cell that has a part of it.
  SIMDBEZIER_RARE void pack_edge(std::size_t patch, std::size_t edge) const {
    const EdgeCells cells(task_.shape, Side(edge));
    const std::size_t end = nearer_end(patch, edge);
    for (std::size_t k = 0; k < cells.count; ++k) {
      pack_cell_edge(patch, cells, k, edge, end);
    }
  }

  /// The corners of a component where an edge ends.
  [[nodiscard]] T* outer_corner(std::size_t patch, std::size_t edge, std::size_t end,
                                std::size_t component) const {
    const detail::NetShape& shape = task_.shape;
    const Side side(edge);
    const EdgeCells cells(shape, side);
    return task_.edges + patch * shape.edges() +
           cells.at(end * (cells.count - 1)) * shape.cell_edges() + shape.corners_at() +
           component * 4 + side.corner(end);
  }

  /// Returns the end of an edge that is nearer to the origin in the first component where the ends
  /// differ: whichever way the edge runs, and whatever is mirrored, that is the same point.
  [[nodiscard]] std::size_t nearer_end(std::size_t patch, std::size_t edge) const {
    for (std::size_t c = 0; c < static_cast<std::size_t>(task_.shape.components); ++c) {
      const double begin = __builtin_fabs(*outer_corner(patch, edge, 0, c));
      const double end = __builtin_fabs(*outer_corner(patch, edge, 1, c));
      if (begin != end) {
        return begin < end ? 0 : 1;
      }
    }
    return 0;
  }

  /// Packs the edge in its cell number k, as the point at one of its ends.
  void pack_cell_edge(std::size_t patch, const EdgeCells& cells, std::size_t k, std::size_t edge,
                      std::size_t end) const {
    const detail::NetShape& shape = task_.shape;
    const Side side(edge);
    const std::size_t cell = cells.at(k);
    T* const edges = task_.edges + patch * shape.edges() + cell * shape.cell_edges();
    const bool around = task_.origins != nullptr || !side.along_u;
    const auto components = static_cast<std::size_t>(shape.components);
    for (std::size_t c = 0; c < components; ++c) {
      const T point = *outer_corner(patch, edge, end, c);
      put_constant(edges, c, edge, around ? T(0) : point);
      T* const corners = edges + shape.corners_at() + c * 4;
      if (k > 0) {
        corners[side.corner(0)] = point;
      }
      if (k + 1 < cells.count) {
        corners[side.corner(1)] = point;
      }
      if (task_.origins != nullptr) {
        T* const origins = task_.origins + patch * shape.origins() + cell * shape.cell_origins();
        origins[c * detail::kOriginsPerComponent + detail::kEdgeOriginsAt + edge] = point;
      }
    }
    if (side.along_u) {
      put_constant(edges, components, edge, T(1));
      return;
    }
    keep_positive(edges + components * shape.edge_powers() * kEdges + edge,
                  least_weight(patch, edge));
    if (task_.origins == nullptr) {
      edges[shape.corners_at() + components * 4 + side.end] = static_cast<T>(1 + end);
    }
  }

  /// Returns the least weight of an edge's control points.
  [[nodiscard]] double least_weight(std::size_t patch, std::size_t edge) const {
    const EdgePoints points(task_, patch, edge);
    double least = static_cast<double>(points.weight(0));
    for (std::size_t k = 1; k < points.count; ++k) {
      const auto weight = static_cast<double>(points.weight(k));
      least = weight < least ? weight : least;
    }
    return least;
  }

  /// Lifts a weight along u = const that is no larger than what its terms are rounded by, 2 E where
  /// a multiply-add rounds twice: to at least 2 E, so that it is computed as a positive number.
  /// E has no more roundings of any term than certificates count (docs/accuracy.md), which for such
  /// patches are infinite.
  void keep_positive(T* weight, double least) const {
    const std::size_t powers = task_.shape.edge_powers();
    const std::size_t degree = task_.shape.order_v() - 1;
    const bool halved = task_.shape.cells_v() == 2;
    double size = 0;
    double rounded = 0;
    for (std::size_t k = 0; k < powers; ++k) {
      const double term = __builtin_ldexp(__builtin_fabs(static_cast<double>(weight[k * kEdges])),
                                          -static_cast<int>(k));
      size += term;
      rounded += static_cast<double>(std::min(k + 3, degree + 2) + (halved ? k : 0)) * term;
    }
    const double error = rounded * (std::numeric_limits<T>::epsilon() / 2);
    const double constant = static_cast<double>(weight[0]);
    if (least <= 2 * error && 2 * constant - size <= 2 * error) {
      weight[0] = static_cast<T>(constant + 4 * error);
    }
  }

  void put_constant(T* edges, std::size_t channel, std::size_t edge, T value) const {
    T* const powers = edges + channel * task_.shape.edge_powers() * kEdges + edge;
    for (std::size_t k = 0; k < task_.shape.edge_powers(); ++k) {
      powers[k * kEdges] = k == 0 ? value : T(0);
    }
  }

  const Task& task_;
  bool wanted_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  bool any_[kEdges] = {};
  alignas(64) double points_[kEdges][kWideLanes] = {}; ///< 1 or 0
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
