// Every allocation of every public call fails once: the call says so, has changed nothing and lost
// nothing, and works afterwards.
#include <gtest/gtest.h>

#include "tests/reliability/faults/counted_allocations.hpp"
#include "tests/reliability/faults/library_calls.hpp"

namespace simdbezier::tests::library_memory_test {
namespace {

class LibraryMemory : public ::testing::TestWithParam<Call> {
protected:
  /// Fails all allocations from the first on, then from the second on, … until the call succeeds;
  /// returns how many. one_fails: the first, the second, … alone.
  static int fail_each(const Call& call, const Options& options, const Results& expected,
                       bool one_fails) {
    for (int allowed = 0; allowed < 1000; ++allowed) {
      Results results;
      const Results before = results;
      const long live = live_allocations();
      allow_allocations(allowed, one_fails);
      const Status status = call.run(results, options);
      allow_allocations(-1);
      if (status == Status::ok) {
        EXPECT_TRUE(results.same_values(expected));
        return allowed;
      }
      EXPECT_EQ(to_string(status), to_string(Status::out_of_memory));
      EXPECT_EQ(live_allocations(), live) << "memory was lost";
      EXPECT_TRUE(results.same_values(before) && results.same_sets(before)) << "written to";
      EXPECT_EQ(to_string(call.run(results, options)), to_string(Status::ok));
      EXPECT_TRUE(results.same_values(expected)) << "another result after a failure";
    }
    ADD_FAILURE() << "the call never succeeds";
    return 0;
  }
};

TEST_P(LibraryMemory, EachAllocationFailsOnce) {
  const Call& call = GetParam();
  Results(); // makes the inputs
  const long live = live_allocations();
  for (const int threads : {1, 2}) {
    const Options options{.threads = threads};
    Results expected;
    EXPECT_EQ(to_string(call.run(expected, options)), to_string(Status::ok));
    for (const bool one_fails : {false, true}) {
      const int failed = fail_each(call, options, expected, one_fails);
      EXPECT_EQ(failed > 0, call.allocates) << failed << " allocations, " << threads << " threads";
    }
  }
  EXPECT_EQ(live_allocations(), live) << "memory was lost";
}

INSTANTIATE_TEST_SUITE_P(Calls, LibraryMemory, ::testing::ValuesIn(all_calls()));

} // namespace
} // namespace simdbezier::tests::library_memory_test
