// How packing reads nets of any shape and writes their blocks: registers of one value of as many
// patches on one side, the caller's arrays and packed blocks on the other. Polygons of curves are
// nets of one row.
#pragma once

#include "kernels/pack/pack_groups.hpp"
#include "kernels/pack/shape_pack_formulas.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

inline constexpr std::size_t kMostPoints = kMostOrder * kMostOrder;

/// Whether all control values of a group are of a size that cannot do harm: a coefficient is at
/// most 2^43 times its control values (C(15,k) 2^k < 2^22 in each direction), sums on the way 2^30
/// times, and with weights, control values are products of two such numbers.
template <typename T>
class ControlSizes {
public:
  void add_weights(const Wide* weights, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      squares_ = squares_ + weights[k] * weights[k];
      positive_ = positive_ & (weights[k] >= Wide(kSafeWeight));
    }
  }
  /// Adds one component: control values, and Cartesian points.
  template <typename W>
  void add(const W* values, const Wide* points, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      const Wide value = to_wide(values[k]);
      squares_ = squares_ + value * value + points[k] * points[k];
    }
  }
  /// Returns false where something may not be finite, or a weight not be positive.
  [[nodiscard]] bool are_safe() const {
    return all_of<Wide>(positive_ & (squares_ <= Wide(kSafeSquares)));
  }

private:
  static constexpr double kSafeSquares = sizeof(T) == sizeof(float) ? 0x1p80 : 0x1p800;
  static constexpr double kSafeWeight = sizeof(T) == sizeof(float) ? 0x1p-40 : 0x1p-400;
  Wide squares_ = Wide(0.0);
  MaskOf<Wide> positive_ = squares_ <= squares_;
};

/// The nets of a group.
template <typename T, typename S>
class NetReader {
public:
  using W = CarriedIn<T, S>;

  /// All of it has to outlive this. relative_to: of the first three components.
  NetReader(const ControlNets<S>& nets, const double* relative_to)
      : nets_(nets), relative_to_(relative_to),
        order_u_(static_cast<std::size_t>(nets.degree_u) + 1),
        order_v_(static_cast<std::size_t>(nets.degree_v) + 1),
        channels_(static_cast<std::size_t>(nets.components) +
                  (nets.weights == Weights::none ? 0 : 1)) {}

  /// Begins with patches [first, first + count); lanes behind them repeat the last one.
  void begin(std::size_t first, std::size_t count) {
    for (std::size_t p = 0; p < kWideLanes; ++p) {
      const std::size_t patch = first + (p < count ? p : count - 1);
      net_[p] = nets_.points + static_cast<std::ptrdiff_t>(patch) * nets_.patch_stride;
    }
  }

  /// Reads one channel of all points, [j][i], as it stands in the caller's memory.
  void read(std::size_t channel, Wide* values) const {
    for (std::size_t j = 0; j < order_v_; ++j) {
      std::ptrdiff_t at = static_cast<std::ptrdiff_t>(channel) * nets_.component_stride +
                          static_cast<std::ptrdiff_t>(j) * nets_.row_stride;
      for (std::size_t i = 0; i < order_u_; ++i, at += nets_.point_stride) {
        *values++ = load_each(net_, at);
      }
    }
  }

  /// Copies all values of the first `count` patches, as they were given except for the sign of
  /// zeros.
  void copy(std::size_t count, S* to) const {
    const std::size_t values = order_u_ * order_v_ * channels_;
    const auto channels = static_cast<std::ptrdiff_t>(channels_);
    const bool packed =
        nets_.component_stride == 1 && nets_.point_stride == channels &&
        (order_v_ == 1 || nets_.row_stride == static_cast<std::ptrdiff_t>(order_u_) * channels);
    for (std::size_t p = 0; p < count; ++p, to += values) {
      packed ? copy_packed(net_[p], values, to) : copy_strided(net_[p], to);
    }
  }

  /// Moves one component: `points` come as read() has them and become Cartesian and relative to the
  /// set's origin; `values` are the same, or times the weight where there are weights (else null).
  void move(std::size_t component, const Wide* weights, Wide* points, W* values) const {
    const Wide origin(component < 3 ? relative_to_[component] : 0.0);
    const std::size_t count = order_u_ * order_v_;
    if (weights == nullptr) {
      for (std::size_t k = 0; k < count; ++k) {
        values[k] = difference_of<W>(points[k], origin);
        points[k] = to_wide(values[k]);
      }
    } else if (nets_.weights == Weights::homogeneous) {
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
    constexpr std::size_t kStep = kLanes<vec<S>>;
    std::size_t k = 0;
    for (; k + kStep <= count; k += kStep) {
      store_vector<vec<S>>(to + k, load_vector<vec<S>>(from + k) + vec<S>(S(0)));
    }
    for (; k < count; ++k) {
      to[k] = from[k] + S(0);
    }
  }
  void copy_strided(const S* net, S* to) const {
    for (std::size_t j = 0; j < order_v_; ++j) {
      for (std::size_t i = 0; i < order_u_; ++i) {
        const S* const point = net + static_cast<std::ptrdiff_t>(j) * nets_.row_stride +
                               static_cast<std::ptrdiff_t>(i) * nets_.point_stride;
        for (std::size_t c = 0; c < channels_; ++c) {
          *to++ = point[static_cast<std::ptrdiff_t>(c) * nets_.component_stride] + S(0);
        }
      }
    }
  }

  const ControlNets<S>& nets_;
  const double* relative_to_;
  std::size_t order_u_;
  std::size_t order_v_;
  std::size_t channels_;
  const S* net_[kWideLanes] = {}; ///< every lane's first control point
};

/// Writes values, a register each, to consecutive places of every lane's block: those of a channel
/// at a time, of which what does not fill a block waits for the next channel's.
template <typename T>
class BlockWriter {
public:
  /// Begins with the first place of every lane, `stride` values apart; the first `count` lanes are
  /// written.
  SIMDBEZIER_INLINE void begin(T* to, std::size_t stride, std::size_t count) {
    to_ = to;
    stride_ = static_cast<std::ptrdiff_t>(stride);
    count_ = count;
    waiting_ = 0;
    blocks_ = 0;
  }
  /// Where the next values go, up to kMostPoints of them.
  [[nodiscard]] SIMDBEZIER_INLINE Wide* next() { return values_ + waiting_; }
  /// The next `count` values are there.
  SIMDBEZIER_INLINE void add(std::size_t count) {
    const Wide* from = values_;
    for (waiting_ += count; waiting_ >= kTransposed; waiting_ -= kTransposed) {
      store_lanes(from, to_, stride_, count_);
      from += kTransposed;
      to_ += kTransposed;
      ++blocks_;
    }
    for (std::size_t k = 0; k < waiting_ && from != values_; ++k) {
      values_[k] = from[k];
    }
  }
  /// Adds zeros up to a whole cache line of floats.
  SIMDBEZIER_INLINE void finish() {
    const std::size_t zeros = (blocks_ + (waiting_ > 0 ? 1 : 0)) % 2 * kTransposed +
                              (waiting_ > 0 ? kTransposed - waiting_ : 0);
    for (std::size_t k = 0; k < zeros; ++k) {
      values_[waiting_ + k] = Wide(0.0);
    }
    add(zeros);
  }

private:
  T* to_ = nullptr;
  std::ptrdiff_t stride_ = 0;
  std::size_t count_ = 0;
  std::size_t waiting_ = 0;
  std::size_t blocks_ = 0;
  Wide values_[kMostPoints + 2 * kTransposed];
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
