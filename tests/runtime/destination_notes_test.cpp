// What large calls find out: each kind of call is decided once, or measured by one call at a time,
// and never mixed up with another.
#include "src/choice/measured_call.hpp"

#include <atomic>
#include <barrier>
#include <cstdint>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace simdbezier::detail::destination_notes_test {
namespace {

CallKind kind(std::uint64_t k) { return CallKind().add(k).add(17); }
Way decision(std::uint64_t k) {
  return k % 3 == 0 ? Way::memory : k % 3 == 1 ? Way::cache : Way::memory_other;
}

TEST(DestinationNotes, one_of_many_threads_decides) {
  constexpr std::uint64_t kKinds = 100;
  constexpr int kRounds = 100;
  constexpr int kThreads = 4;
  std::vector<DestinationNotes> notes(kRounds);
  std::atomic<int> claims = 0;
  std::atomic<int> wrong = 0;
  std::barrier start(kThreads);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (DestinationNotes& round : notes) {
        start.arrive_and_wait();
        for (std::uint64_t k = 0; k < kKinds; ++k) {
          const DestinationNotes::Answer answer = round.ask(kind(k));
          if (answer.claimed) {
            ++claims;
            wrong += answer.choice != Way::undecided;
            round.decide(kind(k), decision(k));
          } else {
            wrong += answer.choice != Way::undecided && answer.choice != decision(k);
          }
        }
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(claims, kRounds * static_cast<int>(kKinds));
  for (std::uint64_t k = 0; k < kKinds; ++k) {
    const DestinationNotes::Answer answer = notes[0].ask(kind(k));
    EXPECT_FALSE(answer.claimed) << k;
    EXPECT_EQ(answer.choice, decision(k)) << k;
  }
}

TEST(DestinationNotes, nobody_else_measures_meanwhile) {
  DestinationNotes notes;
  EXPECT_TRUE(notes.ask(kind(1)).claimed);
  for (int k = 0; k < 3; ++k) {
    const DestinationNotes::Answer answer = notes.ask(kind(1));
    EXPECT_FALSE(answer.claimed);
    EXPECT_EQ(answer.choice, Way::undecided);
  }
}

TEST(DestinationNotes, a_claim_can_be_given_back) {
  DestinationNotes notes;
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(notes.ask(kind(1)).claimed);
    notes.decide(kind(1), Way::undecided);
  }
  EXPECT_TRUE(notes.ask(kind(1)).claimed);
  notes.decide(kind(1), Way::memory);
  EXPECT_EQ(notes.ask(kind(1)).choice, Way::memory);
}

TEST(DestinationNotes, measurements_are_notes_until_two_agree_or_there_are_three) {
  struct Case {
    std::vector<Way> measured;
    Way kept;
  };
  const Case cases[] = {
      {{Way::cache, Way::cache}, Way::cache},
      {{Way::memory, Way::memory}, Way::memory},
      {{Way::cache, Way::memory, Way::memory}, Way::memory},
      {{Way::memory, Way::cache, Way::memory}, Way::memory},
      {{Way::cache, Way::memory, Way::memory_other}, Way::memory_other},
  };
  DestinationNotes notes;
  std::uint64_t k = 0;
  for (const Case& c : cases) {
    SCOPED_TRACE(++k);
    Way known = Way::undecided;
    for (const Way way : c.measured) {
      DestinationNotes::Answer answer = notes.ask(kind(k));
      EXPECT_TRUE(answer.claimed);
      EXPECT_EQ(answer.choice, known);
      // Meanwhile, others take what is known; and a claim that is given back changes nothing.
      answer = notes.ask(kind(k));
      EXPECT_FALSE(answer.claimed);
      EXPECT_EQ(answer.choice, known);
      notes.decide(kind(k), Way::undecided);
      answer = notes.ask(kind(k));
      EXPECT_TRUE(answer.claimed);
      EXPECT_EQ(answer.choice, known);
      notes.add_measurement(kind(k), way);
      known = way;
    }
    const DestinationNotes::Answer answer = notes.ask(kind(k));
    EXPECT_FALSE(answer.claimed);
    EXPECT_EQ(answer.choice, c.kept);
  }
}

// Kinds that look for the same places: open and claimed ones keep theirs, and their own answers.
TEST(DestinationNotes, open_kinds_side_by_side_are_not_mixed_up) {
  constexpr std::uint64_t kKinds = 3 * DestinationNotes::kSlots;
  DestinationNotes notes;
  std::vector<bool> has_place(kKinds);
  const auto expect = [&](std::uint64_t k, bool claimed) {
    const DestinationNotes::Answer answer = notes.ask(kind(k));
    EXPECT_EQ(answer.claimed, claimed) << k;
    EXPECT_EQ(answer.choice, has_place[k] ? decision(k) : Way::undecided) << k;
  };
  for (std::uint64_t k = 0; k < kKinds; ++k) {
    has_place[k] = notes.ask(kind(k)).claimed;
    notes.add_measurement(kind(k), decision(k));
  }
  for (std::uint64_t k = 0; k < kKinds; ++k) {
    expect(k, has_place[k]);
  }
  for (std::uint64_t k = kKinds; k-- > 0;) { // while those that came first are claimed
    notes.add_measurement(kind(k), decision(k));
  }
  for (std::uint64_t k = 0; k < kKinds; ++k) {
    expect(k, false);
  }
}

TEST(DestinationNotes, a_decision_takes_the_place_of_a_measurement) {
  DestinationNotes notes;
  EXPECT_TRUE(notes.ask(kind(1)).claimed);
  notes.add_measurement(kind(1), Way::cache);
  EXPECT_TRUE(notes.ask(kind(1)).claimed);
  notes.decide(kind(1), Way::memory);
  const DestinationNotes::Answer answer = notes.ask(kind(1));
  EXPECT_FALSE(answer.claimed);
  EXPECT_EQ(answer.choice, Way::memory);
}

TEST(DestinationNotes, too_many_kinds_are_left_undecided) {
  constexpr std::uint64_t kKinds = 20 * DestinationNotes::kSlots;
  DestinationNotes notes;
  std::vector<bool> decided(kKinds);
  std::size_t count = 0;
  for (std::uint64_t k = 0; k < kKinds; ++k) {
    decided[k] = notes.ask(kind(k)).claimed;
    if (decided[k]) {
      notes.decide(kind(k), decision(k));
      ++count;
    }
  }
  EXPECT_GT(count, DestinationNotes::kSlots / 2);
  EXPECT_LE(count, DestinationNotes::kSlots);
  for (std::uint64_t k = 0; k < kKinds; ++k) {
    EXPECT_EQ(notes.ask(kind(k)).choice, decided[k] ? decision(k) : Way::undecided) << k;
  }
}

} // namespace
} // namespace simdbezier::detail::destination_notes_test
