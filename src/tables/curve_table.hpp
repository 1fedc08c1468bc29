// The contract between the base code and the kernels for curves.
#pragma once

#include <simdbezier/outputs.hpp>

#include "src/storage/curve_shape.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier {

constexpr std::size_t output_index(CurveOutput output) noexcept {
  return static_cast<std::size_t>(output);
}

namespace detail {

/// A sample whose |C'|^2 did not pass the quick test.
template <typename T>
struct TangentQuery {
  const CurveShape* shape;
  GivenNet net; ///< of its curve
  T x;          ///< half-centred parameter
};

template <typename T>
struct TangentAnswer {
  T tangent[3];
  T curvature;
  SampleStatus status;
};

/// Decides a sample in doubt; see src/exact/tangent_fallback.hpp.
template <typename T>
using ResolveTangent = void (*)(const TangentQuery<T>& query, TangentAnswer<T>& answer);

/// What tasks of all kinds have in common. Arrays begin with the task's first curve.
template <typename T>
struct CurveArrays {
  const CurveShape* shape;
  const T* values;
  GivenPoints given;
  const T* tangent_floor;

  Planes<T> out[kCurveVectorOutputs]; ///< planes of components that do not exist are null
  T* curvature;                       ///< may be null
  SampleStatus* status; ///< may be null; filled beforehand, changed where a tangent is unusual
  std::size_t first_component; ///< the component that goes to component[0]
  ResolveTangent<T> resolve_tangent;
  bool prefetch; ///< the set does not fit the second-level cache
  Isa executed;  ///< written by the kernel
};

/// Samples a curve with which kernels can write positions as rows: see curve/curve_kernel.hpp.
inline constexpr std::size_t kLeastRow = 4;
inline constexpr std::size_t kMostRow = 64;
/// They stream rows of cubics without origins only: those of a register of samples up to these (see
/// curve/joined_rows.hpp), and those that whole lines hold (curve/lines_of_curves.hpp).
inline constexpr std::size_t kMostJoined = 1024;

/// Whether cubics of n samples without origins fill cache lines, a curve or several each, which
/// kernels compute in registers.
template <typename T>
[[nodiscard]] constexpr bool rows_fill_lines(const CurveShape& shape, std::size_t n) noexcept {
  return shape.degree == 3 && !shape.origins && n >= kLeastRow && 64 / sizeof(T) % n == 0;
}

/// Consecutive curves at the same parameters: sample i of the k-th one goes to plane[k * n + i].
template <typename T>
struct CurveTask : CurveArrays<T> {
  std::size_t curve_count;
  const T* x; ///< n half-centred parameters, then at least kMaxLanes more values to read
  std::size_t n;
  bool rows;            ///< positions of three components, in the caller's own layout
  T* triples;           ///< of rows: packed x y z take the place of planes
  bool streaming;       ///< past the caches; unless `rows`, curves are whole cache lines
  DrainQueue<T>* drain; ///< null, or what a kernel passes on while it computes: see drain_some()
};

/// Scattered samples with unit-stride outputs.
template <typename T>
struct ScatteredCurveTask : CurveArrays<T> {
  const std::uint32_t* curve;
  const T* t; ///< as given; half-centred parameters are (t - shift) * scale
  T shift;
  T scale;
  std::size_t count;
};

/// Curves to pack, and where the arrays of curve 0 begin.
template <typename T, typename S>
struct CurvePackTask {
  ControlNets<S> rows; ///< polygons, as nets of one row
  CurveShape shape;
  double relative_to[3]; ///< of the first three components

  T* values;
  S* control_points; ///< as given, see given_points.hpp
  T* tangent_floor;
};

/// Packs curves [begin, end) up to the first group that may hold a fault.
template <typename T, typename S>
using CurvePackKernel = PackDoubt (*)(const CurvePackTask<T, S>& task, std::size_t begin,
                                      std::size_t end);

template <typename T>
struct CurveTable {
  void (*grid)(CurveTask<T>& task);
  void (*scattered)(ScatteredCurveTask<T>& task);
  CurvePackKernel<T, float> pack_f32;
  CurvePackKernel<T, double> pack_f64;
};

} // namespace detail
} // namespace simdbezier
