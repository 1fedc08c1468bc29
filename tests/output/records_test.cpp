// Grids in rows of at least a register as records, which kernels put together by themselves: stored
// anywhere, or streamed where rows are whole registers and records begin on a cache line. They have
// the bits and statuses of planes in the cache, and no element is touched that is no output.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/call_options.hpp"
#include "tests/support/canvas.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/long_form.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::records_test {
namespace {

/// Arrays of records: position x y z, du a b c, dv d e f, normal n o p.
const std::string kLayouts[] = {"xyz",          "xyz nop",   "nop xyz",   "xyznop",     "nopxyz",
                                "xyz abc def",  "xyzabcdef", "abcdefxyz", "xyzabc def", "abc def",
                                "xyzabcdefnop", "nop",       "xy zn op"};
constexpr std::string_view kMembers = "xyzabcdef.........nop"; // in the order of Outputs

struct Size {
  std::size_t nu;
  std::size_t nv;
};

constexpr Size kSizes[] = {{16, 16}, {8, 8},   {32, 32}, {24, 5},   {64, 2}, {48, 3}, {16, 1},
                           {96, 9},  {17, 17}, {33, 5},  {9, 7},    {65, 3}, {5, 4},  {25, 20},
                           {18, 6},  {31, 3},  {13, 12}, {17, 131}, {7, 2},  {15, 3}, {41, 2}};
constexpr std::size_t kLine = 16; // elements, of float

class RecordTest : public IsaTest {
protected:
  /// Each array at a line's start, `shift` elements later where that is not 0, 128 bytes or more
  /// from the next.
  template <typename T>
  [[nodiscard]] static Outputs<T> place(const std::string& layout, std::size_t count,
                                        std::size_t shift, Canvas<T>& canvas) {
    canvas.reset(layout.size() * (count + shift + 3 * kLine));
    Outputs<T> out;
    std::istringstream arrays(layout);
    std::size_t first = shift;
    for (std::string members; arrays >> members;) {
      for (std::size_t m = 0; m < members.size(); ++m) {
        const std::size_t k = kMembers.find(members[m]);
        Vectors<T>& group = *groups_of(out)[k / 3];
        (k % 3 == 0 ? group.x : k % 3 == 1 ? group.y : group.z) = canvas.at(first + m);
        group.stride = static_cast<std::ptrdiff_t>(members.size());
      }
      first += (members.size() * count + kLine - 1) / kLine * kLine + 2 * kLine;
    }
    return out;
  }

  [[nodiscard]] static Wanted wanted_by(const std::string& layout) {
    const auto holds = [&](char member) { return layout.find(member) != std::string::npos; };
    return {.position = holds('x'), .tangents = holds('a'), .normal = holds('n')};
  }

  template <typename T>
  void check(const PatchSet<T>& set, const Grid<T>& samples, const std::string& layout,
             std::size_t shift, const CallOptions& options) {
    constexpr auto kUnused = static_cast<SampleStatus>(77);
    const std::size_t patches = std::min(options.patch_count, set.size() - options.first_patch);
    const std::size_t count = patches * samples.nu * samples.nv;
    Planes<T> reference(count, wanted_by(layout));
    CallOptions plain = options;
    plain.threads = 1;
    plain.destination = Destination::cache;
    grid(set, samples, reference.outputs(), plain);
    Canvas<T> canvas(0);
    Outputs<T> out = place(layout, count, shift, canvas);
    std::vector<SampleStatus> status(count + 2, kUnused);
    out.status = with_status_ ? status.data() + 1 : nullptr;
    grid(set, samples, out, options);
    const std::string what = layout + " + " + std::to_string(shift) + ", " +
                             std::to_string(samples.nu) + "x" + std::to_string(samples.nv) + ", " +
                             std::to_string(patches) + " patches" +
                             (options.watertight ? "" : ", open") +
                             (options.destination == Destination::cache ? ", cached" : "");
    EXPECT_EQ(canvas.defects(out, reference, count), 0U) << what;
    if (with_status_) {
      EXPECT_TRUE(std::equal(status.begin() + 1, status.end() - 1, reference.status().begin()))
          << what;
      EXPECT_TRUE(status.front() == kUnused && status.back() == kUnused) << what;
      unusual_ += std::count_if(status.begin() + 1, status.end() - 1,
                                [](SampleStatus s) { return s != SampleStatus::regular; });
    }
    with_status_ = !with_status_;
  }

  /// Uniform grids, all schemes, any number of patches and threads.
  template <typename T>
  void uniform_grids() {
    const std::vector<Net> nets = mixed_nets(17);
    const PatchSet<T> sets[] = {packed<T>(nets), packed<T>(nets, {.local_origin = true})};
    std::size_t turn = 0;
    std::size_t number = 0;
    for (const Size size : kSizes) {
      if (size.nv < 2) {
        continue;
      }
      std::size_t place = ++number;
      for (const std::string& layout : kLayouts) {
        ++place;
        for (std::size_t scheme = 0; scheme < 4; ++scheme, ++turn) {
          if (!in_form(place + scheme, 4)) {
            continue;
          }
          CallOptions options{.threads = turn % 5 == 3 ? 3 : 1,
                              .watertight = scheme < 2,
                              .destination = Destination::memory,
                              .first_patch = turn % 3,
                              .patch_count = turn * 5 % 13 + 2};
          const Grid<T> samples = Grid<T>::uniform(size.nu, size.nv);
          check(sets[scheme % 2], samples, layout, turn % 6 == 5 ? turn % 16 : 0, options);
          options.destination = Destination::cache;
          check(sets[scheme % 2], samples, layout, turn % 16, options);
        }
      }
    }
    EXPECT_GT(unusual_, 0);
  }

  /// Edges in the middle of rows and between rows, samples outside, parameters that are no numbers.
  template <typename T>
  void given_parameters() {
    const PatchSet<T> set = packed<T>(mixed_nets(8));
    Random random(5);
    std::size_t number = 0;
    for (const Size size : kSizes) {
      std::size_t place = ++number;
      std::vector<T> x(size.nu);
      std::vector<T> y(size.nv);
      for (std::vector<T>* const all : {&x, &y}) {
        for (std::size_t k = 0; k < all->size(); ++k) {
          (*all)[k] = k % 7 == 4 ? T(1.5) : boundary_centred<T>(random);
        }
      }
      x[size.nu / 2] = std::numeric_limits<T>::quiet_NaN();
      const Grid<T> samples{size.nu, size.nv, x.data(), y.data(), Parameters::centred};
      for (const std::string& layout : kLayouts) {
        ++place; // the next layout begins with the next choice
        for (const bool watertight : {true, false}) {
          for (const Destination destination : {Destination::memory, Destination::cache}) {
            if (!in_form(++place, 4)) {
              continue;
            }
            check(set, samples, layout, 0,
                  {.threads = 1,
                   .watertight = watertight,
                   .destination = destination,
                   .patch_count = 8});
          }
        }
      }
    }
    EXPECT_GT(unusual_, 0);
  }

  /// More samples than a kernel gets at once: several pieces of patches, and of rows.
  template <typename T>
  void long_calls() {
    const PatchSet<T> set = packed<T>(mixed_nets(70));
    struct Call {
      Size size;
      std::size_t shift;
      int threads;
      std::size_t patches;
    };
    constexpr Call kCalls[] = {
        {{32, 32}, 0, 2, 70}, {{33, 32}, 1, 2, 70}, {{16, 4500}, 0, 1, 2}, {{17, 4500}, 0, 1, 2}};
    std::size_t number = 0;
    for (const std::string& layout : kLayouts) {
      std::size_t place = ++number;
      for (const Destination destination : {Destination::memory, Destination::cache}) {
        ++place; // the next destination begins with the next call
        for (const Call& call : kCalls) {
          if (in_form(++place, 2)) {
            check(
                set, Grid<T>::uniform(call.size.nu, call.size.nv), layout, call.shift,
                {.threads = call.threads, .destination = destination, .patch_count = call.patches});
          }
        }
      }
    }
  }

private:
  bool with_status_ = true; ///< in every other call
  std::ptrdiff_t unusual_ = 0;
};

TEST_P(RecordTest, UniformGridsF32) { uniform_grids<float>(); }
TEST_P(RecordTest, UniformGridsF64) { uniform_grids<double>(); }
TEST_P(RecordTest, GivenParametersF32) { given_parameters<float>(); }
TEST_P(RecordTest, GivenParametersF64) { given_parameters<double>(); }
TEST_P(RecordTest, LongCallsF32) { long_calls<float>(); }
TEST_P(RecordTest, LongCallsF64) { long_calls<double>(); }
INSTANTIATE_FOR_EVERY_ISA(RecordTest);

} // namespace
} // namespace simdbezier::tests::records_test
