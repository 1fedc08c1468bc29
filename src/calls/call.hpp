// The one way of all calls that evaluate: resolve, check, plan, run.
//
//   Status resolve()        what is asked for: instruction set, components, range of the set
//   Status check()          everything that a caller can get wrong
//   bool empty()            nothing is to be done, so that there may not even be a set
//   auto plan()             the work: which kernels, which pieces, how outputs are delivered;
//                           plan(Destination) where that is a choice (calls/destined_call.hpp), and
//                           plan_narrower() where two instruction sets are (calls/width_choice.hpp)
//
// and the work's
//   std::size_t units()           what threads share
//   std::size_t duration()        about how long one thread takes, as duration_of() says
//   std::size_t scratch_bytes()   that each of them needs
//   Isa run(worker, begin, end, scratch)
//
// The first two may refuse the call, before anything has been written. After them only an
// allocation can fail, before the first thread starts.
#pragma once

#include <algorithm>
#include <cstddef>

#include <simdbezier/options.hpp>
#include <simdbezier/samples.hpp>

#include "src/calls/destined_call.hpp"
#include "src/output/output_list.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"

namespace simdbezier::detail {

template <typename Call>
Status make_call(Call&& call, const Options& options) noexcept {
  if (const Status status = call.resolve(); !status) {
    return status;
  }
  if (const Status status = call.check(); !status || call.empty()) {
    return status;
  }
  if constexpr (HasDestination<Call>) {
    return run_to_destination(call, options);
  } else {
    const auto work = call.plan();
    return run_work(AnyWork(work), options);
  }
}

/// The components that a call evaluates.
struct Components {
  std::size_t first = 0;
  std::size_t dimension = 3; ///< how many, at most three
  int of_set = 3;

  /// False where there is no such component.
  [[nodiscard]] bool choose(int components, int first_component) noexcept {
    if (first_component < 0 || first_component >= components) {
      return false;
    }
    of_set = components;
    first = static_cast<std::size_t>(first_component);
    dimension = std::min<std::size_t>(static_cast<std::size_t>(of_set) - first, 3);
    return true;
  }
  /// Whether these are all three of points in space, which have normals.
  [[nodiscard]] bool space() const noexcept { return of_set == 3 && first == 0; }
  /// Whether these are all of points in space or in the plane, which have tangents.
  [[nodiscard]] bool all_of_few() const noexcept {
    return first == 0 && (of_set == 2 || of_set == 3);
  }
};

/// Patches or curves [first, first + count) of a set of `size`; false where the set lacks them.
[[nodiscard]] inline bool resolve_range(const SetRange& range, std::size_t size, std::size_t& first,
                                        std::size_t& count) noexcept {
  const std::size_t rest = size - range.first;
  first = range.first;
  count = range.count == SetRange::kToTheEnd ? rest : range.count;
  return range.first <= size && count <= rest;
}

/// What every call resolves.
template <typename T>
struct Request {
  const KernelTable<T>* table = nullptr;
  std::size_t first = 0; ///< patch or curve
  std::size_t count = 0;
  Components components;

  /// ok | unknown_isa | unsupported_isa | bad_patch_range | bad_components
  template <typename Set>
  [[nodiscard]] Status resolve(const Set& set, const SetRange& range, int first_component,
                               const Options& options) noexcept {
    Isa isa = Isa::automatic;
    if (const Status status = resolve_isa(options.isa, isa); !status) {
      return status;
    }
    table = &kernel_table<T>(isa);
    if (!resolve_range(range, set.size(), first, count)) {
      return Status::bad_patch_range;
    }
    return components.choose(set.components(), first_component) ? Status::ok
                                                                : Status::bad_components;
  }
};

/// The arguments of a call with Outputs or CurveOutputs; references to them.
template <typename T, typename Set, typename Where>
struct Given {
  const Set& set;
  const Where& where;
  OutputList<T> out;
  int first_component;
  const Options& options;

  template <typename Out>
  Given(const Set& patches, const Where& samples, const Out& outputs, const Options& how) noexcept
      : set(patches), where(samples), out(outputs), first_component(outputs.first_component),
        options(how) {}
};

/// What a call on patches needs to know to choose a destination or, by `lines` only, a width.
template <typename T, typename Where>
[[nodiscard]] CallKind kind_of_patches(CallName name, const Given<T, PatchSet<T>, Where>& in,
                                       const Request<T>& request, bool lines = false) noexcept {
  const SetStorage<T>& set = *in.set.storage();
  const NetShape& shape = set.buckets[0].shape;
  return kind_of_outputs(name, in.out, *request.table, lines)
      .add(set.buckets.size())
      .add(shape.order_u())
      .add(shape.order_v())
      .add(shape.channels())
      .add(in.options.watertight ? 1 : 0);
}

/// nu x nv samples of each of `count` patches; false where there are more than can be counted.
[[nodiscard]] inline bool multiply_samples(std::size_t nu, std::size_t nv, std::size_t count,
                                           std::size_t& samples) noexcept {
  return !__builtin_mul_overflow(nu, nv, &samples) &&
         !__builtin_mul_overflow(samples, count, &samples);
}

/// As check_outputs(), for patches.
template <typename T>
[[nodiscard]] Status check_patch_outputs(const OutputList<T>& out, std::size_t samples,
                                         const Components& components,
                                         std::span<const MemoryRange> inputs) noexcept {
  if (!components.space() && (out.holds(Output::normal) || out.wants_curvature())) {
    return Status::bad_components;
  }
  return check_outputs(out, samples, components.dimension, inputs);
}

} // namespace simdbezier::detail
