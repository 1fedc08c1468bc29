// See src/calls/width_choice.hpp.
#include "src/calls/width_choice.hpp"

#include <algorithm>
#include <limits>

#include "src/runtime/batch.hpp"
#include "src/runtime/clock.hpp"

namespace simdbezier::detail {
namespace {

/// Estimated nanoseconds of what is measured at a time, at least and at most.
constexpr std::size_t kBlock = 2048;
constexpr std::size_t kLongestBlock = 16'384;

/// Rounds of both widths. The first one only brings code and data into the caches.
constexpr int kRounds = 6;

/// Nanoseconds. Where the first round takes longer, samples need exact arithmetic, which is the
/// same for both widths. Rounds that come later end early.
constexpr std::int64_t kLongest = 200'000;

/// What is said to be faster has to be so by more than a clock's errors.
constexpr double kMargin = 1.05;

/// Evaluates patches [0, block) on both, several times.
Width faster_width(const AnyWork& widest, const AnyWork& narrower, std::size_t block,
                   const ThreadScratch& scratch) noexcept {
  const AnyWork* const works[] = {&widest, &narrower};
  double best[] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  const std::int64_t begin = clock_now();
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t w = 0; w < 2; ++w) {
      const std::int64_t start = clock_now();
      run_units(0, block * works[w]->grain, 1, scratch, *works[w]);
      const auto took = static_cast<double>(clock_now() - start);
      best[w] = round == 0 ? best[w] : std::min(best[w], took);
    }
    if (round != 1 && clock_now() - begin > kLongest) {
      break;
    }
  }
  return best[1] * kMargin < best[0] ? Width::narrower : Width::widest;
}

} // namespace

CallNotes<Width>& width_notes() noexcept {
  static CallNotes<Width> notes;
  return notes;
}

Status run_and_choose(const AnyWork& widest, const AnyWork& narrower, const CallKind& kind,
                      const Options& options) noexcept {
  const std::size_t patches = widest.units / widest.grain;
  const std::size_t patch = std::max<std::size_t>(widest.duration / patches, 1);
  const int threads = thread_count(options.threads, widest.units, widest.duration);
  ThreadScratch scratch;
  if (!scratch.allocate(std::max(widest.scratch_bytes, narrower.scratch_bytes), threads)) {
    width_notes().decide(kind, Width::undecided);
    return Status::out_of_memory;
  }
  // One patch of a large grid takes too long for a measurement, and has no narrow rows.
  const std::size_t block = std::clamp<std::size_t>(kBlock / patch, 1, patches);
  const Width width =
      patch > kLongestBlock ? Width::widest : faster_width(widest, narrower, block, scratch);
  width_notes().decide(kind, width);
  const AnyWork& work = width == Width::narrower ? narrower : widest;
  const Isa executed = run_units(0, work.units, threads, scratch, work);
  if (options.executed != nullptr) {
    *options.executed = executed;
  }
  return Status::ok;
}

} // namespace simdbezier::detail
