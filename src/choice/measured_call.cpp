#include "src/choice/measured_call.hpp"

#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>

#include "src/choice/clock.hpp"

namespace simdbezier::detail {
namespace {

/// What SIMDBEZIER_DESTINATION says, "cache" or "memory"; automatic for every other word.
Destination read_environment() noexcept {
#if defined(__wasm__)
  return Destination::cache; // nothing stores past the caches
#else
  const char* const word = std::getenv("SIMDBEZIER_DESTINATION");
  const std::string_view wish = word == nullptr ? "" : word;
  return wish == "cache"    ? Destination::cache
         : wish == "memory" ? Destination::memory
                            : Destination::automatic;
#endif
}

/// A later way has to be faster by more than a clock's errors.
constexpr double kMargin = 1.02;

/// The way `wanted` if it is among `ways`, else Way::memory, which always is.
const WayOfCall& find_way(std::span<const WayOfCall> ways, Way wanted) noexcept {
  const auto place = [ways](Way way) {
    return std::find_if(ways.begin(), ways.end(),
                        [way](const WayOfCall& given) { return given.way == way; });
  };
  return place(wanted) == ways.end() ? *place(Way::memory) : *place(wanted);
}

/// One call's work in some ways, a part of it at a time.
class AllWays {
public:
  AllWays(std::span<const WayOfCall> ways, int threads) noexcept : ways_(ways), threads_(threads) {}

  [[nodiscard]] bool allocate() noexcept {
    for (const WayOfCall& way : ways_) {
      scratch_bytes_ = std::max(scratch_bytes_, way.work.scratch_bytes);
    }
    return scratch_.allocate(scratch_bytes_, threads_);
  }
  /// Evaluates the next `items` patches or samples, each of which is evaluated once: at a second
  /// time caches would know what it reads and page tables where it goes, which flatters streaming.
  void run(const WayOfCall& way, std::size_t items) noexcept {
    const std::size_t grain = way.work.grain;
    const std::size_t end = done_ + items;
    const Isa ran = run_units(done_ * grain, end * grain, threads_, scratch_, way.work);
    done_ = end;
    executed_ = ran == Isa::automatic ? executed_ : ran; // a part may have nothing for a kernel
  }
  /// Streams half a block, and as many patches or samples as fill the caches, while what others
  /// have left in these is written back.
  void begin(std::size_t half, std::size_t filling) noexcept {
    if (unsigned char* const own = scratch_.of(0)) {
      std::memset(own, 0, scratch_bytes_); // a first use of pages, as the start of threads is
    }
    const WayOfCall& way = find_way(ways_, Way::memory);
    run(way, half);
    counted_from_ = done_;
    faults_before_ = page_faults();
    run(way, filling);
  }
  /// Whether the output's memory was new since begin(), as far as the calling thread has seen it:
  /// half of its pages or more. Then the system has provided them, which takes longer than what is
  /// measured, even where they have 2 MiB each. item: bytes of a patch or sample.
  [[nodiscard]] bool found_new_memory(std::size_t item) const noexcept {
    constexpr std::size_t kLargePage = std::size_t{2} << 20;
    // Threads that start anew in every run (src/runtime/threads_std.cpp) have new stacks, but for
    // some five that the C library keeps.
    constexpr int kKeptStacks = 5;
    constexpr std::size_t kRuns = 16;
    const auto threads = static_cast<std::size_t>(threads_);
    const std::size_t others = threads_ > kKeptStacks ? kRuns * threads : 2;
    const std::size_t pages = (done_ - counted_from_) * item / threads / kLargePage;
    return page_faults() - faults_before_ > static_cast<std::int64_t>(others + pages / 2);
  }
  /// Evaluates some half blocks, of `half` patches or samples each, in each way; returns the
  /// fastest one. filling: how many patches or samples fill the caches.
  [[nodiscard]] const WayOfCall& measure(std::size_t half, std::size_t filling) noexcept {
    // All blocks of a way together, and plain stores last: caches that they have filled are written
    // back while others stream, which would make plain stores seem up to 1.4 times as fast as they
    // are in the long run, and streaming slower.
    std::int64_t time[kMostWays];
    for (std::size_t k = ways_.size(); k-- > 0;) {
      if (ways_[k].way == Way::cache) {
        // Plain stores would seem to cost nothing but the reading of lines, if caches were not full
        // of ones that have to be written back.
        run(ways_[k], filling);
      }
      time[k] = measure_way(ways_[k], half);
    }
    std::size_t fastest = 0;
    for (std::size_t k = 1; k < ways_.size(); ++k) {
      if (static_cast<double>(time[fastest]) >= kMargin * static_cast<double>(time[k])) {
        fastest = k;
      }
    }
    return ways_[fastest];
  }
  [[nodiscard]] std::size_t done() const noexcept { return done_; }
  [[nodiscard]] Isa executed() const noexcept { return executed_; }

private:
  static constexpr std::size_t kMostWays = 3;

  /// Returns the median of the times that some blocks take, behind half a block that is not timed.
  /// Times of plain stores scatter so much that the least one would flatter them.
  [[nodiscard]] std::int64_t measure_way(const WayOfCall& way, std::size_t half) noexcept {
    run(way, half);
    std::int64_t times[kMeasurements];
    for (std::int64_t& time : times) {
      const std::int64_t start = clock_now();
      run(way, 2 * half);
      time = clock_now() - start;
    }
    std::nth_element(times, times + kMeasurements / 2, times + kMeasurements);
    return times[kMeasurements / 2];
  }

  std::span<const WayOfCall> ways_;
  int threads_;
  ThreadScratch scratch_;
  std::size_t scratch_bytes_ = 0;
  std::size_t done_ = 0;
  std::size_t counted_from_ = 0;
  std::int64_t faults_before_ = 0;
  Isa executed_ = Isa::automatic;
};

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

DestinationNotes& destination_notes() noexcept {
  static DestinationNotes notes;
  return notes;
}

Destination resolve_destination(Destination wanted, std::size_t bytes) noexcept {
  if (wanted != Destination::automatic) {
    return wanted;
  }
  if (!exceeds_caches(bytes)) {
    return Destination::cache;
  }
  static const Destination environment = read_environment();
  return environment;
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
    return run_work(find_way(ways, known).work, options);
  }
  const std::size_t measured = half_blocks(ways.size()) * half;
  const std::size_t caches =
      2 * std::max(last_level_cache(), second_level_cache() * static_cast<std::size_t>(threads));
  const std::size_t filling =
      aligned_items(std::min((items - measured) / 3, items / (bytes / caches + 1)));
  const std::size_t item = bytes / items;
  const WayOfCall* way = &find_way(ways, known);
  all.begin(half, filling);
  if (!all.found_new_memory(item)) {
    way = &all.measure(half, filling);
  }
  if (all.found_new_memory(item)) {
    destination_notes().decide(kind, Way::undecided);
  } else {
    destination_notes().add_measurement(kind, way->way);
  }
  all.run(*way, items - all.done());
  note_executed(all.executed());
  return Status::ok;
}

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
  width_notes().add_measurement(kind, width);
  const AnyWork& work = width == Width::narrower ? narrower : widest;
  note_executed(run_units(0, work.units, threads, scratch, work));
  return Status::ok;
}

} // namespace simdbezier::detail
