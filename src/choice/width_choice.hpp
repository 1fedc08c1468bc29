// Calls that may run on either of two instruction sets, since both give the same bits. The wider
// one is not always the faster one: where a processor splits its registers in two, small grids lose
// by what fills them. The first call of each kind that is large enough and stays in the caches
// therefore evaluates a few of its patches on both, in some 20 microseconds, and the faster one is
// kept. Besides what every call has (call.hpp), such a call has
//
//   bool may_narrow()       whether there are two, nobody has named one of them, and the call is
//                           large enough
//   auto plan_narrower()    the work of plan(Way::cache) on the narrower one
//   CallKind width_kind()   what calls have in common that the same kernels suit
#pragma once

#include <cstddef>
#include <cstdint>

#include <simdbezier/options.hpp>
#include <simdbezier/status.hpp>

#include "src/choice/any_work.hpp"
#include "src/choice/call_notes.hpp"
#include "src/choice/destination.hpp"

namespace simdbezier::detail {

template <typename Call>
concept HasWidths = requires(const Call& call) {
  call.may_narrow();
  call.plan_narrower();
  call.width_kind();
};

enum class Width : std::uint8_t { undecided, widest, narrower };

/// Samples of calls that are not too small for a clock.
inline constexpr std::size_t kLeastMeasured = 1024;

/// What calls of the process have found out.
CallNotes<Width>& width_notes() noexcept;

/// Runs the same work on both instruction sets, of a call that has claimed its kind, and notes
/// which is faster. Returns ok | out_of_memory, before anything is written.
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

} // namespace simdbezier::detail
