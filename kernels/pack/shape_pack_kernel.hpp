// Packing of patches of any shape: a group of patches at a time, one patch a lane.
//
// A group is read channel by channel, and again for each of its cells: what lies in between then is
// one channel's net, in the first-level cache, rather than all of them.
#pragma once

#include "kernels/pack/collapsed_edges.hpp"
#include "kernels/pack/shape_floor.hpp"
#include "kernels/pack/shape_pack_formulas.hpp"
#include "kernels/pack/shape_pack_io.hpp"
#include "kernels/pack/zero_signs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::kMostChannels;

/// One group of nets while it is packed.
template <typename T, typename S>
class ShapeGroup {
public:
  using W = CarriedIn<T, S>;

  explicit ShapeGroup(const detail::PackTask<T, S>& task)
      : task_(task), shape_(task.shape), order_u_(shape_.order_u()), order_v_(shape_.order_v()),
        components_(static_cast<std::size_t>(shape_.components)),
        reader_(task.nets, task.relative_to), collapsed_(task) {}

  /// Packs `count` nets from the first on, 1 <= count <= kWideLanes. Returns false where something
  /// may not be finite, or a weight not be positive.
  bool pack(std::size_t first, std::size_t count) {
    first_ = first;
    count_ = count;
    reader_.begin(first, count);
    reader_.copy(count, task_.control_points + first * shape_.control_values());
    if (shape_.rational) {
      reader_.read(components_, weights_);
    }
    collapsed_.find(first, count);
    PointSizes sizes(shape_, task_.origins != nullptr, weights_);
    sizes.control.add_weights(weights_, shape_.rational ? shape_.points() : 0);
    for (std::size_t cell = 0; cell < shape_.cells(); ++cell) {
      pack_cell(cell, sizes);
    }
    collapsed_.pack();
    store_floors(sizes.floor);
    return sizes.control.are_safe();
  }

private:
  // Points ---------------------------------------------------------------------------------------

  /// Reads one component of all points to values_, and the Cartesian ones to points_.
  void read_component(std::size_t c) {
    reader_.read(c, points_);
    reader_.move(c, shape_.rational ? weights_ : nullptr, points_, values_);
  }

  /// What is asked of all control points: the normal floor, and their sizes.
  struct PointSizes {
    ShapeFloor<T, W> floor;
    ControlSizes<T> control;

    PointSizes(const detail::NetShape& shape, bool origins, const Wide* weights)
        : floor(shape, origins, weights) {}
    /// Adds one component: control values, and Cartesian points.
    void add(const W* values, const Wide* points, std::size_t count) {
      control.add(values, points, count);
      floor.add(points);
    }
  };

  void store_floors(ShapeFloor<T, W>& floor) const {
    Wide floors[2];
    floor.finish(floors);
    for (std::size_t f = 0; f < shape_.floors(); ++f) {
      store_value(floors[f], task_.normal_floor + first_ * shape_.floors() + f, shape_.floors(),
                  count_);
    }
  }

  // Cells ----------------------------------------------------------------------------------------

  /// Cuts the values of one channel down to those of a cell.
  void take_cell(W* values, std::size_t cell) const {
    if (shape_.cells_u() == 2) {
      for (std::size_t j = 0; j < order_v_; ++j) {
        halve(values + j * order_u_, 1, order_u_ - 1, cell % 2);
      }
    }
    if (shape_.cells_v() == 2) {
      for (std::size_t i = 0; i < order_u_; ++i) {
        halve(values + i, order_u_, order_v_ - 1, cell / shape_.cells_u());
      }
    }
  }

  /// sizes: looks at what is read and formed.
  void pack_cell(std::size_t cell, PointSizes& sizes) {
    const std::size_t patch_stride = shape_.coefficients();
    matrices_.begin(task_.coefficients + first_ * patch_stride + cell * shape_.cell_coefficients(),
                    patch_stride, count_);
    T* const edge_blocks = task_.edges + first_ * shape_.edges() + cell * shape_.cell_edges();
    edge_blocks_.begin(edge_blocks, shape_.edges(), count_);
    Wide corners[kMostChannels * 4];
    tiny_ = {};
    if (shape_.rational) {
      for (std::size_t k = 0; k < shape_.points(); ++k) {
        cell_weights_[k] = carried<W>(weights_[k]);
      }
      take_cell(cell_weights_, cell);
      for (std::size_t corner = 0; corner < 4; ++corner) {
        corners[components_ * 4 + corner] = to_wide(cell_weights_[corner_point(corner)]);
      }
      side_weights_[0] = cell_weights_[0];
      side_weights_[1] = cell_weights_[order_u_ - 1];
      form_channel(shape_, cell_weights_, edge_weights_);
      sizes.floor.add_terms(cell_weights_, true);
    }
    for (std::size_t c = 0; c < components_; ++c) {
      read_cell_component(cell, c, corners, sizes);
      side_values_[0] = values_[0];
      side_values_[1] = values_[order_u_ - 1];
      form_channel(shape_, values_, edges_);
      sizes.floor.add_terms(values_);
      if (task_.origins != nullptr) {
        split_origins(cell, c);
      }
      write_channel(values_, edges_);
    }
    if (shape_.rational) {
      write_channel(cell_weights_, edge_weights_);
      if (task_.origins != nullptr) {
        Origins none;
        store_origins(cell, components_, none);
      }
    }
    Wide* const ends = edge_blocks_.next();
    for (std::size_t k = 0; k < shape_.channels() * 4; ++k) {
      ends[k] = k < components_ * 4 ? corners[k] : Wide(0.0);
    }
    edge_blocks_.add(shape_.channels() * 4);
    matrices_.finish();
    edge_blocks_.finish();
    if (tiny_.any()) {
      keep_edges_from_zero(shape_, edge_blocks, count_);
    }
  }

  /// Corner (u,v) stands at v * 2 + u; a curve's row is its first and its last one.
  [[nodiscard]] std::size_t corner_point(std::size_t corner) const {
    return corner / 2 * (order_v_ - 1) * order_u_ + corner % 2 * (order_u_ - 1);
  }

  /// Whether a corner of a cell is one of the patch.
  [[nodiscard]] bool is_outer(std::size_t cell, std::size_t corner) const {
    const std::size_t cell_u = cell % shape_.cells_u();
    const std::size_t cell_v = cell / shape_.cells_u();
    return (shape_.cells_u() == 1 || corner % 2 == cell_u) &&
           (shape_.cells_v() == 1 || corner / 2 == cell_v);
  }

  /// Reads one component's control values of a cell, and its corners, which are points.
  void read_cell_component(std::size_t cell, std::size_t c, Wide* corners, PointSizes& sizes) {
    read_component(c);
    if (cell == 0) {
      sizes.add(values_, points_, shape_.points());
    }
    take_cell(values_, cell);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const std::size_t at = corner_point(corner);
      Wide point = points_[at];
      if (!is_outer(cell, corner)) {
        point = to_wide(values_[at]);
        if (shape_.rational) {
          point = divide(point, corners[components_ * 4 + corner]);
        }
      }
      corners[c * 4 + corner] = point;
    }
  }

  // Origins --------------------------------------------------------------------------------------

  struct Origins {
    Wide at[detail::kOriginsPerComponent];

    SIMDBEZIER_INLINE Origins() {
      for (Wide& origin : at) {
        origin = Wide(0.0);
      }
    }
  };

  void split_origins(std::size_t cell, std::size_t c) {
    Origins origins;
    const W* const weights = shape_.rational ? cell_weights_ : nullptr;
    origins.at[0] = split_origin<T>(values_, weights, shape_.points(), 1);
    const std::size_t powers = shape_.edge_powers();
    for (std::size_t e = 0; powers > 0 && e < detail::kEdges; ++e) {
      const W* const edge = shape_.rational ? edge_weights_ + e : nullptr;
      origins.at[detail::kEdgeOriginsAt + e] =
          split_origin<T>(edges_ + e, edge, powers, detail::kEdges);
    }
    for (std::size_t side = 0; side < 2 && weights != nullptr; ++side) {
      origins.at[detail::kRelativeOriginsAt + side] = relative_origin(origins, cell, side);
    }
    store_origins(cell, c, origins);
  }

  /// Returns the origin of the edge u = side relative to the cell's own. A point need not be what
  /// its origin is, which is rounded to T: it is rounded when it is near.
  [[nodiscard]] Wide relative_origin(const Origins& origins, std::size_t cell,
                                     std::size_t side) const {
    const std::size_t edge = detail::kEdgeU0 + side;
    const Wide relative = origins.at[detail::kEdgeOriginsAt + edge] - origins.at[0];
    if (!collapsed_.any(edge) || side * (shape_.cells_u() - 1) != cell % shape_.cells_u()) {
      return relative;
    }
    const W& weight = side_weights_[side];
    const W near = difference_of<W>(side_values_[side], product(weight, origins.at[0]));
    return select_where<Wide>(collapsed_.which(edge), divide(to_wide(near), to_wide(weight)),
                              relative);
  }

  void store_origins(std::size_t cell, std::size_t channel, const Origins& origins) const {
    T* const to = task_.origins + first_ * shape_.origins() + cell * shape_.cell_origins() +
                  channel * detail::kOriginsPerComponent;
    store_lanes(origins.at, to, static_cast<std::ptrdiff_t>(shape_.origins()), count_);
  }

  void write_channel(const W* values, const W* edges) {
    tiny_.look_at_edges(shape_, edges);
    Wide* matrix = matrices_.next();
    for (std::size_t k = 0; k < order_u_; ++k) {
      for (std::size_t l = 0; l < order_v_; ++l) {
        *matrix++ = to_wide(values[l * order_u_ + k]);
      }
    }
    matrices_.add(shape_.matrix());
    const std::size_t along = shape_.edge_powers() * detail::kEdges;
    Wide* const to = edge_blocks_.next();
    for (std::size_t e = 0; e < along; ++e) {
      to[e] = to_wide(edges[e]);
    }
    edge_blocks_.add(along);
  }

  const detail::PackTask<T, S>& task_;
  const detail::NetShape& shape_;
  const std::size_t order_u_;
  const std::size_t order_v_;
  const std::size_t components_;
  NetReader<T, S> reader_;
  CollapsedEdges<T, S> collapsed_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  TinyEvenCoefficients<T> tiny_; ///< of a cell
  BlockWriter<T> matrices_;
  BlockWriter<T> edge_blocks_;
  // These take about 150 KiB on the stack where registers have eight doubles.
  Wide weights_[kMostPoints];
  Wide points_[kMostPoints];    ///< of one component
  W values_[kMostPoints];       ///< of one component: control values, then coefficients
  W cell_weights_[kMostPoints]; ///< of the cell: its weights, then their coefficients
  W side_values_[2];            ///< of one component: where the edges u = 0, 1 of a cell begin
  W side_weights_[2];
  W edges_[kMostOrder * detail::kEdges];
  W edge_weights_[kMostOrder * detail::kEdges];
};

template <typename T, typename S>
detail::PackDoubt shape_pack_kernel(const detail::PackTask<T, S>& task, std::size_t begin,
                                    std::size_t end) {
  return pack_groups<ShapeGroup<T, S>>(task, begin, end);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
