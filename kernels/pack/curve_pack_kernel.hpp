// Packing of curves: a group at a time, one curve a lane, with the formulas of patches' edges.
#pragma once

#include "kernels/pack/bicubic_pack_kernel.hpp"
#include "kernels/pack/shape_pack_formulas.hpp"
#include "kernels/pack/tangent_floor.hpp"
#include "kernels/pack/zero_signs.hpp"
#include "src/storage/one_point.hpp"
#include "src/tables/curve_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Squares of control values up to which nothing can overflow: a coefficient is at most 2^22 times
/// its control values (C(15,k) 2^k), and with weights those are products of two such numbers.
template <typename T>
inline constexpr double kSafeCurveSquares = sizeof(T) == sizeof(float) ? 0x1p80 : 0x1p800;
/// Weights that need no second look.
template <typename T>
inline constexpr double kSafeCurveWeight = sizeof(T) == sizeof(float) ? 0x1p-40 : 0x1p-400;

/// One group of curves while it is packed.
template <typename T, typename S>
class CurveGroup {
  using W = CarriedIn<T, S>;

public:
  explicit CurveGroup(const detail::CurvePackTask<T, S>& task)
      : task_(task), shape_(task.shape), order_(shape_.order()), curve_values_(shape_.values()),
        components_(static_cast<std::size_t>(shape_.components)) {}

  /// Packs `count` curves from the first on, 1 <= count <= kWideLanes; lanes behind them repeat the
  /// last one. Returns false where something may not be finite, or a weight not be positive.
  bool pack(std::size_t first, std::size_t count) {
    first_ = first;
    count_ = count;
    for (std::size_t p = 0; p < kWideLanes; ++p) {
      const auto curve = static_cast<std::ptrdiff_t>(first + (p < count ? p : count - 1));
      polygon_[p] = task_.curves.points + curve * task_.curves.curve_stride;
    }
    copy_control_points();
    Wide squares(0.0);
    MaskOf<Wide> positive = squares <= squares;
    if (shape_.rational) {
      for (std::size_t i = 0; i < order_; ++i) {
        const Wide weight = value_at(i, components_);
        weights_[i] = weight;
        squares = squares + weight * weight;
        positive = positive & (weight >= Wide(kSafeCurveWeight<T>));
      }
      pack_weights();
    }
    TangentFloor<T> floor(shape_, shape_.rational ? weights_ : nullptr);
    for (std::size_t c = 0; c < components_; ++c) {
      squares = squares + pack_component(c, floor);
    }
    put(task_.tangent_floor, 1, 0, floor.value());
    if (detail::is_even_odd(shape_.degree)) {
      keep_from_zero();
    }
    if (shape_.rational) {
      pack_collapsed();
    }
    return all_of<Wide>(positive & (squares <= Wide(kSafeCurveSquares<T>)));
  }

private:
  SIMDBEZIER_INLINE Wide value_at(std::size_t point, std::size_t channel) const {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(point) * task_.curves.point_stride +
                              static_cast<std::ptrdiff_t>(channel) * task_.curves.component_stride;
    return load_each(polygon_, at);
  }

  /// Stores a value, rounded, at place `at` of every curve's `stride` values; -0 becomes +0.
  SIMDBEZIER_INLINE void put(T* array, std::size_t stride, std::size_t at, Wide value) const {
    alignas(64) double lanes[kWideLanes];
    store_vector<Wide>(lanes, value);
    T* to = array + first_ * stride + at;
    for (std::size_t p = 0; p < count_; ++p, to += stride) {
      *to = static_cast<T>(lanes[p]) + T(0);
    }
  }
  /// Copies the control points as they were given.
  void copy_control_points() const {
    S* to = task_.control_points + first_ * shape_.control_values();
    for (std::size_t p = 0; p < count_; ++p) {
      for (std::size_t i = 0; i < order_; ++i) {
        const S* const point =
            polygon_[p] + static_cast<std::ptrdiff_t>(i) * task_.curves.point_stride;
        for (std::size_t c = 0; c < shape_.channels(); ++c) {
          *to++ = point[static_cast<std::ptrdiff_t>(c) * task_.curves.component_stride] + S(0);
        }
      }
    }
  }
  SIMDBEZIER_INLINE void put_value(std::size_t cell, std::size_t channel, std::size_t k,
                                   Wide value) const {
    put(task_.values, curve_values_,
        cell * shape_.cell_values() + channel * shape_.channel_values() + k, value);
  }

  /// Returns one component's control value, homogeneous where there are weights, and finds its
  /// Cartesian one.
  SIMDBEZIER_INLINE W read_value(std::size_t point, std::size_t component, Wide& cartesian) const {
    const Wide value = value_at(point, component);
    const Wide origin(component < 3 ? task_.relative_to[component] : 0.0);
    if (!shape_.rational) {
      const W moved = difference_of<W>(value, origin);
      cartesian = to_wide(moved);
      return moved;
    }
    const Wide weight = weights_[point];
    if (task_.curves.weights == Weights::homogeneous) {
      const W moved = difference_of<W>(carried<W>(value), product(carried<W>(origin), weight));
      cartesian = divide(to_wide(moved), weight);
      return moved;
    }
    const W moved = difference_of<W>(value, origin);
    cartesian = to_wide(moved);
    return product(moved, weight);
  }

  /// Forms the weights of both cells, which the components need.
  void pack_weights() {
    for (std::size_t cell = 0; cell < shape_.cells(); ++cell) {
      W* const w = cell_weights_[cell];
      for (std::size_t i = 0; i < order_; ++i) {
        w[i] = carried<W>(weights_[i]);
      }
      take_cell(w, cell);
      end_weights_[cell][0] = to_wide(w[0]);
      end_weights_[cell][1] = to_wide(w[order_ - 1]);
      centre(w, 1, order_ - 1);
      for (std::size_t k = 0; k < order_; ++k) {
        put_value(cell, components_, k, to_wide(w[k]));
      }
      for (std::size_t end = 0; end < 2; ++end) {
        put_value(cell, components_, shape_.ends_at() + end, end_weights_[cell][end]);
      }
      if (shape_.origins) {
        put_value(cell, components_, shape_.origin_at(), Wide(0.0));
      }
    }
  }

  SIMDBEZIER_INLINE void take_cell(W* values, std::size_t cell) const {
    if (shape_.cells() == 2) {
      halve(values, 1, order_ - 1, cell);
    }
  }

  /// Packs one component. Returns the sum of squares of its control values.
  Wide pack_component(std::size_t c, TangentFloor<T>& floor) {
    W control[detail::kMostOrder];
    Wide points[detail::kMostOrder];
    Wide squares(0.0);
    for (std::size_t i = 0; i < order_; ++i) {
      control[i] = read_value(i, c, points[i]);
      const Wide value = to_wide(control[i]);
      squares = squares + value * value;
      if (shape_.rational) {
        squares = squares + points[i] * points[i];
      }
    }
    floor.add(points);
    const Wide outer[2] = {points[0], points[order_ - 1]};
    for (std::size_t cell = 0; cell < shape_.cells(); ++cell) {
      W values[detail::kMostOrder];
      for (std::size_t i = 0; i < order_; ++i) {
        values[i] = control[i];
      }
      take_cell(values, cell);
      for (std::size_t end = 0; end < 2; ++end) {
        const bool given = shape_.cells() == 1 || end == cell;
        const Wide inner = to_wide(values[end * (order_ - 1)]);
        const Wide point = given             ? outer[end]
                           : shape_.rational ? divide(inner, end_weights_[cell][end])
                                             : inner;
        put_value(cell, c, shape_.ends_at() + end, point);
      }
      centre(values, 1, order_ - 1);
      if (shape_.origins) {
        put_value(cell, c, shape_.origin_at(), split_origin(values, cell));
      }
      for (std::size_t k = 0; k < order_; ++k) {
        put_value(cell, c, k, to_wide(values[k]));
      }
    }
    return squares;
  }

  /// Keeps even parts from zero as zero_signs.hpp explains. Curves that it applies to have one
  /// cell.
  SIMDBEZIER_INLINE void keep_from_zero() const {
    for (std::size_t p = 0; p < count_; ++p) {
      for (std::size_t c = 0; c < shape_.channels(); ++c) {
        keep_even_part_from_zero(task_.values + (first_ + p) * curve_values_ +
                                     c * shape_.channel_values(),
                                 1, shape_.degree);
      }
    }
  }

  /// Rational curves whose control points are one are packed as that point with a weight of 1, like
  /// collapsed edges of patches (pack/collapsed_edges.hpp), and for the same reason.
  void pack_collapsed() const {
    for (std::size_t p = 0; p < count_; ++p) {
      const S* const given = task_.control_points + (first_ + p) * shape_.control_values();
      if (detail::are_one_point(given, static_cast<std::ptrdiff_t>(shape_.channels()), order_,
                                components_, 1, task_.curves.weights)) {
        pack_point(task_.values + (first_ + p) * curve_values_);
      }
    }
  }
  SIMDBEZIER_RARE void pack_point(T* const first) const {
    const std::size_t last = (shape_.cells() - 1) * shape_.cell_values();
    const auto end_of = [&](std::size_t c, std::size_t end) {
      return first[end * last + c * shape_.channel_values() + shape_.ends_at() + end];
    };
    std::size_t nearer = 0;
    for (std::size_t c = components_; c-- > 0;) {
      const double begin = __builtin_fabs(end_of(c, 0));
      const double end = __builtin_fabs(end_of(c, 1));
      nearer = begin == end ? nearer : begin < end ? 0 : 1;
    }
    for (std::size_t cell = 0; cell < shape_.cells(); ++cell) {
      T* values = first + cell * shape_.cell_values();
      for (std::size_t c = 0; c <= components_; ++c, values += shape_.channel_values()) {
        for (std::size_t k = 0; k < order_; ++k) {
          values[k] = T(0);
        }
        if (c == components_) {
          values[0] = T(1);
          continue;
        }
        const T point = end_of(c, nearer);
        if (cell > 0) {
          values[shape_.ends_at()] = point;
        }
        if (cell + 1 < shape_.cells()) {
          values[shape_.ends_at() + 1] = point;
        }
        values[shape_.origins ? shape_.origin_at() : 0] = point;
      }
    }
  }

  /// Takes the point in the middle of a cell, as rounded to T, out of its coefficients.
  SIMDBEZIER_INLINE Wide split_origin(W* values, std::size_t cell) const {
    if (!shape_.rational) {
      return take_origin<T>(values[0]);
    }
    const W* const w = cell_weights_[cell];
    const Wide origin = rounded_to<T>(divide(to_wide(values[0]), to_wide(w[0])));
    for (std::size_t k = 0; k < order_; ++k) {
      values[k] = difference_of<W>(values[k], product(w[k], origin));
    }
    return origin;
  }

  const detail::CurvePackTask<T, S>& task_;
  const detail::CurveShape shape_;
  std::size_t order_;
  /// This is asked for once: where compilers expect few calls, they leave functions of CurveShape
  /// as symbols.
  std::size_t curve_values_;
  std::size_t components_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  const S* polygon_[kWideLanes];
  Wide weights_[detail::kMostOrder];
  W cell_weights_[2][detail::kMostOrder]; ///< coefficients
  Wide end_weights_[2][2];
};

template <typename T, typename S>
detail::PackDoubt curve_pack_kernel(const detail::CurvePackTask<T, S>& task, std::size_t begin,
                                    std::size_t end) {
  CurveGroup<T, S> group(task);
  return pack_groups(group, begin, end);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
