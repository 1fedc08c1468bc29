// What a process sees of SIMDBEZIER_ISA: `./environment_isa WORD` sets it to WORD, resolves, tries
// an evaluate call and prints the status of both and the instruction set. Once per process, because
// the library reads the variable at its first use.
#include <cstdio>
#include <cstdlib>

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
  Isa executed = Isa::automatic;
  Options options;
  options.executed = &executed;
  const Status evaluated = evaluate(set, Grid<float>::uniform(2, 2), out, options);
  std::printf("%s %s %s %s %s\n", name_of(resolved), name_of(evaluated), to_string(chosen).data(),
              to_string(executed).data(), xyz[0] == 1 ? "untouched" : "written");
  return 0;
}
