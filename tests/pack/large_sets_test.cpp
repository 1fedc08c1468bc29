// Sets that are larger than the caches are written past them. Their patches are the same as those
// of small sets, wherever they lie in a register's group of patches.
#include <cstddef>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "src/runtime/cache_sizes.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::large_sets_test {
namespace {

constexpr std::size_t kNets = 61; // no multiple of what a register holds
constexpr std::size_t kSize = 3;
constexpr std::size_t kSamples = kNets * kSize * kSize;

class LargeSets : public IsaTest {
protected:
  /// Results of all patches: positions, then normals, sample after sample.
  template <typename T>
  std::vector<T> evaluated(const PatchSet<T>& set) {
    const std::size_t samples = set.size() * kSize * kSize;
    std::vector<T> values(6 * samples);
    Outputs<T> out;
    out.position = Vectors<T>::xyz(values.data(), 6);
    out.normal = Vectors<T>::xyz(values.data() + 3, 6);
    grid(set, Grid<T>::uniform(kSize, kSize), out);
    return values;
  }

  template <typename T, typename S>
  void compare(bool local_origin) {
    const std::vector<S> one = packed_points<S>(mixed_nets(kNets));
    // Sets of more than half of the last cache are streamed; a patch takes more than 512 bytes.
    const std::size_t repeats = detail::last_level_cache() / 1024 / kNets + 2;
    std::vector<S> points;
    for (std::size_t k = 0; k < repeats; ++k) {
      points.insert(points.end(), one.begin(), one.end());
    }
    PackOptions options;
    options.local_origin = local_origin;
    options.isa = isa();
    options.threads = 2;
    PatchSet<T> small;
    PatchSet<T> large;
    expect_packed(pack(ControlNets<S>{one.data(), kNets}, small, options));
    expect_packed(pack(ControlNets<S>{points.data(), repeats * kNets}, large, options));
    const std::vector<T> expected = evaluated(small);
    const std::vector<T> found = evaluated(large);
    ASSERT_EQ(found.size(), repeats * expected.size());
    std::size_t different = 0;
    for (std::size_t k = 0; k < repeats; ++k) {
      different += std::memcmp(found.data() + k * 6 * kSamples, expected.data(),
                               6 * kSamples * sizeof(T)) != 0;
    }
    EXPECT_EQ(different, 0U) << "of " << repeats;
  }
};

TEST_P(LargeSets, hold_the_patches_of_small_ones) {
  compare<float, float>(false);
  compare<float, float>(true);
  compare<float, double>(false);
  compare<double, double>(true);
}

INSTANTIATE_FOR_EVERY_ISA(LargeSets);

} // namespace
} // namespace simdbezier::tests::large_sets_test
