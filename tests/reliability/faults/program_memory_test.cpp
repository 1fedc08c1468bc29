// Every allocation of small jobs fails once, alone or with all that follow it.
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/reliability/faults/program_job.hpp"

namespace simdbezier::tests::program_memory_test {
namespace {

using Environment = std::vector<std::pair<std::string, std::string>>;

class ProgramMemory : public ::testing::TestWithParam<const Job*> {
protected:
  static Outcome run_with(const Scene& scene, const Environment& environment) {
    Environment all = environment;
    all.emplace_back("LD_PRELOAD", SIMDBEZIER_FAILING_MALLOC);
    return run(scene.arguments(), {.environment = all});
  }

  static long allocations(const Scene& scene) {
    const TemporaryFolder counts;
    scene.expect_sound(run_with(scene, {{"SIMDBEZIER_ALLOCATIONS", counts.path("count")}}));
    return std::atol(read_file(counts.path("count")).c_str());
  }

  static void fail(Scene& scene, long most, bool all_that_follow) {
    const long count = allocations(scene);
    EXPECT_GT(count, 50) << "allocations are not counted";
    int refused = 0;
    for (const long nth : places(count, most)) {
      SCOPED_TRACE(testing::Message() << "allocation " << nth << " of " << count
                                      << (all_that_follow ? " and all that follow" : ""));
      scene.reset();
      const Outcome outcome = run_with(
          scene, {{"SIMDBEZIER_FAIL_FROM", std::to_string(nth)},
                  {"SIMDBEZIER_FAIL_TO", all_that_follow ? "999999999" : std::to_string(nth)}});
      scene.expect_sound(outcome);
      refused += outcome.exit_code == 1 ? 1 : 0;
    }
    EXPECT_GT(refused, 0) << "no allocation failed";
  }
};

TEST_P(ProgramMemory, FailsOnce) {
  Scene scene(*GetParam(), GetParam()->out[0] == 'o');
  fail(scene, 40, false);
}

TEST_P(ProgramMemory, FailsForGood) {
  Scene scene(*GetParam(), GetParam()->out[0] == 'o');
  fail(scene, 40, true);
}

INSTANTIATE_TEST_SUITE_P(Jobs, ProgramMemory, ::testing::ValuesIn(job_pointers()),
                         [](const auto& each) { return std::string(each.param->name); });

} // namespace
} // namespace simdbezier::tests::program_memory_test
