// The table of shape_bounds.hpp against the formulas that it comes from, and against the bounds of
// bicubic patches and the figures in docs/accuracy.md.
#include <algorithm>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/bounds_text.hpp"
#include "tests/properties/accuracy/judge/direction_errors.hpp"

namespace simdbezier::tests::shape_bounds_test {
namespace {

struct DirectionCase {
  int degree;
  int order;
};

void expect_tabulated(double found, double tabulated, const char* what) {
  EXPECT_LE(found, tabulated * (1 + 1e-9)) << what;
  EXPECT_GE(found, 0.98 * tabulated) << what << ": the table says more than it must";
}

class DirectionErrorTest : public ::testing::TestWithParam<int> {};

TEST_P(DirectionErrorTest, TableHoldsTheMaximum) {
  const int degree = GetParam();
  for (int order = 0; order <= std::min(2, degree); ++order) {
    const DirectionError found = largest_direction_error(degree, order);
    const DirectionError& table = direction_error(degree, order);
    const std::string name = "order " + std::to_string(order);
    expect_tabulated(found.coefficients, table.coefficients, (name + ", S").c_str());
    expect_tabulated(found.together, table.together, (name + ", J").c_str());
    expect_tabulated(found.fused, table.fused, (name + ", R fused").c_str());
    expect_tabulated(found.rounded_twice, table.rounded_twice, (name + ", R").c_str());
    expect_tabulated(found.apart_fused, table.apart_fused, (name + ", Q fused").c_str());
    expect_tabulated(found.apart_rounded_twice, table.apart_rounded_twice, (name + ", Q").c_str());
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, DirectionErrorTest, ::testing::Range(1, 16));

class RowErrorTest : public ::testing::TestWithParam<int> {};

TEST_P(RowErrorTest, TableHoldsTheMaximum) {
  const int degree = GetParam();
  for (int order = 0; order <= 2; ++order) {
    const RowError found = largest_row_error(degree, order);
    const std::string name = "order " + std::to_string(order);
    expect_tabulated(found.fused, row_error(degree, order, true), (name + ", T fused").c_str());
    expect_tabulated(found.rounded_twice, row_error(degree, order, false), (name + ", T").c_str());
  }
}

INSTANTIATE_TEST_SUITE_P(EvenAndOddParts, RowErrorTest, ::testing::Range(3, 6));

// Edges are evaluated as rows in either direction. An edge alone has one coefficient's rounding a
// power, J in all, and a row's own.
TEST(ShapeBoundsTest, EdgesAreCovered) {
  for (const bool fma : {true, false}) {
    for (int along = 1; along <= 15; ++along) {
      for (int across = 1; across <= 15; ++across) {
        for (int order = 0; order <= std::min(2, along); ++order) {
          const double edge = direction_error(along, order).together +
                              row_error(along, order, fma) + local_parameter_error(along, order);
          EXPECT_LE(edge, general_bound(along, across, order, 0, fma))
              << "in u: degree " << along << " by " << across << ", order " << order;
          EXPECT_LE(edge, general_bound(across, along, 0, order, fma))
              << "in v: degree " << along << " by " << across << ", order " << order;
        }
      }
    }
  }
}

// A curve's formula is the surface's with a constant across: the coefficients as written in the
// documentation of the scheme.
TEST(CentredBasisTest, CubicCoefficients) {
  const CentredBasis cubic(3);
  const auto a = cubic.coefficients({1, 2, -1, 5});
  EXPECT_DOUBLE_EQ(a[0], ((1 + 5) + 3 * (2 - 1)) / 8.0);
  EXPECT_DOUBLE_EQ(a[1], 3 * ((5 - 1) + (-1 - 2)) / 8.0);
  EXPECT_DOUBLE_EQ(a[2], 3 * ((1 - 2) + (5 + 1)) / 8.0);
  EXPECT_DOUBLE_EQ(a[3], ((5 - 1) - 3 * (-1 - 2)) / 8.0);
}

// The general formula is no tighter than the one that was maximised over whole nets.
TEST(ShapeBoundsTest, GeneralFormulaCoversBicubics) {
  for (const bool fma : {true, false}) {
    const ShapeBounds general = general_bounds(3, 3, fma);
    const ShapeBounds own = shape_bounds(3, 3, fma);
    EXPECT_GE(general.position, own.position);
    EXPECT_GE(std::max(general.du, general.dv), own.du);
    EXPECT_GE(std::max({general.duu, general.duv, general.dvv}), own.duu);
  }
}

TEST(ShapeBoundsTest, DocumentationHasTheTable) {
  const std::string text = bounds_text();
  EXPECT_NE(documentation().find(text), std::string::npos) << "docs/accuracy.md should contain:\n"
                                                           << text;
}

} // namespace
} // namespace simdbezier::tests::shape_bounds_test
