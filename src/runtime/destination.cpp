// See src/runtime/destination.hpp.
#include "src/runtime/destination.hpp"

#include <cstdlib>
#include <string_view>

namespace simdbezier::detail {
namespace {

Destination read_environment() noexcept {
  const char* const word = std::getenv("SIMDBEZIER_DESTINATION");
  const std::string_view wish = word == nullptr ? "" : word;
  return wish == "cache"    ? Destination::cache
         : wish == "memory" ? Destination::memory
                            : Destination::automatic;
}

constexpr std::uint64_t state_of(Destination destination) noexcept {
  return static_cast<std::uint64_t>(destination);
}

} // namespace

Destination environment_destination() noexcept {
  static const Destination wish = read_environment();
  return wish;
}

DestinationNotes::Answer DestinationNotes::ask(const CallKind& kind) noexcept {
  static_assert(state_of(Destination::automatic) == 0 && state_of(Destination::memory) < kClaimed);
  const std::uint64_t name = kind.value() & ~kStates;
  for (std::size_t k = 0; k < kProbes; ++k) {
    std::atomic<std::uint64_t>& place = slot(kind, k);
    std::uint64_t seen = place.load(std::memory_order_relaxed);
    // Empty, or of this kind and given back: nobody else may have taken it meanwhile.
    if ((seen == 0 || seen == name) &&
        place.compare_exchange_strong(seen, name | kClaimed, std::memory_order_relaxed)) {
      return {Destination::automatic, true};
    }
    if ((seen & ~kStates) == name) {
      const std::uint64_t state = seen & kStates;
      return {state == kClaimed ? Destination::automatic : static_cast<Destination>(state), false};
    }
  }
  return {};
}

void DestinationNotes::decide(const CallKind& kind, Destination destination) noexcept {
  const std::uint64_t name = kind.value() & ~kStates;
  for (std::size_t k = 0; k < kProbes; ++k) {
    std::uint64_t claimed = name | kClaimed;
    if (slot(kind, k).compare_exchange_strong(claimed, name | state_of(destination),
                                              std::memory_order_relaxed)) {
      return;
    }
  }
}

DestinationNotes& destination_notes() noexcept {
  static DestinationNotes notes;
  return notes;
}

} // namespace simdbezier::detail
