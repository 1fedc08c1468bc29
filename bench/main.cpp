// simdbezier_bench: all rows, as README.md beside this file lists them.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <omp.h>
#include <simdbezier/options.hpp>

#include "bench/machine.hpp"
#include "bench/rows/plugin_rows.hpp"
#include "bench/rows/rows.hpp"
#include "src/choice/strategies.hpp"

namespace simdbezier_bench {
namespace {

std::atomic<bool> failed{false};

constexpr char kUsage[] =
    "usage: simdbezier_bench [--evaluator FILE.so]... [--without STRATEGY]... [Google Benchmark's "
    "flags]\n"
    "  --evaluator FILE.so  rows of another evaluator beside the library's own\n"
    "                       (simdbezier/evaluator_plugin.h, docs/judge-your-own.md)\n"
    "  --without STRATEGY   the library's rows do without one of its strategies for grids\n"
    "                       (bench/README.md)\n"
    "bench/README.md describes the rows, and --benchmark_list_tests lists them.\n"
    "exit: 0 all rows are right, 1 a wrong row, a plug-in's fault, or a filter that no row "
    "matches\n"
    "\n";

} // namespace

int max_threads() { return omp_get_num_procs(); }

void fail_row(benchmark::State& state, const std::string& message) {
  failed = true;
  state.SkipWithError(message.c_str());
}

bool any_row_failed() { return failed; }

std::string strategies_taken() {
  const simdbezier::detail::StrategySet taken = simdbezier::detail::take_strategies();
  std::string names;
  for (std::size_t k = 0; k < simdbezier::detail::kGridStrategies; ++k) {
    if (taken.has(static_cast<simdbezier::detail::GridStrategy>(k))) {
      names += (names.empty() ? "" : " ") + std::string(simdbezier::detail::kGridStrategyNames[k]);
    }
  }
  return names;
}

/// Returns the values of "OPTION VALUE" and "OPTION=VALUE", which it takes out of the arguments.
static std::vector<std::string> take_option(std::vector<char*>& arguments,
                                            const std::string& option) {
  std::vector<std::string> values;
  for (std::size_t k = 1; k < arguments.size();) {
    const std::string word = arguments[k];
    const bool next = word == option && k + 1 < arguments.size();
    if (!next && word.rfind(option + "=", 0) != 0) {
      ++k;
      continue;
    }
    values.push_back(next ? arguments[k + 1] : word.substr(option.size() + 1));
    const auto at = arguments.begin() + static_cast<std::ptrdiff_t>(k);
    arguments.erase(at, at + (next ? 2 : 1));
  }
  return values;
}

/// Lets the library do without these strategies. Returns false, and says so, if one is unknown.
static bool forbid_strategies(const std::vector<std::string>& names) {
  using simdbezier::detail::kGridStrategyNames;
  auto allowed = simdbezier::detail::StrategySet::all();
  const auto* const last = std::end(kGridStrategyNames) - 1; // tiles, which is the general path
  for (const std::string& name : names) {
    const auto* const found = std::find(std::begin(kGridStrategyNames), last, name);
    if (found == last) {
      std::fprintf(stderr, "simdbezier_bench: --without: expected one of");
      std::for_each(std::begin(kGridStrategyNames), last, [](std::string_view known) {
        std::fprintf(stderr, " %s", std::string(known).c_str());
      });
      std::fprintf(stderr, ", found %s\n", name.c_str());
      return false;
    }
    allowed.remove(
        static_cast<simdbezier::detail::GridStrategy>(found - std::begin(kGridStrategyNames)));
  }
  simdbezier::detail::allow_strategies(allowed);
  return true;
}

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
  if (std::find(argv, argv + argc, std::string_view("--help")) != argv + argc) {
    std::fputs(kUsage, stdout); // Google Benchmark's flags follow
  }
  bool faulty = false;
  const auto plugins = start_plugins(take_option(arguments, "--evaluator"), faulty);
  if (faulty && plugins.empty()) { // the library's rows alone take an hour that nobody asked for
    return 1;
  }
  if (!forbid_strategies(take_option(arguments, "--without"))) {
    return 2;
  }
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
  register_frame_rows();
  register_call_rows();
  register_pack_rows();
  register_spline_rows();
  register_curve_rows();
  register_peer_rows();
  register_mesh_peer_rows();
  register_plugin_rows(plugins);
  register_limit_rows();
  const std::size_t matching = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  if (matching == 0) {
    std::fputs("simdbezier_bench: --benchmark_filter: no row matches; --benchmark_list_tests lists "
               "them\n",
               stderr);
  }
  return any_row_failed() || faulty || matching == 0 ? 1 : 0;
}
