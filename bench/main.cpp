// simdbezier_bench: every row of design section "Benchmark names"; see README.md beside this file.
#include <algorithm>
#include <atomic>
#include <thread>

#include "bench/machine.hpp"
#include "bench/rows.hpp"

namespace simdbezier_bench {
namespace {

std::atomic<bool> failed{false};

} // namespace

int max_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void fail_row(benchmark::State& state, const std::string& message) {
  failed = true;
  state.SkipWithError(message.c_str());
}

bool any_row_failed() { return failed; }

} // namespace simdbezier_bench

int main(int argc, char** argv) {
  using namespace simdbezier_bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  add_machine_context();
  register_grid_rows();
  register_limit_rows();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return any_row_failed() ? 1 : 0;
}
