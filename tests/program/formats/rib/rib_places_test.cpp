// Where transformations, objects and orientation put the patches of RIB files. Right values were
// worked out by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::rib_places_test {
namespace {

using Point = std::array<double, 3>;
using Points = std::array<Point, 4>;

// @ is this patch. Its points A, B, C, D are at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
const std::string kPatch = "Patch \"bilinear\" \"P\" [0 0 0  1 0 0  0 2 0  1 2 3]";
constexpr Points kThere = {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 3}}};

Points moved(double x, double y, double z) {
  Points points = kThere;
  for (Point& point : points) {
    point = {point[0] + x, point[1] + y, point[2] + z};
  }
  return points;
}

Points turned(const Points& points) { return {points[0], points[2], points[1], points[3]}; }

std::string scene(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += (line == "@" ? kPatch : line) + "\n";
  }
  return text;
}

struct RibScene {
  const char* name;
  std::vector<std::string> lines;
  std::vector<Points> patches;
};
void PrintTo(const RibScene& item, std::ostream* out) { *out << item.name; }

const std::string kOne = "[1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]";
const std::string kMatrix = "[1 2 0 0  0 1 0 0  0 0 -2 0  7 8 9 1]"; // x (1,2,0) + y + z (0,0,-2)
constexpr Points kByMatrix = {{{7, 8, 9}, {8, 10, 9}, {7, 10, 9}, {8, 12, 3}}};
constexpr Points kQuarter = {{{0, 0, 0}, {0, 1, 0}, {-2, 0, 0}, {-2, 1, 3}}}; // x to y

std::vector<RibScene> transformations() {
  const double h = std::sqrt(0.75);
  const double s = 1 / std::sqrt(2.0);
  const double third = 1 / 3.0;
  const double skew = 0.5 * (1 + std::sqrt(3.0)); // sin 30 / (2 sin 45 sin 15 sqrt(2) / 2)
  return {
      {"Nothing",
       {"Translate 0 0 0", "Rotate 0 0 0 0", "Scale 1 1 1", "Skew 0 0 1 0 1 0 0", "Identity",
        "Transform " + kOne, "ConcatTransform " + kOne, "@"},
       {kThere}},
      {"Translate", {"Translate 10 -.5 1e1", "@"}, {moved(10, -0.5, 10)}},
      {"TranslateArray", {"Translate [0 0 1]", "@"}, {moved(0, 0, 1)}},
      {"QuarterTurn", {"Rotate 90 0 0 2", "@"}, {kQuarter}},
      {"QuartersBack", {"Rotate -630 0 0 1e-300", "@"}, {kQuarter}},
      {"Turn",
       {"Rotate 30 0 0 1", "@"},
       {{{{0, 0, 0}, {h, 0.5, 0}, {-1, 2 * h, 0}, {h - 1, 0.5 + 2 * h, 3}}}}},
      {"EighthTurnAboutX",
       {"Rotate 45 1 0 0", "@"},
       {{{{0, 0, 0}, {1, 0, 0}, {0, 2 * s, 2 * s}, {1, -s, 5 * s}}}}},
      {"AboutTheDiagonal",
       {"Rotate 120 3 3 3", "@"}, // x to y to z to x
       {{{{0, 0, 0}, {0, 1, 0}, {0, 0, 2}, {3, 1, 2}}}}},
      {"HalfTurnAboutTheDiagonal",
       {"Rotate 180 1e200 1e200 1e200", "@"},
       {{{{0, 0, 0},
          {-third, 2 * third, 2 * third},
          {4 * third, -2 * third, 4 * third},
          {3, 2, 1}}}}},
      {"Scale", {"Scale 2 3 4", "@"}, {{{{0, 0, 0}, {2, 0, 0}, {0, 6, 0}, {2, 6, 12}}}}},
      {"Flat", {"Scale 1 1 0", "@"}, {{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0}}}}},
      {"Skew", {"Skew 45 0 1 0 1 0 0", "@"}, {{{{0, 0, 0}, {1, 0, 0}, {2, 2, 0}, {3, 2, 3}}}}},
      {"SkewOfSlantedAxes", // y is turned by 30 degrees towards x + y, which stays
       {"Skew [30 0 5 0 1 1 0]", "@"},
       {{{{0, 0, 0}, {1 - skew, -skew, 0}, {2 * skew, 2 + 2 * skew, 0}, {1 + skew, 2 + skew, 3}}}}},
      {"ConcatTransform", {"ConcatTransform " + kMatrix, "@"}, {turned(kByMatrix)}},
      {"Transform", {"Scale 2 2 2", "Transform " + kMatrix, "@"}, {turned(kByMatrix)}},
      {"LastOneFirst",
       {"Translate 1 0 0", "Rotate 90 0 0 1", "@"},
       {{{{1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 3}}}}},
      {"MovedBack", {"Translate 1 0 0", "Translate -1 0 0", "@"}, {kThere}},
      {"PutBack", {"Translate 1 0 0", "Scale 1 1 -1", "Identity", "@"}, {kThere}},
      {"Mesh",
       {"Translate 0 0 1", "PatchMesh \"bilinear\" 3 \"nonperiodic\" 2 \"nonperiodic\" \"P\" "
                           "[0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0]"},
       {{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}},
        {{{1, 0, 1}, {2, 0, 1}, {1, 1, 1}, {2, 1, 1}}}}},
      {"Weights", // S = (0,0,0) (1,0,0) (0,2,0) (1,2,3) with weights 1 2 1 4
       {"Translate 1 0 0", "Patch \"bilinear\" \"Pw\" [0 0 0 1 2 0 0 2 0 2 0 1 4 8 12 4]"},
       {moved(1, 0, 0)}}};
}

std::vector<RibScene> scopes() {
  return {
      {"Transforms",
       {"TransformBegin", "Translate 10 0 0", "@", "TransformEnd", "TransformBegin",
        "Translate -10 0 0", "@", "TransformEnd", "@"},
       {moved(10, 0, 0), moved(-10, 0, 0), kThere}},
      {"Nested",
       {"Translate 1 0 0", "AttributeBegin", "Translate 0 1 0", "TransformBegin", "Scale 3 3 3",
        "Identity", "@", "TransformEnd", "@", "AttributeEnd", "@"},
       {kThere, moved(1, 1, 0), moved(1, 0, 0)}},
      {"Solids",
       {"SolidBegin \"union\"", "Translate 1 0 0", "SolidBegin \"primitive\"", "@", "SolidEnd",
        "SolidEnd", "@"},
       {moved(1, 0, 0), kThere}},
      {"Camera",
       {"FrameBegin 1", "Translate 0 0 5", "Scale 1 1 -1", "Perspective 30",
        "Transform [1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0]", "WorldBegin", "@", "WorldEnd", "FrameEnd"},
       {kThere}},
      {"EmptyFrameFirst", {"FrameBegin 1", "FrameEnd", "FrameBegin 2", "@", "FrameEnd"}, {kThere}},
      {"BehindAll", {"@", "Translate 1 0 0"}, {kThere}},
      {"Marked",
       {"Translate 1 0 0", "CoordinateSystem \"a\"", "Translate 1 0 0", "TransformBegin",
        "CoordSysTransform \"a\"", "@", "CoordSysTransform \"world\"", "@", "TransformEnd", "@"},
       {moved(1, 0, 0), kThere, moved(2, 0, 0)}}};
}

std::vector<RibScene> objects() {
  return {
      {"Instances",
       {"Translate 1 0 0", "ObjectBegin 7", "Translate 0 1 0", "@", "ObjectEnd", "ObjectInstance 7",
        "@", "AttributeBegin", "Translate 0 0 1", "ObjectInstance 7", "AttributeEnd"},
       {moved(1, 1, 0), moved(1, 0, 0), moved(1, 1, 1)}},
      {"BeforeTheWorld",
       {"Translate 0 0 5", "ObjectBegin \"a b\"", "@", "ObjectEnd", "WorldBegin", "Translate 1 0 0",
        "ObjectInstance \"a b\"", "WorldEnd"},
       {moved(1, 0, 0)}},
      {"ObjectsOfObjects",
       {"ObjectBegin 1", "Translate 1 0 0", "@", "ObjectEnd", "ObjectBegin 2", "Translate 0 1 0",
        "ObjectInstance 1", "Rotate 90 0 0 1", "ObjectInstance 1", "ObjectEnd", "Translate 0 0 1",
        "ObjectInstance 2"},
       {moved(1, 1, 1), {{{0, 2, 1}, {0, 3, 1}, {-2, 2, 1}, {-2, 3, 4}}}}},
      {"NamedAgain",
       {"ObjectBegin 1", "@", "ObjectEnd", "ObjectInstance 1", "ObjectBegin 1", "Translate 1 0 0",
        "@", "@", "ObjectEnd", "ObjectInstance 1"},
       {kThere, moved(1, 0, 0), moved(1, 0, 0)}},
      {"ScopesInside",
       {"ObjectBegin 1", "AttributeBegin", "Translate 1 0 0", "AttributeEnd", "@", "ObjectEnd",
        "ObjectInstance 1"},
       {kThere}},
      {"Empty", {"ObjectBegin 1", "ObjectEnd", "ObjectInstance 1", "@"}, {kThere}}};
}

std::vector<RibScene> sides() {
  constexpr Points mirrored = {{{0, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {-1, 2, 3}}};
  return {{"Mirrored", {"Scale -1 1 1", "@"}, {turned(mirrored)}},
          {"MirroredTwice", {"Scale -1 1 1", "Scale -1 1 1", "@"}, {kThere}},
          {"TurnedByScales",
           {"Scale -1 -1 1", "@"},
           {{{{0, 0, 0}, {-1, 0, 0}, {0, -2, 0}, {-1, -2, 3}}}}},
          {"Inside",
           {"Orientation \"inside\"", "@", "Orientation \"outside\"", "@"},
           {turned(kThere), kThere}},
          {"InsideAndMirrored", {"Orientation \"inside\"", "Scale -1 1 1", "@"}, {mirrored}},
          {"Reversed",
           {"ReverseOrientation", "@", "ReverseOrientation", "@"},
           {turned(kThere), kThere}},
          {"ReversedInAScope",
           {"TransformBegin", "ReverseOrientation", "TransformEnd", "@", "AttributeBegin",
            "ReverseOrientation", "@", "AttributeEnd", "@"},
           {turned(kThere), kThere, turned(kThere)}},
          {"LeftHand",
           {"Orientation \"lh\"", "@", "Orientation \"rh\"", "@"},
           {kThere, turned(kThere)}},
          {"HandsOfAMirroredSpace", // the space is right-handed: rh is its outside, which is kept
           {"Scale -1 1 1", "Orientation \"rh\"", "@", "Orientation \"lh\"", "@"},
           {turned(mirrored), mirrored}},
          {"HandsOfAMirroredCamera",
           {"Scale 1 1 -1", "WorldBegin", "Orientation \"rh\"", "@", "Orientation \"lh\"", "@"},
           {kThere, turned(kThere)}},
          {"Instances",
           {"ObjectBegin 1", "Scale -1 1 1", "@", "ReverseOrientation", "@", "ObjectEnd",
            "ObjectInstance 1", "Scale -1 1 1", "ObjectInstance 1", "ReverseOrientation",
            "ObjectInstance 1"},
           {turned(mirrored), mirrored, kThere, turned(kThere), turned(kThere), kThere}}};
}

class RibSceneTest : public ::testing::TestWithParam<RibScene> {};

TEST_P(RibSceneTest, HasItsPatchesInTheirPlaces) {
  const RibScene& item = GetParam();
  const tools::PatchFile file = read_text("rib", scene(item.lines));
  ASSERT_EQ(file.count, item.patches.size());
  for (std::size_t p = 0; p < file.count; ++p) {
    const std::vector<WeightedPoint> points = patch_points(file, p);
    for (std::size_t k = 0; k < 4; ++k) {
      const Point& expected = item.patches[p][k];
      const double found[] = {points[k].x, points[k].y, points[k].z};
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(found[c], expected[c], 4e-15) << "patch " << p << ", point " << k << ", " << c;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Transformations, RibSceneTest, ::testing::ValuesIn(transformations()),
                         [](const auto& test) { return std::string(test.param.name); });
INSTANTIATE_TEST_SUITE_P(Scopes, RibSceneTest, ::testing::ValuesIn(scopes()),
                         [](const auto& test) { return std::string(test.param.name); });
INSTANTIATE_TEST_SUITE_P(Objects, RibSceneTest, ::testing::ValuesIn(objects()),
                         [](const auto& test) { return std::string(test.param.name); });
INSTANTIATE_TEST_SUITE_P(Sides, RibSceneTest, ::testing::ValuesIn(sides()),
                         [](const auto& test) { return std::string(test.param.name); });

// Without a request for the other side, meshes keep their order. Otherwise columns become rows.
TEST(RibSide, ExchangesTheDirectionsOfMeshes) {
  const std::string mesh = "PatchMesh \"bilinear\" 3 \"periodic\" 2 \"nonperiodic\" \"P\" "
                           "[0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0]";
  const tools::PatchFile file = read_text("rib", "ReverseOrientation\n" + mesh);
  ASSERT_EQ(file.count, 3U);
  constexpr double expected[3][4] = {{0, 3, 1, 4}, {1, 4, 2, 5}, {2, 5, 0, 3}};
  for (std::size_t p = 0; p < 3; ++p) {
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(patch_points(file, p)[k].x, expected[p][k]);
    }
  }
}

// A tip whose points are 3/1 and 0.3/0.1, moved so that sums cancel, stays one point.
TEST(RibPole, StaysOnePointWhereverItIsMoved) {
  const std::string tip = "NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 \"Pw\" "
                          "[1 0 0 1  0 1 0 1  0 0 3 1  0 0 .3 .1]\n";
  const std::string patch = "Patch \"bilinear\" \"Pw\" [1 0 0 1  0 1 0 1  0 0 3 1  0 0 .3 .1]\n";
  for (const std::string& shape : {tip, patch}) {
    for (const char* const moves :
         {"Translate 0 0 0", "Translate 0 0 -3", "Rotate 45 1 0 0\nTranslate 0 0 -3",
          "Rotate 45 1 0 0\nTranslate 0 3 0", "Rotate 30 1 0 0", "Rotate 45 1 1 0"}) {
      SCOPED_TRACE(moves);
      const Outcome outcome =
          run({"info", "-", "--format", "rib"}, {.input = std::string(moves) + "\n" + shape});
      EXPECT_EQ(outcome.exit_code, 0);
      EXPECT_NE(outcome.out.find("1 collapsed"), std::string::npos) << outcome.out;
    }
  }
}

} // namespace
} // namespace simdbezier::tests::rib_places_test
