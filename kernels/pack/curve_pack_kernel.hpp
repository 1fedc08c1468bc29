// Packing of curves: a group at a time, one curve a lane, with the formulas of patches' edges.
#pragma once

#include "kernels/pack/shape_pack_io.hpp"
#include "kernels/pack/tangent_floor.hpp"
#include "kernels/pack/zero_signs.hpp"
#include "src/storage/one_point.hpp"
#include "src/tables/curve_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// One group of curves while it is packed.
template <typename T, typename S>
class CurveGroup {
  using W = CarriedIn<T, S>;

public:
  explicit CurveGroup(const detail::CurvePackTask<T, S>& task)
      : task_(task), shape_(task.shape), order_(shape_.order()), curve_values_(shape_.values()),
        components_(static_cast<std::size_t>(shape_.components)),
        reader_(task.rows, task.relative_to) {}

  /// Packs `count` curves from the first on, 1 <= count <= kWideLanes; lanes behind them repeat the
  /// last one. Returns false where something may not be finite, or a weight not be positive.
  bool pack(std::size_t first, std::size_t count) {
    first_ = first;
    count_ = count;
    reader_.begin(first, count);
    reader_.copy(count, task_.control_points + first * shape_.control_values());
    ControlSizes<T> sizes;
    if (shape_.rational) {
      reader_.read(components_, weights_);
      sizes.add_weights(weights_, order_);
      pack_weights();
    }
    TangentFloor<T> floor(shape_, shape_.rational ? weights_ : nullptr);
    for (std::size_t c = 0; c < components_; ++c) {
      pack_component(c, floor, sizes);
    }
    store_value(floor.value(), task_.tangent_floor + first_, 1, count_);
    if (detail::is_even_odd(shape_.degree)) {
      keep_from_zero();
    }
    if (shape_.rational) {
      pack_collapsed();
    }
    return sizes.are_safe();
  }

private:
  SIMDBEZIER_KERNEL void put_value(std::size_t cell, std::size_t channel, std::size_t k,
                                   Wide value) const {
    store_value(value,
                task_.values + first_ * curve_values_ + cell * shape_.cell_values() +
                    channel * shape_.channel_values() + k,
                curve_values_, count_);
  }

  /// Packs the weights, which the components need.
  void pack_weights() {
    W control[detail::kMostOrder];
    for (std::size_t i = 0; i < order_; ++i) {
      control[i] = carried<W>(weights_[i]);
    }
    pack_channel(components_, control, nullptr);
  }

  SIMDBEZIER_INLINE void take_cell(W* values, std::size_t cell) const {
    if (shape_.cells() == 2) {
      halve(values, 1, order_ - 1, cell);
    }
  }

  void pack_component(std::size_t c, TangentFloor<T>& floor, ControlSizes<T>& sizes) {
    W control[detail::kMostOrder];
    Wide points[detail::kMostOrder];
    reader_.read(c, points);
    reader_.move(c, shape_.rational ? weights_ : nullptr, points, control);
    sizes.add(control, points, order_);
    floor.add(points);
    const Wide outer[2] = {points[0], points[order_ - 1]};
    pack_channel(c, control, outer);
  }

  /// Packs all cells of a component, whose curves end at the points `outer`, or of the weight, for
  /// which outer is null.
  void pack_channel(std::size_t channel, const W* control, const Wide* outer) {
    for (std::size_t cell = 0; cell < shape_.cells(); ++cell) {
      W component[detail::kMostOrder];
      W* const values = outer == nullptr ? cell_weights_[cell] : component;
      for (std::size_t i = 0; i < order_; ++i) {
        values[i] = control[i];
      }
      take_cell(values, cell);
      for (std::size_t end = 0; end < 2; ++end) {
        Wide value = to_wide(values[end * (order_ - 1)]);
        if (outer == nullptr) {
          end_weights_[cell][end] = value;
        } else if (shape_.cells() == 1 || end == cell) {
          value = outer[end];
        } else if (shape_.rational) {
          value = divide(value, end_weights_[cell][end]);
        }
        put_value(cell, channel, shape_.ends_at() + end, value);
      }
      centre(values, 1, order_ - 1);
      if (shape_.origins) {
        const W* const weights = shape_.rational ? cell_weights_[cell] : nullptr;
        put_value(cell, channel, shape_.origin_at(),
                  outer == nullptr ? Wide(0.0) : split_origin<T>(values, weights, order_, 1));
      }
      for (std::size_t k = 0; k < order_; ++k) {
        put_value(cell, channel, k, to_wide(values[k]));
      }
    }
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
                                components_, 1, task_.rows.weights)) {
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

  const detail::CurvePackTask<T, S>& task_;
  const detail::CurveShape shape_;
  std::size_t order_;
  /// This is asked for once: where compilers expect few calls, they leave functions of CurveShape
  /// as symbols.
  std::size_t curve_values_;
  std::size_t components_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  NetReader<T, S> reader_;
  Wide weights_[detail::kMostOrder];
  W cell_weights_[2][detail::kMostOrder]; ///< coefficients
  Wide end_weights_[2][2];
};

template <typename T, typename S>
detail::PackDoubt curve_pack_kernel(const detail::CurvePackTask<T, S>& task, std::size_t begin,
                                    std::size_t end) {
  return pack_groups<CurveGroup<T, S>>(task, begin, end);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
