// RIB files whose patches have no known place: they are refused with the line of what hides it.
#include <gtest/gtest.h>

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "tests/program/formats/format_files.hpp"

namespace simdbezier::tests::rib_unplaced_test {
namespace {

// @ is a patch.
const std::string kPatch = "Patch \"bilinear\" \"P\" [0 0 0 1 0 0 0 1 0 1 1 0]";

struct Unplaced {
  const char* name;
  std::vector<std::string> lines;
  std::size_t line;    ///< that is named
  const char* message; ///< which begins with it, behind "expected "
};
void PrintTo(const Unplaced& item, std::ostream* out) { *out << item.name; }

std::vector<Unplaced> unknown() {
  return {
      {"Perspective",
       {"WorldBegin", "Perspective 90", "@"},
       2,
       "a known affine transformation of the patch in line 3, found 'Perspective'"},
      {"Deformation", {"Deformation \"bend\" \"k\" [1]", "@"}, 1, "a known affine"},
      {"Projective", {"Transform [1 0 0 0 0 1 0 1 0 0 1 0 0 0 0 1]", "@"}, 1, "a known affine"},
      {"Homogeneous",
       {"@", "ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2]", "@"},
       2,
       "a known affine transformation of the patch in line 3, found 'ConcatTransform'"},
      {"NoAxis", {"Rotate 1 0 0 0", "@"}, 1, "a known affine"},
      {"SkewBeyondItsAxes", {"Skew 45 0 1 0 1 1 0", "@"}, 1, "a known affine"},
      {"SkewBackBeyondItsAxes", {"Skew -135 0 1 0 1 1 0", "@"}, 1, "a known affine"},
      {"SkewAlongItsAxis", {"Skew 10 0 1 0 0 2 0", "@"}, 1, "a known affine"},
      {"UnknownName", {"CoordSysTransform \"a\"", "@"}, 1, "a known affine"},
      {"NameOfTheCamera",
       {"CoordinateSystem \"a\"", "WorldBegin", "CoordSysTransform \"a\"", "@"},
       3,
       "a known affine"},
      {"NameOfAnObject",
       {"ObjectBegin 1", "CoordinateSystem \"a\"", "ObjectEnd", "CoordSysTransform \"a\"", "@"},
       4,
       "a known affine"},
      {"NameInAScope",
       {"ScopedCoordinateSystem \"a\"", "CoordSysTransform \"a\"", "@"},
       2,
       "a known affine"},
      {"NameInAnObject",
       {"ObjectBegin 1", "CoordSysTransform \"world\"", "@"},
       2,
       "a known affine"},
      {"MarkedUnknown",
       {"Perspective 9", "CoordinateSystem \"a\"", "Identity", "CoordSysTransform \"a\"", "@"},
       1,
       "a known affine"},
      {"FirstOfTwo", {"Perspective 90", "Perspective 80", "@"}, 1, "a known affine"},
      {"BeforeAScope",
       {"Perspective 90", "AttributeBegin", "Scale 2 2 2", "@"},
       1,
       "a known affine"},
      {"InTheSecondScope",
       {"TransformBegin", "@", "TransformEnd", "TransformBegin", "Perspective 90", "@"},
       5,
       "a known affine"},
      {"OfAnInstance",
       {"ObjectBegin 1", "@", "ObjectEnd", "Perspective 90", "ObjectInstance 1"},
       4,
       "a known affine transformation of the object in line 5, found 'Perspective'"},
      {"NotFinite",
       {"Scale 1e200 1 1", "Scale 1e200 1 1", "@"},
       2,
       "transformations whose product is finite"},
      {"PointNotFinite",
       {"Translate 1e308 0 0", "Translate 7e307 0 0", "Scale 1e308 1 1", "@"},
       4,
       "a point that its transformations leave finite"},
      {"TooFewNumbers", {"Translate 1 0", "@"}, 1, "3 numbers behind Translate, found 2"},
      {"TooFewInArray", {"Translate [1 0]", "@"}, 1, "3 numbers behind Translate, found 2"},
      {"Moving",
       {"MotionBegin [0 1]", "@"},
       1,
       "a Patch, PatchMesh or NuPatch, found 'MotionBegin'"},
      {"Archive", {"ArchiveBegin \"a\"", "@", "ArchiveEnd"}, 1, "a Patch, PatchMesh or NuPatch"}};
}

std::vector<Unplaced> misplaced() {
  return {
      {"SecondFrame",
       {"FrameBegin 1", "WorldBegin", "@", "WorldEnd", "FrameEnd", "FrameBegin 2", "@"},
       6,
       "patches in one frame or world only"},
      {"SecondWorld",
       {"WorldBegin", "@", "WorldEnd", "WorldBegin", "@", "WorldEnd"},
       4,
       "patches in one frame or world only"},
      {"EndWithoutBegin", {"@", "TransformEnd"}, 2, "TransformBegin before it"},
      {"OtherEnd",
       {"AttributeBegin", "TransformBegin", "@", "AttributeEnd"},
       4,
       "TransformEnd for line 2, found 'AttributeEnd'"},
      {"ObjectInObject",
       {"ObjectBegin 1", "@", "ObjectBegin 2"},
       3,
       "ObjectEnd, found 'ObjectBegin'"},
      {"WorldInObject", {"ObjectBegin 1", "@", "WorldBegin"}, 3, "ObjectEnd, found 'WorldBegin'"},
      {"OpenObject", {"ObjectBegin 1", "@"}, 2, "ObjectEnd, found the end of the file"},
      {"OpenScopeInObject",
       {"ObjectBegin 1", "AttributeBegin", "@", "ObjectEnd"},
       4,
       "AttributeEnd for line 2, found 'ObjectEnd'"},
      {"UnknownObject", {"@", "ObjectInstance 1"}, 2, "an object (ObjectBegin) that ended before"},
      {"ObjectInItself", {"ObjectBegin 1", "@", "ObjectInstance 1"}, 3, "an object (ObjectBegin)"},
      {"ObjectIsShownByInstances", {"ObjectBegin 1", "@", "ObjectEnd"}, 3, "a patch (Patch"},
      {"NoName", {"ObjectBegin", "@"}, 2, "a name behind ObjectBegin, found 'Patch'"},
      {"NoSide", {"Orientation \"left\"", "@"}, 1, "\"outside\", \"inside\", \"lh\" or \"rh\""},
      {"HandInAnObject",
       {"ObjectBegin 1", "Orientation \"lh\""},
       2,
       "\"outside\" or \"inside\" in an object"}};
}

class UnplacedTest : public ::testing::TestWithParam<Unplaced> {};

TEST_P(UnplacedTest, IsRefusedWithItsLine) {
  const Unplaced& item = GetParam();
  std::string text;
  for (const std::string& line : item.lines) {
    text += (line == "@" ? kPatch : line) + "\n";
  }
  const std::string message = refusal("rib", text);
  const std::string expected = ":" + std::to_string(item.line) + ": expected " + item.message;
  EXPECT_TRUE(message.starts_with(expected)) << message;
}

INSTANTIATE_TEST_SUITE_P(Unknown, UnplacedTest, ::testing::ValuesIn(unknown()),
                         [](const auto& test) { return std::string(test.param.name); });
INSTANTIATE_TEST_SUITE_P(Misplaced, UnplacedTest, ::testing::ValuesIn(misplaced()),
                         [](const auto& test) { return std::string(test.param.name); });

// Objects of objects could be any number of patches in few characters.
TEST(RibInstances, AreLimited) {
  std::string text = "ObjectBegin 0\n" + kPatch + "\nObjectEnd\n";
  for (int k = 1; k <= 40; ++k) {
    const std::string before = "ObjectInstance " + std::to_string(k - 1) + "\n";
    text += "ObjectBegin " + std::to_string(k) + "\n" + before + before + "ObjectEnd\n";
  }
  const std::string message = refusal("rib", text + "ObjectInstance 40\n");
  EXPECT_NE(message.find("expected instances of at most 4210688 points, found more"),
            std::string::npos)
      << message;
}

} // namespace
} // namespace simdbezier::tests::rib_unplaced_test
