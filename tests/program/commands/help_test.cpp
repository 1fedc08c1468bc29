// What the program says of itself.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests::help_test {
namespace {

const std::vector<std::string> kCommands = {"tessellate", "evaluate", "info", "convert", "plan"};

std::string help_of(const std::string& command) {
  const Outcome outcome = run({command, "--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(run({command, "-h"}).out, outcome.out);
  EXPECT_EQ(run({command, "--help", "IN", "--bogus"}).out, outcome.out);
  return outcome.out;
}

TEST(Help, AndVersionAreAnswers) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--help"}, "usage: simdbezier COMMAND"},
      {{"-h"}, "tessellate IN -o OUT [options]"},
      {{"--version"}, "simdbezier 0."}};
  for (const auto& [arguments, part] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
  }
}

TEST(Help, HasExamplesRangesDefaultsAndExitCodes) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"tessellate",
       {"N or NUxNV, each from 2 to 1048576", "(default 16)", "1 to 1024, or 0 for as many as pay",
        "(default f32", "rounded to float first", "--no-normals",
        ".obj, .ply, .stl, .glb, .vtu or .raw", "at most 4097 a direction in one mesh without gaps",
        "a device or pipe needs --to"}},
      {"evaluate",
       {"position, du, dv, duu, duv, dvv, normal, curvature", "(default position)",
        "they come in the order named here", "patch,x,y with x = 2u-1",
        "Samples of every patch (default 16): N or", "may be a device or pipe"}},
      {"info", {"--json", "bez, bpt, bv, iges, itd, obj, rib or sbp"}}};
  for (const auto& [command, parts] : cases) {
    std::string help = help_of(command);
    EXPECT_NE(help.find("Examples:\n  simdbezier " + command), std::string::npos) << help;
    EXPECT_NE(help.find("Exit codes: 0 done, 1 bad input, bad number or failed write, 2 other bad "
                        "usage.\n"),
              std::string::npos);
    for (std::size_t at = help.find("\n                        "); at != std::string::npos;
         at = help.find("\n                        ")) {
      help.replace(at, 25, " "); // lines that go on
    }
    for (const std::string& part : parts) {
      EXPECT_NE(help.find(part), std::string::npos) << part << "\n" << help;
    }
  }
}

// Every option that help lists is one, and needs what help says.
TEST(Help, ListsNoOptionThatIsNotThere) {
  for (const std::string& command : kCommands) {
    const std::string help = help_of(command);
    EXPECT_EQ(help.find("not supported"), std::string::npos) << help;
    std::size_t options = 0;
    for (std::size_t at = help.find("\n  --"); at != std::string::npos;
         at = help.find("\n  --", at + 1)) {
      const std::string name = help.substr(at + 3, help.find_first_of(" [\n", at + 3) - at - 3);
      const Outcome outcome = run({command, "builtin:teapot", name, "--bogus"});
      EXPECT_EQ(outcome.err.find("found '" + name + "'"), std::string::npos) << outcome.err;
      ++options;
    }
    EXPECT_GE(options, 2U) << help;
  }
}

TEST(Help, HasExamplesThatRun) {
  const TemporaryFolder folder;
  for (const std::string& command : kCommands) {
    const std::string help = help_of(command);
    const std::size_t at = help.find("  simdbezier " + command + " builtin:teapot");
    ASSERT_NE(at, std::string::npos) << help;
    std::vector<std::string> words;
    std::istringstream line(help.substr(at, help.find('\n', at) - at));
    for (std::string word; line >> word;) {
      words.push_back(words.size() > 1 && words.back() == "-o" ? folder.path(word) : word);
    }
    words.erase(words.begin());
    EXPECT_EQ(run(words).exit_code, 0) << help;
  }
}

TEST(Help, KeepsToTheTerminal) {
  std::string all = run({"--help"}).out;
  for (const std::string& command : kCommands) {
    all += help_of(command);
  }
  std::istringstream lines(all);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(),
              line.starts_with("  simdbezier ") || line.starts_with("  printf") ? 100U : 82U)
        << line; // examples are not broken; an accent is two characters here
  }
}

} // namespace
} // namespace simdbezier::tests::help_test
