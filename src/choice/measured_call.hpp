// Calls that choose by measuring: whether their results go through the caches or past them, and on
// which of two instruction sets with equal bits they run.
//
// No rule foretells what is the fastest: stores depend on the machine, on what kernels can put
// where it belongs by themselves, on the width of rows and on the number of threads, and where a
// processor splits wide registers in two, small grids lose by what fills them. The first calls of
// each kind that are large enough therefore evaluate some of their samples in each way that their
// caller allows. What two calls agree about, or the third one says, is kept. All ways give the same
// bits, so that it does not matter who decides what.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/options.hpp>
#include <simdbezier/status.hpp>

#include "src/choice/call_notes.hpp"
#include "src/choice/destination.hpp"
#include "src/output/output_list.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/cache_sizes.hpp"

namespace simdbezier::detail {

/// Calls that can write through the caches or past them.
template <typename Call>
concept HasDestination = requires(const Call& call) {
  call.plan(Way::cache); // the work, for each way of getting the outputs to memory
  call.written();        // how many bytes it writes
  call.kind();           // what calls have in common that the same stores suit
};

/// Calls that may run on either of two instruction sets.
template <typename Call>
concept HasWidths = requires(const Call& call) {
  call.may_narrow();    // whether there are two, none is named, and the call is large
  call.plan_narrower(); // the work of plan(Way::cache) on the narrower one
  call.width_kind();    // what calls have in common that the same kernels suit
};

/// What a call plans, whose functions have the names of these members.
struct AnyWork {
  const void* work;
  Isa (*run)(const void* work, int worker, std::size_t begin, std::size_t end,
             unsigned char* scratch);
  std::size_t units;         ///< what threads share
  std::size_t duration;      ///< about how long one thread takes, as duration_of() says
  std::size_t grain;         ///< units of a patch or sample, of which each way has equally many
  std::size_t scratch_bytes; ///< that each thread needs

  template <typename Work>
  explicit AnyWork(const Work& of, std::size_t units_of_patch = 1) noexcept
      : work(&of), run([](const void* self, int worker, std::size_t begin, std::size_t end,
                          unsigned char* scratch) {
          return static_cast<const Work*>(self)->run(worker, begin, end, scratch);
        }),
        units(of.units()), duration(of.duration()), grain(units_of_patch),
        scratch_bytes(of.scratch_bytes()) {}

  Isa operator()(int worker, std::size_t begin, std::size_t end,
                 unsigned char* scratch) const noexcept {
    return run(work, worker, begin, end, scratch);
  }
};

/// Runs it in the floating-point environment of make_call(). Returns ok | out_of_memory, before
/// anything is written.
[[nodiscard]] inline Status run_work(const AnyWork& work, const RunOptions& options) noexcept {
  return run_blocks_here(work.units, work.duration, options, work.scratch_bytes, work);
}

/// Bytes of the vectors of `samples` samples.
template <typename T>
[[nodiscard]] std::size_t written_bytes(const OutputList<T>& out, std::size_t samples) noexcept {
  return samples * out.vector_values() * sizeof(T);
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

enum class Width : std::uint8_t { undecided, widest, narrower };

/// Samples of calls that are not too small for a clock.
inline constexpr std::size_t kLeastMeasured = 1024;

/// What calls of the process have found out.
CallNotes<Width>& width_notes() noexcept;

/// Runs a call that has claimed its kind: first a few of its patches on both instruction sets, in
/// some 20 microseconds, and notes which is faster. Returns ok | out_of_memory, before anything is
/// written.
[[nodiscard]] Status run_and_choose(const AnyWork& widest, const AnyWork& narrower,
                                    const CallKind& kind, const Options& options) noexcept;

/// Runs a checked call whose output stays in the caches.
template <HasWidths Call>
Status run_in_cache(const Call& call, const Options& options) noexcept {
  if (call.may_narrow()) {
    const CallKind kind = call.width_kind();
    const CallNotes<Width>::Answer answer = width_notes().ask(kind);
    if (answer.claimed) {
      const auto widest = call.plan(Way::cache);
      const auto narrower = call.plan_narrower();
      return run_and_choose(AnyWork(widest, widest.grain()), AnyWork(narrower, narrower.grain()),
                            kind, options);
    }
    if (answer.choice == Width::narrower) {
      const auto work = call.plan_narrower();
      return run_work(AnyWork(work), options);
    }
  }
  const auto work = call.plan(Way::cache);
  return run_work(AnyWork(work), options);
}

/// Measured blocks of each way. One half block runs ahead of them.
inline constexpr std::size_t kMeasurements = 3;

/// Returns the half blocks of all ways.
constexpr std::size_t half_blocks(std::size_t ways) noexcept {
  return (1 + 2 * kMeasurements) * ways;
}

/// Returns at most `items`, and a multiple of 16 if there are as many: so many rows are whole
/// lines.
constexpr std::size_t aligned_items(std::size_t items) noexcept {
  constexpr std::size_t kLine = 16;
  return items < kLine ? items : items / kLine * kLine;
}

/// Returns how many patches or samples half a block has, those of all threads together: of a call
/// with so many items and bytes, for so many ways. 0 where measuring would be more than a quarter
/// of it.
inline std::size_t half_block(std::size_t items, std::size_t bytes, std::size_t ways,
                              int threads) noexcept {
  // A thread's block is as large as its second-level cache, and up to four times as large where
  // that is no more of the call than may be measured: the last chunk of a block has nothing to
  // overlap, and a chunk is up to a third of that cache.
  constexpr std::size_t kMostOfCall = 4;
  const auto many = static_cast<std::size_t>(threads);
  const std::size_t share = bytes / (half_blocks(ways) * kMostOfCall * many);
  const std::size_t least = std::max<std::size_t>(second_level_cache() / 2, 1);
  return share < least ? 0 : aligned_items(items / (bytes / std::min(share, 4 * least) + 1)) * many;
}

using DestinationNotes = CallNotes<Way>;

/// The notes of the process.
DestinationNotes& destination_notes() noexcept;

/// Where `bytes` bytes go that a caller wants to go to `wanted`: automatic where only a measurement
/// can tell.
[[nodiscard]] Destination resolve_destination(Destination wanted, std::size_t bytes) noexcept;

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
  if (destination != Destination::cache && exceeds_caches(bytes)) {
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
