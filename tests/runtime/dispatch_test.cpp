// Names, availability and choice of instruction sets.
#include <algorithm>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

#include "src/runtime/dispatch.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::dispatch_test {
namespace {

TEST(Dispatch, names_round_trip) {
  EXPECT_EQ(isa_from_name("automatic"), Isa::automatic);
  EXPECT_EQ(to_string(Isa::automatic), "automatic");
  for (const Isa isa : kEveryIsa) {
    EXPECT_EQ(isa_from_name(to_string(isa)), isa);
  }
  for (const char* name : {"", "AVX2", "avx", "avx2 ", "sse4"}) {
    EXPECT_FALSE(isa_from_name(name).has_value()) << name;
  }
}

TEST(Dispatch, what_was_built_and_can_run_is_available_and_resolves) {
  std::vector<Isa> expected; // SIMDBEZIER_BUILT_ISAS: the build's own list, narrowest first
  for (const std::string_view name : {SIMDBEZIER_BUILT_ISAS}) {
    const Isa isa = isa_from_name(name).value();
    if (detail::cpu_supports(isa)) {
      expected.push_back(isa);
    }
  }
  const auto available = available_isas();
  EXPECT_TRUE(std::ranges::equal(available, expected));
  ASSERT_FALSE(available.empty());
  for (const Isa isa : available) {
    Isa chosen = Isa::automatic;
    EXPECT_EQ(resolve_isa(isa, chosen), Status::ok);
    EXPECT_EQ(chosen, isa);
  }
}

TEST(Dispatch, what_is_not_available_is_refused_and_nothing_is_chosen) {
  for (const Isa isa : kEveryIsa) {
    if (!is_available(isa)) {
      Isa chosen = Isa::automatic;
      EXPECT_EQ(resolve_isa(isa, chosen), Status::unsupported_isa);
      EXPECT_EQ(chosen, Isa::automatic);
    }
  }
  EXPECT_FALSE(is_available(absent_isa()));
}

TEST(Dispatch, classes) {
  EXPECT_FALSE(fuses_multiply_add(Isa::scalar));
  EXPECT_FALSE(fuses_multiply_add(Isa::sse2));
  EXPECT_FALSE(fuses_multiply_add(Isa::simd128));
  EXPECT_TRUE(fuses_multiply_add(Isa::avx2));
  EXPECT_TRUE(fuses_multiply_add(Isa::avx512));
  EXPECT_TRUE(fuses_multiply_add(Isa::neon64));
}

TEST(Dispatch, a_status_is_true_where_it_is_ok) {
  EXPECT_TRUE(Status());
  for (int i = 0; i <= Status::snap_too_large; ++i) {
    const Status status = static_cast<Status::Code>(i);
    EXPECT_EQ(static_cast<bool>(status), status == Status::ok);
    EXPECT_EQ(static_cast<bool>(simdbezier::Report{status}), static_cast<bool>(status));
    EXPECT_EQ(status.code(), i);
  }
}

TEST(Dispatch, every_status_has_a_text_of_its_own) {
  std::vector<std::string_view> texts;
  for (int i = 0; i <= Status::snap_too_large; ++i) {
    const std::string_view text = simdbezier::to_string(static_cast<Status::Code>(i));
    EXPECT_EQ(std::count(texts.begin(), texts.end(), text), 0) << text;
    texts.push_back(text);
  }
}

} // namespace
} // namespace simdbezier::tests::dispatch_test
