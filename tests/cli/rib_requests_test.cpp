// Requests of RIB files: which are passed over, and that no unknown one is.
#include <gtest/gtest.h>

#include <string>

#include "tests/cli/format_files.hpp"
#include "tools/rib_requests.hpp"

namespace simdbezier::tests {
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
        RibCase{"Numbers", "Translate 0 -.5 +1e-3 ", ""},
        RibCase{"Strings", "Option \"limits\" \"bucketsize\" [32 32] ", ""},
        RibCase{"Arrays", "Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] ", ""},
        RibCase{"LowerCase", "version 3.04 ", ""},
        RibCase{"Added", "Bxdf \"PxrDiffuse\" \"d\" \"color diffuseColor\" [1 1 1] ", ""},
        RibCase{"Misspelt", "Pacth \"bilinear\" \"P\" [0 0 0 1 0 0 0 1 0 1 1 0] ", "Pacth"},
        RibCase{"CutOff", "P ", "P"}, RibCase{"PartOfAName", "Begin ", "Begin"},
        RibCase{"ByteOrderMarkInside", " \xef\xbb\xbf", "\\xef\\xbb\\xbfPatch"},
        RibCase{"Binary", "\xcc\x05 ", "\\xcc\\x05"},
        RibCase{"Compressed", "\x1f\x8b\x08 ", "\\x1f\\x8b\\x08"},
        RibCase{"StrayBracket", "Translate 0 0 5 ] ", "]"}),
    [](const auto& item) { return item.param.name; });

TEST(RibRequest, IsInOneListOnly) {
  static_assert(tools::is_listed("version", tools::kRibPassedOver));
  static_assert(!tools::is_listed("Light", tools::kRibOtherGeometry));
  static_assert(!tools::is_listed("Archive", tools::kRibPassedOver));
  EXPECT_FALSE(tools::is_listed("MotionBegin", tools::kRibPassedOver));
  EXPECT_TRUE(tools::is_listed("MotionBegin", tools::kRibOtherGeometry));
}

} // namespace
} // namespace simdbezier::tests
