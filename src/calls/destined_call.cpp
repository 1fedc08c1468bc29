// See src/calls/destined_call.hpp.
#include "src/calls/destined_call.hpp"

#include <algorithm>
#include <limits>

#include "src/calls/measured_blocks.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/cache_sizes.hpp"
#include "src/runtime/clock.hpp"

namespace simdbezier::detail {
namespace {

/// A later way has to be faster by more than a clock's errors.
constexpr double kMargin = 1.02;

/// One call's work in some ways, a part of it at a time.
class AllWays {
public:
  AllWays(std::span<const WayOfCall> ways, int threads) noexcept : ways_(ways), threads_(threads) {}

  [[nodiscard]] bool allocate() noexcept {
    std::size_t bytes = 0;
    for (const WayOfCall& way : ways_) {
      bytes = std::max(bytes, way.work.scratch_bytes);
    }
    return scratch_.allocate(bytes, threads_);
  }
  /// Evaluates patches or samples [begin, end).
  void run(const WayOfCall& way, std::size_t begin, std::size_t end) noexcept {
    const std::size_t grain = way.work.grain;
    const Isa ran = run_units(begin * grain, end * grain, threads_, scratch_, way.work);
    executed_ = ran == Isa::automatic ? executed_ : ran; // a part may have nothing for a kernel
  }
  /// Evaluates the first half blocks, of `half` patches or samples each, and `dirty` behind them;
  /// returns the fastest way.
  [[nodiscard]] const WayOfCall& measure(std::size_t half, std::size_t dirty) noexcept {
    // Pages are there afterwards, and lines are in no cache, as those are that come later.
    const std::size_t measured = half_blocks(ways_.size()) * half;
    run(ways_.back(), 0, measured);
    // All blocks of a way together, and plain stores last: caches that they have filled are written
    // back while others stream, which would make plain stores seem up to 1.4 times as fast as they
    // are in the long run, and streaming slower.
    std::int64_t time[kMostWays];
    for (std::size_t k = ways_.size(); k-- > 0;) {
      if (k == 0) {
        // Plain stores would seem to cost nothing but the reading of lines, if caches were not full
        // of ones that have to be written back.
        run(ways_.front(), measured, measured + dirty);
      }
      time[k] = measure_way(ways_[k], k * kHalvesOfWay * half, half);
    }
    std::size_t fastest = 0;
    for (std::size_t k = 1; k < ways_.size(); ++k) {
      if (static_cast<double>(time[fastest]) >= kMargin * static_cast<double>(time[k])) {
        fastest = k;
      }
    }
    return ways_[fastest];
  }
  [[nodiscard]] Isa executed() const noexcept { return executed_; }

private:
  static constexpr std::size_t kMostWays = 3;

  /// Returns the median of the times that some blocks take, the first of which begins half a block
  /// behind `begin`. Times of plain stores scatter so much that the least one would flatter them.
  [[nodiscard]] std::int64_t measure_way(const WayOfCall& way, std::size_t begin,
                                         std::size_t half) noexcept {
    run(way, begin, begin + half);
    std::int64_t times[kMeasurements];
    for (std::size_t k = 0; k < kMeasurements; ++k) {
      const std::size_t at = begin + (1 + 2 * k) * half;
      const std::int64_t start = clock_now();
      run(way, at, at + 2 * half);
      times[k] = clock_now() - start;
    }
    std::nth_element(times, times + kMeasurements / 2, times + kMeasurements);
    return times[kMeasurements / 2];
  }

  std::span<const WayOfCall> ways_;
  int threads_;
  ThreadScratch scratch_;
  Isa executed_ = Isa::automatic;
};

/// The way that is taken where nothing can be measured: what is known already, or streaming.
const WayOfCall& unmeasured(std::span<const WayOfCall> ways, Way known) noexcept {
  const auto place = [ways](Way wanted) {
    return std::find_if(ways.begin(), ways.end(),
                        [wanted](const WayOfCall& way) { return way.way == wanted; });
  };
  return place(known) == ways.end() ? *place(Way::memory) : *place(known);
}

} // namespace

Destination resolve_destination(Destination wanted, std::size_t bytes) noexcept {
  if (wanted != Destination::automatic) {
    return wanted;
  }
  return exceeds_caches(bytes) ? environment_destination() : Destination::cache;
}

bool is_measured(Destination resolved, std::size_t bytes) noexcept {
  return exceeds_caches(bytes) && resolved != Destination::cache;
}

CallKind measured_kind(CallKind kind, std::size_t bytes, const Options& options) noexcept {
  constexpr std::size_t kMany = std::numeric_limits<std::size_t>::max();
  const int threads = thread_count(options.threads, kMany, kLongDuration);
  return kind.add(static_cast<std::uint64_t>(threads)).add(bytes / 4 > last_level_cache() ? 1 : 0);
}

Status run_and_decide(std::span<const WayOfCall> ways, Way known, const CallKind& kind,
                      std::size_t bytes, const Options& options) noexcept {
  const AnyWork& first = ways.front().work;
  const std::size_t items = first.units / first.grain;
  const int threads = thread_count(options.threads, items, first.duration);
  const std::size_t half = ways.size() == 1 ? 0 : half_block(items, bytes, ways.size(), threads);
  AllWays all(ways, threads);
  if (half == 0 || !all.allocate()) {
    destination_notes().decide(kind, Way::undecided);
    return run_work(unmeasured(ways, known).work, options);
  }
  const std::size_t measured = half_blocks(ways.size()) * half;
  const std::size_t caches =
      2 * std::max(last_level_cache(), second_level_cache() * static_cast<std::size_t>(threads));
  const bool plain = ways.front().way == Way::cache;
  const std::size_t dirty =
      plain ? aligned_items(std::min((items - measured) / 2, items / (bytes / caches + 1))) : 0;
  const WayOfCall& fastest = all.measure(half, dirty);
  destination_notes().add_measurement(kind, fastest.way);
  all.run(fastest, measured + dirty, items);
  report(all.executed(), options);
  return Status::ok;
}

} // namespace simdbezier::detail
