// What all operations on control nets have in common: checks of views, faults in the values, and
// the way to a kernel.
#pragma once

#include <initializer_list>

#include <simdbezier/nets.hpp>
#include <simdbezier/outputs.hpp>

#include "src/output/memory_range.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/tables/net_table.hpp"

namespace simdbezier::detail {

/// A view that kernels take; its degrees and components must be sound.
template <typename S>
NetView<const S> view_of(const ControlNets<S>& nets) noexcept;
template <typename S>
NetView<S> view_of(const MutableNets<S>& nets) noexcept;

/// The report where no control point is at fault but a parameter, or the presence of weights.
constexpr Report argument_fault(Status status) noexcept { return {status, 0, -1, 0}; }

/// Whether a view can be read: ok | bad_degree | bad_components | null_input | bad_stride |
/// size_overflow | input_too_small. Overlapping nets are allowed, a point that repeats itself is
/// not.
template <typename S>
Status check_input(const ControlNets<S>& nets) noexcept;

/// check_input() of nets in space: also bad_components where points have not three components.
template <typename S>
Status check_in_space(const ControlNets<S>& nets) noexcept {
  const Status status = check_input(nets);
  return status == Status::ok && nets.components != 3 ? Status::bad_components : status;
}

/// Whether there is no list of views, although it is said to have some.
template <typename S>
constexpr bool is_missing(std::span<const ControlNets<S>> nets) noexcept {
  return nets.data() == nullptr && !nets.empty();
}

/// Whether all views can be read, and their patches be counted: as check_input(), and null_input
/// where there is no list of views, or size_overflow.
template <typename S>
Status check_views(std::span<const ControlNets<S>> nets) noexcept;

/// The patches of all views: ok | null_input where there is no list of views | size_overflow.
template <typename S>
Status count_patches(std::span<const ControlNets<S>> nets, std::size_t& patches) noexcept {
  if (is_missing(nets)) {
    return Status::null_input;
  }
  patches = 0;
  for (const ControlNets<S>& view : nets) {
    if (__builtin_add_overflow(patches, view.count, &patches)) {
      return Status::size_overflow;
    }
  }
  return Status::ok;
}

/// The patches of all views, which can be counted.
template <typename S>
std::size_t patches_of(std::span<const ControlNets<S>> nets) noexcept {
  std::size_t patches = 0;
  static_cast<void>(count_patches(nets, patches));
  return patches;
}

/// Whether a view can be written: ok | null_output | bad_stride | size_overflow | output_too_small,
/// as well as bad_patch_range, bad_degree and bad_components where the view is not what the
/// operation writes.
template <typename S>
Status check_output(const MutableNets<S>& out, const ControlNets<S>& nets, int degree_u,
                    int degree_v) noexcept;

/// ok | overlapping_outputs: no value of one view stands where one of the other does.
template <typename S>
Status check_apart(const ControlNets<S>& a, const ControlNets<S>& b) noexcept;

/// ok | overlapping_outputs where the range meets the memory of the view, gaps included, which is
/// how inputs of grids are compared with outputs as well.
template <typename S>
Status check_apart(const ControlNets<S>& nets, const MemoryRange& range) noexcept;

/// The first value that is not finite, or weight that is not positive, in order of patches, then
/// control points, then components. With signed_weights weights may be anything finite.
template <typename S>
Report find_fault(const ControlNets<S>& nets, int threads, bool signed_weights = false) noexcept;

/// ok | null_output | output_too_small | overlapping_outputs, of an array that `count` results of
/// nets go to.
template <typename S, typename T>
Status check_array(const ControlNets<S>& nets, const Values<T>& array, std::size_t count) noexcept {
  if (count > array.capacity) {
    return Status::output_too_small;
  }
  if (array.first == nullptr && nets.count > 0) {
    return Status::null_output;
  }
  return check_apart(nets, MemoryRange(array.first, count * sizeof(T)));
}

/// check_input, check_output and check_apart of all views.
template <typename S>
Status check_nets(const ControlNets<S>& nets, std::initializer_list<const MutableNets<S>*> out,
                  int degree_u, int degree_v) noexcept;

/// Runs a kernel of one of the tables of nets on all patches; `values` of a group are scratch.
template <typename Table, typename Task>
Status run_net_kernel(NetKernel<Task> Table::*kernel, const Task& task, std::size_t count,
                      std::size_t values, const RunOptions& options) noexcept {
  Isa isa = Isa::automatic;
  if (const Status status = resolve_isa(options.isa, isa); !status) {
    return status;
  }
  const NetKernel<Task> run = separate_table<Table>(isa).*kernel;
  return run_blocks(lane_groups(count), duration_of(count, 100), options, values * kLineBytes,
                    [&](int, std::size_t begin, std::size_t end, unsigned char* scratch) {
                      const std::size_t last = end * kMaxLanes < count ? end * kMaxLanes : count;
                      return run(task, begin * kMaxLanes, last, scratch);
                    });
}

/// What operations on nets whose views have been checked begin with: which instruction set runs,
/// and whether values are sound.
template <typename T>
Report prepare(const ControlNets<T>& nets, const RunOptions& options, bool signed_weights,
               Isa& isa) noexcept {
  const Status runs = resolve_isa(options.isa, isa);
  return runs ? find_fault(nets, options.threads, signed_weights) : Report{runs};
}

/// All steps of such an operation.
template <typename T, typename Task>
Report compute_nets(const ControlNets<T>& nets, NetKernel<Task> NetOperationTable<T>::*kernel,
                    const Task& task, std::size_t values, const RunOptions& options,
                    bool signed_weights = false) noexcept {
  Isa isa = Isa::automatic;
  const Report sound = prepare(nets, options, signed_weights, isa);
  return sound ? Report{run_net_kernel(kernel, task, nets.count, values, options)} : sound;
}

} // namespace simdbezier::detail
