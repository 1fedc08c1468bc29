// The contract between the base code and the kernels of one instruction set. No xsimd in here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/outputs.hpp>
#include <simdbezier/status.hpp>

#include "src/storage/patch_arrays.hpp"
#include "src/tables/grid_strategy.hpp"

namespace simdbezier {

/// Returns the number of an output's planes in a task. A class of planes that enumerators index
/// costs tiles up to a twentieth of their speed: its operators are functions when g++ first sees
/// them.
constexpr std::size_t output_index(Output output) noexcept {
  return static_cast<std::size_t>(output);
}

namespace detail {

// Sets of outputs that need the same are constants: kernels may not read the table that they come
// from, which would be one more symbol of all objects.

/// Returns the outputs of patches of which is(Output) holds.
template <typename Is>
constexpr OutputSelection outputs_where(const Is& is) noexcept {
  OutputSelection all;
  for (std::size_t k = 0; k < kOutputs; ++k) {
    if (is(static_cast<Output>(k))) {
      all.add(static_cast<Output>(k));
    }
  }
  return all;
}
/// Returns the outputs whose highest derivatives are of that order, and not those of lower ones.
consteval OutputSelection outputs_of_order(int order) noexcept {
  return outputs_where([order](Output output) { return derivative_order(output) == order; });
}
inline constexpr OutputSelection kSpaceOutputs = outputs_where(needs_space);

/// Three planes of one vector output, unit stride; null where it was not asked for.
template <typename T>
struct Planes {
  T* component[3] = {nullptr, nullptr, nullptr};
  [[nodiscard]] bool wanted() const noexcept { return component[0] != nullptr; }
};

/// A sample whose |du x dv|^2 did not pass the quick test.
template <typename T>
struct NormalQuery {
  const NetShape* shape;
  GivenNet net; ///< of its patch
  T x;          ///< half-centred parameters
  T y;
};

/// What the components of a limit are known to, relative to the largest: below the last rounding to
/// float by far more than directions need, and 10^-9 degree in double.
template <typename T>
inline constexpr double kLimitTolerance = sizeof(T) == sizeof(float) ? 0x1p-18 : 0x1p-38;

/// The accuracy of regular directions: there are many samples close to where they vanish, and exact
/// decisions of high degrees take a millisecond each. Bounds exceed errors by far.
inline constexpr double kRegularTolerance = 0x1p-16;

/// Writes the unit normal (or zero, or nan at nan parameters); see src/exact/normal_fallback.hpp.
template <typename T>
using ResolveNormal = SampleStatus (*)(const NormalQuery<T>& query, T normal[3]);

/// How a row of samples is evaluated.
enum class RowKind : std::uint8_t {
  interior,
  edge_v0, ///< Y is exactly -1/2
  edge_v1, ///< Y is exactly 1/2
  outside  ///< |Y| > 1/2 or nan: the interior's formula, every normal takes a second look
};

/// Consecutive rows of one kind.
template <typename T>
struct RowRun {
  const T* y; ///< `rows` half-centred parameters, then at least kMaxLanes more readable values
  std::uint32_t rows;
  RowKind kind;
};

/// Finished samples on their way from staging to the caller's memory; see
/// src/tables/drain_queue.hpp.
template <typename T>
struct DrainQueue;

/// What tasks of samples have in common: patches, and where results go.
template <typename T>
struct SampleTask : PatchArrays<T> {
  Planes<T> out[kVectorOutputs];
  T* curvature[kCurvatureKinds]; ///< null where not wanted; read by the kernels of any shape only
  std::size_t first_component;   ///< the component that goes to component[0]; likewise
  SampleStatus* status; ///< may be null; `regular` beforehand, changed where a sample is not
  ResolveNormal<T> resolve_normal;
  bool watertight; ///< edges come from their own control points
  bool prefetch;   ///< the set does not fit the second-level cache
  Isa executed;    ///< written by the kernel
};

/// Consecutive patches on consecutive rows of one grid.
///
/// Sample (patch, row, column) of the task goes to plane[patch * patch_step + row * nu + column],
/// counted from the task's first patch and first row.
template <typename T>
struct GridTask : SampleTask<T> {
  std::size_t patch_count;
  std::size_t patch_step;

  const T* x; ///< nu values, then kMaxLanes more that repeat the last one
  std::size_t nu;
  const RowRun<T>* runs; ///< the rows, first to last
  std::size_t run_count;

  bool streaming;       ///< rows are to be stored past the caches: see src/output/output_plan.hpp
  bool by_lines;        ///< rows are stored in whole lines: see src/choice/line_costs.hpp
  bool plain_to_memory; ///< outputs leave the caches, by plain stores
  std::size_t cached_bytes; ///< of samples stay in the first-level cache while tile follows tile
  std::size_t record;       ///< values to the next sample: OutputPlan::record() or kSampleRecord
  DrainQueue<T>* drain; ///< null, or what a kernel passes on while it computes: see drain_some()
  StrategySet allowed;  ///< read by the kernels of bicubic patches
  StrategySet taken;    ///< written by these
  /// Values of columns and rows that stand behind position and normal in records of kVertexRecord.
  const T* column_values;
  const T* row_values;
};

/// Scattered samples with unit-stride outputs.
template <typename T>
struct ScatteredTask : SampleTask<T> {
  const std::uint32_t* patch;
  const T* u; ///< as given; half-centred parameters are (u - shift) * scale
  const T* v;
  T shift;
  T scale;
  std::size_t count;
  T common_floor; ///< no patch has a higher normal_floor; infinity where they differ much
};

/// X and Y arrays are padded so that the widest kernel may read past the last column or row.
inline constexpr std::size_t kMaxLanes = 16;

/// Rows that go past the caches wherever they begin have at most so many registers.
inline constexpr std::size_t kMostStreamedRegisters = 16;

/// Patches, curves or nets in whole groups of the widest kernel: work that is cut at groups has one
/// incomplete register at the most, the last one.
constexpr std::size_t lane_groups(std::size_t count) noexcept {
  return count / kMaxLanes + (count % kMaxLanes == 0 ? 0 : 1);
}

/// Which outputs a kernel is compiled for.
enum OutputSet : std::size_t {
  kPosition,
  kPositionNormal,
  kPositionDerivatives,
  kAnyOutputs,        ///< position, du, dv, normal: all computed, null groups not stored
  kSecondDerivatives, ///< duu, duv, dvv: all computed, null groups not stored
  kOutputSets
};

/// Nets of one shape to pack: where the arrays of patch 0 begin, and what positions become relative
/// to.
template <typename T, typename S>
struct PackTask {
  ControlNets<S> nets;
  NetShape shape;
  double relative_to[3]; ///< of the first three components
  T* coefficients;
  T* edges;
  S* control_points; ///< as given, see given_points.hpp
  T* origins;        ///< null where none are wanted
  T* normal_floor;
  /// The kernel of bicubic nets goes past the caches where lines are whole; KernelTable::fence()
  /// completes that.
  bool streaming;
  bool far; ///< the arrays would not stay in the second-level cache: their lines are asked for
};

/// Patches [begin, end) have been packed, but something among them may not be finite, and what
/// follows them has not been looked at. begin == end where all is well.
struct PackDoubt {
  std::size_t begin;
  std::size_t end;
};

/// Packs patches [begin, end).
template <typename T, typename S>
using PackKernel = PackDoubt (*)(const PackTask<T, S>& task, std::size_t begin, std::size_t end);

/// Returns the packing kernel of `table` for control points in S.
template <typename S, typename Table>
constexpr auto packing_kernel(const Table& table) noexcept {
  if constexpr (std::is_same_v<S, float>) {
    return table.pack_f32;
  } else {
    return table.pack_f64;
  }
}

/// Samples whose derivatives of any order are wanted: src/tables/derivative_task.hpp.
template <typename T>
struct DerivativeTask;

/// Kernels for patches of any shape. They read NetShape where those of KernelTable know theirs, but
/// the tasks are the same, and so are the bits where both can run.
template <typename T>
struct ShapeTable {
  void (*grid)(GridTask<T>& task); ///< all outputs that the task wants
  void (*scattered)(ScatteredTask<T>& task);
  void (*derivatives)(DerivativeTask<T>& task);
  PackKernel<T, float> pack_f32;
  PackKernel<T, double> pack_f64;
};

/// Kernels for curves (src/tables/curve_table.hpp), for operations on control nets
/// (src/tables/net_table.hpp), and for meshes (src/tables/mesh_table.hpp).
template <typename T>
struct CurveTable;
template <typename T>
struct NetTable;
template <typename T>
struct MeshTable;

/// Kernels for bicubic patches in space, and the way to all others.
template <typename T>
struct KernelTable {
  Isa isa;
  std::size_t lanes;
  /// There is only one kernel for each purpose: bicubic patches take the kernels of any shape, and
  /// those of their own are null; curves are not written as rows.
  bool compact;
  bool puts_records; ///< whether usual outputs' grid kernels put records together
  void (*grid[kOutputSets])(GridTask<T>& task);
  void (*drain)(DrainQueue<T>& queue); ///< passes on all that is left
  void (*fence)();                     ///< completes streaming stores
  /// Stores whole registers one behind the other, to see what stores across lines cost; null where
  /// no kernel wants to know.
  void (*store_registers)(T* to, std::size_t registers);
  std::uint32_t (*highest_index)(const std::uint32_t* index, std::size_t count);
  PackKernel<T, float> pack_f32;
  PackKernel<T, double> pack_f64;
  const ShapeTable<T>* shapes;
  const CurveTable<T>* curves;
  const NetTable<T>* nets;
  const MeshTable<T>* meshes; ///< null where there is only one kernel for each purpose
};

} // namespace detail
} // namespace simdbezier
