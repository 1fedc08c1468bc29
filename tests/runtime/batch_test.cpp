// Work cut into blocks: every unit once, whoever starts the threads. Built with each of the back
// ends.
#include "src/runtime/batch.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "src/runtime/threads.hpp"
#include "src/runtime/useful_threads.hpp"
#include "tests/support/environment.hpp"

namespace simdbezier::detail {
namespace {

constexpr std::size_t kLong = kLongDuration;

TEST(SIMDBEZIER_BACK_END, every_unit_is_done_once) {
  for (const std::size_t units : {0U, 1U, 2U, 7U, 64U, 1000U}) {
    for (const int asked : {0, 1, 2, 3, 5, 16}) {
      const int threads = thread_count(asked, units, kLong);
      ASSERT_GE(threads, 1);
      ASSERT_LE(static_cast<std::size_t>(threads), units < 1 ? 1 : units);
      std::vector<std::atomic<int>> done(units);
      std::vector<std::atomic<int>> worked(static_cast<std::size_t>(threads));
      auto body = [&](int worker, std::size_t begin, std::size_t end) {
        ++worked.at(static_cast<std::size_t>(worker));
        for (std::size_t k = begin; k < end; ++k) {
          ++done.at(k);
        }
      };
      for_blocks(units, threads, BlockBody(body));
      for (const std::atomic<int>& times : done) {
        ASSERT_EQ(times, 1) << units << " units, " << threads << " threads";
      }
      for (const std::atomic<int>& times : worked) {
        ASSERT_LE(times, 1) << units << " units, " << threads << " threads";
      }
    }
  }
}

TEST(SIMDBEZIER_BACK_END, the_first_failure_is_the_same_on_any_number_of_threads) {
  constexpr std::size_t kUnits = 1000;
  for (const int threads : {1, 2, 5}) {
    for (const std::size_t first : {0U, 1U, 499U, 500U, 999U, 1000U}) {
      const auto holds = [first](std::size_t k) { return k < first || (k - first) % 3 != 0; };
      EXPECT_EQ(first_failure(kUnits, kShortestShare, threads, holds), first) << threads;
    }
  }
}

TEST(SIMDBEZIER_BACK_END, one_thread_is_the_callers) {
  const std::thread::id caller = std::this_thread::get_id();
  auto body = [&](int, std::size_t, std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); };
  for_blocks(10, 1, BlockBody(body));
}

/// In a region of several threads a call that names no number has one. The thread is a new one,
/// which has not found out yet how many are of use.
TEST(SIMDBEZIER_BACK_END, calls_within_a_call_have_one_thread) {
  std::thread([] {
    const int threads = thread_count(2, 2, kLong);
    auto body = [&](int, std::size_t, std::size_t) {
      EXPECT_EQ(thread_count(0, 100, kLong), threads == 1 ? default_threads() : 1);
    };
    for_blocks(2, threads, BlockBody(body));
    EXPECT_EQ(thread_count(0, 1000000, kLong), default_threads());
  }).join();
}

/// Each works in the library's environment, and has the caller's again when the caller uses it.
TEST(SIMDBEZIER_BACK_END, threads_are_started_in_the_callers_environment) {
  constexpr int kThreads = 4;
  std::uint64_t ours = 0;
  const auto is_ours = [&](int, std::size_t, std::size_t, unsigned char*) {
    EXPECT_EQ(tests::control_register(), ours);
    return Isa::automatic;
  };
  const auto run_case = [&](const tests::EnvironmentCase& test, bool here) {
    const tests::ScopedEnvironment environment(test.rounding, test.flush);
    const std::uint64_t callers = tests::control_register();
    if (here) {
      const DefaultFpEnvironment library;
      ours = tests::control_register();
      EXPECT_NE(ours, callers) << test.name;
      run_units(0, kThreads, kThreads, ThreadScratch(), is_ours);
    } else {
      auto body = [&](int worker, std::size_t begin, std::size_t end) {
        is_ours(worker, begin, end, nullptr);
      };
      for_blocks(kThreads, kThreads, BlockBody(body));
    }
    EXPECT_EQ(tests::control_register(), callers) << test.name;
    auto body = [&](int worker, int) {
      EXPECT_EQ(tests::control_register(), callers) << test.name << ", thread " << worker;
    };
    run_on_threads(kThreads, ThreadBody(body));
  };
  for (const tests::EnvironmentCase& test : tests::kEnvironments) {
    for (const bool here : {true, false}) {
      std::thread(run_case, test, here).join(); // whose runtime has no threads yet
    }
  }
}

/// The first share may have nothing for a kernel.
TEST(SIMDBEZIER_BACK_END, any_thread_says_which_kernel_ran) {
  ThreadScratch scratch;
  const auto last = [](int, std::size_t, std::size_t end, unsigned char*) {
    return end == 100 ? Isa::sse2 : Isa::automatic;
  };
  for (const int threads : {1, 2, 4}) {
    EXPECT_EQ(run_units(0, 100, threads, scratch, last), Isa::sse2) << threads;
  }
}

TEST(SIMDBEZIER_BACK_END, scratch_beyond_all_memory_is_refused) {
  for (const int threads : {8, 16}) {
    ThreadScratch scratch;
    EXPECT_FALSE(scratch.allocate(std::size_t{3} << 60, threads)) << threads;
  }
}

/// Where nobody says how many, short work does not wake a thread; who says so gets it.
TEST(SIMDBEZIER_BACK_END, threads_are_started_for_work_that_is_worth_it) {
  struct Case {
    int requested;
    std::size_t units;
    std::size_t duration;
    int expected; ///< at most default_threads() where nothing is requested, else most_threads()
  };
  constexpr std::size_t kShare = kShortestShare;
  constexpr int kMany = 1 << 20;
  const Case cases[] = {
      {0, 1000, 0, 1},          {0, 1000, 2 * kShare - 1, 1},
      {0, 1000, 2 * kShare, 2}, {0, 1000, 3 * kShare, 3},
      {0, 1000, kLong, 1000},   {0, 1, kLong, 1},
      {0, 0, kLong, 1},         {-1, 1000, kShare, 1},
      {-1, 1000, kLong, 1000},  {1, 1000, kLong, 1},
      {2, 1000, 0, 2},          {3, 2, 0, 2},
      {kMany, 1000, 0, 1000},
  };
  std::thread([&cases] { // one that has not found out yet how many are of use
    for (const Case& c : cases) {
      const int most = c.requested > 0 ? most_threads() : default_threads();
      EXPECT_EQ(thread_count(c.requested, c.units, c.duration), std::min(c.expected, most))
          << c.requested << " requested, " << c.units << " units, " << c.duration << " ns";
    }
  })
      .join();
  EXPECT_EQ(duration_of(kLong / 2, 3), kLong); // more than can be counted
}

TEST(SIMDBEZIER_BACK_END, more_threads_than_are_of_use_are_not_started) {
  EXPECT_LE(thread_count(1 << 20, 1 << 20, kLong), most_threads());
}

/// Calls of a machine whose other processes come and go, in milliseconds: what each one's threads
/// did, and how many threads the next one may take.
TEST(SIMDBEZIER_BACK_END, threads_that_wait_for_processors_are_not_started) {
  struct Call {
    std::int64_t begin;
    int threads;
    double work; ///< processor time of all threads
    std::int64_t elapsed;
    int next; ///< of 8
  };
  const Call calls[] = {
      {0, 8, 2, 3, 8},       // threads have to be started first
      {3, 8, 40, 6, 8},      // 6.7 of 8 are at work
      {10, 8, 12, 4, 8},     // 3 of 8
      {14, 8, 0.5, 1, 8},    // too short to be judged by itself
      {15, 8, 8, 2, 2},      // 2.8 of 8 with the one before, for the second time
      {30, 2, 5.9, 3, 2},    // no reason to take more
      {118, 8, 9, 5, 1},     // the pause is over, but 1.8 of 8
      {332, 8, 4, 5, 1},     // the pause doubles
      {738, 8, 4, 5, 1},     //
      {1544, 8, 4, 5, 1},    //
      {3150, 8, 4, 5, 1},    // but not beyond 1.6 s
      {4752, 1, 1, 1, 1},    //
      {4756, 8, 30, 5, 8},   // free again
      {4770, 8, 4, 5, 8},    // doubts begin anew
      {4780, 8, 4, 5, 1},    //
      {4886, 8, 38.4, 8, 8}, // six tenths are enough
  };
  constexpr std::int64_t kMillisecond = 1'000'000;
  UsefulThreads useful;
  for (const Call& call : calls) {
    const std::int64_t end = (call.begin + call.elapsed) * kMillisecond;
    useful.note(call.threads, static_cast<std::int64_t>(call.work * kMillisecond),
                call.elapsed * kMillisecond, end);
    EXPECT_EQ(useful.of(8, [end] { return end; }), call.next) << "after " << call.begin << " ms";
  }
}

TEST(SIMDBEZIER_BACK_END, threads_that_sleep_do_not_work) {
  const std::int64_t begin = elapsed_time();
  const std::int64_t work = processor_time();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_LT(processor_time() - work, elapsed_time() - begin);
}

} // namespace
} // namespace simdbezier::detail
