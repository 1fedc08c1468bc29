// Control points of iso-parametric curves: de Casteljau's algorithm across a net, in double.
//
// No kernels: a patch's net is read once and interpolated row against row, which compilers turn
// into vector code, and without contraction the bits are the same everywhere.
#pragma once

#include <cstddef>
#include <cstdint>

#include <simdbezier/nets.hpp>

#include "src/storage/patch_storage.hpp"

namespace simdbezier::detail {

enum class Across : std::uint8_t { u, v };

/// The nets, turned so that their direction u is interpolated away, and v runs along curves.
template <typename S>
struct IsoTask {
  ControlNets<S> nets;
  std::size_t channels;
  double t;
  Weights form; ///< of the results: that of the nets, or cartesian

  IsoTask(const ControlNets<S>& all, Across direction, double parameter)
      : nets(direction == Across::u ? all : transposed(all)), channels(shape_of(all).channels()),
        t(parameter), form(all.weights) {}
  /// The nets that a bucket keeps, S as they were given.
  template <typename T>
  IsoTask(const PatchStorage<T>& bucket, Across direction, double parameter)
      : IsoTask(ControlNets<S>::packed(static_cast<const S*>(bucket.given.values), bucket.count,
                                       bucket.shape.degree_u, bucket.shape.degree_v,
                                       bucket.shape.components, bucket.given.weights),
                direction, parameter) {}

  [[nodiscard]] std::size_t curve_values() const {
    return (static_cast<std::size_t>(nets.degree_v) + 1) * channels;
  }
  [[nodiscard]] const S* net(std::size_t patch) const {
    return nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride;
  }
};

/// The control points of one patch's curve, at `points`.
template <typename S>
void form_curve(const IsoTask<S>& task, std::size_t patch, double* points) noexcept;

} // namespace simdbezier::detail
