// The first fault of one patch, found with certainty where a packing kernel only suspects one.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include <simdbezier/patch_set.hpp>

#include "src/storage/patch_storage.hpp"

namespace simdbezier::detail {

template <typename T>
bool all_finite(const T* values, std::size_t count) {
  // x - x is 0 for finite x only, and sums of zeros stay 0.
  T sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += values[i] - values[i];
  }
  return sum == 0;
}

/// Positive, finite, and not so small that 1/w is infinite: kernels divide by multiplying.
template <typename T, typename S>
bool is_weight(S value) {
  const T packed = static_cast<T>(value);
  return packed >= std::numeric_limits<T>::min() && std::isfinite(packed);
}

/// One channel of all points of a patch.
template <typename S>
class ChannelView {
public:
  ChannelView(const ControlNets<S>& nets, std::size_t patch, std::size_t channel)
      : nets_(nets), from_(nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride +
                           static_cast<std::ptrdiff_t>(channel) * nets.component_stride) {}

  /// The first point, j*(degree_u+1)+i, whose value is not `good`; -1 where all are.
  template <typename Good>
  [[nodiscard]] int first_not(Good good) const {
    for (int j = 0; j <= nets_.degree_v; ++j) {
      for (int i = 0; i <= nets_.degree_u; ++i) {
        if (!good(from_[j * nets_.row_stride + i * nets_.point_stride])) {
          return j * (nets_.degree_u + 1) + i;
        }
      }
    }
    return -1;
  }

private:
  const ControlNets<S>& nets_;
  const S* from_;
};

/// Whether everything that was packed of one channel is finite.
template <typename T>
bool channel_is_finite(const PatchStorage<T>& storage, std::size_t place, std::size_t channel) {
  const NetShape& shape = storage.shape;
  const GivenNet net = storage.given.net(place * shape.control_values());
  const bool weight = channel == static_cast<std::size_t>(shape.components);
  for (std::size_t k = 0; k < shape.points() && !weight; ++k) {
    if (!std::isfinite(static_cast<T>(net.coordinate(k, shape.channels(), channel)))) {
      return false;
    }
  }
  for (std::size_t cell = 0; cell < shape.cells(); ++cell) {
    const T* const matrix = storage.coefficients + place * shape.coefficients() +
                            cell * shape.cell_coefficients() + channel * shape.matrix();
    const T* const edges = storage.edges + place * shape.edges() + cell * shape.cell_edges();
    const std::size_t powers = shape.edge_powers() * kEdges;
    if (!all_finite(matrix, shape.matrix()) || !all_finite(edges + channel * powers, powers) ||
        !all_finite(edges + shape.corners_at() + channel * kEdges, kEdges)) {
      return false;
    }
  }
  return true;
}

/// The first fault of patch `patch` of `nets`, whose arrays have been written at `place`; `number`
/// is its number in the set. Weights are looked at first, since they are in all coefficients, then
/// every component's control points before its coefficients.
template <typename T, typename S>
Report inspect(const ControlNets<S>& nets, std::size_t patch, const PatchStorage<T>& storage,
               std::size_t place, std::size_t number) {
  const auto components = static_cast<std::size_t>(nets.components);
  if (storage.shape.rational) {
    const int point = ChannelView<S>(nets, patch, components).first_not(is_weight<T, S>);
    if (point >= 0) {
      return {Status::bad_weight, number, point, nets.components};
    }
  }
  for (std::size_t c = 0; c < storage.shape.channels(); ++c) {
    const int point =
        ChannelView<S>(nets, patch, c).first_not([](S value) { return std::isfinite(value); });
    if (point >= 0) {
      return {Status::non_finite_input, number, point, static_cast<int>(c)};
    }
    if (!channel_is_finite(storage, place, c)) {
      return {Status::coefficient_overflow, number, 0, static_cast<int>(c)};
    }
  }
  return {};
}

} // namespace simdbezier::detail
