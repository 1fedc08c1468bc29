// SIMDBEZIER_ISA: every instruction set can be chosen, is what runs, and unknown ones are errors.
// So are unknown words of SIMDBEZIER_DESTINATION and SIMDBEZIER_SPLIT_STORES.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include <simdbezier/simdbezier.hpp>
#include <tools/formats/teapot.hpp>
#include <tools/patches/pack_patches.hpp>

#include "tests/program/commands/mesh_parsers.hpp"
#include "tests/program/process/program.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::instruction_set_test {
namespace {

constexpr std::size_t kSide = 9;

Circumstances on(const std::string& isa) { return {.environment = {{"SIMDBEZIER_ISA", isa}}}; }

// The teapot's positions by a direct call that names the instruction set.
template <typename T>
std::vector<T> direct_positions(Isa isa) {
  const tools::PatchFile file = tools::teapot();
  const PatchSet<T> set = tools::pack_patches<T>(file);
  std::vector<T> values(file.count * kSide * kSide * 3);
  Outputs<T> out;
  out.position = Vectors<T>::xyz(values.data());
  Options options;
  options.isa = isa;
  EXPECT_EQ(evaluate(set, Grid<T>::uniform(kSide, kSide), out, options), Status::ok);
  EXPECT_EQ(take_executed_isa(), isa);
  return values;
}

template <typename T>
std::vector<T> program_positions(Isa isa, const std::string& precision) {
  const Outcome outcome = run({"evaluate", "builtin:teapot", "--grid", std::to_string(kSide),
                               "--precision", precision, "-o", "-"},
                              on(std::string(to_string(isa))));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<T> values;
  for (const auto& row : parse_csv(outcome.out).rows) {
    std::transform(row.begin() + 3, row.end(), std::back_inserter(values),
                   [](double x) { return static_cast<T>(x); });
  }
  return values;
}

class InstructionSetTest : public ::testing::TestWithParam<Isa> {};

TEST_P(InstructionSetTest, IsChosenByItsName) {
  const std::string name(to_string(GetParam()));
  const Outcome outcome = run({"info", "builtin:teapot", "--json"}, on(name));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("\"chosen\": \"" + name + "\""), std::string::npos) << outcome.out;
}

TEST_P(InstructionSetTest, GivesTheBitsOfADirectCall) {
  EXPECT_EQ(program_positions<float>(GetParam(), "f32"), direct_positions<float>(GetParam()));
  EXPECT_EQ(program_positions<double>(GetParam(), "f64"), direct_positions<double>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Available, InstructionSetTest,
                         ::testing::ValuesIn(available_isas().begin(), available_isas().end()),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST(InstructionSet, OverrideReachesTheKernels) {
  // The two classes of results differ somewhere on the teapot, so a choice that is ignored shows.
  const std::span<const Isa> isas = available_isas();
  const auto differs = [&](Isa isa) {
    return fuses_multiply_add(isa) != fuses_multiply_add(isas[0]);
  };
  const auto other = std::ranges::find_if(isas, differs);
  if (other == isas.end()) {
    GTEST_SKIP() << "this machine has one class of results only";
  }
  EXPECT_NE(program_positions<float>(isas[0], "f32"), program_positions<float>(*other, "f32"));
}

TEST(InstructionSet, UnknownOrUnavailableIsBadUsage) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> commands = {
      {"info", "builtin:teapot"},
      {"tessellate", folder.path("absent.bez"), "-o", folder.path("out.ply")}, // before any work
      {"tessellate", "builtin:teapot", "-o", folder.path("out.ply")},
      {"evaluate", "builtin:teapot", "-o", folder.path("out.csv")},
      {"evaluate", "builtin:teapot", "-o", "-"}};
  const std::string narrowest(to_string(available_isas().front()));
  for (const std::string name : {"bogus", "AVX2", "scalar", "sse2", "avx2", "avx512", "neon64"}) {
    const auto isa = isa_from_name(name);
    if (isa && is_available(*isa)) {
      continue;
    }
    for (const auto& command : commands) {
      const Outcome outcome = run(command, on(name));
      expect_failure(outcome, 2, "SIMDBEZIER_ISA: expected one of " + narrowest);
      expect_failure(outcome, 2, "found '" + name + "'");
    }
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(MeasuredChoices, UnknownIsBadUsage) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out.csv");
  const std::vector<std::vector<std::string>> commands = {
      {"info", "builtin:teapot"},
      {"tessellate", folder.path("absent.bez"), "-o", folder.path("out.ply")}, // before any work
      {"evaluate", "builtin:teapot", "-o", out}};
  struct Choice {
    std::string variable;
    std::string words[2];
  };
  const Choice choices[] = {{"SIMDBEZIER_DESTINATION", {"memory", "cache"}},
                            {"SIMDBEZIER_SPLIT_STORES", {"slow", "fast"}}};
  for (const auto& [variable, words] : choices) {
    for (const std::string& word : {std::string("bogus"), "M" + words[0], words[1] + " "}) {
      for (const auto& command : commands) {
        expect_failure(run(command, {.environment = {{variable, word}}}), 2,
                       variable + ": expected " + words[0] + " or " + words[1] + ", found '" +
                           word + "'");
      }
    }
    EXPECT_TRUE(folder.names().empty());
    for (const std::string& word : {std::string(), std::string("automatic"), words[0], words[1]}) {
      expect_silent_success(run(commands.back(), {.environment = {{variable, word}}}));
    }
    std::filesystem::remove(out);
  }
}

} // namespace
} // namespace simdbezier::tests::instruction_set_test
