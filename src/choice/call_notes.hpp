// What calls have found out by measuring, for later calls of their kind.
#pragma once

#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace simdbezier::detail {

/// Calls that are alike in all that decides what is faster, as a hash of it.
class CallKind {
public:
  CallKind& add(std::uint64_t fact) noexcept {
    hash_ = (hash_ ^ fact) * 0x9e3779b97f4a7c15U;
    hash_ ^= hash_ >> 29U;
    return *this;
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return hash_; }

private:
  std::uint64_t hash_ = 0x243f6a8885a308d3U;
};

/// What is known of each kind of call. Choice is an enumeration of at most four values, the first
/// of which, 0, means that nothing is decided. Answers stay for as long as the object lives; where
/// there are too many kinds for it, those that come last are never decided. Any number of threads
/// may ask.
template <typename Choice>
class CallNotes {
public:
  struct Answer {
    Choice choice = Choice{}; ///< 0: not decided yet
    bool claimed = false;     ///< the caller, and nobody else, has to call one of the two below
  };

  [[nodiscard]] Answer ask(const CallKind& kind) noexcept {
    const std::uint64_t name = kind.value() & ~kState;
    for (std::size_t k = 0; k < kProbes; ++k) {
      std::atomic<std::uint64_t>& place = slot(kind, k);
      std::uint64_t seen = place.load(std::memory_order_relaxed);
      // Empty, or of this kind and open: nobody else may have taken it meanwhile.
      if ((seen == 0 || is_open(seen, name)) &&
          place.compare_exchange_strong(seen, name | (seen & kState) | kClaimed,
                                        std::memory_order_relaxed)) {
        return {static_cast<Choice>(seen & kChoice), true};
      }
      if ((seen & ~kState) == name) {
        return {static_cast<Choice>(seen & kChoice), false};
      }
    }
    return {};
  }

  /// Notes the answer after a claim, for good. 0: the next one who asks may claim the kind, and
  /// what had been measured before stays.
  void decide(const CallKind& kind, Choice choice) noexcept {
    if (std::atomic<std::uint64_t>* const place = claimed_slot(kind)) {
      const std::uint64_t seen = place->load(std::memory_order_relaxed) & ~kClaimed;
      place->store(choice == Choice{} ? seen : with(seen, choice, kSettled),
                   std::memory_order_relaxed);
    }
  }

  /// Notes what was measured after a claim. One measurement can be misled, by others who use the
  /// machine for a moment, so that the next one who asks may claim the kind again: what two
  /// measurements agree about is kept, otherwise what the third one says, which agrees with one of
  /// them where there are two choices.
  void add_measurement(const CallKind& kind, Choice choice) noexcept {
    if (std::atomic<std::uint64_t>* const place = claimed_slot(kind)) {
      const std::uint64_t seen = place->load(std::memory_order_relaxed) & ~kClaimed;
      const bool agrees = static_cast<Choice>(seen & kChoice) == choice;
      const std::uint64_t stage = seen & kStage;
      const std::uint64_t next = stage == 0                  ? kOnce
                                 : stage == kOnce && !agrees ? kDisputed
                                                             : kSettled;
      place->store(with(seen, choice, next), std::memory_order_relaxed);
    }
  }

  static constexpr std::size_t kSlots = 4096;

private:
  static constexpr std::size_t kProbes = 8;
  /// A slot is a kind, whose last bits are a state: a choice, how it was found, and whether
  /// somebody is about to find it. 0 is an empty one.
  static constexpr std::uint64_t kChoice = 3;
  static constexpr std::uint64_t kStage = 3U << 2U;
  static constexpr std::uint64_t kOnce = 1U << 2U;     ///< by one measurement
  static constexpr std::uint64_t kDisputed = 2U << 2U; ///< by two that do not agree
  static constexpr std::uint64_t kSettled = 3U << 2U;
  static constexpr std::uint64_t kClaimed = 1U << 4U;
  static constexpr std::uint64_t kState = kChoice | kStage | kClaimed;

  static constexpr bool is_open(std::uint64_t seen, std::uint64_t name) noexcept {
    return (seen & ~kState) == name && (seen & kClaimed) == 0 && (seen & kStage) != kSettled;
  }
  static constexpr std::uint64_t with(std::uint64_t seen, Choice choice,
                                      std::uint64_t stage) noexcept {
    assert((static_cast<std::uint64_t>(choice) & ~kChoice) == 0);
    return (seen & ~kState) | static_cast<std::uint64_t>(choice) | stage;
  }

  /// The k-th of the kProbes slots in which a kind may be.
  [[nodiscard]] std::atomic<std::uint64_t>& slot(const CallKind& kind, std::size_t k) noexcept {
    return slot_[(kind.value() / (kState + 1) + k) % kSlots];
  }
  /// The slot of a kind that the caller has claimed, so that nobody else changes it.
  [[nodiscard]] std::atomic<std::uint64_t>* claimed_slot(const CallKind& kind) noexcept {
    const std::uint64_t name = kind.value() & ~kState;
    for (std::size_t k = 0; k < kProbes; ++k) {
      const std::uint64_t seen = slot(kind, k).load(std::memory_order_relaxed);
      if ((seen & ~kState) == name && (seen & kClaimed) != 0) {
        return &slot(kind, k);
      }
    }
    return nullptr;
  }

  std::atomic<std::uint64_t> slot_[kSlots] = {};
};

} // namespace simdbezier::detail
