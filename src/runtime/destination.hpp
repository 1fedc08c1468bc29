// Through the caches or past them: what calls with Destination::automatic have found out.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include <simdbezier/options.hpp>

namespace simdbezier::detail {

/// Calls that are alike in all that decides which stores are faster, as a hash of it.
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

/// What SIMDBEZIER_DESTINATION says, "cache" or "memory"; automatic for every other word. It is
/// read at the first use in the process.
Destination environment_destination() noexcept;

/// What is known of each kind of call. Decisions stay for as long as the object lives; where there
/// are too many kinds for it, those that come last are never decided.
class DestinationNotes {
public:
  struct Answer {
    Destination destination = Destination::automatic; ///< that: not decided yet
    bool claimed = false; ///< the caller, and nobody else, has to call decide()
  };

  [[nodiscard]] Answer ask(const CallKind& kind) noexcept;
  /// After a claim. automatic: the next one who asks may claim the kind.
  void decide(const CallKind& kind, Destination destination) noexcept;

  static constexpr std::size_t kSlots = 256;

private:
  static constexpr std::size_t kProbes = 8;
  /// A slot is a kind, whose last two bits are a state; 0 is an empty one.
  static constexpr std::uint64_t kStates = 3;
  static constexpr std::uint64_t kClaimed = 3;

  /// The k-th of the kProbes slots in which a kind may be.
  [[nodiscard]] std::atomic<std::uint64_t>& slot(const CallKind& kind, std::size_t k) noexcept {
    return slot_[(kind.value() / (kStates + 1) + k) % kSlots];
  }

  std::atomic<std::uint64_t> slot_[kSlots] = {};
};

/// Those of the process.
DestinationNotes& destination_notes() noexcept;

} // namespace simdbezier::detail
