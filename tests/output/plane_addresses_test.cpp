// Planes at every place of a cache line: bits as anywhere else, and not one value beside them.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "tests/output/placed_planes.hpp"
#include "tests/support/canvas.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/long_form.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::plane_addresses_test {
namespace {

struct GridSize {
  std::size_t nu;
  std::size_t nv;
};
/// Grids whose rows AVX-512 puts together to whole lines (simd/line_stream.hpp), and some whose
/// rows are stored as they are.
constexpr GridSize kGrids[] = {{7, 5},   {8, 8},   {8, 3},    {9, 9},   {12, 10}, {16, 16},
                               {16, 7},  {17, 17}, {20, 4},   {32, 32}, {32, 3},  {33, 33},
                               {15, 15}, {5, 4},   {16, 140}, {3, 3}};

constexpr GroupSet kOutputs[] = {kP, kP | kDu | kDv, kP | kN};

class PlaneAddresses : public IsaTest {
protected:
  template <typename T>
  void all_grids() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    std::size_t number = 0;
    for (const GridSize size : kGrids) {
      const Grid<T> samples = Grid<T>::uniform(size.nu, size.nv);
      Planes<T> reference(kPatches * size.nu * size.nv);
      grid(set, samples, reference.outputs(), {.threads = 1, .destination = Destination::cache});
      for (const GroupSet groups : kOutputs) {
        ++number;
        for (std::size_t shift = 0; shift < kLine / sizeof(T); ++shift) {
          if (in_form(number + shift, 3)) {
            compare(set, samples, groups, shift, reference);
          }
        }
      }
    }
  }

private:
  static constexpr std::size_t kPatches = 3;
  static constexpr std::size_t kLine = 64;

  /// Plane k begins shift + 7 k values behind the beginning of a line, modulo a line.
  template <typename T>
  void compare(const PatchSet<T>& set, const Grid<T>& samples, GroupSet groups, std::size_t shift,
               const Planes<T>& reference) {
    const std::size_t planes = 3 * static_cast<std::size_t>(std::popcount(groups));
    PlacedPlanes<T> memory(planes, reference.count());
    Outputs<T> out;
    std::size_t next = 0;
    const auto plane = [&] {
      const std::size_t k = next++;
      return memory.at(k, (shift + 7 * k) % (kLine / sizeof(T)));
    };
    T* begin[kVectorGroups][3];
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      if (holds(groups, g)) {
        std::generate_n(begin[g], 3, plane);
        *groups_of(out)[g] = Vectors<T>::planes(begin[g][0], begin[g][1], begin[g][2]);
      }
    }
    const int threads = shift % 8 == 3 ? 2 : 1;
    const auto destination = shift % 4 == 1 ? Destination::memory : Destination::cache;
    grid(set, samples, out, {.threads = threads, .destination = destination});
    const auto where = [&] {
      return std::to_string(samples.nu) + "x" + std::to_string(samples.nv) + " outputs " +
             std::to_string(groups) + " + " + std::to_string(shift);
    };
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      for (std::size_t c = 0; c < 3 && holds(groups, g); ++c) {
        EXPECT_TRUE(memory.take(begin[g][c], reference.plane(plane_group(g), c)))
            << where() << ", group " << g << " component " << c;
      }
    }
    EXPECT_TRUE(memory.is_poison()) << where();
  }
};

TEST_P(PlaneAddresses, OfPlanesF32) { all_grids<float>(); }
TEST_P(PlaneAddresses, OfPlanesF64) { all_grids<double>(); }
INSTANTIATE_FOR_EVERY_ISA(PlaneAddresses);

} // namespace
} // namespace simdbezier::tests::plane_addresses_test
