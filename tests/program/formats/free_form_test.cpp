// Meshes of several patches: RIB's PatchMesh and OBJ's composite surfaces, and what else these two
// formats allow in more than one way.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/formats/sample_nets.hpp"

namespace simdbezier::tests::free_form_test {
namespace {

/// The x coordinates of a patch, which in these tests are numbers of points.
std::vector<int> numbers(const tools::PatchFile& file, std::size_t patch) {
  std::vector<int> result;
  for (const WeightedPoint& point : patch_points(file, patch)) {
    result.push_back(static_cast<int>(point.x));
  }
  return result;
}

/// The numbers of a patch whose rows begin at `rows` and have points `columns` further on.
std::vector<int> expected(const std::vector<int>& rows, const std::vector<int>& columns) {
  std::vector<int> result;
  for (const int row : rows) {
    for (const int column : columns) {
      result.push_back(row + column);
    }
  }
  return result;
}

std::string numbered(int count, const std::string& before, const std::string& after) {
  std::string text;
  for (int k = 0; k < count; ++k) {
    text += before + std::to_string(k) + " " + std::to_string(k % 5) + " 1" + after;
  }
  return text;
}

struct Mesh {
  const char* name;
  const char* head; ///< from the type to the wraps, behind an optional Basis
  int points;
  std::vector<std::vector<int>> patches;
};
void PrintTo(const Mesh& mesh, std::ostream* out) { *out << mesh.name; }

std::vector<Mesh> meshes() {
  const std::vector<int> first = {0, 1, 2, 3};
  const std::vector<int> second = {3, 4, 5, 6};
  return {
      {"Open",
       "PatchMesh \"bicubic\" 7 \"nonperiodic\" 4 \"nonperiodic\"",
       28,
       {expected({0, 7, 14, 21}, first), expected({0, 7, 14, 21}, second)}},
      {"OpenInV",
       "PatchMesh \"bicubic\" 4 \"nonperiodic\" 7 \"nonperiodic\"",
       28,
       {expected({0, 4, 8, 12}, first), expected({12, 16, 20, 24}, first)}},
      {"TwoByTwo",
       "PatchMesh \"bicubic\" 7 \"nonperiodic\" 7 \"nonperiodic\"",
       49,
       {expected({0, 7, 14, 21}, first), expected({0, 7, 14, 21}, second),
        expected({21, 28, 35, 42}, first), expected({21, 28, 35, 42}, second)}},
      {"ClosedInU",
       "PatchMesh \"bicubic\" 6 \"periodic\" 4 \"nonperiodic\"",
       24,
       {expected({0, 6, 12, 18}, first), expected({0, 6, 12, 18}, {3, 4, 5, 0})}},
      {"ClosedInV",
       "PatchMesh \"bicubic\" 4 \"nonperiodic\" 6 \"periodic\"",
       24,
       {expected({0, 4, 8, 12}, first), expected({12, 16, 20, 0}, first)}},
      {"ClosedInBoth",
       "PatchMesh \"bicubic\" 3 \"periodic\" 3 \"periodic\"",
       9,
       {expected({0, 3, 6, 0}, {0, 1, 2, 0})}},
      {"StepFour",
       "Basis \"bezier\" 4 \"bezier\" 3 PatchMesh \"bicubic\" 8 \"nonperiodic\" 4 \"nonperiodic\"",
       32,
       {expected({0, 8, 16, 24}, first), expected({0, 8, 16, 24}, {4, 5, 6, 7})}},
      {"BasisAsMatrix",
       "Basis [-1 3 -3 1 3 -6 3 0 -3 3 0 0 1 0 0 0] 3 \"bezier\" 3 PatchMesh \"bicubic\" 4 "
       "\"nonperiodic\" 4 \"nonperiodic\"",
       16,
       {expected({0, 4, 8, 12}, first)}},
      {"BilinearOpen",
       "PatchMesh \"bilinear\" 3 \"nonperiodic\" 2 \"nonperiodic\"",
       6,
       {{0, 1, 3, 4}, {1, 2, 4, 5}}},
      {"BilinearClosed",
       "PatchMesh \"bilinear\" 3 \"periodic\" 2 \"nonperiodic\"",
       6,
       {{0, 1, 3, 4}, {1, 2, 4, 5}, {2, 0, 5, 3}}},
      {"Patch", "Patch \"bicubic\"", 16, {expected({0, 4, 8, 12}, first)}},
      {"PatchInAnyStep",
       "Basis \"bezier\" 1 \"bezier\" 1 Patch \"bicubic\"",
       16,
       {expected({0, 4, 8, 12}, first)}},
  };
}

class PatchMeshTest : public ::testing::TestWithParam<Mesh> {};

TEST_P(PatchMeshTest, IsCutIntoItsPatches) {
  const Mesh& mesh = GetParam();
  const tools::PatchFile file =
      read_text("rib", mesh.head + (" \"P\" [" + numbered(mesh.points, "", " ")) + "]");
  ASSERT_EQ(file.count, mesh.patches.size());
  for (std::size_t p = 0; p < file.count; ++p) {
    EXPECT_EQ(numbers(file, p), mesh.patches[p]) << "patch " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(All, PatchMeshTest, ::testing::ValuesIn(meshes()),
                         [](const auto& test) { return std::string(test.param.name); });

// Bézier points are those of the file, others are not.
TEST(Rib, BasisEndsWithItsScope) {
  const std::string patch = "Patch \"bicubic\" \"P\" [" + numbered(16, "", " ") + "]\n";
  const std::string other = "Basis \"power\" 4 \"power\" 4\n";
  const std::vector<int> bezier = expected({0, 4, 8, 12}, {0, 1, 2, 3});
  const auto first = [&](const std::string& text) { return numbers(read_text("rib", text), 0); };
  EXPECT_EQ(first("AttributeBegin\n" + other + "AttributeEnd\n" + patch), bezier);
  EXPECT_EQ(first(other + "Basis \"bezier\" 3 \"bezier\" 3\n" + patch), bezier);
  EXPECT_NE(first("AttributeBegin\n" + other + patch), bezier);
  EXPECT_NE(first("TransformBegin\n" + other + "TransformEnd\n" + patch), bezier);
}

// Coefficients of powers may be anything, as long as weights of Bézier points are above 0. Those of
// points that are means of the file's have to be above 0 themselves.
TEST(Rib, WeightsCountAsBezierPoints) {
  const auto text = [](const char* basis, const char* other, const char* last) {
    std::string points;
    for (int k = 0; k < 15; ++k) {
      points += std::string("0 0 0 ") + other + " ";
    }
    return std::string("Basis \"") + basis + "\" 1 \"" + basis + "\" 1 Patch \"bicubic\" \"Pw\" [" +
           points + "2 4 6 " + last + "]";
  };
  const tools::PatchFile file = read_text("rib", text("power", "0", "2"));
  EXPECT_EQ(patch_points(file, 0), std::vector<WeightedPoint>(16, {1, 2, 3, 2}));
  EXPECT_EQ(refusal("rib", text("power", "0", "-2")),
            ":1: expected values whose Bézier points have weights above 0, found -2");
  EXPECT_EQ(refusal("rib", text("b-spline", "0", "1")), ":1: expected a weight above 0, found '0'");
  EXPECT_NE(refusal("rib", text("catmull-rom", "-1", "1")), "");
}

struct RibBasisText {
  const char* name;
  const char* other; ///< another way to write it; four decimals mean the named basis
};

TEST(Rib, MatricesOfNamedBasesAreThese) {
  const RibBasisText cases[] = {
      {"\"b-spline\"", "[-.1667 .5 -.5 .1667 .5 -1 .5 0 -.5 0 .5 0 .16667 .66667 .16667 0]"},
      {"\"catmull-rom\"", "[-.5 1.5 -1.5 .5 1 -2.5 2 -.5 -.5 0 .5 0 0 1 0 0]"},
      {"\"hermite\"", "[2 1 -2 1 -3 -2 3 -1 0 1 0 0 1 0 0 0]"},
      {"\"power\"", "[1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]"}};
  const std::string patch = "Patch \"bicubic\" \"P\" [" + numbered(16, "", " ") + "]\n";
  for (const auto& [name, other] : cases) {
    const std::string behind = std::string(" 1 \"bezier\" 3 ") + patch;
    const auto points = [&](const char* basis) {
      return patch_points(read_text("rib", std::string("Basis ") + basis + behind), 0);
    };
    EXPECT_EQ(points(name), points(other)) << name;
  }
}

// n points in step s are (n - 4) / s + 1 patches, or n / s where they are closed.
TEST(Rib, StepsSayHowManyPatches) {
  struct Case {
    const char* basis;
    const char* u;
    const char* v;
    int points;
    std::size_t patches;
  };
  const Case cases[] = {
      {"\"b-spline\" 1 \"b-spline\" 1", "6 \"nonperiodic\"", "5 \"periodic\"", 30, 15},
      {"\"hermite\" 2 \"bezier\" 3", "8 \"nonperiodic\"", "7 \"nonperiodic\"", 56, 6},
      {"\"hermite\" 2 \"power\" 4", "6 \"periodic\"", "8 \"nonperiodic\"", 48, 6},
      {"\"power\" 4 \"catmull-rom\" 1", "4 \"periodic\"", "4 \"nonperiodic\"", 16, 1},
      {"[0 0 0 0 0 0 0 0 -1 1 0 0 1 0 0 0] 1 \"bezier\" 4", "5 \"nonperiodic\"", "8 \"periodic\"",
       40, 4}};
  for (const auto& [basis, u, v, points, patches] : cases) {
    const std::string text = std::string("Basis ") + basis + " PatchMesh \"bicubic\" " + u + " " +
                             v + " \"P\" [" + numbered(points, "", " ") + "]";
    EXPECT_EQ(read_text("rib", text).count, patches) << text;
  }
}

std::string composite(const std::string& type, const std::string& degrees, int points,
                      const std::string& parameters) {
  std::string text = numbered(points, "v ", " 2\n") + "cstype " + type + "\ndeg " + degrees + "\n";
  text += "surf 0 1 0 1";
  for (int k = 1; k <= points; ++k) {
    text += ' ';
    text += std::to_string(k);
  }
  return text + "\n" + parameters + "end\n";
}

TEST(Obj, CompositeSurfacesShareRowsAndColumns) {
  const tools::PatchFile file =
      read_text("obj", composite("bezier", "2 1", 5 * 4, "parm u 0 0.5 1\nparm v 0 0.25 0.5 1\n"));
  ASSERT_EQ(file.count, 6U);
  EXPECT_EQ(file.runs.size(), 1U);
  EXPECT_EQ(file.runs[0].degree_u, 2);
  EXPECT_EQ(file.runs[0].degree_v, 1);
  for (int v = 0; v < 3; ++v) {
    for (int u = 0; u < 2; ++u) {
      EXPECT_EQ(numbers(file, static_cast<std::size_t>(v * 2 + u)),
                expected({5 * v, 5 * v + 5}, {2 * u, 2 * u + 1, 2 * u + 2}));
    }
  }
}

TEST(Obj, WeightsCountWhereTheTypeIsRational) {
  const std::string parameters = "parm u 0 1\nparm v 0 1\n";
  EXPECT_EQ(patch_points(read_text("obj", composite("bezier", "1 1", 4, parameters)), 0)[1],
            (WeightedPoint{1, 1, 1, 1}));
  EXPECT_EQ(patch_points(read_text("obj", composite("rat bezier", "1 1", 4, parameters)), 0)[1],
            (WeightedPoint{1, 1, 1, 2}));
  // Without a type of its own, a surface has the last one's.
  const std::string two = composite("rat bezier", "1 1", 4, parameters) +
                          "surf 0 1 0 1 -4 -3 -2 -1\n" + parameters + "end\n";
  EXPECT_EQ(read_text("obj", two).runs.at(0).count, 2U);
  // Weights that nothing uses do not matter.
  EXPECT_EQ(refusal("obj", "v 0 0 0 -1\n" + replaced(composite("rat bezier", "1 1", 4, parameters),
                                                     "1 2 3 4", "-4 -3 -2 -1")),
            "");
  EXPECT_EQ(refusal("obj", replaced(composite("bezier", "1 1", 4, parameters), "1 2\n", "1 0\n")),
            "");
}

TEST(Obj, JoinsContinuedLines) {
  const std::string text = composite("bezier", "1 1", 4, "parm u 0 1\nparm v 0 1\n");
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string joined =
        replaced(replaced(text, "surf 0 1", "surf 0 \\" + end + "1"), "1 2 3 4",
                 "1\\" + end + " 2 \\" + end + "\\" + end + " 3 4");
    EXPECT_EQ(patch_points(read_text("obj", joined), 0), patch_points(read_text("obj", text), 0));
  }
}

} // namespace
} // namespace simdbezier::tests::free_form_test
