#include <cstdio>

#include <simdbezier/simdbezier.hpp>

int main() {
  float points[48];
  for (int k = 0; k < 48; ++k) {
    points[k] = static_cast<float>(k % 3 == 0 ? k / 3 % 4 : k % 3 == 1 ? k / 12 : 0);
  }
  simdbezier::PatchSet<float> set;
  if (!simdbezier::pack(simdbezier::ControlNets<float>{points, 1}, set)) {
    return 1;
  }
  float xyz[3 * 81];
  simdbezier::Outputs<float> out;
  out.position = simdbezier::Vectors<float>::xyz(xyz);
  const auto grid = simdbezier::Grid<float>::uniform(9, 9);
  if (const auto status = simdbezier::evaluate(set, grid, out); !status) {
    std::printf("%s\n", simdbezier::to_string(status).data());
    return 1;
  }
  std::printf("corner %g %g %g\n", static_cast<double>(xyz[0]), static_cast<double>(xyz[1]),
              static_cast<double>(xyz[2]));
  return 0;
}
