#include "bench/machine.hpp"

#include <fstream>
#include <string>

#include <benchmark/benchmark.h>
#include <simdbezier/options.hpp>
#include <simdbezier/version.hpp>

#include "bench/rows/rows.hpp"
#include "simdbezier_bench/build_facts.hpp"

namespace simdbezier_bench {
namespace {

/// x86 has a "model name", aarch64 numbers only.
std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const bool named = line.starts_with("model name");
    if (named || line.starts_with("CPU part")) {
      const auto colon = line.find(": ");
      return colon == std::string::npos ? line : line.substr(named ? colon + 2 : 0);
    }
  }
  return "unknown";
}

std::string isa_names() {
  std::string names;
  for (const simdbezier::Isa isa : simdbezier::available_isas()) {
    names += names.empty() ? "" : " ";
    names += simdbezier::to_string(isa);
  }
  return names;
}

std::string chosen_isa() {
  simdbezier::Isa chosen = simdbezier::Isa::automatic;
  const simdbezier::Status status = simdbezier::resolve_isa(simdbezier::Isa::automatic, chosen);
  return std::string(status == simdbezier::Status::ok ? simdbezier::to_string(chosen)
                                                      : simdbezier::to_string(status));
}

} // namespace

void add_machine_context() {
#if defined(__clang__)
  const std::string compiler = "clang " __clang_version__;
#else
  const std::string compiler = "g++ " __VERSION__;
#endif
  benchmark::AddCustomContext("cpu", cpu_model());
  benchmark::AddCustomContext("cores", std::to_string(max_threads()));
  benchmark::AddCustomContext("compiler", compiler);
  benchmark::AddCustomContext("flags", kFlags);
  benchmark::AddCustomContext("baseline_flags", kBaselineFlags);
  benchmark::AddCustomContext("isas", isa_names());
  benchmark::AddCustomContext("isa", chosen_isa());
}

} // namespace simdbezier_bench
