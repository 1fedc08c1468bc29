// Derivatives of any order. Lanes are samples of one patch that lie alike, not necessarily
// consecutive ones. They wait until a register is full, or the patch ends.
#pragma once

#include "kernels/derivative/derivative_cell.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Samples in one cell of a patch, on the same sides of it.
template <typename T>
struct AlikeSamples {
  std::size_t count;
  std::size_t at[kLanes<vec<T>>]; ///< in the task
  T x[kLanes<vec<T>>];            ///< local
  T y[kLanes<vec<T>>];
};

/// One parameter of one sample: its cell in that direction, and its place in the cell.
template <typename T>
struct LocalParameter {
  std::size_t cell = 0;
  T value;
  Side side = kInside;

  SIMDBEZIER_PART LocalParameter(T half_centred, std::size_t cells, bool watertight)
      : value(half_centred) {
    if (cells == 2) {
      const bool low = half_centred < T(0);
      cell = low ? 0 : 1;
      value = cell_parameter(half_centred);
    }
    if (watertight) {
      side = value == T(-0.5) ? kLowEnd : value == T(0.5) ? kHighEnd : kInside;
    }
  }
};

template <typename T>
class DerivativeKernel {
  using V = vec<T>;
  static constexpr std::size_t kPlaces = 4 * kSides * kSides; ///< cells and sides

public:
  explicit DerivativeKernel(const DerivativeTask<T>& task) : task_(task) {
    for (AlikeSamples<T>& samples : waiting_) {
      samples.count = 0;
    }
  }

  void run() {
    for (std::size_t k = 0; k < task_.count; ++k) {
      if (k > 0 && task_.patch[k] != task_.patch[k - 1]) {
        flush();
      }
      patch_ = task_.patch[k];
      add(k);
    }
    flush();
  }

private:
  SIMDBEZIER_PART void add(std::size_t k) {
    const LocalParameter<T> u(task_.x[k], task_.shape->cells_u(), task_.watertight);
    const LocalParameter<T> v(task_.y[k], task_.shape->cells_v(), task_.watertight);
    const std::size_t cell = v.cell * task_.shape->cells_u() + u.cell;
    const std::size_t place = (cell * kSides + v.side) * kSides + u.side;
    AlikeSamples<T>& samples = waiting_[place];
    samples.at[samples.count] = k;
    samples.x[samples.count] = u.value;
    samples.y[samples.count] = v.value;
    occupied_ |= std::uint64_t{1} << place;
    if (++samples.count == kLanes<V>) {
      evaluate(place);
    }
  }

  void flush() {
    while (occupied_ != 0) {
      evaluate(static_cast<std::size_t>(__builtin_ctzll(occupied_)));
    }
  }

  SIMDBEZIER_KERNEL void evaluate(std::size_t place) {
    AlikeSamples<T>& samples = waiting_[place];
    for (std::size_t i = samples.count; i < kLanes<V>; ++i) { // so that these lanes trap nothing
      samples.x[i] = samples.x[0];
      samples.y[i] = samples.y[0];
    }
    const V x = load_vector<V>(samples.x);
    const V y = load_vector<V>(samples.y);
    const MaskOf<V> finite = (x == x) & (y == y);
    const NetShape& shape = *task_.shape;
    const CellDerivatives<V> cell(
        task_, cell_of<T>(task_, shape, patch_, place / (kSides * kSides)),
        static_cast<Side>(place % kSides), static_cast<Side>(place / kSides % kSides), x, y);
    const std::size_t components = static_cast<std::size_t>(shape.components);
    for (std::size_t c = 0; c < 3 && task_.first_component + c < components; ++c) {
      TaylorTable<V> derivatives;
      cell.evaluate(task_.first_component + c, derivatives);
      store(samples, c, finite, derivatives);
    }
    samples.count = 0;
    occupied_ &= ~(std::uint64_t{1} << place);
  }

  SIMDBEZIER_PART void store(const AlikeSamples<T>& samples, std::size_t c, MaskOf<V> finite,
                             const TaylorTable<V>& derivatives) const {
    for (std::size_t d = 0; d < task_.derivative_count; ++d) {
      const PartialDerivative<T>& wanted = task_.derivatives[d];
      const V factor =
          broadcast<V>(derivative_factor<T>(wanted.order_u, wanted.order_v, *task_.shape));
      const V value = derivatives[wanted.order_u][wanted.order_v] * factor;
      alignas(64) T lanes[kLanes<V>];
      store_vector(lanes, select_where<V>(finite, value, broadcast<V>(T(__builtin_nan("")))));
      T* const plane = c == 0 ? wanted.out.x : c == 1 ? wanted.out.y : wanted.out.z;
      for (std::size_t i = 0; i < samples.count; ++i) {
        plane[static_cast<std::ptrdiff_t>(task_.first + samples.at[i]) * wanted.out.stride] =
            lanes[i];
      }
    }
  }

  const DerivativeTask<T>& task_;
  std::size_t patch_ = 0;
  std::uint64_t occupied_ = 0; ///< one bit a place where samples wait
  AlikeSamples<T> waiting_[kPlaces];
};

template <typename T>
SIMDBEZIER_KERNEL void derivative_kernel(DerivativeTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  DerivativeKernel<T> kernel(task);
  kernel.run();
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
