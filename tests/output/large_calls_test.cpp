// Calls that write more than the caches hold decide by themselves whether to stream: the first two
// or three of a kind store in every way, those after them in the fastest one. The bits are those of
// plain stores.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "src/choice/measured_call.hpp"
#include "src/runtime/cache_sizes.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::large_calls_test {
namespace {

constexpr std::size_t kSide = 33;
constexpr std::size_t kRepeated = 8; ///< patches, again and again
constexpr std::size_t kChunk = 3 * kRepeated * kSide * kSide;
/// Machines with larger caches than this would need more memory than a test should take.
constexpr std::size_t kMostBytes = std::size_t{600} << 20;

/// So many bytes are worth measuring.
std::size_t measured_bytes() {
  return std::max(detail::last_level_cache() / 2, 48 * detail::second_level_cache());
}

class LargeCalls : public IsaTest {
protected:
  /// call(set, out, options) on as many patches as are worth measuring.
  using Call =
      std::function<void(const PatchSet<float>&, const Outputs<float>&, const CallOptions&)>;
  void check(const Call& call) {
    const std::size_t bytes = measured_bytes();
    if (bytes > kMostBytes) {
      GTEST_SKIP() << "caches of " << bytes << " bytes";
    }
    const std::size_t repeats = bytes / (kChunk * sizeof(float)) + 1;
    ASSERT_GT(detail::half_block(repeats * kRepeated, repeats * kChunk * sizeof(float), 3, 1), 0U);
    const std::vector<Net> some = mixed_nets(kRepeated);
    std::vector<Net> nets;
    for (std::size_t k = 0; k < repeats * kRepeated; ++k) {
      nets.push_back(some[k % kRepeated]);
    }
    const PatchSet<float> few = packed<float>(some);
    const PatchSet<float> many = packed<float>(nets);
    check(call, few, many, repeats, 1);
    check(call, few, many, repeats, 3);
  }

private:
  /// many: `few` so many times. planes: 1 for triples, 3 for x, y and z apart.
  static void check(const Call& call, const PatchSet<float>& few, const PatchSet<float>& many,
                    std::size_t repeats, std::size_t planes) {
    const std::size_t piece = kChunk / planes;
    const auto outputs = [&](float* first, std::size_t pieces) {
      const std::size_t plane = piece * pieces;
      Outputs<float> out;
      out.position = planes == 1 ? Vectors<float>::xyz(first)
                                 : Vectors<float>::planes(first, first + plane, first + 2 * plane);
      return out;
    };
    std::vector<float> expected(kChunk);
    call(few, outputs(expected.data(), 1), {.threads = 1, .destination = Destination::cache});
    std::vector<float> found(repeats * kChunk);
    constexpr CallOptions kAutomatic = {.threads = 1};
    constexpr CallOptions kMemory = {.threads = 1, .destination = Destination::memory};
    // The fourth call of a kind keeps what those before it have found.
    constexpr CallOptions kCalls[] = {kAutomatic,     kAutomatic,     kAutomatic, kAutomatic,
                                      {.threads = 2}, {.threads = 6}, kMemory,    kMemory,
                                      kMemory,        kMemory};
    for (const CallOptions& options : kCalls) {
      std::fill(found.begin(), found.end(), -7.0F);
      call(many, outputs(found.data(), repeats), options);
      std::size_t different = 0;
      for (std::size_t k = 0; k < planes * repeats; ++k) {
        different += std::memcmp(found.data() + k * piece, expected.data() + k / repeats * piece,
                                 piece * sizeof(float)) != 0;
      }
      EXPECT_EQ(different, 0U) << "of " << planes << " times " << repeats
                               << " pieces, threads: " << options.threads;
    }
  }

protected:
  /// Planes of small squares that leave the caches by plain stores: kernels store them in another
  /// way than those that stay. The same patches follow each other again and again.
  template <typename T>
  void plain_planes() {
    const std::size_t bytes = detail::last_level_cache() / 2;
    if (bytes > kMostBytes) {
      GTEST_SKIP() << "caches of " << 2 * bytes << " bytes";
    }
    const std::vector<Net> some = mixed_nets(kRepeated);
    const std::vector<T> points = packed_points<T>(some);
    const PatchSet<T> few = packed<T>(some);
    const auto repeats_of = [&](std::size_t samples, std::size_t planes) {
      return bytes / (kRepeated * samples * planes * sizeof(T)) + 1;
    };
    std::vector<T> all;
    for (std::size_t r = 0; r < repeats_of(16, 3); ++r) {
      all.insert(all.end(), points.begin(), points.end());
    }
    PatchSet<T> set;
    expect_packed(
        pack(ControlNets<T>::packed(all.data(), repeats_of(16, 3) * kRepeated, 3, 3, 3), set));
    std::vector<T> found;
    for (const std::size_t side : {4U, 5U, 6U, 9U}) {
      for (const Output second : {Output::position, Output::normal, Output::du}) {
        const std::size_t groups = second == Output::position ? 1
                                   : second == Output::normal ? 2
                                                              : 3;
        const std::size_t chunk = kRepeated * side * side;
        const std::size_t repeats = repeats_of(side * side, 3 * groups);
        const auto outputs = [&](T* first, std::size_t count) {
          Outputs<T> out;
          const auto next = [&] {
            T* const plane = first;
            first += 3 * count;
            return Vectors<T>::planes(plane, plane + count, plane + 2 * count);
          };
          out.position = next();
          if (groups > 1) {
            out[second] = next();
          }
          if (groups > 2) {
            out.dv = next();
          }
          return out;
        };
        const Grid<T> samples = Grid<T>::uniform(side, side);
        const CallOptions plain{.threads = 1, .destination = Destination::cache};
        std::vector<T> expected(3 * groups * chunk);
        grid(few, samples, outputs(expected.data(), chunk), plain);
        found.assign(3 * groups * chunk * repeats, T(-7));
        CallOptions many = plain;
        many.patch_count = repeats * kRepeated;
        grid(set, samples, outputs(found.data(), chunk * repeats), many);
        std::size_t different = 0;
        for (std::size_t k = 0; k < 3 * groups * repeats; ++k) {
          different += std::memcmp(found.data() + k * chunk, expected.data() + k / repeats * chunk,
                                   chunk * sizeof(T)) != 0;
        }
        EXPECT_EQ(different, 0U) << side << "x" << side << ", " << groups << " outputs";
      }
    }
  }
};

TEST_P(LargeCalls, OnOneGrid) {
  check([this](const PatchSet<float>& set, const Outputs<float>& out, const CallOptions& options) {
    grid(set, Grid<float>::uniform(kSide, kSide), out, options);
  });
}

TEST_P(LargeCalls, OnGridsOfTheirOwn) {
  check([this](const PatchSet<float>& set, const Outputs<float>& out, const CallOptions& options) {
    const std::vector<std::uint32_t> side(set.size(), kSide);
    PatchGrids grids;
    grids.nu = grids.nv = side;
    patch_grids(set, grids, out, options);
  });
}

// No row begins in the last part of the call, which therefore runs no kernel.
TEST_P(LargeCalls, OnTwoRows) {
  const std::size_t bytes = measured_bytes();
  if (bytes > kMostBytes) {
    GTEST_SKIP() << "caches of " << bytes << " bytes";
  }
  const std::uint32_t nu[] = {static_cast<std::uint32_t>(bytes / 2 / (3 * sizeof(float)) + 1)};
  const std::uint32_t nv[] = {2};
  PatchGrids grids;
  grids.nu = nu;
  grids.nv = nv;
  const PatchSet<float> set = packed<float>(mixed_nets(1));
  std::vector<float> found[2];
  for (std::vector<float>& xyz : found) {
    xyz.resize(std::size_t{nu[0]} * 2 * 3);
    Outputs<float> out;
    out.position = Vectors<float>::xyz(xyz.data());
    patch_grids(set, grids, out, CallOptions{.threads = 1});
  }
  EXPECT_EQ(std::memcmp(found[0].data(), found[1].data(), found[0].size() * sizeof(float)), 0);
}

TEST_P(LargeCalls, InPlanesByPlainStoresF32) { plain_planes<float>(); }
TEST_P(LargeCalls, InPlanesByPlainStoresF64) { plain_planes<double>(); }

INSTANTIATE_FOR_EVERY_ISA(LargeCalls);

// Measuring takes a quarter of a call at most, and every call that is large enough for that does.
TEST(MeasuredBlocks, AreAQuarterAtMost) {
  const std::size_t cache = detail::second_level_cache();
  for (const int threads : {1, 2, 3, 16}) {
    for (const std::size_t ways : {2U, 3U}) {
      const std::size_t blocks = detail::half_blocks(ways);
      const std::size_t enough = 4 * blocks * static_cast<std::size_t>(threads) * (cache / 2);
      for (const std::size_t item : {std::size_t{36}, std::size_t{972}, cache / 40, cache / 9}) {
        for (std::size_t bytes = enough / 8; bytes < 16 * enough; bytes += bytes / 7) {
          const std::size_t items = bytes / item;
          const std::size_t half = detail::half_block(items, items * item, ways, threads);
          EXPECT_LE(4 * blocks * half, items) << item << " bytes, " << items << " items";
          EXPECT_EQ(half > 0, items * item >= enough) << item << " bytes, " << items << " items";
        }
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::large_calls_test
