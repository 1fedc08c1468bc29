// The one way of all calls that evaluate: resolve, check, plan, run.
//
//   Status resolve()   what is asked for: instruction set, components, range of the set
//   Status check()     everything that a caller can get wrong
//   bool empty()       nothing is to be done, so that there may not even be a set
//   auto plan()        the work (AnyWork): which kernels, which pieces, how outputs are delivered;
//                      plan(Way) where that is a choice (choice/measured_call.hpp)
//
// The first two may refuse the call, before anything has been written. After them only an
// allocation can fail, before the first thread starts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>

#include <simdbezier/curves.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/patch_set.hpp>

#include "src/calls/grid_plan.hpp"
#include "src/choice/measured_call.hpp"
#include "src/output/output_list.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/storage/curve_storage.hpp"
#include "src/storage/patch_storage.hpp"

namespace simdbezier::detail {

template <typename Call>
Status make_call(Call&& call, const Options& options) noexcept {
  const DefaultFpEnvironment environment;
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

/// Checks the outputs of patches: as check_outputs(), and bad_components.
template <typename T>
[[nodiscard]] Status check_patch_outputs(const OutputList<T>& out, std::size_t samples,
                                         const Components& components,
                                         std::span<const MemoryRange> inputs) noexcept {
  if (!components.space() && out.holds_any(kSpaceOutputs)) {
    return Status::bad_components;
  }
  return check_outputs(out, samples, components.dimension, inputs);
}

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

  /// Checks the outputs: as check_outputs(), and bad_components.
  [[nodiscard]] Status check(std::size_t samples, const Components& components,
                             std::span<const MemoryRange> inputs) const noexcept {
    if constexpr (std::is_same_v<Set, PatchSet<T>>) {
      return check_patch_outputs(out, samples, components, inputs);
    } else {
      const bool bends = out.holds(CurveOutput::tangent) || out.wants_curvature();
      return bends && !components.all_of_few()
                 ? Status::bad_components
                 : check_outputs(out, samples, components.dimension, inputs);
    }
  }
};

/// What a call on patches needs to know to choose a destination or, by `lines` only, a width.
template <typename T, typename Where>
[[nodiscard]] CallKind kind_of_call(CallName name, const Given<T, PatchSet<T>, Where>& in,
                                    const Request<T>& request, bool lines = false) noexcept {
  const SetStorage<T>& set = *in.set.storage();
  const NetShape& shape = set.buckets[0].shape;
  return kind_of_outputs(name, in.out, *request.table, lines)
      .add(set.buckets.size())
      .add(shape.order_u())
      .add(shape.order_v())
      .add(shape.channels())
      .add(set.buckets[0].origins != nullptr ? 1 : 0)
      .add(in.options.watertight ? 1 : 0);
}

/// What a call on curves needs to know to choose a destination.
template <typename T, typename Where>
[[nodiscard]] CallKind kind_of_call(CallName name, const Given<T, CurveSet<T>, Where>& in,
                                    const Request<T>& request) noexcept {
  const CurveShape& shape = in.set.storage()->shape;
  return kind_of_outputs(name, in.out, *request.table, false)
      .add(static_cast<std::uint64_t>(shape.degree))
      .add(shape.values());
}

/// nu x nv samples of each of `count` patches; false where there are more than can be counted.
[[nodiscard]] inline bool multiply_samples(std::size_t nu, std::size_t nv, std::size_t count,
                                           std::size_t& samples) noexcept {
  return !__builtin_mul_overflow(nu, nv, &samples) &&
         !__builtin_mul_overflow(samples, count, &samples);
}

/// The patches or curves that a call's grids are for; samples of both name their own.
template <typename Where>
[[nodiscard]] SetRange range_of(const Where& where) noexcept {
  if constexpr (requires { where.nu.size(); }) {
    return {where.patches.first, where.nu.size()};
  } else if constexpr (requires { where.n.size(); }) {
    return {where.curves.first, where.n.size()};
  } else if constexpr (requires { where.patches; }) {
    return where.patches;
  } else if constexpr (requires { where.curves; }) {
    return where.curves;
  } else {
    return {};
  }
}

/// What calls share: the first step, and what it resolves. Arguments: Given, or what has the same
/// members but for `out`.
template <typename T, typename Arguments>
class ArgumentsCall {
public:
  template <typename Set, typename Where, typename Out>
  ArgumentsCall(const Set& set, const Where& where, const Out& out, const Options& options) noexcept
      : in_(set, where, out, options) {}

  Status resolve() noexcept {
    return request_.resolve(in_.set, range_of(in_.where), in_.first_component, in_.options);
  }
  [[nodiscard]] bool empty() const noexcept { return request_.count == 0; }

protected:
  [[nodiscard]] Status check_given(std::size_t samples,
                                   std::span<const MemoryRange> inputs) const noexcept {
    return in_.check(samples, request_.components, inputs);
  }

  Arguments in_;
  Request<T> request_;
};

/// A call with Outputs or CurveOutputs. Set: PatchSet or CurveSet.
template <typename T, template <typename> typename Set, typename Where>
using OutputCall = ArgumentsCall<T, Given<T, Set<T>, Where>>;

/// A call on one grid for all patches or curves, as far as the grid is concerned.
template <typename T, typename Arguments>
class OneGridCall : public ArgumentsCall<T, Arguments> {
public:
  using ArgumentsCall<T, Arguments>::ArgumentsCall;

  Status check() noexcept {
    const Grid<T>& grid = as_grid(this->in_.where);
    std::size_t samples = 0;
    if (!multiply_samples(grid.nu, grid.nv, this->request_.count, samples)) {
      return Status::size_overflow;
    }
    const MemoryRange inputs[] = {{grid.u, grid.nu * sizeof(T)}, {grid.v, grid.nv * sizeof(T)}};
    constexpr bool kRow = // whose v is not the caller's
        std::is_same_v<decltype(this->in_.set), const CurveSet<T>&>;
    const bool uniform = grid.u == nullptr && (kRow || grid.v == nullptr);
    const Status usable = this->check_given(samples, std::span(inputs, uniform ? 0 : kRow ? 1 : 2));
    return usable ? plan_.build(grid) : usable;
  }

protected:
  [[nodiscard]] std::size_t samples() const noexcept {
    return plan_.nu() * plan_.nv() * this->request_.count;
  }

  GridPlan<T> plan_;
};

/// The call on it with Outputs or CurveOutputs. Work: made of what is given, what is resolved, the
/// plan of the grid and a way to write.
template <CallName kName, typename T, template <typename> typename Set, typename Where,
          typename Work>
class CommonGridCall : public OneGridCall<T, Given<T, Set<T>, Where>> {
  using Base = OneGridCall<T, Given<T, Set<T>, Where>>;

public:
  using Base::Base;

  [[nodiscard]] Work plan(Way way) const noexcept {
    return {this->in_, this->request_, this->plan_, way};
  }
  [[nodiscard]] std::size_t written() const noexcept {
    return written_bytes(this->in_.out, this->samples());
  }
  [[nodiscard]] CallKind kind() const noexcept {
    return kind_of_call(kName, this->in_, this->request_)
        .add(this->plan_.nu())
        .add(this->plan_.nv());
  }
};

} // namespace simdbezier::detail
