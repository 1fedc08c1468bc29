// See src/calls/destined_call.hpp.
#include "src/calls/destined_call.hpp"

#include <algorithm>
#include <limits>

#include "src/runtime/batch.hpp"
#include "src/runtime/cache_sizes.hpp"
#include "src/runtime/clock.hpp"

namespace simdbezier::detail {
namespace {

/// Measurements of each way, and the part of a call that all of them may take.
constexpr std::size_t kMeasurements = 4;
constexpr std::size_t kMostOfCall = 4;

/// Streaming has to be faster by more than a clock's errors.
constexpr double kMargin = 1.02;

/// One call's work in both ways, a part of it at a time.
class BothWays {
public:
  BothWays(const AnyWork& plain, const AnyWork& streaming, int threads) noexcept
      : plain_(plain), streaming_(streaming), threads_(threads) {}

  [[nodiscard]] bool allocate() noexcept {
    return scratch_.allocate(std::max(plain_.scratch_bytes, streaming_.scratch_bytes), threads_);
  }
  /// Evaluates patches or samples [begin, end).
  void run(Destination way, std::size_t begin, std::size_t end) noexcept {
    const AnyWork& work = way == Destination::cache ? plain_ : streaming_;
    const Isa ran = run_units(begin * work.grain, end * work.grain, threads_, scratch_, work);
    executed_ = ran == Isa::automatic ? executed_ : ran; // a part may have nothing for a kernel
  }
  /// Evaluates the first 2 * kMeasurements * block patches or samples, and `dirty` behind them;
  /// returns the faster way.
  [[nodiscard]] Destination measure(std::size_t block, std::size_t dirty) noexcept {
    // Pages are there afterwards, and lines are in no cache, as those are that come later.
    const std::size_t measured = 2 * kMeasurements * block;
    run(Destination::memory, 0, measured);
    // Caches are full of lines that have to be written back: otherwise plain stores would seem to
    // cost nothing but the reading of lines.
    run(Destination::cache, measured, measured + dirty);
    constexpr Destination kWays[] = {Destination::cache, Destination::memory};
    std::int64_t best[] = {std::numeric_limits<std::int64_t>::max(),
                           std::numeric_limits<std::int64_t>::max()};
    for (std::size_t k = 0; k < 2 * kMeasurements; ++k) {
      const std::int64_t start = clock_now();
      run(kWays[k % 2], k * block, (k + 1) * block);
      best[k % 2] = std::min(best[k % 2], clock_now() - start);
    }
    return static_cast<double>(best[0]) < kMargin * static_cast<double>(best[1])
               ? Destination::cache
               : Destination::memory;
  }
  [[nodiscard]] Isa executed() const noexcept { return executed_; }

private:
  const AnyWork& plain_;
  const AnyWork& streaming_;
  int threads_;
  ThreadScratch scratch_;
  Isa executed_ = Isa::automatic;
};

} // namespace

Destination unmeasured_destination(std::size_t bytes) noexcept {
  const Destination wish = environment_destination();
  return !exceeds_caches(bytes)           ? Destination::cache
         : wish == Destination::automatic ? Destination::memory
                                          : wish;
}

bool is_measured(std::size_t bytes) noexcept {
  return exceeds_caches(bytes) && environment_destination() == Destination::automatic;
}

CallKind measured_kind(CallKind kind, std::size_t bytes, const Options& options) noexcept {
  constexpr std::size_t kMany = std::numeric_limits<std::size_t>::max();
  const int threads = thread_count(options.threads, kMany, kLongDuration);
  return kind.add(static_cast<std::uint64_t>(threads)).add(bytes / 4 > last_level_cache() ? 1 : 0);
}

Status run_and_decide(const AnyWork& plain, const AnyWork& streaming, const CallKind& kind,
                      std::size_t bytes, const Options& options) noexcept {
  const std::size_t items = plain.units / plain.grain;
  const int threads = thread_count(options.threads, items, plain.duration);
  // A block is half of what the second-level caches of all threads hold.
  const std::size_t blocks = bytes / (second_level_cache() / 2) + 1;
  // Rows that are whole lines together begin on a line in every thread's share of it.
  const std::size_t step = items / blocks < 16 ? 1 : 16;
  const std::size_t block = items / blocks / step * step * static_cast<std::size_t>(threads);
  const std::size_t measured = 2 * kMeasurements * block;
  BothWays both(plain, streaming, threads);
  const bool ready = both.allocate();
  if (!ready || block == 0 || measured > items / kMostOfCall) {
    destination_notes().decide(kind, Destination::automatic);
    return ready ? run_work(streaming, options) : Status::out_of_memory;
  }
  const std::size_t caches =
      std::max(last_level_cache(), 2 * second_level_cache() * static_cast<std::size_t>(threads));
  const std::size_t dirty =
      std::min((items - measured) / 2, items / (bytes / caches + 1)) / step * step;
  const Destination faster = both.measure(block, dirty);
  destination_notes().decide(kind, faster);
  both.run(faster, measured + dirty, items);
  report(both.executed(), options);
  return Status::ok;
}

} // namespace simdbezier::detail
