// Grids of a few samples, which have kernels of their own where rows and columns begin and end on
// the patch's edges. They must give the scattered call's bits whatever the parameters in between,
// and write nothing but their outputs.
#include <bit>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/canvas.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::small_grids_test {
namespace {

/// How one direction's centred parameters lie.
enum class Row {
  uniform,
  given,     ///< from edge to edge, unevenly
  reversed,  ///< as given, from 1 to -1
  edge_amid, ///< as given, and one of the inner ones is an edge, too
  outside,   ///< as given, and one of the inner ones is not in the patch
  inner,     ///< no edges
  count
};

template <typename T>
std::vector<T> parameters(Row row, std::size_t n) {
  std::vector<T> x(n);
  const auto last = static_cast<double>(n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double even = (2 * static_cast<double>(i) - last) / last;
    x[i] = static_cast<T>(row == Row::uniform ? even : even - 0.1 * (1 - even * even));
  }
  switch (row) {
  case Row::reversed:
    return {x.rbegin(), x.rend()};
  case Row::edge_amid:
    x[n / 2] = T(n % 2 == 0 ? -1 : 1);
    break;
  case Row::outside:
    x[n / 2] = T(1.5);
    break;
  case Row::inner:
    x[0] = T(-0.875);
    x[n - 1] = T(0.875);
    break;
  default:
    break;
  }
  return x;
}

enum class Layout { planes, triples, vertices };

constexpr GroupSet kChoices[] = {kP, kP | kN, kP | kDu | kDv, kP | kDu | kDv | kN, kN, kDu};
// More than a register has lanes, and no multiple of that; and so many that nearly all lanes are
// used, without which AVX-512 has other kernels.
constexpr std::size_t kFew = 21;
constexpr std::size_t kMany = 62;

template <typename T>
class SmallGrids : public IsaTest {
protected:
  void sizes(const PackOptions& pack_options, bool watertight) {
    const PatchSet<T> set = packed<T>(mixed_nets(kFew), pack_options);
    const Options options = call(watertight);
    for (std::size_t nu = 2; nu <= 7; ++nu) {
      for (std::size_t nv = 2; nv <= 7; ++nv) {
        for (int row = 0; row < static_cast<int>(Row::count); ++row) {
          // Against uniform ones in the other direction, in both ways, and against themselves.
          compare(set, options, nu, nv, static_cast<Row>(row), Row::uniform);
          compare(set, options, nu, nv, Row::uniform, static_cast<Row>(row));
          compare(set, options, nu, nv, static_cast<Row>(row), static_cast<Row>(row));
        }
      }
    }
  }

  /// The squares that have kernels of their own for many patches.
  void squares_of_many_patches(const PackOptions& pack_options, bool watertight) {
    const PatchSet<T> set = packed<T>(mixed_nets(kMany), pack_options);
    for (const std::size_t side : {4U, 5U}) {
      for (int row = 0; row < static_cast<int>(Row::count); ++row) {
        compare(set, call(watertight), side, side, static_cast<Row>(row), Row::uniform);
        compare(set, call(watertight), side, side, Row::uniform, static_cast<Row>(row));
      }
    }
  }

private:
  static Options call(bool watertight) {
    Options options;
    options.watertight = watertight;
    options.threads = 1;
    return options;
  }

  void compare(const PatchSet<T>& set, const Options& options, std::size_t nu, std::size_t nv,
               Row across, Row along) {
    const std::vector<T> x = parameters<T>(across, nu);
    const std::vector<T> y = parameters<T>(along, nv);
    const std::size_t count = set.size() * nu * nv;
    SampleArrays<T> samples;
    for (std::size_t k = 0; k < count; ++k) {
      samples.add(k / (nu * nv), x[k % nu], y[k / nu % nv]);
    }
    Planes<T> expected(count);
    scattered(set, samples.view(Parameters::centred), expected.outputs(), options);
    const Grid<T> of_grid{nu, nv, x.data(), y.data(), Parameters::centred};
    for (const GroupSet groups : kChoices) {
      for (const Layout layout : {Layout::planes, Layout::triples, Layout::vertices}) {
        const std::string name = std::to_string(nu) + "x" + std::to_string(nv) + ", rows " +
                                 std::to_string(static_cast<int>(across)) + " and " +
                                 std::to_string(static_cast<int>(along)) + ", groups " +
                                 std::to_string(groups) + ", layout " +
                                 std::to_string(static_cast<int>(layout));
        compare(set, options, of_grid, groups, layout, expected, count, name);
      }
    }
  }

  void compare(const PatchSet<T>& set, const Options& options, const Grid<T>& of_grid,
               GroupSet groups, Layout layout, const Planes<T>& expected, std::size_t count,
               const std::string& name) {
    canvas_.reset(3 * kVectorGroups * (count + kGap));
    Outputs<T> out;
    const std::size_t vertex = 3 * static_cast<std::size_t>(std::popcount(groups));
    std::size_t member = 0;
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      if (!holds(groups, g)) {
        continue;
      }
      T* const first = canvas_.at(3 * g * (count + kGap));
      *groups_of(out)[g] =
          layout == Layout::planes
              ? Vectors<T>::planes(first, first + (count + kGap), first + 2 * (count + kGap))
          : layout == Layout::triples
              ? Vectors<T>::xyz(first)
              : Vectors<T>::xyz(canvas_.at(member), static_cast<std::ptrdiff_t>(vertex));
      member += 3;
    }
    std::vector<SampleStatus> status(count);
    out.status = status.data();
    grid(set, of_grid, out, options);
    EXPECT_EQ(canvas_.defects(out, expected, count), 0U) << name;
    if (holds(groups, kVectorGroups - 1)) {
      EXPECT_EQ(status, expected.status()) << name;
    }
  }

  static constexpr std::size_t kGap = 17; // more than a register
  Canvas<T> canvas_{0};
};

PackOptions local_origin() {
  PackOptions options;
  options.local_origin = true;
  return options;
}

using SmallGridsF32 = SmallGrids<float>;
using SmallGridsF64 = SmallGrids<double>;
INSTANTIATE_FOR_EVERY_ISA(SmallGridsF32);
INSTANTIATE_FOR_EVERY_ISA(SmallGridsF64);

TEST_P(SmallGridsF32, watertight) { sizes({}, true); }
TEST_P(SmallGridsF64, watertight) { sizes({}, true); }
TEST_P(SmallGridsF32, watertight_around_origins) { sizes(local_origin(), true); }
TEST_P(SmallGridsF64, watertight_around_origins) { sizes(local_origin(), true); }
TEST_P(SmallGridsF32, many_patches) { squares_of_many_patches({}, true); }
TEST_P(SmallGridsF64, many_patches) { squares_of_many_patches({}, true); }
TEST_P(SmallGridsF32, open) { sizes({}, false); }
TEST_P(SmallGridsF64, open) { sizes({}, false); }

} // namespace
} // namespace simdbezier::tests::small_grids_test
