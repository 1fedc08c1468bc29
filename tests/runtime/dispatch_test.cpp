// Names, availability and choice of instruction sets.
#include <algorithm>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

namespace {

using simdbezier::Isa;
using simdbezier::Status;

constexpr Isa kAll[] = {Isa::automatic, Isa::scalar, Isa::sse2,
                        Isa::avx2,      Isa::avx512, Isa::neon64};

TEST(Dispatch, names_round_trip) {
  for (const Isa isa : kAll) {
    EXPECT_EQ(simdbezier::isa_from_name(simdbezier::to_string(isa)), isa);
  }
  for (const char* name : {"", "AVX2", "avx", "avx2 ", "sse4"}) {
    EXPECT_FALSE(simdbezier::isa_from_name(name).has_value()) << name;
  }
}

TEST(Dispatch, scalar_is_always_available_and_available_ones_resolve) {
  const auto available = simdbezier::available_isas();
  ASSERT_FALSE(available.empty());
  EXPECT_EQ(available.front(), Isa::scalar);
  for (const Isa isa : available) {
    Isa chosen = Isa::automatic;
    EXPECT_EQ(simdbezier::resolve_isa(isa, chosen), Status::ok);
    EXPECT_EQ(chosen, isa);
  }
}

TEST(Dispatch, what_is_not_available_is_refused_and_nothing_is_chosen) {
  const auto available = simdbezier::available_isas();
  int refused = 0;
  for (const Isa isa : kAll) {
    if (isa == Isa::automatic ||
        std::find(available.begin(), available.end(), isa) != available.end()) {
      continue;
    }
    ++refused;
    Isa chosen = Isa::scalar;
    EXPECT_EQ(simdbezier::resolve_isa(isa, chosen), Status::unsupported_isa);
    EXPECT_EQ(chosen, Isa::scalar);
  }
  EXPECT_GE(refused, 1); // no machine has both avx512 and neon64
}

TEST(Dispatch, classes) {
  EXPECT_FALSE(simdbezier::fuses_multiply_add(Isa::scalar));
  EXPECT_FALSE(simdbezier::fuses_multiply_add(Isa::sse2));
  EXPECT_TRUE(simdbezier::fuses_multiply_add(Isa::avx2));
  EXPECT_TRUE(simdbezier::fuses_multiply_add(Isa::avx512));
  EXPECT_TRUE(simdbezier::fuses_multiply_add(Isa::neon64));
}

TEST(Dispatch, every_status_has_a_text_of_its_own) {
  std::vector<std::string_view> texts;
  for (int i = 0; i <= static_cast<int>(Status::out_of_memory); ++i) {
    const std::string_view text = simdbezier::to_string(static_cast<Status>(i));
    EXPECT_EQ(std::count(texts.begin(), texts.end(), text), 0) << text;
    texts.push_back(text);
  }
}

} // namespace
