// Which way to memory large calls keep. The calls are made up, and so are their clock, which stands
// still but for what they add to it, and the machine's caches.
#include "src/calls/destined_call.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "src/runtime/batch.hpp"
#include "src/runtime/cache_sizes.hpp"
#include "src/runtime/clock.hpp"

namespace simdbezier::detail {

namespace way_choice_test {
std::int64_t now = 0;
constexpr std::size_t kL2 = 1000;
constexpr std::size_t kL3 = 20 * kL2;
} // namespace way_choice_test

std::int64_t clock_now() noexcept { return way_choice_test::now; }
std::size_t last_level_cache() noexcept { return way_choice_test::kL3; }
std::size_t second_level_cache() noexcept { return way_choice_test::kL2; }
bool exceeds_caches(std::size_t bytes) noexcept { return bytes > way_choice_test::kL3 / 2; }

namespace way_choice_test {
namespace {

constexpr std::size_t kPatches = 100'000;

struct Log {
  bool used[4] = {};                                                  ///< by number of Way
  std::vector<Way> last = std::vector<Way>(kPatches, Way::undecided); ///< that wrote each patch
};

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
    log->used[static_cast<std::size_t>(way)] = true;
    for (std::size_t patch = begin; patch < end; ++patch) {
      log->last[patch] = way;
    }
    now += takes * static_cast<std::int64_t>(end - begin);
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

constexpr std::size_t kMeasurable = 4 * kL3;
/// Measuring three ways would be more than a quarter of it.
constexpr std::size_t kShort = kL3;

struct Step {
  std::size_t bytes;
  Way fastest;
  int ways; ///< that the call measures; 1: it measures nothing
  Way last; ///< that wrote the call's last patches
  bool alike = false;
};

struct Case {
  const char* name;
  Destination destination;
  std::vector<Step> calls;
};

const std::vector<Case>& cases() {
  constexpr Way kPlain = Way::cache;
  constexpr Way kMuch = Way::memory;
  constexpr Way kLittle = Way::memory_by_l1;
  static const std::vector<Case> all = {
      {"two calls agree",
       Destination::automatic,
       {{kMeasurable, kLittle, 3, kLittle},
        {kMeasurable, kLittle, 3, kLittle},
        {kMeasurable, kPlain, 1, kLittle},
        {kMeasurable, kPlain, 1, kLittle}}},
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
        {kMeasurable, kLittle, 3, kLittle},
        {kMeasurable, kPlain, 1, kLittle}}},
      {"short calls take what is known, and measure nothing",
       Destination::automatic,
       {{kShort, kPlain, 1, kMuch},
        {kMeasurable, kPlain, 3, kPlain},
        {kShort, kMuch, 1, kPlain},
        {kMeasurable, kLittle, 3, kLittle},
        {kShort, kMuch, 1, kLittle},
        {kMeasurable, kPlain, 3, kPlain},
        {kShort, kMuch, 1, kPlain}}},
      {"plain stores are no choice where streaming is asked for",
       Destination::memory,
       {{kMeasurable, kPlain, 2, kMuch},
        {kMeasurable, kPlain, 2, kMuch},
        {kMeasurable, kLittle, 1, kMuch}}},
      {"a call with one way says nothing of others",
       Destination::memory,
       {{kMeasurable, kLittle, 1, kMuch, true},
        {kMeasurable, kLittle, 2, kLittle},
        {kMeasurable, kLittle, 1, kMuch, true},
        {kMeasurable, kLittle, 2, kLittle},
        {kMeasurable, kMuch, 1, kLittle}}},
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
      Isa executed = Isa::automatic;
      Options options;
      options.threads = 1;
      options.executed = &executed;
      options.destination = c.destination;
      const FakeCall call{name, step.fastest, step.bytes, step.alike, &log};
      ASSERT_EQ(run_to_destination(call, options), Status::ok);
      EXPECT_EQ(executed, Isa::scalar);
      EXPECT_EQ(log.used[1] + log.used[2] + log.used[3], step.ways);
      EXPECT_EQ(log.last.back(), step.last);
      for (const Way way : log.last) {
        ASSERT_NE(way, Way::undecided); // each patch has been written
      }
    }
  }
}

} // namespace
} // namespace way_choice_test
} // namespace simdbezier::detail
