// Grid and scattered calls, and all instruction sets of one class, agree bit for bit.
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/watertight/shared_edges.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/isas.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::grid_equals_scattered_test {
namespace {

struct GridCase {
  std::size_t nu;
  std::size_t nv;
};

// Widths around every lane count, the kernels' special widths, and some odd ones.
constexpr GridCase kGridCases[] = {
    {2, 2},   {3, 5},  {4, 4},  {5, 5},  {7, 3},   {8, 8},   {9, 9},   {10, 6}, {15, 4}, {16, 16},
    {17, 17}, {18, 5}, {23, 7}, {24, 3}, {31, 2},  {32, 32}, {33, 33}, {34, 2}, {40, 3}, {47, 5},
    {48, 3},  {49, 3}, {63, 2}, {64, 3}, {65, 65}, {100, 2}, {101, 3}, {2, 101}};

/// The grid's samples as scattered ones, in the order of the grid's output.
template <typename T>
[[nodiscard]] SampleArrays<T> as_scattered(std::size_t patches, GridCase shape) {
  SampleArrays<T> samples;
  const auto list = grid_parameters<T>(static_cast<int>(shape.nu), static_cast<int>(shape.nv));
  for (std::size_t p = 0; p < patches; ++p) {
    for (const Parameters2<T>& at : list) {
      samples.add(p, at.x, at.y);
    }
  }
  return samples;
}

class GridScatteredTest : public IsaTest {
protected:
  template <typename T>
  void expect_equal(const PackOptions& packing = {}) {
    const std::vector<Net> nets = mixed_nets(17);
    const PatchSet<T> set = packed<T>(nets, packing);
    for (const GridCase& shape : kGridCases) {
      const std::size_t count = nets.size() * shape.nu * shape.nv;
      Planes<T> from_grid(count);
      Planes<T> from_scattered(count);
      grid(set, Grid<T>::uniform(shape.nu, shape.nv), from_grid.outputs());
      scattered(set, as_scattered<T>(nets.size(), shape).view(Parameters::centred),
                from_scattered.outputs());
      EXPECT_EQ(differing_values(from_grid, from_scattered), 0u)
          << "of " << 12 * count << " values, grid " << shape.nu << " x " << shape.nv;
    }
  }
};

TEST_P(GridScatteredTest, EqualBitsFloat) { expect_equal<float>(); }
TEST_P(GridScatteredTest, EqualBitsDouble) { expect_equal<double>(); }
TEST_P(GridScatteredTest, EqualBitsLocalOriginsFloat) {
  expect_equal<float>({.local_origin = true});
}
TEST_P(GridScatteredTest, EqualBitsLocalOriginsDouble) {
  expect_equal<double>({.local_origin = true});
}
INSTANTIATE_FOR_EVERY_ISA(GridScatteredTest);

/// Each instruction set against the first of its class.
class ClassTest : public IsaTest {
protected:
  [[nodiscard]] static Isa first_of_class() {
    for (const Isa candidate : available_isas()) {
      if (fuses_multiply_add(candidate) == fuses_multiply_add(isa())) {
        return candidate;
      }
    }
    return isa();
  }

  template <typename T>
  void expect_equal(const PackOptions& packing = {}) {
    const std::vector<Net> nets = mixed_nets(33);
    const PatchSet<T> set = packed<T>(nets, packing);
    for (const GridCase& shape : kGridCases) {
      const std::size_t count = nets.size() * shape.nu * shape.nv;
      const Grid<T> samples = Grid<T>::uniform(shape.nu, shape.nv);
      Planes<T> here(count);
      Planes<T> reference(count);
      grid(set, samples, here.outputs());
      ASSERT_EQ(evaluate(set, samples, reference.outputs(), {.isa = first_of_class()}), Status::ok);
      EXPECT_EQ(differing_values(here, reference), 0u)
          << "of " << 12 * count << " values, grid " << shape.nu << " x " << shape.nv << ", "
          << to_string(isa()) << " against " << to_string(first_of_class());
    }
  }
};

TEST_P(ClassTest, EqualBitsFloat) { expect_equal<float>(); }
TEST_P(ClassTest, EqualBitsDouble) { expect_equal<double>(); }
TEST_P(ClassTest, EqualBitsLocalOriginsFloat) { expect_equal<float>({.local_origin = true}); }
TEST_P(ClassTest, EqualBitsLocalOriginsDouble) { expect_equal<double>({.local_origin = true}); }
INSTANTIATE_FOR_EVERY_ISA(ClassTest);

// The counterproof: between the classes the comparison does find differences.
TEST(ClassCounterproof, ClassesDiffer) {
  const std::vector<Net> nets = mixed_nets(33);
  const PatchSet<float> set = packed<float>(nets);
  if (!has_class(true) || !has_class(false)) {
    GTEST_SKIP() << "there is one class only";
  }
  const Isa first = available_isas().front(); // classes are in order, too
  const Isa last = available_isas().back();
  Planes<float> fused(nets.size() * 256);
  Planes<float> rounded(nets.size() * 256);
  const Grid<float> samples = Grid<float>::uniform(16, 16);
  ASSERT_EQ(evaluate(set, samples, fused.outputs(), {.isa = last}), Status::ok);
  ASSERT_EQ(evaluate(set, samples, rounded.outputs(), {.isa = first}), Status::ok);
  EXPECT_GT(differing_values(fused, rounded), 0u);
}

} // namespace
} // namespace simdbezier::tests::grid_equals_scattered_test
