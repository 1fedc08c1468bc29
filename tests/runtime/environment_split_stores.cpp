// Whether stores across cache lines are taken for slow: `./environment_split_stores WORD` sets
// SIMDBEZIER_SPLIT_STORES to WORD and asks twice for each of three tables: one whose stores take a
// hundred times as long where they do not begin at a line's start, one whose stores never do, and
// one without stores. Prints the answers and how many tables were measured. Once per process,
// because the library reads the variable at its first use.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "src/choice/line_costs.hpp"

namespace {

using namespace simdbezier;
using namespace simdbezier::detail;

volatile unsigned work = 0;

void spend(unsigned rounds) {
  for (unsigned k = 0; k < rounds; ++k) {
    work = work + 1;
  }
}

int measured[2] = {};

void slow_across(float* to, std::size_t /*registers*/) {
  measured[0] = 1;
  spend(reinterpret_cast<std::uintptr_t>(to) % 64 == 0 ? 10 : 1000);
}

void never_slow(float* /*to*/, std::size_t /*registers*/) {
  measured[1] = 1;
  spend(100);
}

const char* answer(Isa isa, void (*stores)(float*, std::size_t)) {
  KernelTable<float> table{};
  table.isa = isa;
  table.lanes = 8;
  table.store_registers = stores;
  const bool first = splits_slowly(table);
  return first != splits_slowly(table) ? "undecided" : first ? "slow" : "fast";
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2 || setenv("SIMDBEZIER_SPLIT_STORES", argv[1], 1) != 0) {
    return 2;
  }
  const char* const answers[] = {answer(Isa::avx2, slow_across), answer(Isa::avx512, never_slow),
                                 answer(Isa::sse2, nullptr)};
  std::printf("%s %s %s, measured %d tables\n", answers[0], answers[1], answers[2],
              measured[0] + measured[1]);
  return 0;
}
