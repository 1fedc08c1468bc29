// Lengths of vectors, whose bits may not depend on the standard library.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/length.hpp>

namespace simdbezier::tests::length_test {
namespace {

using tools::length_of;
using Vector = std::array<double, 3>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMost = std::numeric_limits<double>::max();

struct Case {
  const char* name;
  Vector vector;
  double length;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// The sums of squares are exact, so that the length is a root that is rounded once. std::hypot() of
// libstdc++ 12 returns the number below it for the three roots.
const Case kCases[] = {{"Nothing", {0, -0.0, 0}, 0},
                       {"Whole", {3, -4, 12}, 13},
                       {"RootOf90", {4, 7, 5}, 0x1.2f9422c23c47ep+3},
                       {"RootOf934", {3, 30, 5}, 0x1.e8fb8cce514e4p+4},
                       {"RootOf1594", {9, 27, 28}, 0x1.3f6641777acd9p+5},
                       {"Huge", {0x4p1000, 0x7p1000, 0x5p1000}, 0x1.2f9422c23c47ep+1003},
                       {"Tiny", {0x4p-1000, 0x7p-1000, 0x5p-1000}, 0x1.2f9422c23c47ep-997},
                       {"NearlyTooLarge", {kMost, 0, 0x1p-1074}, kMost},
                       {"TooLarge", {kMost, kMost, 0}, kInfinity},
                       {"Denormal", {0x3p-1074, 0, -0x4p-1074}, 0x5p-1074},
                       {"SmallestOfAll", {0, 0x1p-1074, 0}, 0x1p-1074},
                       {"HugeBesideTiny", {-0x1p1023, 0x1p-1074, 1}, 0x1p1023},
                       {"Infinite", {1, -kInfinity, kNan}, kInfinity}};

class Length : public testing::TestWithParam<Case> {};

TEST_P(Length, HasKnownBits) {
  const Case& c = GetParam();
  const auto [x, y, z] = c.vector;
  for (const Vector& vector : {Vector{x, y, z}, {y, z, x}, {z, x, y}}) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(length_of(vector)),
              std::bit_cast<std::uint64_t>(c.length))
        << length_of(vector);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Length, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(LengthOfVectors, IsNoNumberWhereAComponentIsNone) {
  for (const Vector& vector : {Vector{kNan, 0, 0}, {1, kNan, 1}, {kNan, kNan, kNan}}) {
    EXPECT_TRUE(std::isnan(length_of(vector)));
  }
}

TEST(LengthOfVectors, IsThatOfABoxsDiagonal) {
  EXPECT_EQ(tools::diagonal_of({{1, 2, -3}, {5, 9, 2}}), 0x1.2f9422c23c47ep+3);
}

} // namespace
} // namespace simdbezier::tests::length_test
