// Grids with Isa::automatic may run on either of two instruction sets, whichever is faster. That
// must never show in a result: calls that measure, and calls that come after them, give the bits of
// the widest instruction set.
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "tests/calls/grid_cases.hpp"
#include "tests/support/isas.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::automatic_isa_test {
namespace {

constexpr std::size_t kSizes[][2] = {{2, 2}, {3, 5},  {4, 4},   {5, 5},   {8, 8},
                                     {9, 9}, {7, 16}, {16, 16}, {24, 24}, {33, 17}};
constexpr Wanted kWanted[] = {{true, false, false, false},    {true, true, false, false},
                              {true, false, true, true},      {false, true, true, true},
                              {true, true, true, true, true}, {true, true, true, true, true, true}};
constexpr std::size_t kPatches = 300; // 2 x 2 samples of each are enough for a measurement

/// The one that a call with Isa::automatic runs on where there is nothing to choose.
Isa resolved() {
  Isa isa = Isa::automatic;
  EXPECT_EQ(resolve_isa(Isa::automatic, isa), Status::ok);
  return isa;
}

/// Whether a call with Isa::automatic may report this one.
bool may_run(Isa isa) {
  const Isa widest = resolved();
  return isa == widest ||
         (is_available(isa) && fuses_multiply_add(isa) && fuses_multiply_add(widest));
}

template <typename T>
void compare(const PatchSet<T>& set, std::size_t nu, std::size_t nv, Wanted wanted) {
  const std::size_t samples = set.size() * nu * nv;
  const Grid<T> grid = Grid<T>::uniform(nu, nv);
  Planes<T> expected(samples, wanted);
  Options options;
  options.isa = resolved();
  ASSERT_EQ(evaluate(set, grid, expected.outputs(), options), Status::ok);
  for (int call = 0; call < 3; ++call) {
    for (const int threads : {1, 3}) {
      Planes<T> found(samples, wanted);
      options = {};
      options.threads = threads;
      ASSERT_EQ(evaluate(set, grid, found.outputs(), options), Status::ok);
      EXPECT_EQ(differing_values(found, expected), 0U)
          << nu << " x " << nv << ", call " << call << ", " << threads << " threads";
      const Isa executed = take_executed_isa();
      EXPECT_TRUE(may_run(executed)) << to_string(executed);
    }
  }
}

template <typename T>
void compare_all(const PatchSet<T>& set) {
  for (const auto& size : kSizes) {
    for (const Wanted& wanted : kWanted) {
      compare(set, size[0], size[1], wanted);
    }
  }
}

TEST(AutomaticIsa, gives_the_widest_ones_bits) {
  const std::vector<Net> nets = mixed_nets(kPatches); // some have normals that vanish
  compare_all(packed<float>(nets));
  compare_all(packed<double>(nets));
}

TEST(AutomaticIsa, leaves_small_calls_to_the_widest_one) {
  struct Call {
    std::size_t patches;
    std::size_t size;
  };
  for (const Call call : {Call{3, 8}, Call{63, 4}, Call{1, 23}, Call{1, 31}}) {
    const PatchSet<float> set = packed<float>(wavy_nets(call.patches));
    for (int repeat = 0; repeat < 3; ++repeat) {
      Planes<float> found(call.patches * call.size * call.size);
      const Grid<float> grid = Grid<float>::uniform(call.size, call.size);
      ASSERT_EQ(evaluate(set, grid, found.outputs()), Status::ok);
      EXPECT_EQ(take_executed_isa(), resolved()) << call.patches << " of " << call.size;
    }
  }
}

} // namespace
} // namespace simdbezier::tests::automatic_isa_test
