// What a process sees of SIMDBEZIER_ISA: `./environment_isa WORD` sets it to WORD, resolves, tries
// an evaluate call and prints the status of both and the instruction set. Then it prints whether
// grids that are large enough for a choice of instruction sets keep to the resolved one ("kept") or
// may take the next narrower one ("free"). Once per process, because the library reads the variable
// at its first use.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <simdbezier/simdbezier.hpp>

namespace {

const char* name_of(simdbezier::Status status) {
  switch (status.code()) {
  case simdbezier::Status::ok:
    return "ok";
  case simdbezier::Status::unknown_isa:
    return "unknown_isa";
  case simdbezier::Status::unsupported_isa:
    return "unsupported_isa";
  default:
    return "other";
  }
}

/// Grids of small squares, of which the first ones are evaluated on both where there is a choice.
const char* choice_of_large_grids(simdbezier::Isa resolved) {
  using namespace simdbezier;
  constexpr std::size_t kPatches = 256;
  const std::vector<float> points(48 * kPatches);
  PatchSet<float> set;
  if (!pack(ControlNets<float>{points.data(), kPatches}, set)) {
    return "failed";
  }
  for (std::size_t n = 2; n < 12; ++n) {
    std::vector<float> xyz(3 * kPatches * n * n);
    Outputs<float> out;
    out.position = Vectors<float>::xyz(xyz.data());
    if (!evaluate(set, Grid<float>::uniform(n, n), out)) {
      return "refused";
    }
    const Isa executed = take_executed_isa();
    if (executed != resolved) {
      return fuses_multiply_add(executed) == fuses_multiply_add(resolved) ? "free" : "wrong";
    }
  }
  return "kept";
}

} // namespace

int main(int argc, char** argv) {
  using namespace simdbezier;
  if (argc != 2 || setenv("SIMDBEZIER_ISA", argv[1], 1) != 0) {
    return 2;
  }
  Isa chosen = Isa::automatic;
  const Status resolved = resolve_isa(Isa::automatic, chosen);
  const float points[48] = {};
  PatchSet<float> set;
  if (!pack(ControlNets<float>{points, 1}, set)) {
    return 2;
  }
  float xyz[12] = {1};
  Outputs<float> out;
  out.position = Vectors<float>::xyz(xyz);
  const Status evaluated = evaluate(set, Grid<float>::uniform(2, 2), out);
  const Isa executed = take_executed_isa();
  std::printf("%s %s %s %s %s %s\n", name_of(resolved), name_of(evaluated),
              to_string(chosen).data(), to_string(executed).data(),
              xyz[0] == 1 ? "untouched" : "written", choice_of_large_grids(chosen));
  return 0;
}
