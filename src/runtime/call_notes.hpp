// What calls have found out by measuring, for later calls of their kind.
#pragma once

#include <atomic>
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

/// What is known of each kind of call. Choice is an enumeration of at most seven values,
/// the first of which, 0, means that nothing is decided. Decisions stay for as long as the object
/// lives; where there are too many kinds for it, those that come last are never decided. Any number
/// of threads may ask.
template <typename Choice>
class CallNotes {
public:
  struct Answer {
    Choice choice = Choice{}; ///< 0: not decided yet
    bool claimed = false;     ///< the caller, and nobody else, has to call decide()
  };

  [[nodiscard]] Answer ask(const CallKind& kind) noexcept {
    const std::uint64_t name = kind.value() & ~kStates;
    for (std::size_t k = 0; k < kProbes; ++k) {
      std::atomic<std::uint64_t>& place = slot(kind, k);
      std::uint64_t seen = place.load(std::memory_order_relaxed);
      // Empty, or of this kind and given back: nobody else may have taken it meanwhile.
      if ((seen == 0 || seen == name) &&
          place.compare_exchange_strong(seen, name | kClaimed, std::memory_order_relaxed)) {
        return {Choice{}, true};
      }
      if ((seen & ~kStates) == name) {
        const std::uint64_t state = seen & kStates;
        return {state == kClaimed ? Choice{} : static_cast<Choice>(state), false};
      }
    }
    return {};
  }

  /// Notes the answer after a claim. 0: the next one who asks may claim the kind.
  void decide(const CallKind& kind, Choice choice) noexcept {
    const std::uint64_t name = kind.value() & ~kStates;
    for (std::size_t k = 0; k < kProbes; ++k) {
      std::uint64_t claimed = name | kClaimed;
      if (slot(kind, k).compare_exchange_strong(claimed, name | static_cast<std::uint64_t>(choice),
                                                std::memory_order_relaxed)) {
        return;
      }
    }
  }

  static constexpr std::size_t kSlots = 256;

private:
  static constexpr std::size_t kProbes = 8;
  /// A slot is a kind, whose last three bits are a state: a choice, or kClaimed. 0 is an empty one.
  static constexpr std::uint64_t kStates = 7;
  static constexpr std::uint64_t kClaimed = 7;

  /// The k-th of the kProbes slots in which a kind may be.
  [[nodiscard]] std::atomic<std::uint64_t>& slot(const CallKind& kind, std::size_t k) noexcept {
    return slot_[(kind.value() / (kStates + 1) + k) % kSlots];
  }

  std::atomic<std::uint64_t> slot_[kSlots] = {};
};

} // namespace simdbezier::detail
