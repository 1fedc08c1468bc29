// Calls that can write through the caches or past them. Besides what every call has (call.hpp):
//
//   auto plan(Way)                  the work, for each way of getting the outputs to memory
//   std::size_t written() const     how many bytes it writes
//   CallKind kind() const           what calls have in common that the same stores suit
//
// and the work's
//   std::size_t grain()             units of a patch or sample, of which there are equally many
//   each way
//
// Which way is the fastest depends on the machine, on what the kernels can put where it belongs by
// themselves, on the width of rows and on the number of threads; no rule foretells it. The first
// large calls of each kind therefore evaluate some of their samples in each way that their caller
// allows, and the fastest one is kept: what two calls agree about, or what the third one says. All
// give the same bits, so that it does not matter who decides what.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/options.hpp>
#include <simdbezier/status.hpp>

#include "src/choice/any_work.hpp"
#include "src/choice/destination.hpp"
#include "src/choice/width_choice.hpp"
#include "src/output/output_list.hpp"
#include "src/runtime/cache_sizes.hpp"

namespace simdbezier::detail {

template <typename Call>
concept HasDestination = requires(const Call& call) {
  call.plan(Way::cache);
  call.written();
  call.kind();
};

/// Bytes of the vectors of `samples` samples.
template <typename T>
[[nodiscard]] std::size_t written_bytes(const OutputList<T>& out, std::size_t samples) noexcept {
  std::size_t values = 0;
  for (std::size_t g = 0; g < out.vector_count; ++g) {
    if (out.wants(g)) {
      values += dimension_of(*out.vectors[g]);
    }
  }
  return samples * values * sizeof(T);
}

enum class CallName : std::uint8_t {
  grid,
  patch_grids,
  curve_grid,
  curve_grids,
  mesh,
  spline_grid
};

/// What calls of all names have: instruction set, type and layout of the outputs. lines: whether it
/// is enough to know which outputs begin on a cache line, and the place within one does not matter.
template <typename T>
[[nodiscard]] CallKind kind_of_outputs(CallName name, const OutputList<T>& out,
                                       const KernelTable<T>& table, bool lines) noexcept {
  CallKind kind;
  kind.add(static_cast<std::uint64_t>(name)).add(static_cast<std::uint64_t>(table.isa));
  kind.add(sizeof(T)).add(out.wants_curvature() ? 1 : 0);
  for (std::size_t g = 0; g < out.vector_count; ++g) {
    if (out.wants(g)) {
      const Vectors<T>& v = *out.vectors[g];
      kind.add(g).add(static_cast<std::uint64_t>(v.stride)).add(v.y == v.x + 1 ? 1 : 0);
      for (const T* const first : {v.x, v.y, v.z}) {
        const std::uintptr_t within = reinterpret_cast<std::uintptr_t>(first) % 64;
        kind.add(lines ? within != 0 : within);
      }
    }
  }
  return kind;
}

/// Where `bytes` bytes go that a caller wants to go to `wanted`: automatic where only a measurement
/// can tell.
[[nodiscard]] Destination resolve_destination(Destination wanted, std::size_t bytes) noexcept;

/// Whether calls of so many bytes measure.
[[nodiscard]] bool is_measured(Destination resolved, std::size_t bytes) noexcept;

/// A call's work in one way.
struct WayOfCall {
  Way way;
  AnyWork work;
};

/// Runs the same work in some ways, one at least, of a call that has claimed its kind, and notes
/// which is the fastest. Where there is one way alone, too little work or no memory to measure, or
/// the output's memory is new (found_new_memory()), it notes nothing, and takes `known`, what
/// earlier calls have found, if that is among the ways, else Way::memory, which always is. Returns
/// ok | out_of_memory, before anything is written.
[[nodiscard]] Status run_and_decide(std::span<const WayOfCall> ways, Way known,
                                    const CallKind& kind, std::size_t bytes,
                                    const Options& options) noexcept;

/// Adds the number of threads, on which bandwidth depends, and whether most of the output has left
/// the caches when the call returns: plain stores cost more then.
[[nodiscard]] CallKind measured_kind(CallKind kind, std::size_t bytes,
                                     const Options& options) noexcept;

/// Runs a checked call that has claimed its kind, and measures on the way, as far as there is a
/// choice: where nothing is staged, or in chunks of a size of its own, streaming is one way.
template <typename Call>
Status measure_ways(const Call& call, Destination destination, Way known, const CallKind& kind,
                    std::size_t bytes, const Options& options) noexcept {
  const auto cache = call.plan(Way::cache);
  const auto memory = call.plan(Way::memory);
  const auto other = call.plan(Way::memory_other);
  const WayOfCall ways[] = {{Way::cache, AnyWork(cache, cache.grain())},
                            {Way::memory, AnyWork(memory, memory.grain())},
                            {Way::memory_other, AnyWork(other, other.grain())}};
  const std::size_t first = destination == Destination::memory ? 1 : 0;
  const bool alike = memory.scratch_bytes() == other.scratch_bytes();
  return run_and_decide(std::span(ways).subspan(first, (alike ? 2 : 3) - first), known, kind, bytes,
                        options);
}

/// Runs a checked call.
template <typename Call>
Status run_to_destination(const Call& call, const Options& options) noexcept {
  const std::size_t bytes = call.written();
  const Destination destination = resolve_destination(options.destination, bytes);
  Way way = destination == Destination::cache ? Way::cache : Way::memory;
  if (is_measured(destination, bytes)) {
    CallKind kind = measured_kind(call.kind(), bytes, options);
    kind.add(static_cast<std::uint64_t>(destination));
    const DestinationNotes::Answer answer = destination_notes().ask(kind);
    if (answer.claimed) {
      return measure_ways(call, destination, answer.choice, kind, bytes, options);
    }
    way = answer.choice == Way::undecided ? way : answer.choice;
  }
  if constexpr (HasWidths<Call>) {
    if (way == Way::cache && !exceeds_caches(bytes)) {
      return run_in_cache(call, options);
    }
  }
  const auto work = call.plan(way);
  return run_work(AnyWork(work), options);
}

} // namespace simdbezier::detail
