// Sums and products of counts, and files whose counts wrap around where nobody looks.
#include <gtest/gtest.h>

#include <limits>
#include <ostream>

#include <tools/process/counts.hpp>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::counts_test {
namespace {

using tools::Count;

constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kHalf = std::size_t{1} << 32;

TEST(Count, HasAValueWhereItCanBeCounted) {
  EXPECT_EQ((Count(3) * 4 + 5).value(), 17U);
  EXPECT_EQ((Count(kMost) * 1 + 0).value(), kMost);
  EXPECT_EQ((Count(kMost) * 0).value(), 0U);
  EXPECT_TRUE(Count(7).within(7));
  EXPECT_FALSE(Count(8).within(7));
  EXPECT_EQ(to_string(Count(17)), "17");
}

TEST(Count, HasNoneWhereItCannot) {
  const Count wrapped[] = {Count(kHalf) * kHalf,          Count(kMost) + 1,
                           Count(kHalf) * kHalf * 0,      Count(kHalf) * (kHalf / 4) * 4,
                           Count(kMost) + 1 + 0,          Count(kHalf) * kHalf + 1,
                           Count(2) * (Count(kMost) + 1), Count(1) + Count(kMost) * 2};
  for (const Count count : wrapped) {
    EXPECT_FALSE(count.value().has_value());
    EXPECT_FALSE(count.within(kMost));
    EXPECT_EQ(to_string(count), "more than 18446744073709551615");
  }
}

// One thing is no "things".
TEST(Quantity, OfOneIsSingular) {
  struct Case {
    const char* format;
    const char* text;
    const char* message;
  };
  const Case cases[] = {
      {"bez", "1\n7\n",
       ":2: expected 1 patch of 48 coordinates as declared in line 1, found the end of the file "
       "after 0 patches and 1 coordinate"},
      {"bpt", "2 1 1 0 0 0 1 0 0 0 1 0 1 1 0",
       ":1: expected 2 patches as declared in line 1, found the end of the file after 1 patch"},
      {"bpt", "1 1 1 0 0 0 1 0 0 0 1 0 1 1 0 5",
       ":1: expected the end of the file after 1 patch as declared in line 1, found '5'"},
      {"obj", "v 1\n", ":1: expected x y z or x y z w, found 1 number"},
      {"rib", "Patch \"bilinear\" \"P\" [7]",
       ":1: expected 4 points of 3 numbers, found ']' after 1 number"},
      {"rib", "PatchMesh \"bilinear\" 1 \"nonperiodic\" 2 \"nonperiodic\" \"P\" []",
       ":1: expected the number of points in u (2 to 2147483648), found '1'"}};
  for (const auto& [format, text, message] : cases) {
    EXPECT_EQ(refusal(format, text), message);
  }
}

struct HugeFile {
  const char* name;
  const char* format;
  std::string text;
  const char* message;
};
void PrintTo(const HugeFile& item, std::ostream* out) { *out << item.name; }

std::string mesh(const std::string& u, const std::string& v, const std::string& list) {
  return "PatchMesh \"bilinear\" " + u + " \"nonperiodic\" " + v + " \"nonperiodic\" " + list;
}

std::vector<HugeFile> huge_files() {
  const std::string many = "2147483648"; // 2^31: four times its square is 0 in 64 bits
  constexpr const char* counted = ":1: expected a number of coordinates that can be counted";
  return {
      {"WrapsToNone", "rib", mesh(many, many, "\"Pw\" []"), counted},
      {"HardlyFits", "rib", mesh(many, "2147483647", "\"Pw\" []"),
       ":1: expected 4611686016279904256 points of 4 numbers, found ']' after 0 numbers"},
      {"FitsButIsNotThere", "rib", mesh(many, "2", "\"P\" [0 0 0]"),
       ":1: expected 4294967296 points of 3 numbers, found ']' after 3 numbers"},
      {"BeyondPoints", "rib", mesh("2147483649", "2", "\"P\" []"),
       ":1: expected the number of points in u (2 to 2147483648), found '2147483649'"},
      {"BeyondIntegers", "rib", mesh("18446744073709551618", "2", "\"P\" []"),
       ":1: expected the number of points in u (2 to 2147483648), found '18446744073709551618'"},
      {"HugeStep", "rib",
       "Basis \"bezier\" 2147483648 \"bezier\" 2147483648\n"
       "PatchMesh \"bicubic\" 2147483648 \"periodic\" 2147483648 \"periodic\" \"Pw\" []",
       ":2: expected a number of coordinates that can be counted"},
      {"PatchesBez", "bez", "384307168202282326 0 0 0",
       ":1: expected 384307168202282326 patches of 48 coordinates as declared in line 1"},
      {"PatchesBpt", "bpt", "18446744073709551615 1 1 0 0 0",
       ":1: expected 18446744073709551615 patches as declared in line 1"},
      {"DegreeBv", "bv", "5 4294967297 1 0 0 0", ":1: expected degree 1 to 15 across the rows"},
      {"OrderItd", "itd", "[OBJECT A [SURFACE BEZIER 4294967298 2 E3 [0 0 0]]]",
       ":1: expected order 2 to 16 (degree 1 to 15) in u"},
      {"VertexObj", "obj",
       "v 0 0 0\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 18446744073709551617 1 1 1\n",
       ":4: expected the number of a vertex, 1 to 1 or -1 to -1, found '18446744073709551617'"},
      {"VertexFromTheEndObj", "obj",
       "v 0 0 0\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 -18446744073709551615 1 1 1\n",
       ":4: expected the number of a vertex, 1 to 1 or -1 to -1, found '-1844674407370955161"},
  };
}

class HugeFileTest : public ::testing::TestWithParam<HugeFile> {};

TEST_P(HugeFileTest, IsRefusedWithItsLine) {
  const std::string message = refusal(GetParam().format, GetParam().text);
  EXPECT_TRUE(message.starts_with(GetParam().message)) << message;
}

TEST_P(HugeFileTest, TakesNoMemoryForItsCounts) {
  const std::string format = GetParam().format;
  const Outcome outcome = run({"info", "-", "--format", format}, {.input = GetParam().text});
  expect_failure(outcome, 1, "standard input:");
  constexpr long kPlenty = 400L << 10; // sanitizers have their own
  EXPECT_LT(outcome.memory, kPlenty);
}

INSTANTIATE_TEST_SUITE_P(All, HugeFileTest, ::testing::ValuesIn(huge_files()),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace simdbezier::tests::counts_test
