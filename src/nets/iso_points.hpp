// Control points of iso-parametric curves: de Casteljau's algorithm across a net, in double.
//
// No kernels: a patch's net is read once and interpolated row against row, which compilers turn
// into vector code, and without contraction the bits are the same everywhere.
#pragma once

#include <cstddef>
#include <cstdint>

#include <simdbezier/control_nets.hpp>

#include "src/storage/patch_storage.hpp"

namespace simdbezier::detail {

enum class Across : std::uint8_t { u, v };

/// The nets, seen from the direction that is interpolated away.
template <typename S>
struct IsoTask {
  ControlNets<S> nets;
  int degree;            ///< across
  int curve_degree;      ///< along
  std::ptrdiff_t across; ///< stride from point to point
  std::ptrdiff_t along;
  std::size_t channels;
  double t;
  Weights form; ///< of the results: that of the nets, or cartesian

  IsoTask(const ControlNets<S>& all, Across direction, double parameter)
      : nets(all), degree(direction == Across::u ? all.degree_u : all.degree_v),
        curve_degree(direction == Across::u ? all.degree_v : all.degree_u),
        across(direction == Across::u ? all.point_stride : all.row_stride),
        along(direction == Across::u ? all.row_stride : all.point_stride),
        channels(static_cast<std::size_t>(all.components) + (all.weights == Weights::none ? 0 : 1)),
        t(parameter), form(all.weights) {}
  /// The nets that a bucket keeps, S as they were given.
  template <typename T>
  IsoTask(const PatchStorage<T>& bucket, Across direction, double parameter)
      : IsoTask(ControlNets<S>::packed(static_cast<const S*>(bucket.given.values), bucket.count,
                                       bucket.shape.degree_u, bucket.shape.degree_v,
                                       bucket.shape.components, bucket.given.weights),
                direction, parameter) {}

  [[nodiscard]] std::size_t curve_values() const {
    return (static_cast<std::size_t>(curve_degree) + 1) * channels;
  }
  [[nodiscard]] const S* net(std::size_t patch) const {
    return nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride;
  }
};

/// The control points of one patch's curve, at `points`.
template <typename S>
void form_curve(const IsoTask<S>& task, std::size_t patch, double* points) noexcept;

} // namespace simdbezier::detail
