// Registration of the benchmark rows, and what they have in common.
#pragma once

#include <chrono>
#include <string>

#include <benchmark/benchmark.h>

namespace simdbezier_bench {

void register_grid_rows();
void register_limit_rows();

/// Every core that this process may use: 1 under `taskset -c 1`.
int max_threads();

/// Ends a row with an error, which makes the program's exit code 1.
void fail_row(benchmark::State& state, const std::string& message);
bool any_row_failed();

/// Runs `call` under the benchmark's clock and reports rates per second, `items` and `bytes` being
/// those of one call. Rows of several threads report real time; the others, processor time.
///
/// UseRealTime() would do that too, but it appends "/real_time" to the row's name.
template <typename Call>
void time_calls(benchmark::State& state, int threads, double items, double bytes, Call call) {
  const auto begin = std::chrono::steady_clock::now();
  for (auto _ : state) {
    call();
    benchmark::ClobberMemory();
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  const auto calls = static_cast<double>(state.iterations());
  using benchmark::Counter;
  const bool real_time = threads != 1;
  const double scale = real_time ? calls / elapsed.count() : calls;
  const Counter::Flags flags = real_time ? Counter::kDefaults : Counter::kIsRate;
  state.counters["items_per_second"] = Counter(scale * items, flags);
  if (bytes > 0) {
    state.counters["bytes_per_second"] = Counter(scale * bytes, flags, Counter::kIs1024);
  }
}

} // namespace simdbezier_bench
