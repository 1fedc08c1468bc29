#include "src/choice/strategies.hpp"

#include <atomic>

namespace simdbezier::detail {
namespace {

constinit std::atomic<std::uint32_t> allowed_bits{StrategySet::all().bits()};
constinit std::atomic<std::uint32_t> taken_bits{0};

} // namespace

StrategySet allowed_strategies() noexcept {
  return StrategySet(allowed_bits.load(std::memory_order_relaxed));
}

void allow_strategies(StrategySet allowed) noexcept {
  allowed_bits.store(allowed.bits(), std::memory_order_relaxed);
}

void note_strategies(StrategySet taken) noexcept {
  // Threads share this line: it is written only if that changes it.
  if ((taken.bits() & ~taken_bits.load(std::memory_order_relaxed)) != 0) {
    taken_bits.fetch_or(taken.bits(), std::memory_order_relaxed);
  }
}

StrategySet take_strategies() noexcept { return StrategySet(taken_bits.exchange(0)); }

} // namespace simdbezier::detail
