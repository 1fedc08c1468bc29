// What a parent's flags may not take from the library: NaN is refused, and results keep their bits.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <simdbezier/simdbezier.hpp>

using namespace simdbezier;

int main() {
  std::vector<float> points(3 * 16);
  std::uint32_t random = 1;
  for (float& value : points) {
    random = random * 1664525 + 1013904223;
    value = static_cast<float>(random >> 8) / 65536.0F - 100.0F;
  }
  const auto nets = ControlNets<float>::packed(std::span<const float>(points));
  PatchSet<float> set;
  std::vector<float> values(2 * 3 * 17 * 17);
  Outputs<float> out;
  out.position = Vectors<float>::xyz(values, 6);
  out.normal = Vectors<float>::xyz(std::span(values).subspan(3), 6);
  if (!pack(nets, set) || !evaluate(set, Grid<float>::uniform(17, 17), out)) {
    return std::puts("nothing was evaluated") > 0;
  }
  std::uint32_t sum = 0;
  for (const float& value : values) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    sum = 31 * sum + bits;
  }
  points[7] = std::strtof("nan", nullptr);
  const bool refused = pack(nets, set).status == Status::non_finite_input;
  std::printf("bits %08x, NaN %s\n", sum, refused ? "refused" : "taken");
}
