// Planes at every address, also where numbers are not aligned to their own size (in packed
// structures, in files that are mapped): bits as anywhere else, and not one byte beside them.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/canvas.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/long_form.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::any_address_test {
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

/// Planes in bytes, since a T cannot be read where it is not aligned. Around each of them are 64
/// bytes or more that are nobody's.
class BytePlanes {
public:
  BytePlanes(std::size_t planes, std::size_t plane_bytes)
      : bytes_(plane_bytes), pitch_((plane_bytes / kLine + 4) * kLine),
        memory_(planes * pitch_ + 3 * kLine, kPoison) {
    first_ = 2 * kLine - reinterpret_cast<std::uintptr_t>(memory_.data()) % kLine;
  }

  /// shift: bytes behind the beginning of a line, fewer than a line.
  [[nodiscard]] unsigned char* at(std::size_t plane, std::size_t shift) {
    return memory_.data() + first_ + plane * pitch_ + shift;
  }
  /// Whether the plane holds these values. Poisons it again.
  [[nodiscard]] bool take(unsigned char* plane, const void* values) const {
    const bool equal = std::memcmp(plane, values, bytes_) == 0;
    std::memset(plane, kPoison, bytes_);
    return equal;
  }
  /// Whether nothing was written but what was taken.
  [[nodiscard]] bool is_poison() const {
    return std::all_of(memory_.begin(), memory_.end(),
                       [](unsigned char byte) { return byte == kPoison; });
  }

private:
  static constexpr std::size_t kLine = 64;
  static constexpr unsigned char kPoison = 0xa5;

  std::size_t bytes_;
  std::size_t pitch_;
  std::vector<unsigned char> memory_;
  std::size_t first_;
};

class AnyAddress : public IsaTest {
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
        for (std::size_t shift = 0; shift < 64; ++shift) {
          if (in_form(number + shift, 5)) {
            compare(set, samples, groups, shift, reference);
          }
        }
      }
    }
  }

private:
  static constexpr std::size_t kPatches = 3;

  /// Plane k begins shift + 7 k bytes behind the beginning of a line, modulo a line.
  template <typename T>
  void compare(const PatchSet<T>& set, const Grid<T>& samples, GroupSet groups, std::size_t shift,
               const Planes<T>& reference) {
    const std::size_t planes = 3 * static_cast<std::size_t>(std::popcount(groups));
    BytePlanes memory(planes, reference.count() * sizeof(T));
    Outputs<T> out;
    std::size_t next = 0;
    const auto plane = [&] {
      const std::size_t k = next++;
      return memory.at(k, (shift + 7 * k) % 64);
    };
    unsigned char* begin[kVectorGroups][3];
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      if (holds(groups, g)) {
        std::generate_n(begin[g], 3, plane);
        const auto at = [&](std::size_t c) { return reinterpret_cast<T*>(begin[g][c]); };
        *groups_of(out)[g] = Vectors<T>::planes(at(0), at(1), at(2));
      }
    }
    const int threads = shift % 8 == 3 ? 2 : 1;
    grid(set, samples, out, {.threads = threads, .destination = Destination::cache});
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

TEST_P(AnyAddress, OfPlanesF32) { all_grids<float>(); }
TEST_P(AnyAddress, OfPlanesF64) { all_grids<double>(); }
INSTANTIATE_FOR_EVERY_ISA(AnyAddress);

} // namespace
} // namespace simdbezier::tests::any_address_test
