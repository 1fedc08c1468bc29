// The contract between the base code and the kernels for operations on control nets.
//
// Kernels work on groups of as many patches as a register has lanes. A group is gathered to
// [value][lane], value being (j * order_u + i) * channels + channel, in homogeneous coordinates;
// every algorithm is written once over a register and runs on such arrays, which lie in scratch
// memory that the base code provides.
#pragma once

#include "src/tables/bound_task.hpp"
#include "src/tables/kernel_table.hpp"
#include "src/tables/mean_task.hpp"

namespace simdbezier::detail {

/// One value of a group has so many bytes, whatever the instruction set and the type.
inline constexpr std::size_t kLineBytes = 64;

/// Nets in memory, read or written: ControlNets and MutableNets with sizes instead of degrees.
template <typename S>
struct NetView {
  S* points;
  std::size_t order_u;
  std::size_t order_v;
  std::size_t components;
  std::size_t channels; ///< components and weight
  std::ptrdiff_t patch_stride;
  std::ptrdiff_t row_stride;
  std::ptrdiff_t point_stride;
  std::ptrdiff_t component_stride;
  Weights weights; ///< cartesian ones multiply the components on the way in, divide on the way out
  bool packed;     ///< the values of a net lie side by side, in the order of a group
};

/// Which control points of the input a point of the result is a mean of, with positive factors, in
/// one direction: point k of those from first[k] to last[k]; none is known where last[k] is less.
/// Where they are one point (one_point.hpp), rational results are that point whatever its weights,
/// which roundings would not say; a single one is copied.
struct Support {
  std::uint8_t first[kMostOrder];
  std::uint8_t last[kMostOrder];
};

/// Parameters as UnitParameter holds them.
template <typename T>
struct Weighting {
  T t;
  T complement;
};

/// Cuts in u (into out[0] and out[1]), in v (out[0] and out[2]), or both. The scratch has room for
/// three nets.
template <typename T>
struct SplitTask {
  NetView<const T> in;
  NetView<T> out[4]; ///< [2 * half in v + half in u]; points null where not wanted
  bool in_u;
  bool in_v;
  Weighting<T> u;
  Weighting<T> v;
  Support support_u[2]; ///< of the lower and the upper half
  Support support_v[2];
};

/// A piece of each net. Its scratch has room for four nets.
template <typename T>
struct SegmentTask {
  NetView<const T> in;
  NetView<T> out;
  bool in_u; ///< not the whole of [0,1]
  bool in_v;
  Weighting<T> u[2];
  Weighting<T> v[2];
  Support support_u;
  Support support_v;
};

/// A linear map of one direction's values: out_r = factor_r sum_k entry_rk in_k / divisor_r.
///
/// Terms are added in pairs, the order of which is part of the map: pairs that mirror each other
/// give reversed input the reversed result, bit for bit.
struct LinearMap {
  struct Pair {
    std::size_t a, b; ///< columns; equal with entry_b = 0 where a term is alone
    double entry_a, entry_b;
  };
  struct Row {
    Pair pair[kMostOrder];
    std::size_t pairs = 0;
    double factor = 1;
    double divisor = 1;
  };
  Row row[kMostOrder];
  std::size_t rows = 0;
  bool identity = false;
  bool keeps_constants = false; ///< rows sum to 1: of equal values comes that value
};

/// Maps both directions, in double. The scratch has room for three nets of the larger order in each
/// direction.
template <typename T>
struct MapTask {
  NetView<const T> in;
  NetView<T> out;
  const LinearMap* u;
  const LinearMap* v;
  Support support_u;
  Support support_v;
};

/// Boxes of nets. Their scratch has room for one net, and two for each level.
template <typename T>
struct BoxTask {
  NetView<const T> in;
  T* low; ///< [patch][component]
  T* high;
  int levels; ///< 0: boxes of the control points
};

/// Distances from bilinear patches. Their scratch has room for one net.
template <typename T>
struct FlatnessTask {
  NetView<const T> in;
  T* out;            ///< [patch]
  T root_components; ///< sqrt(components), rounded up
};

/// The rates of bicubic polynomial patches are in src/tables/rate_task.hpp, and what those of
/// others need in src/tables/bound_task.hpp.
template <typename T>
struct RateTask;

/// Works on patches [begin, end) and says what it was compiled for.
template <typename Task>
using NetKernel = Isa (*)(const Task& task, std::size_t begin, std::size_t end,
                          unsigned char* scratch);

/// Operations that make nets of nets, or measure them. They are a table of their own because static
/// programs that only evaluate and mesh are linked without them.
template <typename T>
struct NetOperationTable {
  NetKernel<SplitTask<T>> split;
  NetKernel<SegmentTask<T>> segment;
  NetKernel<MapTask<T>> map;
  NetKernel<BoxTask<T>> boxes;
  NetKernel<FlatnessTask<T>> flatness;
};

/// So many patches are measured at once: as many as the widest register has doubles.
inline constexpr std::size_t kMeasured = 8;

/// What is measured of patches with three components, in double and without fused operations.
template <typename T>
struct MeasureKernels {
  /// sums[c][p] = sum_k factors[k] |coefficients[p stride + c terms + k]|, k < terms, added from
  /// the first one on.
  void (*sums)(const T* coefficients, std::size_t stride, std::size_t terms, const double* factors,
               double (*sums)[kMeasured]);
  /// The least and the largest sum_c (P[c] - eye[c]) axis[c] of the points of packed bicubic nets.
  void (*depths)(const T* nets, std::ptrdiff_t stride, const double* eye, const double* axis,
                 double* nearest, double* farthest);
};

/// What meshes and splines need of nets.
template <typename T>
struct NetTable {
  NetKernel<RateTask<T>> rates;
  BoundKernels bounds; ///< in double, whatever T is
  MeanKernels means;   ///< likewise
  MeasureKernels<T> measures;
};

} // namespace simdbezier::detail
