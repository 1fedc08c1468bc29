// See src/choice/width_choice.hpp.
#include "src/choice/width_choice.hpp"

#include <algorithm>
#include <limits>

#include "src/choice/clock.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier::detail {
namespace {

/// Samples that are evaluated at a time, and the most of a patch: larger grids have no narrow rows.
constexpr std::size_t kBlock = 2048;
constexpr std::size_t kLargestPatch = 4096;

/// The part of a block that is evaluated first, to see how long samples take.
constexpr std::size_t kProbe = 16;

/// Nanoseconds of a block. Samples that take longer need exact arithmetic, for which the width of
/// registers does not matter.
constexpr std::int64_t kLongestBlock = 300'000;

/// Rounds of both widths. The first one only brings code and data into the caches.
constexpr int kRounds = 6;
constexpr std::int64_t kLongest = 200'000; ///< nanoseconds, after which no further round begins

/// What is said to be faster has to be so by more than a clock's errors.
constexpr double kWidthMargin = 1.05;

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// A call's first patches on both instruction sets.
class BothWidths {
public:
  BothWidths(const AnyWork& widest, const AnyWork& narrower, const ThreadScratch& scratch) noexcept
      : works_{&widest, &narrower}, scratch_(scratch) {}

  /// Returns the faster width. block: how many patches are evaluated at a time.
  [[nodiscard]] Width measure(std::size_t block) const noexcept {
    const std::size_t probe = std::max<std::size_t>(block / kProbe, 1);
    std::int64_t probed = time(0, probe);
    if (probed <= kLongestBlock) { // once more, since the first run may find pages missing
      probed = std::min(probed, time(0, probe));
    }
    if (probed > kLongestBlock / static_cast<std::int64_t>(block / probe)) {
      return Width::widest;
    }
    std::int64_t best[] = {kNever, kNever};
    const std::int64_t begin = clock_now();
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t width = 0; width < 2; ++width) {
        const std::int64_t took = time(width, block);
        best[width] = round == 0 ? kNever : std::min(best[width], took);
      }
      if (round > 1 && clock_now() - begin > kLongest) {
        break;
      }
    }
    return static_cast<double>(best[1]) * kWidthMargin < static_cast<double>(best[0])
               ? Width::narrower
               : Width::widest;
  }

private:
  [[nodiscard]] std::int64_t time(std::size_t width, std::size_t patches) const noexcept {
    const AnyWork& work = *works_[width];
    const std::int64_t start = clock_now();
    run_units(0, patches * work.grain, 1, scratch_, work);
    return clock_now() - start;
  }

  const AnyWork* works_[2];
  const ThreadScratch& scratch_;
};

} // namespace

CallNotes<Width>& width_notes() noexcept {
  static CallNotes<Width> notes;
  return notes;
}

Status run_and_choose(const AnyWork& widest, const AnyWork& narrower, const CallKind& kind,
                      const Options& options) noexcept {
  const std::size_t patches = widest.units / widest.grain;
  const std::size_t patch = std::max<std::size_t>(widest.duration / patches, 1); ///< samples
  const int threads = thread_count(options.threads, widest.units, widest.duration);
  ThreadScratch scratch;
  if (!scratch.allocate(std::max(widest.scratch_bytes, narrower.scratch_bytes), threads)) {
    width_notes().decide(kind, Width::undecided);
    return Status::out_of_memory;
  }
  const std::size_t block = std::clamp<std::size_t>(kBlock / patch, 1, patches);
  const Width width =
      patch > kLargestPatch ? Width::widest : BothWidths(widest, narrower, scratch).measure(block);
  width_notes().decide(kind, width);
  const AnyWork& work = width == Width::narrower ? narrower : widest;
  note_executed(run_units(0, work.units, threads, scratch, work));
  return Status::ok;
}

} // namespace simdbezier::detail
