// Command lines that the program refuses, and those that it answers without any data.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/cli/program.hpp"

namespace simdbezier::tests {
namespace {

struct BadUsage {
  const char* name;
  std::vector<std::string> arguments;
  std::string message;
};
void PrintTo(const BadUsage& item, std::ostream* out) { *out << item.name; }

std::vector<std::string> tessellate(std::vector<std::string> rest) {
  rest.insert(rest.begin(), {"tessellate", "builtin:teapot"});
  return rest;
}
std::vector<std::string> tessellate_obj(std::vector<std::string> rest) {
  rest.insert(rest.begin(), {"tessellate", "builtin:teapot", "-o", "out.obj"});
  return rest;
}
std::vector<std::string> tessellate_ply(std::vector<std::string> rest) {
  rest.insert(rest.begin(), {"tessellate", "builtin:teapot", "-o", "out.ply"});
  return rest;
}
std::vector<std::string> evaluate(std::vector<std::string> rest) {
  rest.insert(rest.begin(), {"evaluate", "builtin:teapot", "-o", "out.csv"});
  return rest;
}

std::vector<BadUsage> bad_usages() {
  const std::string command = "expected tessellate, evaluate, info or --help, found ";
  const std::string grid = "--grid: expected N or NUxNV, each from 2 to 1048576, found '";
  return {
      {"Nothing", {}, command + "nothing"},
      {"UnknownCommand", {"draw", "builtin:teapot"}, command + "'draw'"},
      {"EmptyCommand", {"", "builtin:teapot"}, command + "''"},
      {"OptionForCommand", {"--bogus"}, command + "'--bogus'"},
      {"OptionBeforeCommand", {"--bogus", "info", "builtin:teapot"}, "found '--bogus'"},
      {"UnknownOption",
       {"info", "builtin:teapot", "--bogus", "3"},
       "info: expected what 'simdbezier info --help' lists, found '--bogus'"},
      {"UnknownOptionForOutput", tessellate({"--out", "out.obj"}), "--help' lists, found '--out'"},
      {"OutputWithoutOption", tessellate({"out.obj"}), "found 'out.obj'"},
      {"OptionOfAnotherCommand", {"info", "builtin:teapot", "--grid", "3"}, "found '--grid'"},
      {"OutputWithoutName", tessellate({"-o"}), "-o"},
      {"NoInput", {"info"}, "IN is required"},
      {"EmptyInput",
       {"info", ""},
       "IN: expected builtin:teapot, the name of a file or -, found ''"},
      {"TwoInputs", {"info", "builtin:teapot", "builtin:teapot"}, "builtin:teapot"},
      {"UnknownBuiltin", {"info", "builtin:cup"}, "expected builtin:teapot"},
      {"StandardInputWithoutFormat", {"info", "-"}, "--format"},
      {"UnknownFormat",
       {"info", "-", "--format", "xyz"},
       "--format: expected bez, bpt, bv, itd, obj or rib, found 'xyz'"},
      {"EmptyFormat", {"info", "-", "--format", ""}, "--format"},
      {"LaterFormat",
       {"info", "-", "--format", "step"},
       "reading .step files is not supported yet"},
      {"NoOutput", tessellate({}), "-o is required"},
      {"UnknownOutput", tessellate({"-o", "out.xyz"}), "expected a name that ends in .obj or .ply"},
      {"OutputWithoutExtension", tessellate({"-o", "obj"}), "expected a name that ends in"},
      {"MeshToStandardOutput", tessellate({"-o", "-"}), "expected a name that ends in"},
      {"LaterStl", tessellate({"-o", "out.stl"}), ".stl files is not supported yet"},
      {"LaterGlb", tessellate({"-o", "out.glb"}), ".glb files is not supported yet"},
      {"LaterTolerance", tessellate_obj({"--tolerance", "0.1"}), "not supported yet"},
      {"GridAndTolerance", tessellate_obj({"--tolerance", "0.1", "--grid", "4"}), "excludes"},
      {"GridZero", tessellate_obj({"--grid", "0"}), grid},
      {"GridOne", tessellate_obj({"--grid", "1"}), grid},
      {"GridOneSide", tessellate_obj({"--grid", "4x1"}), grid},
      {"GridOtherSide", tessellate_obj({"--grid", "0x4"}), grid},
      {"GridNegative", tessellate_obj({"--grid", "-4"}), grid},
      {"GridWord", tessellate_obj({"--grid", "fine"}), grid},
      {"GridFraction", tessellate_obj({"--grid", "4.5"}), grid},
      {"GridHalf", tessellate_obj({"--grid", "4x"}), grid},
      {"GridThreeSides", tessellate_obj({"--grid", "4x4x4"}), grid},
      {"GridSpaces", tessellate_obj({"--grid", " 4"}), grid},
      {"GridEmpty", tessellate_obj({"--grid", "4", "--grid", "5"}), "--grid"},
      {"GridBeyondLimit", tessellate_obj({"--grid", "1048577"}), grid},
      {"GridBeyondIntegers", tessellate_obj({"--grid", "18446744073709551618"}), grid},
      {"GridBeyondMemory", tessellate_obj({"--grid", "1048576"}), "bytes of results"},
      {"GridBeyondMemoryInCsv", evaluate({"--grid", "200000"}), "bytes of results"},
      {"GridBeyondPlyIndices", tessellate_ply({"--grid", "8193"}),
       "expected at most 2147483648 vertices in a PLY file, found 2148007968"},
      {"ThreadsNegative", tessellate_obj({"--threads", "-1"}), "--threads: expected 1 to 1024"},
      {"ThreadsWord", tessellate_obj({"--threads", "all"}), "--threads: expected 1 to 1024"},
      {"ThreadsBeyondLimit", tessellate_obj({"--threads", "99999999999"}), "--threads"},
      {"Precision", tessellate_obj({"--precision", "f16"}), "expected f32 or f64, found 'f16'"},
      {"EvaluateUnknownOutput", {"evaluate", "builtin:teapot", "-o", "out.txt"}, "ends in .csv"},
      {"OutputsUnknown", evaluate({"--outputs", "colour"}),
       "expected position, du, dv, duu, duv, dvv, normal, curvature separated by commas, found "
       "'colour'"},
      {"OutputsEmptyItem", evaluate({"--outputs", "position,"}), "expected position, du, dv"},
      {"OutputsThirdDerivative", evaluate({"--outputs", "duu,duuu"}), "found 'duu,duuu'"},
      {"OutputsDvu", evaluate({"--outputs", "dvu"}), "found 'dvu'"},
      {"SamplesAndGrid", evaluate({"--samples", "s.csv", "--grid", "4"}), "excludes"},
      {"StandardInputTwice",
       {"evaluate", "-", "--format", "bez", "--samples", "-", "-o", "-"},
       "standard input is already read"},
  };
}

class BadUsageTest : public ::testing::TestWithParam<BadUsage> {};

TEST_P(BadUsageTest, ExitsTwoWithOneLine) {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path(""));
  expect_failure(run(GetParam().arguments), 2, GetParam().message);
  std::filesystem::current_path(before);
  EXPECT_TRUE(folder.names().empty()) << folder.names().front() << " was left behind";
}

INSTANTIATE_TEST_SUITE_P(All, BadUsageTest, ::testing::ValuesIn(bad_usages()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Usage, InputsOfUnknownOrLaterFormats) {
  const TemporaryFolder folder;
  expect_failure(run({"info", folder.write("in.xyz", "1\n")}), 2,
                 ".itd, .obj or .rib, or --format");
  for (const std::string later : {"iges", "igs", "step", "stp", "pov"}) {
    expect_failure(run({"info", folder.write("in." + later, "1\n")}), 2,
                   "." + later + " files is not supported yet");
  }
}

TEST(Usage, HelpAndVersionAreAnswers) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--help"}, "tessellate"},
      {{"--version"}, "simdbezier 0."},
      {{"tessellate", "--help"}, "--no-normals"},
      {{"evaluate", "--help"}, "rounded to float first"},
      {{"info", "--help"}, "--json"}};
  for (const auto& [arguments, part] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
  }
}

} // namespace
} // namespace simdbezier::tests
