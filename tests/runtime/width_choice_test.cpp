// Which of two instruction sets a call keeps. The calls are made up, and so is their clock, which
// stands still but for what they add to it.
#include "src/choice/measured_call.hpp"

#include <cstdint>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include "src/choice/clock.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier::detail {

namespace width_choice_test {
std::int64_t now = 0;
} // namespace width_choice_test

std::int64_t clock_now() noexcept { return width_choice_test::now; }
std::int64_t page_faults() noexcept { return 0; }

namespace width_choice_test {
namespace {

constexpr Isa kWide = Isa::avx512;
constexpr Isa kNarrow = Isa::avx2;
constexpr std::size_t kPatches = 64;
constexpr std::size_t kStrips = 3; ///< units of a patch

struct Log {
  int runs[2] = {};                                             ///< on kWide, kNarrow
  std::vector<Isa> last = std::vector<Isa>(kPatches * kStrips); ///< that wrote each unit
};

struct FakeWork {
  Isa isa;
  int takes;               ///< nanoseconds of a patch
  std::size_t nanoseconds; ///< the estimate
  Log* log;

  [[nodiscard]] std::size_t grain() const { return kStrips; }
  [[nodiscard]] std::size_t units() const { return kPatches * kStrips; }
  [[nodiscard]] std::size_t duration() const { return nanoseconds; }
  [[nodiscard]] std::size_t scratch_bytes() const { return isa == kWide ? 64 : 128; }
  Isa run(int, std::size_t begin, std::size_t end, unsigned char* scratch) const {
    scratch[scratch_bytes() - 1] = 1;
    ++log->runs[isa == kWide ? 0 : 1];
    for (std::size_t unit = begin; unit < end; ++unit) {
      log->last[unit] = isa;
    }
    now += takes * static_cast<std::int64_t>((end - begin) / kStrips);
    return isa;
  }
};

struct FakeCall {
  std::uint64_t name;
  bool choice;
  int wide; ///< nanoseconds of a patch
  int narrow;
  std::size_t nanoseconds;
  Log* log;

  [[nodiscard]] FakeWork plan(Way) const { return {kWide, wide, nanoseconds, log}; }
  [[nodiscard]] FakeWork plan_narrower() const { return {kNarrow, narrow, nanoseconds, log}; }
  [[nodiscard]] bool may_narrow() const { return choice; }
  [[nodiscard]] CallKind width_kind() const { return CallKind().add(name); }
};

struct Case {
  const char* name;
  bool choice;
  int wide; ///< nanoseconds of a patch
  int narrow;
  std::size_t nanoseconds;
  Isa writes;    ///< the results of all calls
  bool measured; ///< the first two calls run both
};

constexpr std::size_t kUsual = 4096;
constexpr Case kCases[] = {
    {"the narrower one is faster", true, 40, 30, kUsual, kNarrow, true},
    {"the wider one is faster", true, 30, 40, kUsual, kWide, true},
    {"the narrower one is faster by less than clocks can tell", true, 104, 100, kUsual, kWide,
     true},
    {"a clock that stands still", true, 0, 0, kUsual, kWide, true},
    {"there is no choice", false, 40, 30, kUsual, kWide, false},
    {"samples take longer than usual", true, 9000, 7000, kUsual, kNarrow, true},
    {"samples take so long that nothing is measured", true, 10'000, 100, kUsual, kWide, false},
    {"a patch that takes as long", true, 400'000, 100, kUsual, kWide, false},
    {"patches are too large", true, 40, 30, kPatches * 4097, kWide, false},
    {"the largest patches", true, 40, 30, kPatches * 4096, kNarrow, true},
    {"a duration that nobody knows", true, 40, 30, kLongDuration, kWide, false},
    {"less than a sample a patch", true, 40, 30, 1, kNarrow, true},
};

TEST(WidthChoice, the_first_two_calls_measure_and_later_ones_keep_to_it) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    for (int call = 0; call < 4; ++call) {
      Log log;
      const FakeCall fake{
          static_cast<std::uint64_t>(&c - kCases), c.choice, c.wide, c.narrow, c.nanoseconds, &log};
      EXPECT_EQ(run_in_cache(fake, Options{}), Status::ok);
      EXPECT_EQ(take_executed_isa(), c.writes) << call;
      EXPECT_EQ(log.last, std::vector<Isa>(kPatches * kStrips, c.writes)) << call;
      const bool both = log.runs[0] > 0 && log.runs[1] > 0;
      EXPECT_EQ(both, call < 2 && c.measured) << call;
    }
  }
}

TEST(WidthChoice, one_misled_measurement_is_outvoted) {
  for (const int misled : {0, 1}) {
    for (int call = 0; call < 5; ++call) {
      Log log;
      const int narrow = call == misled ? 50 : 30;
      const FakeCall fake{
          std::size(kCases) + static_cast<std::uint64_t>(misled), true, 40, narrow, kUsual, &log};
      EXPECT_EQ(run_in_cache(fake, Options{}), Status::ok);
      EXPECT_EQ(take_executed_isa(), call == misled ? kWide : kNarrow) << misled << ' ' << call;
      EXPECT_EQ(log.runs[0] > 0 && log.runs[1] > 0, call < 3) << misled << ' ' << call;
    }
  }
}

} // namespace
} // namespace width_choice_test
} // namespace simdbezier::detail
