// Requests of RIB files: which are passed over, and that no unknown one is.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/program/formats/format_files.hpp"
#include "tools/formats/rib_requests.hpp"

namespace simdbezier::tests::rib_requests_test {
namespace {

const std::string kPatch = "Patch \"bilinear\" \"P\" [0 0 0 1 0 0 0 1 0 1 1 0]\n";

struct RibCase {
  const char* name;
  std::string before; ///< in front of a patch, in line 1
  const char* found;  ///< what the reader names; empty: passed over
};
void PrintTo(const RibCase& item, std::ostream* out) { *out << item.name; }

class RibRequestTest : public ::testing::TestWithParam<RibCase> {};

TEST_P(RibRequestTest, IsKnownOrRefusedWithItsLine) {
  const auto& [name, before, found] = GetParam();
  const std::string text = before + kPatch + kPatch;
  if (std::string(found).empty()) {
    EXPECT_EQ(read_text("rib", text).count, 2U);
  } else {
    EXPECT_EQ(refusal("rib", text),
              std::string(":1: expected a request of .rib files, found '") + found + "'");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Requests, RibRequestTest,
    ::testing::Values(
        RibCase{"Numbers", "Translate 0 -.0 +0e-3 ", ""},
        RibCase{"Strings", "Option \"limits\" \"bucketsize\" [32 32] ", ""},
        RibCase{"Arrays", "Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] ", ""},
        RibCase{"LowerCase", "version 3.04 ", ""},
        RibCase{"Added", "Bxdf \"PxrDiffuse\" \"d\" \"color diffuseColor\" [1 1 1] ", ""},
        RibCase{"Misspelt", "Pacth \"bilinear\" \"P\" [0 0 0 1 0 0 0 1 0 1 1 0] ", "Pacth"},
        RibCase{"CutOff", "P ", "P"}, RibCase{"PartOfAName", "Begin ", "Begin"},
        RibCase{"ByteOrderMarkInside", " \xef\xbb\xbf", "\\xef\\xbb\\xbfPatch"},
        RibCase{"Binary", "\xcc\x05 ", "\\xcc\\x05"},
        RibCase{"StrayBracket", "Translate 0 0 5 ] ", "]"},
        RibCase{"OneNumberTooMany", "Translate 0 0 0 Rotate 0 0 0 1 5 ", ""}),
    [](const auto& item) { return item.param.name; });

// Behind a parameter's name in the list of a patch, and in an array: what is missing there must not
// swallow geometry.
struct RibList {
  const char* name;
  std::string text;
  const char* message; ///< empty: taken
  std::size_t patches = 0;
};
void PrintTo(const RibList& item, std::ostream* out) { *out << item.name; }

std::vector<RibList> rib_lists() {
  const std::string list = "\"P\" [0 0 0 1 0 0 0 1 0 1 1 0] ";
  const std::string head = "Patch \"bilinear\" ";
  const std::string patch = head + list;
  constexpr const char* value = ":1: expected a value of the parameter 'Cs', found ";
  constexpr const char* array = ":1: expected ']' for the array in line 1, found ";
  constexpr const char* behind =
      ":1: expected a parameter's name or a request behind the patch, found ";
  return {
      {"Array", head + "\"st\" [0 1 2 3] " + list + "\"Cs\" [1 0 0] " + patch, "", 2},
      {"OneNumber", patch + "\"Cs\" 1 " + patch, "", 2},
      {"OneString", patch + "\"string name\" \"a\" " + patch, "", 2},
      {"Strings", patch + "\"string name\" [\"a\" \"b\"] " + patch, "", 2},
      {"DeclaredPoints", head + "\"vertex point\tP \"" + list.substr(3) + patch, "", 2},
      {"Numbers", "CropWindow 0 1 0 1 " + patch + "Sides 2 " + patch, "", 2},
      {"UnfinishedOther", "Surface \"plastic\" \"Ka\" " + patch + patch, "", 2},
      {"ValueIsPatch", patch + "\"Cs\" " + patch, value},
      {"ValueIsPatchMesh", patch + "\"Cs\" PatchMesh \"bilinear\" ", value},
      {"ValueIsSphere", patch + "\"Cs\" Sphere 1 -1 1 360", value},
      {"ValueIsRequest", patch + "\"Cs\" AttributeEnd " + patch, value},
      {"ValueIsEnd", patch + "\"Cs\"", value},
      {"ValueIsBracket", patch + "\"Cs\" ] " + patch, value},
      {"ValueBeforePoints", head + "\"Cs\" " + patch, value},
      {"ValueIsName", patch + "\"Cs\" \"st\" [0 0 1 0 0 1 1 1] " + patch, behind},
      {"ValueIsPoints", head + "\"Cs\" " + list + patch,
       ":1: expected \"P\" or \"Pw\" of the patch"},
      {"TwoValues", patch + "\"Cs\" 1 0 0 " + patch, behind},
      {"ArrayTwice", patch + "\"Cs\" [1 0 0] [1 0 0] " + patch, behind},
      {"NumberBehind", patch + "5 " + patch, behind},
      {"ArrayBehind", patch + "[0 0 0] " + patch, behind},
      {"BracketBehind", patch + "] " + patch, behind},
      {"OpenArray", patch + "\"Cs\" [1 0 0 " + patch, array},
      {"OpenArrayAndStrayBracket", patch + "\"Cs\" [1 0 0 " + patch + "] " + patch, array},
      {"ArrayInArray", patch + "\"Cs\" [[1 0 0] [0 1 0]] " + patch, array},
      {"OpenMatrix", "Transform [1 0 0 0 0 1 0 0 " + patch + "] " + patch, array},
      {"OpenStrings", "Option \"searchpath\" \"shader\" [\"a\" " + patch + "] " + patch, array},
      {"HeightsToo", patch + "\"Pz\" [0 0 0 0] " + patch, ":1: expected one of \"P\" and \"Pw\""},
  };
}

class RibListTest : public ::testing::TestWithParam<RibList> {};

TEST_P(RibListTest, LosesNoGeometry) {
  const RibList& item = GetParam();
  if (std::string(item.message).empty()) {
    EXPECT_EQ(read_text("rib", item.text).count, item.patches);
  } else {
    const std::string message = refusal("rib", item.text);
    EXPECT_TRUE(message.starts_with(item.message)) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(All, RibListTest, ::testing::ValuesIn(rib_lists()),
                         [](const auto& test) { return std::string(test.param.name); });

// Where patches are: lines of a scene, of which one is at fault or none. @ stands for a patch.
struct RibPlace {
  const char* name;
  std::vector<std::string> lines;
  std::size_t fault = 0; ///< its line; 0: all patches stand where their points say
  const char* message = "";
};
void PrintTo(const RibPlace& item, std::ostream* out) { *out << item.name; }

std::vector<RibPlace> rib_places() {
  const std::string one = "[1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]";
  const std::string other = "[1 0 0 0 0 1 0 0 0 0 1 0 7 0 0 1]";
  constexpr const char* number = "3 numbers behind Translate, found 2";
  constexpr const char* frame = "patches in one frame or world only, found";
  return {
      {"Translate", {"WorldBegin", "Translate 10 0 0", "@", "WorldEnd"}, 2},
      {"TranslateArray", {"Translate [0 0 1]", "@"}, 1},
      {"Rotate", {"@", "Rotate 30 0 0 1", "@"}, 2},
      {"Scale", {"Scale 1 1 -1", "@"}, 1},
      {"Skew", {"Skew 45 0 1 0 1 0 0", "@"}, 1},
      {"SkewArray", {"Skew [45 0 1 0 1 0 0]", "@"}, 1},
      {"ConcatTransform", {"ConcatTransform " + other, "@"}, 1},
      {"Transform", {"Transform " + other, "@"}, 1},
      {"CoordSysTransform", {"CoordSysTransform \"a\"", "@"}, 1},
      {"Perspective", {"WorldBegin", "Perspective 90", "@"}, 2},
      {"Deformation", {"Deformation \"bend\" \"k\" [1]", "@"}, 1},
      {"FirstOfTwo", {"Translate 1 0 0", "Translate -1 0 0", "@"}, 1},
      {"BeforeAScope", {"Scale 2 2 2", "AttributeBegin", "@", "AttributeEnd"}, 1},
      {"InAScope", {"TransformBegin", "Translate 1 0 0", "@", "TransformEnd"}, 2},
      {"InTheSecondScope",
       {"TransformBegin", "@", "TransformEnd", "TransformBegin", "Scale 3 3 3", "@"},
       5},
      {"BehindAScope", {"Scale 3 3 3", "TransformBegin", "Identity", "@", "TransformEnd", "@"}, 1},
      {"MeshOfPatches",
       {"Translate 1 0 0",
        "PatchMesh \"bilinear\" 2 \"nonperiodic\" 2 \"nonperiodic\" \"P\" [0 0 0 1 "
        "0 0 0 1 0 1 1 0]"},
       1},
      {"Instance", {"ObjectInstance 1", "@"}, 1, "a Patch or PatchMesh, found 'ObjectInstance'"},
      {"TooFewNumbers", {"Translate 1 0", "@"}, 1, number},
      {"TooFewInArray", {"Translate [1 0]", "@"}, 1, number},
      {"SecondFrame",
       {"FrameBegin 1", "WorldBegin", "@", "WorldEnd", "FrameEnd", "FrameBegin 2", "@"},
       6,
       frame},
      {"SecondWorld", {"WorldBegin", "@", "WorldEnd", "WorldBegin", "@", "WorldEnd"}, 4, frame},
      {"Camera", {"Translate 0 0 5", "Rotate 30 1 0 0", "Perspective 30", "WorldBegin", "@"}},
      {"CameraOfAFrame",
       {"FrameBegin 1", "Translate 0 0 5", "WorldBegin", "@", "WorldEnd", "FrameEnd"}},
      {"NothingMoves",
       {"Translate 0 0 0", "Rotate 0 0 0 1", "Scale 1 1 1", "Skew 0 0 1 0 1 0 0", "Identity",
        "Transform " + one, "ConcatTransform " + one, "@"}},
      {"MovedBack", {"Translate 1 0 0", "Identity", "@"}},
      {"PutBack", {"Translate 1 0 0", "Transform " + one, "@"}},
      {"LightsOnly",
       {"TransformBegin", "Translate 1 2 3", "LightSource \"l\" 1", "TransformEnd", "@"}},
      {"BehindAttributes", {"AttributeBegin", "Scale 2 2 2", "AttributeEnd", "@"}},
      {"BehindAll", {"@", "Translate 1 0 0"}},
      {"EmptyFrameFirst", {"FrameBegin 1", "FrameEnd", "FrameBegin 2", "@", "FrameEnd"}},
  };
}

class RibPlaceTest : public ::testing::TestWithParam<RibPlace> {};

TEST_P(RibPlaceTest, IsWhatThePointsSayOrRefusedWithItsLine) {
  const RibPlace& item = GetParam();
  std::string text;
  std::size_t patches = 0;
  for (const std::string& line : item.lines) {
    text += line == "@" ? kPatch : line + "\n";
    patches += line == "@" ? 1 : 0;
  }
  if (item.fault == 0) {
    EXPECT_EQ(read_text("rib", text).count, patches);
    return;
  }
  const std::string line = item.lines[item.fault - 1];
  const std::string message = refusal("rib", text);
  EXPECT_TRUE(message.starts_with(":" + std::to_string(item.fault) + ": expected ")) << message;
  EXPECT_TRUE(message.find(*item.message != 0 ? std::string(item.message)
                                              : "found '" + line.substr(0, line.find(' ')) + "'") !=
              std::string::npos)
      << message;
}

INSTANTIATE_TEST_SUITE_P(All, RibPlaceTest, ::testing::ValuesIn(rib_places()),
                         [](const auto& test) { return std::string(test.param.name); });

// A scope of transformations is none of bases.
TEST(RibPlace, TransformationsEndWithoutBases) {
  const std::string basis = "Basis \"b-spline\" 1 \"b-spline\" 1\n";
  const std::string bicubic = "Patch \"bicubic\" \"P\" [";
  EXPECT_NE(refusal("rib", "TransformBegin\n" + basis + "TransformEnd\n" + bicubic)
                .find("expected a patch in the bezier basis"),
            std::string::npos);
}

TEST(RibRequest, IsInOneListOnly) {
  static_assert(tools::is_listed("version", tools::kRibPassedOver));
  static_assert(!tools::is_listed("Light", tools::kRibOtherGeometry));
  static_assert(!tools::is_listed("Archive", tools::kRibPassedOver));
  EXPECT_FALSE(tools::is_listed("MotionBegin", tools::kRibPassedOver));
  EXPECT_TRUE(tools::is_listed("MotionBegin", tools::kRibOtherGeometry));
}

} // namespace
} // namespace simdbezier::tests::rib_requests_test
