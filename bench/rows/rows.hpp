// Registration of the benchmark rows, and what they have in common.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>

#include "bench/subjects/job.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {

void register_call_rows();
void register_curve_rows();
void register_derivative_rows();
void register_frame_rows();
void register_grid_rows();
void register_shape_rows();
void register_tile_rows();
void register_scattered_rows();
void register_net_rows();
void register_pack_rows();
void register_spline_rows();
void register_mesh_peer_rows();
void register_peer_rows();
void register_limit_rows();
void register_tessellate_rows();
void register_tolerance_rows();

/// Where the data of a row are while it runs; its name calls that the destination.
enum class MemoryLevel { cache, memory };

/// The parts of a name: <call>/<outputs>/<type>/<who>/<nu>x<nv>/<destination>/threads:<t>
struct RowName {
  std::string call;
  OutputGroups outputs = OutputGroups::position;
  bool single = true;   ///< f32, otherwise f64
  std::string who = {}; ///< instruction set, baseline or peer
  std::size_t nu = 1;
  std::size_t nv = 1;
  MemoryLevel level = MemoryLevel::cache;
  int threads = 1;

  [[nodiscard]] std::string text() const;
};

/// The parts of a name that say what patches a row has: nothing for bicubic ones.
std::string shape_parts(BatchShape shape);

/// The number of cores that this process may use, which is 1 under `taskset -c 1`.
int max_threads();

/// Ends a row with an error, which makes the program's exit code 1.
void fail_row(benchmark::State& state, const std::string& message);

/// Returns the names of the strategies for grids that the library has taken since the last call.
std::string strategies_taken();
bool any_row_failed();

/// Runs `call` under the benchmark's clock and reports rates per second; `items` and `bytes` are
/// those of one call. Rows of several threads report real time, and the others processor time.
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

/// Registers a row. make() gives what is timed: an object with operator()(), items() and bytes() of
/// one call, and check(), which runs it once and returns an empty string or the reason why it must
/// not be timed. Rows to memory then run twice more without a clock: up to three calls of a kind
/// measure which stores are faster there.
template <typename Make>
void register_row(const std::string& name, benchmark::TimeUnit unit, int threads, Make make) {
  const auto checked = std::make_shared<bool>(false); // once a process, not once a repetition
  const int calls_ahead = name.find("/memory/") == std::string::npos ? 0 : 2;
  auto run = [threads, make, checked, calls_ahead](benchmark::State& state) {
    if (output_buffer() == nullptr) {
      return fail_row(state, "no memory for the output");
    }
    auto row = make();
    if (!*checked) {
      const std::string failure = row.check();
      if (!failure.empty()) {
        return fail_row(state, failure);
      }
      for (int k = 0; k < calls_ahead; ++k) {
        row();
      }
      *checked = true;
    }
    static_cast<void>(strategies_taken());
    time_calls(state, threads, row.items(), row.bytes(), [&row] { row(); });
    state.SetLabel(strategies_taken());
  };
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(unit);
}

} // namespace simdbezier_bench
