#include "src/choice/line_costs.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <string_view>

#include "src/choice/clock.hpp"

namespace simdbezier::detail {
namespace {

enum class SplitCost : unsigned char { unknown, fast, slow };

SplitCost read_split_wish() noexcept {
  const char* const word = std::getenv("SIMDBEZIER_SPLIT_STORES");
  const std::string_view wish = word == nullptr ? "" : word;
  return wish == "slow" ? SplitCost::slow : wish == "fast" ? SplitCost::fast : SplitCost::unknown;
}

/// Nanoseconds of the fastest of some runs, so that interruptions do not count.
template <typename T>
double time_of_stores(const KernelTable<T>& table, T* to, std::size_t registers) noexcept {
  constexpr int kRuns = 8;
  constexpr int kRounds = 48;
  double best = 1e300;
  for (int run = 0; run < kRuns; ++run) {
    const std::int64_t begin = clock_now();
    for (int round = 0; round < kRounds; ++round) {
      table.store_registers(to, registers);
    }
    best = std::min(best, static_cast<double>(clock_now() - begin));
  }
  return best;
}

template <typename T>
SplitCost measure_splits(const KernelTable<T>& table) noexcept {
  constexpr std::size_t kBytes = 4096; // stays in the first-level cache
  alignas(64) T memory[kBytes / sizeof(T) + kMaxLanes] = {};
  const std::size_t registers = kBytes / sizeof(T) / table.lanes;
  const double within = time_of_stores(table, memory, registers);
  const double across = time_of_stores(table, memory + 1, registers);
  return across > 2 * within ? SplitCost::slow : SplitCost::fast;
}

} // namespace

template <typename T>
bool splits_slowly(const KernelTable<T>& table) noexcept {
  if (table.store_registers == nullptr) {
    return false;
  }
  static const SplitCost wish = read_split_wish();
  if (wish != SplitCost::unknown) {
    return wish == SplitCost::slow;
  }
  // Two threads may both measure, and then agree or not; either answer will do.
  constexpr std::size_t kIsas = 8;
  static std::atomic<SplitCost> answers[kIsas] = {};
  std::atomic<SplitCost>& answer = answers[static_cast<std::size_t>(table.isa) % kIsas];
  if (answer.load(std::memory_order_relaxed) == SplitCost::unknown) {
    answer.store(measure_splits(table), std::memory_order_relaxed);
  }
  return answer.load(std::memory_order_relaxed) == SplitCost::slow;
}

template bool splits_slowly(const KernelTable<float>&) noexcept;
template bool splits_slowly(const KernelTable<double>&) noexcept;

} // namespace simdbezier::detail
