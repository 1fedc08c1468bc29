// Requests of RIB files: which are passed over, and that no unknown one is.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/program/formats/format_files.hpp"
#include "tools/formats/rib/requests.hpp"

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

TEST(RibRequest, IsInOneListOnly) {
  static_assert(tools::is_listed("version", tools::kRibPassedOver));
  static_assert(!tools::is_listed("Light", tools::kRibOtherGeometry));
  static_assert(!tools::is_listed("Archive", tools::kRibPassedOver));
  EXPECT_FALSE(tools::is_listed("MotionBegin", tools::kRibPassedOver));
  EXPECT_TRUE(tools::is_listed("MotionBegin", tools::kRibOtherGeometry));
}

} // namespace
} // namespace simdbezier::tests::rib_requests_test
