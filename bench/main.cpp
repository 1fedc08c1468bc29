// simdbezier_bench: all rows, as README.md beside this file lists them.
#include <atomic>
#include <cstdio>
#include <string>
#include <vector>

#include <omp.h>
#include <simdbezier/isa.hpp>

#include "bench/machine.hpp"
#include "bench/plugin_rows.hpp"
#include "bench/rows.hpp"

namespace simdbezier_bench {
namespace {

std::atomic<bool> failed{false};

} // namespace

int max_threads() { return omp_get_num_procs(); }

void fail_row(benchmark::State& state, const std::string& message) {
  failed = true;
  state.SkipWithError(message.c_str());
}

bool any_row_failed() { return failed; }

std::string RowName::text() const {
  const char* const names[] = {"position", "position_normal", "position_derivatives",
                               "second_derivatives", "curvature"};
  return call + "/" + names[static_cast<int>(outputs)] + (single ? "/f32/" : "/f64/") + who + "/" +
         std::to_string(nu) + "x" + std::to_string(nv) +
         (level == MemoryLevel::cache ? "/cache" : "/memory") +
         "/threads:" + std::to_string(threads);
}

std::string shape_parts(BatchShape shape) {
  const std::string degree = std::to_string(shape.degree_u) + "x" + std::to_string(shape.degree_v);
  return (degree == "3x3" ? std::string() : "/degree:" + degree) +
         (shape.rational ? "/weights:rational" : "");
}

} // namespace simdbezier_bench

int main(int argc, char** argv) {
  using namespace simdbezier_bench;
  // Google Benchmark's half second a row would take an hour. A later flag overrides this one.
  std::string min_time = "--benchmark_min_time=0.05";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + (argc > 0 ? 1 : 0), min_time.data());
  bool faulty = false;
  const auto plugins = start_plugins(take_evaluators(arguments), faulty);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) {
    return 2;
  }
  if (simdbezier::available_isas().empty()) {
    std::fputs("this machine has none of the instruction sets that the library was built for\n",
               stderr);
    return 1;
  }
  add_machine_context();
  register_grid_rows();
  register_shape_rows();
  register_derivative_rows();
  register_tile_rows();
  register_scattered_rows();
  register_net_rows();
  register_tessellate_rows();
  register_tolerance_rows();
  register_pack_rows();
  register_curve_rows();
  register_peer_rows();
  register_mesh_peer_rows();
  register_plugin_rows(plugins);
  register_limit_rows();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return any_row_failed() || faulty ? 1 : 0;
}
