// Command lines that the program refuses, and the ways in which words may stand.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests::usage_test {
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
  const std::string command =
      "expected tessellate, evaluate, info, convert, plan, join or --help, found ";
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
      {"OutputWithoutName", tessellate({"-o"}),
       "-o: expected a name that ends in .obj, .ply, .stl, .glb, .vtu or .raw, or - with --to, "
       "found the "
       "end "
       "of the command line"},
      {"CsvWithoutName",
       {"evaluate", "builtin:teapot", "-o"},
       "-o: expected a name that ends in .csv, or - for standard output, found the end of the"},
      {"FormatWithoutName",
       {"info", "builtin:teapot", "--format"},
       "--format: expected bez, bpt, bv, iges, itd, obj, rib or sbp, found the end of the command "
       "line"},
      {"GridWithoutValue", tessellate_obj({"--grid"}),
       "--grid: expected N or NUxNV, each from 2 to "
       "1048576, found the end of the command line"},
      {"OptionForValue", tessellate({"-o", "--grid", "4"}),
       "-o: expected a name that ends in .obj, .ply, .stl, .glb, .vtu or .raw, or - with --to, "
       "found "
       "'--grid'"},
      {"OptionForOptionsValue", tessellate_obj({"--threads", "--grid=4"}),
       "--threads: expected 1 to 1024, or 0 for as many as pay, found '--grid=4'"},
      {"FlagWithValue",
       {"info", "builtin:teapot", "--json=3"},
       "--json: expected no value, found '3'"},
      {"OtherFlagWithValue", tessellate_obj({"--no-normals=false"}),
       "--no-normals: expected no value, found 'false'"},
      {"FlagTwice",
       {"info", "builtin:teapot", "--json", "--json"},
       "--json: expected once, found 2 times"},
      {"FlagWithEmptyValue",
       {"info", "builtin:teapot", "--json="},
       "--json: expected no value, found ''"},
      {"StatsEmpty", tessellate_obj({"--stats="}), "--stats: expected text or json, found ''"},
      {"GridEmptyBehindEquals", tessellate_obj({"--grid=", "4"}), grid + "'"},
      {"OutputEmptyBehindEquals", tessellate({"-o="}),
       "-o: expected a name that ends in .obj, .ply, .stl, .glb, .vtu or .raw, or - with --to, "
       "found ''"},
      {"OutputBehindEquals", tessellate({"-o=x.obj"}),
       "-o: expected a name that ends in .obj, .ply, .stl, .glb, .vtu or .raw, or - with --to, "
       "found "
       "'=x.obj'"},
      {"FormatOfBuiltin",
       {"info", "builtin:teapot", "--format", "obj"},
       "--format: expected with a file, found 'builtin:teapot'"},
      {"FormatOfBuiltinMesh", tessellate_obj({"--format", "bez"}),
       "--format: expected with a file, found 'builtin:teapot'"},
      {"OutputTwice", tessellate_obj({"-o", "other.obj"}), "-o: expected once, found 2 times"},
      {"NoInput",
       {"info"},
       "IN: expected builtin:teapot, the name of a file or - for standard input, found nothing"},
      {"EmptyInput",
       {"info", ""},
       "IN: expected builtin:teapot, the name of a file or - for standard input, found ''"},
      {"TwoInputs",
       {"info", "builtin:teapot", "b.bez"},
       "info: expected one IN, found 'b.bez' behind 'builtin:teapot'"},
      {"UnknownBuiltin", {"info", "builtin:cup"}, "expected builtin:teapot"},
      {"StandardInputWithoutFormat", {"info", "-"}, "--format"},
      {"UnknownFormat",
       {"info", "-", "--format", "xyz"},
       "--format: expected bez, bpt, bv, iges, itd, obj, rib or sbp, found 'xyz'"},
      {"EmptyFormat", {"info", "-", "--format", ""}, "--format"},
      {"LaterFormat",
       {"info", "-", "--format", "step"},
       "--format: reading .step files is not supported yet"},
      {"NoOutput", tessellate({}),
       "-o: expected a name that ends in .obj, .ply, .stl, .glb, .vtu or .raw, or - with --to, "
       "found "
       "nothing"},
      {"NoOutputOfCsv",
       {"evaluate", "builtin:teapot"},
       "-o: expected a name that ends in .csv, or - for standard output, found nothing"},
      {"UnknownOutput", tessellate({"-o", "out.xyz"}),
       "expected a name that ends in .obj, .ply, .stl, .glb, .vtu or .raw"},
      {"GltfOfManyFiles", tessellate({"-o", "out.gltf"}),
       "or - with --to, found 'out.gltf' (.glb is the form of glTF that is one file)"},
      {"GltfOfManyFilesByName", tessellate({"-o", "-", "--to", "gltf"}),
       "--to: expected obj, ply, stl, glb, vtu or raw, found 'gltf' (.glb is the form"},
      {"OutputWithoutExtension", tessellate({"-o", "obj"}), "expected a name that ends in"},
      {"MeshToStandardOutput", tessellate({"-o", "-"}), "expected a name that ends in"},
      {"PatchesToStandardOutput",
       {"convert", "builtin:teapot", "-o", "-"},
       "-o: expected a name that ends in .bez, .bpt, .obj or .sbp, or - with --to, found '-'"},
      {"PatchesWithoutExtension",
       {"convert", "builtin:teapot", "-o", "out"},
       "-o: expected a name that ends in .bez, .bpt, .obj or .sbp, or - with --to, found 'out'"},
      {"PatchesOfUnknownFormat",
       {"convert", "builtin:teapot", "-o", "-", "--to", "ply"},
       "--to: expected bez, bpt, obj or sbp, found 'ply'"},
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
      {"GridTwice", tessellate_obj({"--grid", "4", "--grid", "5"}),
       "--grid: expected once, found 2 times"},
      {"GridEmpty", tessellate_obj({"--grid", ""}), grid},
      {"GridBeyondLimit", tessellate_obj({"--grid", "1048577"}), grid},
      {"GridBeyondIntegers", tessellate_obj({"--grid", "18446744073709551618"}), grid},
      {"GridBeyondMemory", tessellate_obj({"--grid", "1048576", "--no-weld"}), "bytes of results"},
      {"GridBeyondMemoryInCsv", evaluate({"--grid", "200000"}), "bytes of results"},
      {"GridBeyondIndices", tessellate_ply({"--grid", "11586", "--no-weld"}),
       "--grid: expected at most 4294967295 vertices, found 4295532672"},
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
      {"SamplesAndGrid", evaluate({"--samples", "s.csv", "--grid", "4"}),
       "--samples: expected without --grid, found both"},
      {"StandardInputTwice",
       {"evaluate", "-", "--format", "bez", "--samples", "-", "-o", "-"},
       "found standard input, which IN is read from"},
      {"SamplesEmpty", evaluate({"--samples", ""}), "--samples: expected the name of a CSV file"},
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
                 ".obj, .rib or .sbp, or --format");
  for (const std::string later : {"step", "stp", "pov"}) {
    const std::string name = folder.write("in." + later, "1\n");
    expect_failure(run({"info", name}), 2,
                   name + ": reading ." + later + " files is not supported yet");
  }
}

TEST(Usage, WordsMayStandInManyWays) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out.ply");
  const std::vector<std::vector<std::string>> commands = {
      {"tessellate", "builtin:teapot", "-o", out},
      {"tessellate", "-o", out, "builtin:teapot"},
      {"tessellate", "-o" + out, "builtin:teapot"},
      {"tessellate", "-o", out, "--", "builtin:teapot"},
      {"tessellate", "builtin:teapot", "-o", out, "--grid=16", "--threads=1"}};
  std::string first;
  for (const std::vector<std::string>& command : commands) {
    expect_silent_success(run(command));
    first = first.empty() ? read_file(out) : first;
    EXPECT_TRUE(read_file(out) == first);
  }
}

TEST(Usage, AnswersThatCannotBeWrittenAreFailures) {
  const std::vector<std::vector<std::string>> answers = {{"--help"},
                                                         {"--version"},
                                                         {"info", "--help"},
                                                         {"info", "builtin:teapot"},
                                                         {"info", "builtin:teapot", "--json"},
                                                         {"evaluate", "builtin:teapot", "-o", "-"}};
  for (const auto& arguments : answers) {
    expect_failure(run(arguments, {.append_path = "/dev/full"}), 1,
                   "standard output: expected room to write, found 'No space left on device'");
    expect_failure(run(arguments, {.append_path = "closed"}), 1,
                   "standard output: expected room to write, found 'Bad file descriptor'");
  }
}

} // namespace
} // namespace simdbezier::tests::usage_test
