// GoogleTest bodies that run on every instruction set of the machine, and prove that they did.
//
//     using PositionTest = IsaTest;
//     TEST_P(PositionTest, MeetsItsBound) { grid(set, Grid<float>::uniform(9, 9), out); }
//     INSTANTIATE_FOR_EVERY_ISA(PositionTest);
#pragma once

#include <span>
#include <string>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/call_options.hpp"

namespace simdbezier::tests {

/// Evaluate calls go through grid(), scattered() and so on, which force the instruction set under
/// test and check the name that the kernel itself wrote. A body that made no such call fails: it
/// would pass on an instruction set it never ran on.
class IsaTest : public ::testing::TestWithParam<Isa> {
protected:
  [[nodiscard]] static Isa isa() { return GetParam(); }

  template <typename T, typename How = CallOptions>
  void grid(const PatchSet<T>& set, const Grid<T>& samples, const Outputs<T>& out,
            const How& options = {}) {
    run(options, [&](const How& forced) { return evaluate(set, samples, out, forced); });
  }

  template <typename T, typename How = CallOptions>
  void scattered(const PatchSet<T>& set, const Samples<T>& samples, const Outputs<T>& out,
                 const How& options = {}) {
    run(options, [&](const How& forced) { return evaluate(set, samples, out, forced); });
  }

  template <typename T, typename How = CallOptions>
  void tiles(const PatchSet<T>& set, const Grid<T>& samples, const TileFormat& format,
             TileFunction<T> function, const How& options = {}) {
    run(options,
        [&](const How& forced) { return evaluate_tiles(set, samples, format, function, forced); });
  }

  template <typename T, typename How = CallOptions>
  void patch_grids(const PatchSet<T>& set, const PatchGrids& grids, const Outputs<T>& out,
                   const How& options = {}) {
    run(options, [&](const How& forced) { return evaluate(set, grids, out, forced); });
  }

  /// call(options): an evaluate call with these options, except for the instruction set.
  template <typename How = CallOptions, typename Call>
  void run(How options, const Call& call) {
    options.isa = isa();
    static_cast<void>(take_executed_isa()); // of calls before
    const Status status = call(options);
    expect_ran(status, take_executed_isa());
  }

  /// Counts calls that take their own path to the library (other evaluators, other threads).
  void expect_ran(Status status, Isa executed) {
    EXPECT_EQ(to_string(status), to_string(Status::ok));
    EXPECT_EQ(to_string(executed), to_string(isa())) << "another instruction set ran";
    calls_ += executed == isa() ? 1 : 0;
  }

  void TearDown() override {
    if (!IsSkipped()) {
      EXPECT_GT(calls_, 0) << "no evaluate call ran on " << to_string(isa());
    }
  }

private:
  int calls_ = 0;
};

[[nodiscard]] inline std::string isa_test_name(const ::testing::TestParamInfo<Isa>& info) {
  return std::string(to_string(info.param));
}

#define INSTANTIATE_FOR_EVERY_ISA(suite)                                                           \
  INSTANTIATE_TEST_SUITE_P(Isa, suite,                                                             \
                           ::testing::ValuesIn(available_isas().begin(), available_isas().end()),  \
                           ::simdbezier::tests::isa_test_name)

} // namespace simdbezier::tests
