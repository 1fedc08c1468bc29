// How packing reads nets of any shape and writes their blocks: registers of one value of as many
// patches on one side, the caller's arrays and packed blocks on the other.
#pragma once

#include "kernels/pack/bicubic_pack_kernel.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The nets of a group.
template <typename T, typename S>
class NetReader {
public:
  using W = CarriedIn<T, S>;

  explicit NetReader(const detail::NetPackTask<T, S>& task)
      : task_(task), order_u_(task.shape.order_u()), order_v_(task.shape.order_v()) {}

  /// Begins with patches [first, first + count); lanes behind them repeat the last one.
  void begin(std::size_t first, std::size_t count) {
    for (std::size_t p = 0; p < kWideLanes; ++p) {
      const std::size_t patch = first + (p < count ? p : count - 1);
      net_[p] = task_.nets.points + static_cast<std::ptrdiff_t>(patch) * task_.nets.patch_stride;
    }
  }

  /// Reads one channel of all points, [j][i], as it stands in the caller's memory.
  void read(std::size_t channel, Wide* values) const {
    for (std::size_t j = 0; j < order_v_; ++j) {
      std::ptrdiff_t at = static_cast<std::ptrdiff_t>(channel) * task_.nets.component_stride +
                          static_cast<std::ptrdiff_t>(j) * task_.nets.row_stride;
      for (std::size_t i = 0; i < order_u_; ++i, at += task_.nets.point_stride) {
        alignas(64) double lanes[kWideLanes];
        for (std::size_t p = 0; p < kWideLanes; ++p) {
          lanes[p] = static_cast<double>(net_[p][at]);
        }
        *values++ = load_vector<Wide>(lanes);
      }
    }
  }

  /// Copies all values of the first `count` patches, as they were given except for the sign of
  /// zeros.
  void copy(std::size_t count, S* to) const {
    const ControlNets<S>& nets = task_.nets;
    const std::size_t values = order_u_ * order_v_ * task_.shape.channels();
    const auto channels = static_cast<std::ptrdiff_t>(task_.shape.channels());
    const bool packed = nets.component_stride == 1 && nets.point_stride == channels &&
                        nets.row_stride == static_cast<std::ptrdiff_t>(order_u_) * channels;
    for (std::size_t p = 0; p < count; ++p, to += values) {
      packed ? copy_packed(net_[p], values, to) : copy_strided(net_[p], to);
    }
  }

  /// Moves one component: `points` come as read() has them and become Cartesian and relative to the
  /// set's origin; `values` are the same, or times the weight where there are weights (else null).
  void move(std::size_t component, const Wide* weights, Wide* points, W* values) const {
    const Wide origin(component < 3 ? task_.relative_to[component] : 0.0);
    const std::size_t count = order_u_ * order_v_;
    if (weights == nullptr) {
      for (std::size_t k = 0; k < count; ++k) {
        values[k] = difference_of<W>(points[k], origin);
        points[k] = to_wide(values[k]);
      }
    } else if (task_.nets.weights == Weights::homogeneous) {
      for (std::size_t k = 0; k < count; ++k) {
        const W moved_by = product(carried<W>(origin), weights[k]);
        values[k] = difference_of<W>(carried<W>(points[k]), moved_by);
        points[k] = divide(to_wide(values[k]), weights[k]);
      }
    } else {
      for (std::size_t k = 0; k < count; ++k) {
        const W moved = difference_of<W>(points[k], origin);
        values[k] = product(moved, weights[k]);
        points[k] = to_wide(moved);
      }
    }
  }

private:
  static void copy_packed(const S* from, std::size_t count, S* to) {
    for (std::size_t k = 0; k < count; ++k) {
      to[k] = from[k] + S(0);
    }
  }
  void copy_strided(const S* net, S* to) const {
    for (std::size_t j = 0; j < order_v_; ++j) {
      for (std::size_t i = 0; i < order_u_; ++i) {
        const S* const point = net + static_cast<std::ptrdiff_t>(j) * task_.nets.row_stride +
                               static_cast<std::ptrdiff_t>(i) * task_.nets.point_stride;
        for (std::size_t c = 0; c < task_.shape.channels(); ++c) {
          *to++ = point[static_cast<std::ptrdiff_t>(c) * task_.nets.component_stride] + S(0);
        }
      }
    }
  }

  const detail::NetPackTask<T, S>& task_;
  std::size_t order_u_;
  std::size_t order_v_;
  const S* net_[kWideLanes] = {}; ///< every lane's first control point
};

/// Writes values, a register each, to consecutive places of every lane's block.
template <typename T>
class BlockWriter {
public:
  SIMDBEZIER_INLINE BlockWriter(T* to, std::size_t stride, std::size_t count)
      : to_(to), stride_(static_cast<std::ptrdiff_t>(stride)), count_(count) {}

  SIMDBEZIER_INLINE void put(Wide value) {
    values_[filled_++] = value;
    if (filled_ == kTransposed) {
      flush();
    }
  }
  /// Puts zeros up to a whole cache line of floats.
  SIMDBEZIER_INLINE void finish() {
    while (filled_ != 0 || blocks_ % 2 != 0) {
      put(Wide(0.0));
    }
  }

private:
  SIMDBEZIER_INLINE void flush() {
    if (count_ == kWideLanes) {
      store_transposed(values_, to_, stride_);
    } else {
      alignas(64) T lanes[kWideLanes * kTransposed];
      store_transposed(values_, lanes, static_cast<std::ptrdiff_t>(kTransposed));
      for (std::size_t p = 0; p < count_; ++p) {
        T* const to = to_ + static_cast<std::ptrdiff_t>(p) * stride_;
        copy_values(lanes + p * kTransposed, kTransposed, to);
      }
    }
    to_ += kTransposed;
    ++blocks_;
    filled_ = 0;
  }

  T* to_;
  std::ptrdiff_t stride_;
  std::size_t count_; ///< of the lanes, the first so many are written
  std::size_t filled_ = 0;
  std::size_t blocks_ = 0;
  Wide values_[kTransposed];
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
