// Per-patch grids: each patch's samples are those of a grid call on it alone, bit for bit, and what
// lies between the patches' samples is left as it was.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/output/layouts.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/workload.hpp"

namespace simdbezier::tests::patch_grids_test {
namespace {

constexpr int kThreads[] = {1, 2, 5};
constexpr Wanted kEverything{.second = true};

/// Numbers of samples for each patch, and where they go.
struct Sizes {
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  std::vector<std::size_t> offset; ///< filled by place()

  [[nodiscard]] std::size_t samples(std::size_t k) const { return std::size_t{nu[k]} * nv[k]; }

  /// Puts `gap(k)` free places before patch k; returns the number of places in all.
  template <typename Gap>
  std::size_t place(const Gap& gap) {
    std::size_t end = 0;
    offset.clear();
    for (std::size_t k = 0; k < nu.size(); ++k) {
      offset.push_back(end + gap(k));
      end = offset.back() + samples(k);
    }
    return end;
  }
  [[nodiscard]] PatchGrids view(bool with_offsets) const {
    return {nu, nv, with_offsets ? std::span(offset) : std::span<const std::size_t>()};
  }
};

[[nodiscard]] Sizes random_sizes(std::size_t patches, int most, std::uint64_t seed,
                                 int least_nu = 2) {
  Random random(seed);
  Sizes sizes;
  for (std::size_t k = 0; k < patches; ++k) {
    sizes.nu.push_back(static_cast<std::uint32_t>(random.integer(least_nu, most)));
    sizes.nv.push_back(static_cast<std::uint32_t>(random.integer(2, most)));
  }
  return sizes;
}

enum class Offsets : std::uint8_t { none, packed, gaps };

class PatchGridsTest : public IsaTest {
protected:
  /// Grid calls on each patch alone; places in the gaps keep what Planes is filled with.
  template <typename T>
  [[nodiscard]] Planes<T> reference_of(const PatchSet<T>& set, const Sizes& sizes,
                                       std::size_t first, std::size_t places, Wanted wanted,
                                       bool watertight) {
    Planes<T> reference(places, wanted);
    for (std::size_t k = 0; k < sizes.nu.size(); ++k) {
      grid(set, Grid<T>::uniform(sizes.nu[k], sizes.nv[k]),
           advanced(reference.outputs(), sizes.offset[k]),
           {.threads = 1, .watertight = watertight, .first_patch = first + k, .patch_count = 1});
    }
    return reference;
  }

  template <typename T>
  void check(const PatchSet<T>& set, Sizes sizes, Offsets offsets, const CallOptions& options,
             Wanted wanted = kEverything) {
    const std::size_t places =
        sizes.place([&](std::size_t k) { return offsets == Offsets::gaps ? k * 7 % 5 : 0; });
    const Planes<T> reference =
        reference_of(set, sizes, options.first_patch, places, wanted, options.watertight);
    Planes<T> found(places, wanted);
    patch_grids(set, sizes.view(offsets != Offsets::none), found.outputs(), options);
    EXPECT_EQ(differing_values(found, reference), 0U)
        << sizes.nu.size() << " patches from " << options.first_patch << ", offsets "
        << static_cast<int>(offsets) << ", " << options.threads << " threads";
  }

  template <typename T>
  void random_grids() {
    const PatchSet<T> set = packed<T>(mixed_nets(90));
    for (const Offsets offsets : {Offsets::none, Offsets::packed, Offsets::gaps}) {
      for (const int threads : kThreads) {
        check(set, random_sizes(90, 70, 5), offsets, {.threads = threads},
              {.second = threads == 1});
        check(set, random_sizes(90, 6, 7), offsets, {.threads = threads});
      }
      check(set, random_sizes(1, 20, 8), offsets, {.threads = 3, .patch_count = 1});
      check(set, random_sizes(2, 3, 9), offsets, {.threads = 7, .patch_count = 2});
    }
  }

  /// All pairs of small sizes, so that every strategy meets every other.
  template <typename T>
  void every_small_size() {
    Sizes sizes;
    for (std::uint32_t nu = 2; nu <= 35; ++nu) {
      for (const std::uint32_t nv : {2U, 3U, 5U, 9U}) {
        sizes.nu.push_back(nu);
        sizes.nv.push_back(nv);
      }
    }
    const PatchSet<T> set = packed<T>(mixed_nets(sizes.nu.size()));
    check(set, sizes, Offsets::none, {.threads = 1});
    check(set, sizes, Offsets::gaps, {.threads = 2, .watertight = false});
  }

  /// Grids of one size, whose places are not looked up; and all but one of them.
  template <typename T>
  void one_size() {
    for (const std::size_t patches : {1U, 2U, 90U}) {
      const PatchSet<T> set = packed<T>(mixed_nets(patches));
      for (const std::uint32_t nu : {2U, 5U, 17U, 70U}) {
        for (const std::uint32_t nv : {2U, 3U, 33U}) {
          Sizes sizes{std::vector(patches, nu), std::vector(patches, nv), {}};
          for (const int threads : kThreads) {
            check(set, sizes, Offsets::none, {.threads = threads}, {.second = nu == 5});
          }
          check(set, sizes, Offsets::gaps, {.threads = 2});
          ++(nu == 5 ? sizes.nu : sizes.nv).back();
          check(set, sizes, Offsets::none, {.threads = 2});
        }
      }
    }
  }

  template <typename T>
  void windows() {
    const PatchSet<T> set = packed<T>(mixed_nets(12), {.local_origin = true});
    for (const auto& [first, count] :
         {std::pair<std::size_t, std::size_t>{0, 12}, {0, 1}, {11, 1}, {3, 6}}) {
      check(set, random_sizes(count, 20, first), Offsets::gaps,
            {.threads = 2, .first_patch = first, .patch_count = count});
      check(set, random_sizes(count, 20, first), Offsets::none,
            {.threads = 1, .watertight = false, .first_patch = first, .patch_count = count});
    }
  }

  /// One patch that several threads have to share, among many small ones.
  template <typename T>
  void dense_patch() {
    const PatchSet<T> set = packed<T>(mixed_nets(60));
    for (const std::size_t dense : {0U, 30U, 59U}) {
      Sizes sizes;
      sizes.nu.assign(60, 3);
      sizes.nv.assign(60, 3);
      sizes.nu[dense] = dense == 30 ? 2000 : 700;
      sizes.nv[dense] = dense == 30 ? 1500 : 401;
      check(set, sizes, dense == 0 ? Offsets::none : Offsets::gaps,
            {.threads = dense == 59 ? 2 : 5}, {true, false, false, false});
    }
  }

  template <typename T>
  void layouts(Sizes sizes) {
    const std::size_t patches = sizes.nu.size();
    const PatchSet<T> set = packed<T>(mixed_nets(patches));
    Canvas<T> canvas(0);
    std::size_t turn = 0;
    for (const std::size_t gap : {std::size_t{0}, std::size_t{3}}) {
      const std::size_t places = sizes.place([&](std::size_t) { return gap; });
      const Planes<T> reference = reference_of(set, sizes, 0, places, kEverything, true);
      const auto check_layout = [&](const char* name, const Outputs<T>& out) {
        patch_grids(set, sizes.view(gap > 0), out,
                    {.threads = turn % 5 == 2 ? 2 : 1,
                     .destination = turn % 3 == 0 ? Destination::cache : Destination::memory});
        EXPECT_EQ(canvas.defects(out, reference, places), 0U) << name << ", gap " << gap;
        ++turn;
      };
      for (std::size_t shift = 0; shift < 16; ++shift) {
        for (const PlaneCase& layout : kPlaneCases) {
          canvas.reset(plane_elements(layout, places));
          check_layout(layout.name, plane_outputs(layout, places, shift, canvas.at(0)));
        }
        for (const VertexCase& layout : vertex_cases()) {
          canvas.reset(vertex_elements(layout, places) + shift);
          check_layout(layout.name, vertex_outputs(layout, places, canvas.at(shift)));
        }
      }
    }
  }
};

TEST_P(PatchGridsTest, RandomGridsF32) { random_grids<float>(); }
TEST_P(PatchGridsTest, RandomGridsF64) { random_grids<double>(); }
TEST_P(PatchGridsTest, EverySmallSizeF32) { every_small_size<float>(); }
TEST_P(PatchGridsTest, EverySmallSizeF64) { every_small_size<double>(); }
TEST_P(PatchGridsTest, OneSizeF32) { one_size<float>(); }
TEST_P(PatchGridsTest, OneSizeF64) { one_size<double>(); }
TEST_P(PatchGridsTest, WindowsF32) { windows<float>(); }
TEST_P(PatchGridsTest, WindowsF64) { windows<double>(); }
TEST_P(PatchGridsTest, DensePatchF32) { dense_patch<float>(); }
TEST_P(PatchGridsTest, LayoutsF32) { layouts<float>(random_sizes(13, 21, 4)); }
TEST_P(PatchGridsTest, LayoutsF64) { layouts<double>(random_sizes(13, 21, 4)); }
TEST_P(PatchGridsTest, LayoutsOfOneSizeF32) {
  layouts<float>({std::vector(13, 9U), std::vector(13, 5U), {}});
}
TEST_P(PatchGridsTest, LayoutsOfLongRowsF32) { layouts<float>(random_sizes(7, 35, 6, 16)); }
TEST_P(PatchGridsTest, LayoutsOfLongRowsF64) { layouts<double>(random_sizes(7, 35, 6, 8)); }
INSTANTIATE_FOR_EVERY_ISA(PatchGridsTest);

/// Three patches of 2x3, 4x2 and 3x3 samples, changed by one thing at a time.
class PatchGridErrors : public ::testing::Test {
protected:
  static constexpr std::size_t kPlaces = 23;

  void refuse(Status expected, const PatchGrids& grids, const CallOptions& options = {}) {
    Outputs<float> out;
    out.position = Vectors<float>::planes(canvas_.at(0), canvas_.at(64), canvas_.at(128));
    EXPECT_EQ(to_string(evaluate(set_, grids, out, options)), to_string(expected));
    EXPECT_TRUE(canvas_.untouched());
  }

  PatchSet<float> set_ = packed<float>(mixed_nets(3));
  std::uint32_t nu_[3] = {2, 4, 3};
  std::uint32_t nv_[3] = {3, 2, 3};
  std::size_t offset_[3] = {0, 6, 14};
  Canvas<float> canvas_{192};
};

TEST_F(PatchGridErrors, SizesThatAreNoGrid) {
  for (std::uint32_t* const sizes : {nu_, nv_}) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const std::uint32_t bad : {0U, 1U}) {
        const std::uint32_t good = std::exchange(sizes[k], bad);
        refuse(Status::bad_grid, {nu_, nv_});
        sizes[k] = good;
      }
    }
  }
}

TEST_F(PatchGridErrors, OffsetsThatDoNotAscendFarEnough) {
  const std::size_t bad[][3] = {{0, 5, 14}, {0, 6, 13}, {0, 6, 6},
                                {14, 6, 0}, {1, 6, 14}, {0, 0, 0}};
  for (const auto& offset : bad) {
    refuse(Status::bad_offsets, {nu_, nv_, offset});
  }
}

TEST_F(PatchGridErrors, LengthsThatDiffer) {
  const std::span<const std::uint32_t> nu(nu_);
  const std::span<const std::uint32_t> nv(nv_);
  const std::span<const std::size_t> offset(offset_);
  refuse(Status::unequal_lengths, {nu, nv.first(2)});
  refuse(Status::unequal_lengths, {nu.first(2), nv});
  refuse(Status::unequal_lengths, {nu, nv, offset.first(2)});
  refuse(Status::unequal_lengths, {nu.first(2), nv.first(2), offset});
  for (const std::size_t count : {0U, 2U, 4U}) {
    refuse(Status::unequal_lengths, {nu, nv, offset, {0, count}});
    EXPECT_EQ(sample_count(set_, PatchGrids{nu, nv, offset, {0, count}}), 0U);
  }
  EXPECT_EQ(sample_count(set_, PatchGrids{nu, nv, offset, {0, 3}}), 23U);
}

TEST_F(PatchGridErrors, MissingInputs) {
  constexpr const std::uint32_t* kNull = nullptr;
  refuse(Status::null_input, {{kNull, 3}, nv_, offset_});
  refuse(Status::null_input, {nu_, {kNull, 3}});
  refuse(Status::ok, {}, {.patch_count = 0});
  refuse(Status::ok, {}, {.first_patch = 3});
}

TEST_F(PatchGridErrors, PatchRanges) {
  refuse(Status::bad_patch_range, {nu_, nv_}, {.first_patch = 4});
  refuse(Status::bad_patch_range, {nu_, nv_}, {.first_patch = 1});
}

TEST_F(PatchGridErrors, SizesThatOverflow) {
  constexpr auto kMost = std::numeric_limits<std::uint32_t>::max();
  for (const std::size_t dense : {0U, 2U}) {
    nu_[dense] = nv_[dense] = kMost;
    refuse(Status::size_overflow, {nu_, nv_});
  }
  nu_[1] = nv_[1] = kMost;
  refuse(Status::size_overflow, {nu_, nv_});
  const std::vector<std::uint32_t> equal(4, std::uint32_t{1} << 31); // 4 * 2^62 samples
  set_ = packed<float>(mixed_nets(4));
  refuse(Status::size_overflow, {equal, equal});
  set_ = packed<float>(mixed_nets(3));
  const std::uint32_t small[3] = {2, 2, 2};
  const std::size_t far[3] = {0, 4, std::numeric_limits<std::size_t>::max() - 3};
  refuse(Status::size_overflow, {small, small, far});
  const std::size_t beyond[3] = {0, 4, std::size_t{1} << 62};
  refuse(Status::size_overflow, {small, small, beyond});
}

TEST_F(PatchGridErrors, Outputs) {
  const PatchGrids grids{nu_, nv_};
  Outputs<float> out;
  EXPECT_EQ(evaluate(set_, grids, out), Status::null_output);
  out.position = {canvas_.at(0), canvas_.at(kPlaces), nullptr, 1};
  EXPECT_EQ(evaluate(set_, grids, out), Status::missing_z);
  out.position = Vectors<float>::xyz(canvas_.at(0), 0);
  EXPECT_EQ(evaluate(set_, grids, out), Status::bad_stride);
  out.position = Vectors<float>::xyz(canvas_.at(0), 2);
  EXPECT_EQ(evaluate(set_, grids, out), Status::bad_stride);
  out.position = Vectors<float>::planes(canvas_.at(0), canvas_.at(22), canvas_.at(64));
  EXPECT_EQ(evaluate(set_, grids, out), Status::overlapping_outputs);
  EXPECT_TRUE(canvas_.untouched());
}

TEST(PatchGridsOfNothing, IsOk) {
  float values[3] = {-7, -7, -7};
  Outputs<float> out;
  out.position = Vectors<float>::xyz(values);
  EXPECT_EQ(evaluate(PatchSet<float>{}, PatchGrids{}, out), Status::ok);
  EXPECT_EQ(values[0], -7);
}

} // namespace
} // namespace simdbezier::tests::patch_grids_test
