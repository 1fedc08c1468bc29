#include "src/runtime/batch.hpp"

#include <algorithm>
#include <utility>

#include "src/runtime/useful_threads.hpp"

namespace simdbezier {
namespace {

thread_local Isa executed = Isa::automatic;
thread_local detail::UsefulThreads useful_threads;

} // namespace

Isa take_executed_isa() noexcept { return std::exchange(executed, Isa::automatic); }

namespace detail {

void note_executed(Isa isa) noexcept { executed = isa; }

int thread_count(int requested, std::size_t units, std::size_t duration) noexcept {
  const std::size_t shares = requested > 0 ? units : std::min(units, duration / kShortestShare);
  if (requested == 1 || shares <= 1) {
    return 1;
  }
  const int wanted = requested > 0 ? requested : useful_threads.of(default_threads(), elapsed_time);
  const int most = std::min(wanted, most_threads());
  return static_cast<int>(std::min(shares, static_cast<std::size_t>(std::max(most, 1))));
}

namespace {

// Shares are static, so that every thread writes the same pages in every call of equal shape.
void run_share(std::size_t units, int worker, int workers, BlockBody body) {
  const auto share = [&](int k) {
    return share_begin(units, static_cast<std::size_t>(workers), static_cast<std::size_t>(k));
  };
  const DefaultFpEnvironment environment;
  body(worker, share(worker), share(worker + 1));
}

} // namespace

void for_blocks(std::size_t units, int threads, BlockBody body) noexcept {
  const DefaultFpEnvironment environment;
  for_blocks_here(units, threads, body);
}

void for_blocks_here(std::size_t units, int threads, BlockBody body) noexcept {
  if (threads <= 1) {
    body(0, 0, units);
    return;
  }
  const CallersFpEnvironment environment; // of the threads that are started
  std::atomic<std::int64_t> work = 0;
  auto run = [&](int worker, int workers) {
    const std::int64_t begin = processor_time();
    run_share(units, worker, workers, body);
    work += processor_time() - begin;
  };
  const std::int64_t begin = elapsed_time();
  run_on_threads(threads, ThreadBody(run));
  const std::int64_t end = elapsed_time();
  useful_threads.note(threads, work, end - begin, end);
}

} // namespace detail
} // namespace simdbezier
