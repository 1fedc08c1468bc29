#include "bench/baselines/baselines.hpp"

#include <string_view>

#include <simdbezier/options.hpp>

#include "simdbezier_bench/isa_list.hpp"

namespace simdbezier_bench {

SIMDBEZIER_BENCH_EACH_ISA(SIMDBEZIER_BENCH_DECLARE_BASELINES)

template <typename T>
Baselines<T> widest_baselines() {
  Baselines<T> widest;
  for (const simdbezier::Isa isa : simdbezier::available_isas()) { // narrowest first
    const std::string_view name = simdbezier::to_string(isa);
#define SIMDBEZIER_BENCH_TAKE(isa_name)                                                            \
  if (name == #isa_name) {                                                                         \
    widest = {isa_name::de_casteljau, isa_name::de_casteljau_scattered, isa_name::autovectorised,  \
              isa_name::de_casteljau_curves};                                                      \
  }
    SIMDBEZIER_BENCH_EACH_ISA(SIMDBEZIER_BENCH_TAKE)
#undef SIMDBEZIER_BENCH_TAKE
  }
  return widest;
}

template Baselines<float> widest_baselines<float>();
template Baselines<double> widest_baselines<double>();

} // namespace simdbezier_bench
