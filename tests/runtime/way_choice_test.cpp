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
  Log* log;

  [[nodiscard]] std::size_t grain() const { return 1; }
  [[nodiscard]] std::size_t units() const { return kPatches; }
  [[nodiscard]] std::size_t duration() const { return kLongDuration; }
  [[nodiscard]] std::size_t scratch_bytes() const { return way == Way::memory ? 64 : 128; }
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
  Log* log;

  [[nodiscard]] FakeWork plan(Way way) const { return {way, way == fastest ? 10 : 20, log}; }
  [[nodiscard]] std::size_t written() const { return bytes; }
  [[nodiscard]] CallKind kind() const { return CallKind().add(name); }
};

constexpr std::size_t kMeasurable = 4 * kL3;
/// Measuring three ways would be more than a quarter of it.
constexpr std::size_t kShort = kL3;

struct Step {
  std::size_t bytes;
  Way fastest;
  bool measures;
  Way last; ///< that wrote the call's last patches
};

struct Case {
  const char* name;
  std::vector<Step> calls;
};

const std::vector<Case>& cases() {
  constexpr Way kPlain = Way::cache;
  constexpr Way kMuch = Way::memory;
  constexpr Way kLittle = Way::memory_by_l1;
  static const std::vector<Case> all = {
      {"two calls agree",
       {{kMeasurable, kLittle, true, kLittle},
        {kMeasurable, kLittle, true, kLittle},
        {kMeasurable, kPlain, false, kLittle},
        {kMeasurable, kPlain, false, kLittle}}},
      {"the first one is misled",
       {{kMeasurable, kPlain, true, kPlain},
        {kMeasurable, kMuch, true, kMuch},
        {kMeasurable, kMuch, true, kMuch},
        {kMeasurable, kPlain, false, kMuch}}},
      {"the second one is misled",
       {{kMeasurable, kMuch, true, kMuch},
        {kMeasurable, kPlain, true, kPlain},
        {kMeasurable, kMuch, true, kMuch},
        {kMeasurable, kPlain, false, kMuch}}},
      {"they never agree",
       {{kMeasurable, kPlain, true, kPlain},
        {kMeasurable, kMuch, true, kMuch},
        {kMeasurable, kLittle, true, kLittle},
        {kMeasurable, kPlain, false, kLittle}}},
      {"short calls take what is known, and measure nothing",
       {{kShort, kPlain, false, kMuch},
        {kMeasurable, kPlain, true, kPlain},
        {kShort, kMuch, false, kPlain},
        {kMeasurable, kLittle, true, kLittle},
        {kShort, kMuch, false, kLittle},
        {kMeasurable, kPlain, true, kPlain},
        {kShort, kMuch, false, kPlain}}},
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
      ASSERT_EQ(run_to_destination(FakeCall{name, step.fastest, step.bytes, &log}, options),
                Status::ok);
      EXPECT_EQ(executed, Isa::scalar);
      EXPECT_EQ(log.used[1] && log.used[2] && log.used[3], step.measures);
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
