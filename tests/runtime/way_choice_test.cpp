// Which way to memory large calls keep. The calls are made up, and so are their clock, which stands
// still but for what they add to it, and the machine's caches, which hold what plain stores have
// left in them until streaming stores have given them time to write it back.
#include "src/choice/measured_call.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "src/choice/clock.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/cache_sizes.hpp"

namespace simdbezier::detail {

namespace way_choice_test {
std::int64_t now = 0;
std::int64_t faults = 0;
constexpr std::size_t kL2 = 1'000'000;
constexpr std::size_t kL3 = 20 * kL2;
} // namespace way_choice_test

std::int64_t clock_now() noexcept { return way_choice_test::now; }
std::int64_t page_faults() noexcept { return way_choice_test::faults; }
std::size_t last_level_cache() noexcept { return way_choice_test::kL3; }
std::size_t second_level_cache() noexcept { return way_choice_test::kL2; }
bool exceeds_caches(std::size_t bytes) noexcept { return bytes > way_choice_test::kL3 / 2; }

namespace way_choice_test {
namespace {

constexpr std::size_t kPatches = 100'000;
constexpr std::size_t kMeasurable = 4 * kL3;
constexpr std::size_t kPatchesInCaches = kPatches / 5; ///< of a call of kMeasurable bytes

constexpr std::size_t kPatch = kMeasurable / kPatches; ///< bytes
constexpr std::size_t kSmallPage = std::size_t{4} << 10;
constexpr std::size_t kLargePage = std::size_t{2} << 20;

struct Log {
  std::size_t new_page = 0; ///< bytes of a page where the output's memory is new, or 0
  std::size_t new_from = 0; ///< the first patch in new memory
  bool used[4] = {};        ///< by number of Way
  std::vector<Way> way = std::vector<Way>(kPatches, Way::undecided); ///< of each patch
  bool once = true;                                                  ///< no patch is written twice
};

/// Patches in the caches that have to be written back.
std::size_t left_in_caches = 0;

/// Returns for how many patches' time a way writes `patches` of them, one after the other.
std::size_t time_of(Way way, std::size_t patches) {
  constexpr std::size_t kSlower = 4;
  if (way == Way::cache) { // lines are only read until the caches are full
    const std::size_t room = std::min(patches, kPatchesInCaches - left_in_caches);
    left_in_caches += room;
    return room / kSlower + (patches - room);
  }
  const std::size_t beside = std::min(patches, left_in_caches);
  left_in_caches -= beside;
  return kSlower * beside + (patches - beside);
}

struct FakeWork {
  Way way;
  int takes; ///< nanoseconds of a patch
  std::size_t scratch;
  Log* log;

  [[nodiscard]] std::size_t grain() const { return 1; }
  [[nodiscard]] std::size_t units() const { return kPatches; }
  [[nodiscard]] std::size_t duration() const { return kLongDuration; }
  [[nodiscard]] std::size_t scratch_bytes() const { return scratch; }
  Isa run(int, std::size_t begin, std::size_t end, unsigned char*) const {
    bool& used = log->used[static_cast<std::size_t>(way)];
    faults += begin == 0 ? 100 : used ? 0 : 1; // of threads that start, or of others
    used = true;
    for (std::size_t patch = begin; patch < end; ++patch) {
      faults +=
          log->new_page != 0 && patch >= log->new_from && patch % (log->new_page / kPatch) == 0;
      log->once = log->once && log->way[patch] == Way::undecided;
      log->way[patch] = way;
    }
    now += takes * static_cast<std::int64_t>(time_of(way, end - begin));
    return Isa::scalar;
  }
};

struct FakeCall {
  std::uint64_t name;
  Way fastest;
  std::size_t bytes;
  bool alike; ///< streams in one way alone
  Log* log;

  [[nodiscard]] FakeWork plan(Way way) const {
    return {way, way == fastest ? 10 : 20, way == Way::memory && !alike ? 64U : 128U, log};
  }
  [[nodiscard]] std::size_t written() const { return bytes; }
  [[nodiscard]] CallKind kind() const { return CallKind().add(name); }
};

/// Measuring three ways would be more than a quarter of it.
constexpr std::size_t kShort = kL3;

struct Step {
  std::size_t bytes;
  Way fastest;
  int ways; ///< that write patches; 1: the call measures nothing
  Way last; ///< that wrote the call's last patches
  bool alike = false;
  std::size_t new_page = 0;
  std::size_t new_from = 0;
};

struct Case {
  const char* name;
  Destination destination;
  std::vector<Step> calls;
};

const std::vector<Case>& cases() {
  constexpr Way kPlain = Way::cache;
  constexpr Way kMuch = Way::memory;
  constexpr Way kOther = Way::memory_other;
  static const std::vector<Case> all = {
      {"two calls agree",
       Destination::automatic,
       {{kMeasurable, kOther, 3, kOther},
        {kMeasurable, kOther, 3, kOther},
        {kMeasurable, kPlain, 1, kOther},
        {kMeasurable, kPlain, 1, kOther}}},
      {"the first one is misled",
       Destination::automatic,
       {{kMeasurable, kPlain, 3, kPlain},
        {kMeasurable, kMuch, 3, kMuch},
        {kMeasurable, kMuch, 3, kMuch},
        {kMeasurable, kPlain, 1, kMuch}}},
      {"the second one is misled",
       Destination::automatic,
       {{kMeasurable, kMuch, 3, kMuch},
        {kMeasurable, kPlain, 3, kPlain},
        {kMeasurable, kMuch, 3, kMuch},
        {kMeasurable, kPlain, 1, kMuch}}},
      {"they never agree",
       Destination::automatic,
       {{kMeasurable, kPlain, 3, kPlain},
        {kMeasurable, kMuch, 3, kMuch},
        {kMeasurable, kOther, 3, kOther},
        {kMeasurable, kPlain, 1, kOther}}},
      {"short calls take what is known, and measure nothing",
       Destination::automatic,
       {{kShort, kPlain, 1, kMuch},
        {kMeasurable, kPlain, 3, kPlain},
        {kShort, kMuch, 1, kPlain},
        {kMeasurable, kOther, 3, kOther},
        {kShort, kMuch, 1, kOther},
        {kMeasurable, kPlain, 3, kPlain},
        {kShort, kMuch, 1, kPlain}}},
      {"plain stores are no choice where streaming is asked for",
       Destination::memory,
       {{kMeasurable, kPlain, 2, kMuch},
        {kMeasurable, kPlain, 2, kMuch},
        {kMeasurable, kOther, 1, kMuch}}},
      {"a call with one way says nothing of others",
       Destination::memory,
       {{kMeasurable, kOther, 1, kMuch, true},
        {kMeasurable, kOther, 2, kOther},
        {kMeasurable, kOther, 1, kMuch, true},
        {kMeasurable, kOther, 2, kOther},
        {kMeasurable, kMuch, 1, kOther}}},
      {"calls to new memory say nothing, and begin by streaming",
       Destination::automatic,
       {{kMeasurable, kPlain, 1, kMuch, false, kSmallPage},
        {kMeasurable, kPlain, 1, kMuch, false, kLargePage},
        {kMeasurable, kMuch, 3, kMuch},
        {kMeasurable, kPlain, 1, kMuch, false, kLargePage},
        {kMeasurable, kPlain, 3, kPlain},
        {kMeasurable, kMuch, 2, kPlain, false, kSmallPage},
        {kMeasurable, kPlain, 3, kPlain},
        {kMeasurable, kMuch, 1, kPlain, false, kSmallPage}}},
      {"nor do calls whose memory is new in part, although they measure",
       Destination::automatic,
       {{kMeasurable, kPlain, 3, kPlain, false, kSmallPage, kPatches / 2},
        {kMeasurable, kMuch, 3, kMuch},
        {kMeasurable, kPlain, 3, kPlain, false, kSmallPage, kPatches / 2},
        {kMeasurable, kMuch, 3, kMuch},
        {kMeasurable, kPlain, 1, kMuch}}},
      {"a few new pages do not matter",
       Destination::automatic,
       {{kMeasurable, kPlain, 3, kPlain, false, kLargePage, kPatches / 10 * 7},
        {kMeasurable, kPlain, 3, kPlain, false, kLargePage, kPatches / 10 * 7},
        {kMeasurable, kMuch, 1, kPlain}}},
  };
  return all;
}

TEST(WayChoice, what_two_calls_agree_about_is_kept) {
  std::uint64_t name = 0;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    ++name;
    for (const Step& step : c.calls) {
      SCOPED_TRACE("call " + std::to_string(&step - c.calls.data()));
      Log log;
      log.new_page = step.new_page;
      log.new_from = step.new_from;
      left_in_caches = kPatchesInCaches;
      Options options;
      options.threads = 1;
      options.destination = c.destination;
      const FakeCall call{name, step.fastest, step.bytes, step.alike, &log};
      ASSERT_EQ(run_to_destination(call, options), Status::ok);
      EXPECT_EQ(take_executed_isa(), Isa::scalar);
      EXPECT_EQ(log.used[1] + log.used[2] + log.used[3], step.ways);
      EXPECT_EQ(log.way.back(), step.last);
      for (const Way way : log.way) {
        ASSERT_NE(way, Way::undecided); // each patch has been written
      }
      EXPECT_TRUE(log.once); // what has been seen before would be faster than what comes later
    }
  }
}

} // namespace
} // namespace way_choice_test
} // namespace simdbezier::detail
