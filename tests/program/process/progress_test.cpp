// The bar: what fits on a line, and that it is gone when the program is.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <ostream>
#include <thread>

#include <tools/process/progress.hpp>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests::progress_test {
namespace {

constexpr const char* kCleared = "\r\x1b[K";

TEST(ProgressLine, NeverExceedsTheTerminal) {
  for (std::size_t columns = 0; columns < 100; ++columns) {
    for (const std::uint64_t total : {0ULL, 1ULL, 1000ULL}) {
      for (const std::uint64_t done : {0ULL, 1ULL, 999ULL, 1000ULL, 18446744073709551615ULL}) {
        EXPECT_LE(tools::progress_line("evaluating", "samples", done, total, columns).size(),
                  columns);
      }
    }
  }
}

TEST(ProgressLine, ShowsWhatThereIsRoomFor) {
  const auto line = [](std::size_t columns, std::uint64_t total = 200) {
    return tools::progress_line("reading", "bytes", 100, total, columns);
  };
  EXPECT_EQ(line(80), "reading [" + std::string(20, '#') + std::string(20, ' ') + "]  50 %");
  EXPECT_EQ(line(23), "reading [###    ]  50 %");
  EXPECT_EQ(line(14), "reading  50 %");
  EXPECT_EQ(line(6), " 50 %");
  EXPECT_EQ(line(3), "");
  EXPECT_EQ(line(80, 0), "reading 100 bytes");
  EXPECT_EQ(line(12, 0), "100 bytes");
  EXPECT_EQ(line(80, 50), "reading [" + std::string(40, '#') + "] 100 %") << "a file that grows";
}

TEST(ProgressLine, SaysHowLongItTakesWhereThereIsRoom) {
  const auto line = [](std::size_t columns, double seconds) {
    return tools::progress_line("tessellating", "patches", 50, 200, columns, seconds);
  };
  EXPECT_EQ(line(80, 9),
            "tessellating [" + std::string(10, '#') + std::string(30, ' ') + "]  25 %, 9 s left");
  EXPECT_TRUE(line(80, 59.1).ends_with(", 1 min 0 s left"));
  EXPECT_TRUE(line(80, 200).ends_with(", 3 min 20 s left"));
  EXPECT_TRUE(line(80, 7500).ends_with(", 2 h 5 min left"));
  EXPECT_TRUE(line(80, 1e300).ends_with(" min left"));
  EXPECT_EQ(line(28, 9), "tessellating  25 %, 9 s left");
  EXPECT_EQ(line(27, 9), "tessellating [#     ]  25 %");
  for (std::size_t columns = 0; columns < 100; ++columns) {
    EXPECT_LE(line(columns, 7500).size(), columns);
  }
}

// Shows after a second of work, with the next block that arrives.
void read_for_long(Program& program) {
  const std::string block = "0 " + std::string(70000, ' ');
  program.feed("1000000 " + block);
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  program.feed(block);
  program.await_on_terminal("reading ");
}

TEST(Progress, IsClearedByAnInterruption) {
  for (const int number : {SIGINT, SIGTERM, SIGQUIT}) {
    Program program({"info", "-", "--format", "bez"}, {.columns = 80});
    read_for_long(program);
    kill(program.id(), number);
    const Outcome outcome = program.finish();
    EXPECT_EQ(outcome.signal, number);
    EXPECT_TRUE(outcome.err.ends_with(kCleared)) << outcome.err;
  }
}

TEST(Progress, IsClearedBeforeAMessage) {
  Program program({"info", "-", "--format", "bez"}, {.columns = 30});
  read_for_long(program);
  program.feed("word\n");
  const Outcome outcome = program.finish();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find(std::string(kCleared) + "simdbezier: standard input:1: expected"),
            std::string::npos)
      << outcome.err;
  const std::size_t bar = outcome.err.find("reading ");
  EXPECT_LT(outcome.err.find('\x1b', bar) - bar, 30U) << "wider than the terminal";
}

TEST(Progress, IsNotShownAmongData) {
  Program program({"evaluate", "builtin:teapot", "--samples", "-", "-o", "/dev/stderr"},
                  {.columns = 80});
  std::string block; // as many samples as are evaluated at once
  for (int k = 0; k < 65536; ++k) {
    block += "0,0,0\n";
  }
  std::thread feeder([&] {
    program.feed("patch,u,v\n" + block);
    std::this_thread::sleep_for(std::chrono::milliseconds(1200));
    program.feed(block + "31,0,0\n");
    program.close_input();
  });
  program.await_on_terminal("\n31,");
  feeder.join();
  const Outcome outcome = program.finish();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
  EXPECT_EQ(outcome.err.find("samples"), std::string::npos);
}

} // namespace
} // namespace simdbezier::tests::progress_test
