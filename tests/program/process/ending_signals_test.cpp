// Whatever ends the program, no temporary file stays, and its parent process sees what ended it.
#include <gtest/gtest.h>

#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests::ending_signals_test {
namespace {

// A program that has begun its output and waits for more samples.
class WaitingProgram {
public:
  explicit WaitingProgram(const std::string& out, Circumstances circumstances = {})
      : program_({"evaluate", "builtin:teapot", "--samples", "-", "-o", out}, circumstances) {
    std::string samples = "patch,u,v\n";
    for (int k = 0; k < 10000; ++k) {
      samples += "0,0.5,0.5\n";
    }
    program_.feed(samples);
  }
  // Until the folder's temporary file is there.
  void await(const TemporaryFolder& folder) const {
    for (int k = 0; k < 1000 && folder.names().empty(); ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_EQ(folder.names().size(), 1U) << "the output was never begun";
    ASSERT_TRUE(folder.names().front().ends_with(".tmp")) << folder.names().front();
  }
  [[nodiscard]] Program& program() { return program_; }

private:
  Program program_;
};

// All whose default is to end the process, with or without a core file.
std::vector<int> ending_signals() {
  std::vector<int> numbers = {SIGHUP,  SIGINT,  SIGQUIT,   SIGILL,  SIGTRAP, SIGABRT, SIGBUS,
                              SIGFPE,  SIGUSR1, SIGSEGV,   SIGUSR2, SIGPIPE, SIGALRM, SIGTERM,
                              SIGXCPU, SIGPROF, SIGVTALRM, SIGPOLL, SIGPWR,  SIGSYS,  SIGSTKFLT};
  numbers.push_back(SIGRTMIN);
  numbers.push_back(SIGRTMAX);
  return numbers;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true; // sanitizers report some of the signals themselves
#else
constexpr bool kSanitized = false;
#endif

class EndingSignalTest : public ::testing::TestWithParam<int> {};

TEST_P(EndingSignalTest, LeavesNothingAndIsSeen) {
  const int number = GetParam();
  if (kSanitized && (number == SIGSEGV || number == SIGBUS || number == SIGFPE ||
                     number == SIGILL || number == SIGABRT || number == SIGTRAP)) {
    GTEST_SKIP() << "the sanitizer's own";
  }
  const TemporaryFolder folder;
  WaitingProgram waiting(folder.path("out.csv"));
  waiting.await(folder);
  kill(waiting.program().id(), number);
  EXPECT_EQ(waiting.program().finish().signal, number);
  EXPECT_TRUE(folder.names().empty()) << folder.names().front() << " was left behind";
}

INSTANTIATE_TEST_SUITE_P(All, EndingSignalTest, ::testing::ValuesIn(ending_signals()),
                         [](const auto& test) { return "Signal" + std::to_string(test.param); });

// What SIGKILL leaves is removed by the next run for the same output, and only that.
TEST(Signals, ThatCannotBeCaughtLeaveWhatTheNextRunRemoves) {
  for (const std::string& name : {std::string("out.csv"), std::string(251, 'n') + ".csv"}) {
    const TemporaryFolder folder;
    const std::string out = folder.path(name);
    {
      WaitingProgram waiting(out);
      waiting.await(folder);
      kill(waiting.program().id(), SIGKILL);
      EXPECT_EQ(waiting.program().finish().signal, SIGKILL);
    }
    ASSERT_EQ(folder.names().size(), 1U);
    const std::string left = folder.names().front();
    EXPECT_TRUE(left.starts_with("." + name.substr(0, 225) + ".simdbezier-")) << left;
    const std::string like_it = folder.write(".out.csv.simdbezier-notes.tmp", "mine");
    const auto make = [&](const std::string& path) {
      expect_silent_success(run({"evaluate", "builtin:teapot", "--grid", "2", "-o", path}));
    };
    make(folder.path("other.csv"));
    EXPECT_TRUE(std::filesystem::exists(folder.path(left)));
    make(out);
    EXPECT_FALSE(std::filesystem::exists(folder.path(left)));
    EXPECT_TRUE(std::filesystem::exists(like_it));
  }
}

TEST(Signals, OrNoneLeaveAloneWhatAnotherRunStillWrites) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out.csv");
  WaitingProgram waiting(out);
  waiting.await(folder);
  const std::string temporary = folder.names().front();
  expect_silent_success(run({"evaluate", "builtin:teapot", "--grid", "2", "-o", out}));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{temporary, "out.csv"}));
  const std::string before = read_file(out);
  expect_silent_success(waiting.program().finish());
  EXPECT_EQ(folder.names(), std::vector<std::string>{"out.csv"});
  EXPECT_NE(read_file(out), before);
}

TEST(Signals, ThatWereIgnoredStayIgnored) {
  const std::vector<int> numbers = {SIGHUP, SIGINT, SIGQUIT, SIGUSR1, SIGALRM, SIGPIPE};
  const TemporaryFolder folder;
  WaitingProgram waiting(folder.path("out.csv"), {.ignored_signals = numbers});
  waiting.await(folder);
  for (const int number : numbers) {
    kill(waiting.program().id(), number);
  }
  expect_silent_success(waiting.program().finish());
  EXPECT_EQ(folder.names(), std::vector<std::string>{"out.csv"});
}

// The moment at which a file exists but is not registered as created yet.
TEST(Signals, RightAfterTheFileWasCreatedLeaveNothing) {
  const TemporaryFolder folder;
  const Outcome outcome = run({"tessellate", "builtin:teapot", "-o", folder.path("out.ply")},
                              {.fault = "termination_at_creation"});
  EXPECT_EQ(outcome.signal, SIGTERM);
  EXPECT_TRUE(folder.names().empty()) << folder.names().front() << " was left behind";
}

// What waits in a temporary file has a name for a moment where a file system cannot do without.
// 6 million vertices are more than memory should hold.
TEST(Signals, BetweenTheNamesOfASpillLeaveNothing) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run({"tessellate", "builtin:teapot", "-o", folder.path("out.stl"), "--grid", "436"},
          {.fault = "termination_at_named_spill"});
  EXPECT_EQ(outcome.signal, SIGTERM);
  EXPECT_TRUE(folder.names().empty()) << folder.names().front() << " was left behind";
}

TEST(Signals, LeaveTheOldFileAsItWas) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.csv", "before");
  const Outcome outcome =
      run({"evaluate", "builtin:teapot", "-o", out}, {.fault = "termination_at_creation"});
  EXPECT_EQ(outcome.signal, SIGTERM);
  EXPECT_EQ(read_file(out), "before");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"out.csv"});
}

// A path of as many characters as the system allows, so that the temporary's would have more.
TEST(Signals, LeaveNothingUnderLongNames) {
  const TemporaryFolder folder;
  constexpr std::size_t kLongest = 4095;
  const std::string name = "o.csv";
  std::string deep = folder.path("");
  while (deep.size() < kLongest - name.size()) {
    const std::size_t rest = kLongest - name.size() - deep.size() - 1;
    deep += std::string(rest > 250 ? 150 : rest, 'd') + "/";
    std::filesystem::create_directory(deep);
  }
  const std::string out = deep + name;
  ASSERT_EQ(out.size(), kLongest);
  const auto count = [&] { return std::distance(std::filesystem::directory_iterator(deep), {}); };
  {
    WaitingProgram waiting(out);
    for (int k = 0; k < 1000 && count() == 0; ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(count(), 1) << "the output was never begun";
    kill(waiting.program().id(), SIGTERM);
    EXPECT_EQ(waiting.program().finish().signal, SIGTERM);
  }
  EXPECT_EQ(count(), 0) << "a file was left behind";
  expect_silent_success(run({"evaluate", "builtin:teapot", "--grid", "2", "-o", out}));
  EXPECT_EQ(count(), 1);
}

} // namespace
} // namespace simdbezier::tests::ending_signals_test
