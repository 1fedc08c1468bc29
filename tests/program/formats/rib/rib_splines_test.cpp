// NuPatch in RIB files: its patches, what trims it, and what is wrong with it.
#include <gtest/gtest.h>

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <tools/process/failure.hpp>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::rib_splines_test {
namespace {

// x = 1, 3, 5, 9 along u at the knots 0 0 0 1 2 2 2, y = 0, 1 across.
const std::string kHead = "NuPatch 4 3 [0 0 0 1 2 2 2] 0 2 2 2 [0 0 1 1] 0 1 ";
const std::string kPoints = "\"P\" [1 0 0 3 0 0 5 0 0 9 0 0  1 1 0 3 1 0 5 1 0 9 1 0]\n";
const std::string kSpline = kHead + kPoints;

/// Points of a patch, x and y in turns.
using Points = std::vector<double>;

Points points_of(const tools::PatchFile& file, std::size_t patch) {
  Points points;
  for (const WeightedPoint& point : patch_points(file, patch)) {
    points.insert(points.end(), {point.x, point.y});
  }
  return points;
}

struct Spline {
  const char* name;
  std::string text;
  std::vector<Points> patches;
};
void PrintTo(const Spline& item, std::ostream* out) { *out << item.name; }

std::vector<Spline> splines() {
  const Points first = {1, 0, 3, 0, 4, 0, 1, 1, 3, 1, 4, 1};
  const Points second = {4, 0, 5, 0, 9, 0, 4, 1, 5, 1, 9, 1};
  const std::string object = "ObjectBegin 1\n" + kSpline + "ObjectEnd\n";
  return {
      {"TwoSpans", kSpline, {first, second}},
      {"SecondHalfOfEach", // f[.5,.5] = (f[0,.5] + f[1,.5]) / 2 = (2 + 3.5) / 2
       "NuPatch 4 3 [0 0 0 1 2 2 2] 0.5 2 2 2 [0 0 1 1] .5 1 " + kPoints,
       {{2.75, .5, 3.5, .5, 4, .5, 2.75, 1, 3.5, 1, 4, 1},
        {4, .5, 5, .5, 9, .5, 4, 1, 5, 1, 9, 1}}},
      {"Weights",
       replaced(kHead, "4 3 [0 0 0 1 2 2 2] 0 2", "2 2 [0 0 3 3] 0 3") +
           "\"Pw\" [1 0 0 1 6 0 0 2  4 4 0 4  3 1 0 1]",
       {{1, 0, 3, 0, 1, 1, 3, 1}}},
      {"Moved",
       "Translate 10 0 0\n" + kSpline,
       {{11, 0, 13, 0, 14, 0, 11, 1, 13, 1, 14, 1}, {14, 0, 15, 0, 19, 0, 14, 1, 15, 1, 19, 1}}},
      {"Turned",
       "ReverseOrientation\n" + kSpline,
       {{1, 0, 1, 1, 3, 0, 3, 1, 4, 0, 4, 1}, {4, 0, 4, 1, 5, 0, 5, 1, 9, 0, 9, 1}}},
      {"InAnObject",
       object + "Translate 0 5 0\nObjectInstance 1\n",
       {{1, 5, 3, 5, 4, 5, 1, 6, 3, 6, 4, 6}, {4, 5, 5, 5, 9, 5, 4, 6, 5, 6, 9, 6}}},
      {"BesideAPatch",
       "Patch \"bilinear\" \"P\" [0 0 0 1 0 0 0 1 0 1 1 0]\n" + kSpline,
       {{0, 0, 1, 0, 0, 1, 1, 1}, first, second}}};
}

class RibSplineTest : public ::testing::TestWithParam<Spline> {};

TEST_P(RibSplineTest, HasItsPatches) {
  const Spline& item = GetParam();
  const tools::PatchFile file = read_text("rib", item.text);
  ASSERT_EQ(file.count, item.patches.size());
  for (std::size_t p = 0; p < file.count; ++p) {
    EXPECT_EQ(points_of(file, p), item.patches[p]) << p;
  }
}

INSTANTIATE_TEST_SUITE_P(All, RibSplineTest, ::testing::ValuesIn(splines()),
                         [](const auto& test) { return std::string(test.param.name); });

struct SplineFault {
  const char* name;
  const char* part; ///< of a NuPatch in line 2, which is replaced
  const char* text;
  const char* message;
};
void PrintTo(const SplineFault& item, std::ostream* out) { *out << item.name; }

constexpr SplineFault kFaults[] = {
    {"FewPoints", "4 3", "2 3", "3 points or more of order 3 in u, found 2"},
    {"OrderOne", "4 3", "4 1", "the order in u (2 to 16), found '1'"},
    {"OrderTooLarge", "2 2 [", "2 17 [", "the order in v (2 to 16), found '17'"},
    {"PointsHuge", "4 3", "4294967296 3", "the number of points in u (2 to 2147483648)"},
    {"KnotMissing", "1 2 2 2]", "1 2 2]", "7 knots for 4 points of order 3 in u, found 6"},
    {"KnotTooMany", "0 0 1 1]", "0 0 1 1 1]", "4 knots for 2 points of order 2 in v, found 5"},
    {"KnotDecreases", "0 1 2 2 2]", "3 1 2 2 2]", "ascending knots in u, found 1 behind 3"},
    {"KnotTooOften", "1 2 2 2]", "2 2 2 2]", "every knot at most 3 times in u, found 2 once more"},
    {"KnotHuge", "[0 0 0", "[-1e302 0 0", "knots of 2^1000 at most in u, found -1e+302"},
    {"KnotNan", "[0 0 0", "[0 nan 0", "a knot in u, or ']' for the array in line 2, found 'nan'"},
    {"KnotsOpen", "2 2] 0 2", "2 2 0 2", "a knot in u, or ']' for the array in line 2, found '['"},
    {"RangeEmpty", "] 0 2 2", "] 1 1 2", "a largest parameter in u above 1, found '1'"},
    {"RangeOutside", "] 0 2 2", "] 0 3 2", "a range inside of 0 to 2 in u, found 0 to 3"},
    {"RangeMissing", "] 0 2 2 2 [", "] 0 [", "a finite number, found '['"},
    {"PointMissing", "9 1 0]", "9 1]", "8 points of 3 numbers, found ']' after 23 numbers"},
    {"PointTooMany", "9 1 0]", "9 1 0 0]", "']' after 8 points of 3 numbers, found '0'"},
    {"NoPoints", "\"P\"", "\"st\"", "\"P\" or \"Pw\" of the patch"},
    {"Weight", "\"P\" [1 0 0 3", "\"Pw\" [1 0 0 -3", "a weight above 0, found '-3'"}};

class SplineFaultTest : public ::testing::TestWithParam<SplineFault> {};

TEST_P(SplineFaultTest, IsRefusedWithItsLine) {
  const SplineFault& fault = GetParam();
  const std::string message =
      refusal("rib", "WorldBegin\n" + replaced(kSpline, fault.part, fault.text));
  EXPECT_TRUE(message.starts_with(std::string(":2: expected ") + fault.message)) << message;
}

INSTANTIATE_TEST_SUITE_P(All, SplineFaultTest, ::testing::ValuesIn(kFaults),
                         [](const auto& test) { return std::string(test.param.name); });

// The knot 1 stands in the file as 1 and 1.000001: two spans, or three.
TEST(RibSplines, KnotsWithinAToleranceAreOne) {
  const std::string text = replaced(kSpline, "4 3 [0 0 0 1 2 2 2]", "5 3 [0 0 0 1 1.000001 2 2 2]");
  const std::string points =
      replaced(text, "[1 0 0 3 0 0 5 0 0 9 0 0  1 1 0 3 1 0 5 1 0 9 1 0]",
               "[1 0 0 3 0 0 4 0 0 5 0 0 9 0 0  1 1 0 3 1 0 4 1 0 5 1 0 9 1 0]");
  const TemporaryFolder folder;
  const std::string in = folder.write("in.rib", points);
  const auto patches = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"info", in, "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return nlohmann::json::parse(run(arguments).out).at("patches").get<int>();
  };
  EXPECT_EQ(patches({}), 3);
  EXPECT_EQ(patches({"--knot-tolerance", "1e-7"}), 3);
  EXPECT_EQ(patches({"--knot-tolerance", "1e-5"}), 2);
  // What is merged is said, and knots that are one are counted once.
  const std::string said = "simdbezier: --knot-tolerance made different knots of 1 spline one\n";
  const Outcome merged = run({"info", in, "--knot-tolerance", "1e-5"});
  EXPECT_EQ(merged.err, said);
  EXPECT_NE(
      merged.out.find("2 x 1 patches, 3 x 2 different knots\nmerged knots       of 1 spline\n"),
      std::string::npos)
      << merged.out;
  const Outcome apart = run({"info", in, "--knot-tolerance", "1e-7"});
  EXPECT_EQ(apart.err, "");
  EXPECT_NE(apart.out.find("3 x 1 patches, 4 x 2 different knots\ncontrol"), std::string::npos)
      << apart.out;
  const std::vector<std::string> tolerance = {"--knot-tolerance", "1e-5"};
  const auto json =
      nlohmann::json::parse(run({"info", in, "--json", tolerance[0], tolerance[1]}).out);
  EXPECT_EQ(json["merged_splines"], 1);
  EXPECT_EQ(json["splines"][0]["u"]["knots"], (std::vector<double>{0, 0, 0, 1, 1, 2, 2, 2}));
  const std::string out = folder.path("out.ply");
  for (const std::vector<std::string>& shard : {std::vector<std::string>{}, {"--shard", "1/2"}}) {
    std::vector<std::string> arguments = {"tessellate",   in,   tolerance[0], tolerance[1],
                                          "--stats=json", "-o", out};
    arguments.insert(arguments.end(), shard.begin(), shard.end());
    const Outcome mesh = run(arguments);
    EXPECT_EQ(mesh.err, said);
    EXPECT_EQ(nlohmann::json::parse(mesh.out)["merged_splines"], 1);
  }
  const Outcome wide = run({"info", in, "--knot-tolerance", "1.5"});
  EXPECT_EQ(wide.exit_code, 1);
  EXPECT_NE(wide.err.find(":1: expected"), std::string::npos) << wide.err;
  for (const char* const found : {"0", "-1", "nan", "x"}) {
    const Outcome refused = run({"info", in, "--knot-tolerance", found});
    EXPECT_NE(refused.err.find("--knot-tolerance: expected a number above 0, found"),
              std::string::npos)
        << refused.err;
  }
}

/// A polygon in the plane of parameters; w is 1.
std::string polygon(const std::vector<double>& u, const std::vector<double>& v) {
  std::string knots = "0 ";
  std::string lists[3];
  for (std::size_t k = 0; k < u.size(); ++k) {
    knots += std::to_string(k) + " ";
    lists[0] += std::to_string(u[k]) + " ";
    lists[1] += std::to_string(v[k]) + " ";
    lists[2] += "1 ";
  }
  const std::string last = std::to_string(u.size() - 1);
  const std::string count = std::to_string(u.size());
  return "TrimCurve [1] [2] [" + knots + last + "] [0] [" + last + "] [" + count + "] [" +
         lists[0] + "] [" + lists[1] + "] [" + lists[2] + "]\n";
}

struct Trim {
  const char* name;
  std::string text; ///< in front of the NuPatch
  bool is_refused;
};
void PrintTo(const Trim& item, std::ostream* out) { *out << item.name; }

std::vector<Trim> trims() {
  const std::string around = polygon({0, 2, 2, 0, 0}, {0, 0, 1, 1, 0});
  const std::string part = polygon({0, 1, 1, 0, 0}, {0, 0, 1, 1, 0});
  const std::string lines = "TrimCurve [4] [2 2 2 2] [0 0 1 1 0 0 1 1 0 0 1 1 0 0 1 1] [0 0 0 0] "
                            "[1 1 1 1] [2 2 2 2] [0 2 2 2 2 0 0 0] [0 0 0 1 1 1 1 0] "
                            "[1 1 1 1 1 1 1 1]\n";
  return {
      {"Around", around, false},
      {"AroundTheOtherWay", polygon({0, 0, 2, 2, 0}, {0, 1, 1, 0, 0}), false},
      {"AroundFromASide", polygon({1, 2, 2, 1, 0, 0, 0, 1}, {0, 0, 1, 1, 1, .25, 0, 0}), false},
      {"AroundInLines", lines, false},
      {"AroundInWeightedLines", replaced(lines, "[0 2 2", "[0 4 2"), true},
      {"WeightsOfLines",
       replaced(replaced(lines, "[0 2 2 2 2", "[0 4 2 6 2"), "[0 0 0 1 1 1 1 0] [1 1 1 1",
                "[0 0 0 3 1 1 1 0] [1 2 1 3"),
       false},
      {"LinesInAnotherOrder", replaced(lines, "[0 2 2 2 2 0 0 0]", "[2 0 2 2 2 0 0 0]"), true},
      {"PartOfALine", replaced(lines, "[0 0 0 0] [1", "[.5 0 0 0] [1"), true},
      {"Part", part, true},
      {"ACornerLess", polygon({0, 2, 2, 0}, {0, 0, 1, 0}), true},
      {"Outside", polygon({-1, 2, 2, -1, -1}, {0, 0, 1, 1, 0}), true},
      {"Inside", polygon({0, 2, 2, 0, 0}, {0, 0, .999, 1, 0}), true},
      {"Open", polygon({0, 2, 2, 0}, {0, 0, 1, 1}), true},
      {"Twice", polygon({0, 2, 2, 0, 0, 2, 2, 0, 0}, {0, 0, 1, 1, 0, 0, 1, 1, 0}), true},
      {"BackAndForth", polygon({0, 2, 1, 2, 2, 0, 0}, {0, 0, 0, 0, 1, 1, 0}), true},
      {"Curved", "TrimCurve [1] [3] [0 0 0 1 1 1] [0] [1] [3] [0 2 0] [0 0 0] [1 1 1]\n", true},
      {"TwoLoops",
       "TrimCurve [1 1] [2 2] [0 0 1 1 0 0 1 1] [0 0] [1 1] [2 2] [0 2 2 0] [0 1 1 0] [1 1 1 1]\n",
       true},
      {"OtherSense", around + "Attribute \"trimcurve\" \"sense\" [\"outside\"]\n", true},
      {"Cancelled", part + "TrimCurve [] [] [] [] [] [] [] [] []\n", false},
      {"Replaced", part + around, false},
      {"InAScope", "AttributeBegin\n" + part + "AttributeEnd\n", false},
      {"InATransformScope", "TransformBegin\n" + part + "TransformEnd\n", true},
      {"InAnObject", "ObjectBegin 1\n" + part + "ObjectEnd\nObjectInstance 1\n", false}};
}

class TrimTest : public ::testing::TestWithParam<Trim> {};

tools::PatchFile read_ignoring(const std::string& text) {
  const TemporaryFolder folder;
  return tools::read_patches(folder.write("in.rib", text), tools::PatchFormat::rib,
                             {.ignore_trims = true});
}

TEST_P(TrimTest, IsRefusedUnlessAllIsLeft) {
  const Trim& item = GetParam();
  const std::string text = item.text + kSpline;
  const std::string message = refusal("rib", text);
  EXPECT_EQ(!message.empty(), item.is_refused) << message;
  if (item.is_refused) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(item.text, '\n'));
    const std::string expected = ": expected no part of the NuPatch in line " +
                                 std::to_string(lines + 1) +
                                 " (--ignore-trims reads all of it), found 'TrimCurve'";
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  }
  const tools::PatchFile file = read_ignoring(text);
  EXPECT_EQ(file.count, 2U);
  EXPECT_EQ(file.ignored_trims, item.is_refused ? 1U : 0U);
}

INSTANTIATE_TEST_SUITE_P(All, TrimTest, ::testing::ValuesIn(trims()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Trims, HaveListsThatFitTogether) {
  const std::string around = polygon({0, 2, 2, 0, 0}, {0, 0, 1, 1, 0});
  struct Case {
    const char* part;
    const char* text;
    const char* message;
  };
  const Case cases[] = {
      {"[1]", "[1 1]", "2 numbers (the order of each curve of the TrimCurve), found 1"},
      {"[1]", "[0]", "a number of curves of the TrimCurve (1 or more), found 0"},
      {"[2]", "[1.5]", "an order of the TrimCurve (2 or more), found 1.5"},
      {"4 4]", "4]", "7 numbers (the knots of each curve of the TrimCurve), found 6"},
      {"[0] [4]", "[0] []", "1 number (the end of each curve of the TrimCurve), found 0"},
      {"[5]", "[4]", "6 numbers (the knots of each curve"},
      {"[5]", "[-5]", "a number of points of the TrimCurve (2 or more), found -5"},
      {"[5]", "Sphere", "the number of points of each curve of the TrimCurve, found 'Sphere'"},
      {"[5]", "[Sphere]", "the number of points of each curve of the TrimCurve, or ']'"}};
  for (const auto& [part, text, message] : cases) {
    const std::string found = refusal("rib", replaced(around, part, text) + kSpline);
    EXPECT_TRUE(found.starts_with(std::string(":1: expected ") + message)) << found;
  }
}

// End to end: what every command says about surfaces that are more than the file's.
TEST(Trims, ThatAreIgnoredAreCounted) {
  const TemporaryFolder folder;
  const std::string part = polygon({0, 1, 1, 0, 0}, {0, 0, 1, 1, 0});
  const std::string in = folder.write("in.rib", part + kSpline + kSpline);
  const std::string said = "simdbezier: 2 trimmed surfaces were read as a whole\n";
  const Outcome info = run({"info", in, "--json", "--ignore-trims"});
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_EQ(info.err, said);
  EXPECT_EQ(nlohmann::json::parse(info.out)["ignored_trims"], 2);
  EXPECT_NE(run({"info", in, "--ignore-trims"}).out.find("ignored trims      2\n"),
            std::string::npos);
  const Outcome mesh =
      run({"tessellate", in, "--ignore-trims", "--stats=json", "-o", folder.path("out.obj")});
  EXPECT_EQ(mesh.err, said);
  EXPECT_EQ(nlohmann::json::parse(mesh.out)["ignored_trims"], 2);
  EXPECT_EQ(run({"evaluate", in, "--ignore-trims", "-o", folder.path("out.csv")}).err, said);
  expect_failure(run({"info", in}), 1, "simdbezier: " + in + ":1: expected no part of the NuPatch");
}

} // namespace
} // namespace simdbezier::tests::rib_splines_test
