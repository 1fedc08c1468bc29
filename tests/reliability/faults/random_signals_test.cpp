// Every signal that a program can catch, at random times.
#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/reliability/faults/program_job.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests::random_signals_test {
namespace {

using Clock = std::chrono::steady_clock;

/// All but the two that nobody can catch, and the first and last real-time ones.
std::vector<int> catchable_signals() {
  std::vector<int> list = {SIGRTMIN, SIGRTMAX};
  for (int signal = 1; signal < 32; ++signal) {
    if (signal != SIGKILL && signal != SIGSTOP) {
      list.push_back(signal);
    }
  }
  return list;
}

int wanted_signals() {
  const char* const wish = std::getenv("SIMDBEZIER_SIGNALS");
  return wish != nullptr ? std::atoi(wish) : 62;
}

std::chrono::nanoseconds duration(const Scene& scene) {
  const auto start = Clock::now();
  EXPECT_EQ(run(scene.arguments()).exit_code, 0);
  return Clock::now() - start;
}

void sleep_for(double nanoseconds) {
  const auto whole = static_cast<long>(nanoseconds);
  const timespec time{whole / 1000000000, whole % 1000000000};
  nanosleep(&time, nullptr);
}

Outcome interrupted(const Scene& scene, int signal, double after) {
  // A sanitizer would report our signals as faults of the program.
  Program program(scene.arguments(),
                  {.environment = {{"ASAN_OPTIONS", "handle_segv=0:handle_sigbus=0:handle_sigfpe=0:"
                                                    "handle_sigill=0:handle_abort=0"}}});
  sleep_for(after);
  kill(program.id(), signal);
  kill(program.id(), SIGCONT); // for those that stop it
  return program.finish();
}

TEST(Signals, AtRandomTimesLeaveNothing) {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  const std::vector<int> signals = catchable_signals();
  const Job file{"file", {"tessellate", "--grid", "40", "--threads", "2"}, "out.obj"};
  Scene fresh(file, false);
  Scene replacing(file, true);
  const auto usual = std::max(duration(fresh), duration(replacing));
  Random random(1);
  int ended = 0;
  for (int k = 0; k < wanted_signals(); ++k) {
    const int signal = signals[static_cast<std::size_t>(k) % signals.size()];
    Scene& scene = k / static_cast<int>(signals.size()) % 2 == 0 ? replacing : fresh;
    scene.reset();
    const double after = random.unit() * 1.1 * static_cast<double>(usual.count());
    SCOPED_TRACE(testing::Message() << strsignal(signal) << ", the " << k << "th");
    const Outcome outcome = interrupted(scene, signal, after);
    scene.expect_sound(outcome, signal);
    ended += outcome.signal != 0 ? 1 : 0;
  }
  RecordProperty("signals", wanted_signals());
  RecordProperty("ended_by_them", ended);
  EXPECT_GT(ended, 0) << "every signal came too late";
}

} // namespace
} // namespace simdbezier::tests::random_signals_test
