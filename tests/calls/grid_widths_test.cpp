// Every grid width around the register widths, with guards: a grid must give the scattered call's
// bits, whatever its size, and write nothing outside of its outputs.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/calls/grid_cases.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::grid_widths_test {
namespace {

/// Seven groups of three planes in one block, poisoned, with a guard before and behind each plane.
template <typename T>
class GuardedPlanes {
public:
  static constexpr std::size_t kGroups = 7;

  explicit GuardedPlanes(std::size_t count)
      : count_(count), values_(3 * kGroups * (count + kGuard) + kGuard, kPoison) {}

  Outputs<T> outputs(unsigned groups) {
    Outputs<T> out;
    Vectors<T>* const group[kGroups] = {&out.position, &out.du,  &out.dv, &out.normal,
                                        &out.duu,      &out.duv, &out.dvv};
    for (std::size_t g = 0; g < kGroups; ++g) {
      if ((groups >> g & 1U) != 0) {
        *group[g] = Vectors<T>::planes(plane(3 * g), plane(3 * g + 1), plane(3 * g + 2));
      }
    }
    return out;
  }
  /// The number of values that differ from `expected` in the groups asked for, or from the poison
  /// elsewhere.
  std::size_t wrong(GuardedPlanes& expected, unsigned groups) {
    GuardedPlanes right(count_);
    for (std::size_t p = 0; p < 3 * kGroups; ++p) {
      if ((groups >> (p / 3) & 1U) != 0) {
        std::copy_n(expected.plane(p), count_, right.plane(p));
      }
    }
    return differing_bits(values_.data(), right.values_.data(), values_.size());
  }

private:
  static constexpr std::size_t kGuard = 32; // more than a register
  static constexpr T kPoison = T(-777);

  T* plane(std::size_t p) { return values_.data() + kGuard + p * (count_ + kGuard); }

  std::size_t count_;
  std::vector<T> values_;
};

enum class Spacing { uniform, given, crowded };

/// crowded: edges in any order and number, and parameters outside of [0,1].
template <typename T>
std::vector<T> spaced(std::size_t count, Spacing spacing) {
  constexpr double kCrowd[] = {-1, 1, 1, -1, -1, 0.3, 1.25, 1, -0.7, 1, 0.1, 0.2, 0.3, -0.9, -1};
  std::vector<T> x = centred_parameters<T>(count);
  for (std::size_t i = 0; i < count && spacing != Spacing::uniform; ++i) {
    x[i] = spacing == Spacing::given
               ? static_cast<T>(std::sin(1.3 * static_cast<double>(i + count)))
               : static_cast<T>(kCrowd[(7 * i + count) % std::size(kCrowd)]);
  }
  return x;
}

/// Which positions a set's patches have, and which edges a call gives them. poles: edges u = 0 and
/// v = 0 are points.
struct Kind {
  bool origins;
  bool watertight;
  bool poles = false;
};

std::vector<Net> with_poles(std::vector<Net> nets) {
  for (Net& net : nets) {
    for (std::size_t k = 1; k < 4; ++k) {
      net.points[k] = net.points[4 * k] = net.points[0];
    }
  }
  return nets;
}

template <typename T>
class EveryWidth : public IsaTest {
protected:
  void widths(Spacing spacing) {
    const std::size_t least = spacing == Spacing::uniform ? 2 : 1;
    for (std::size_t nu = least; nu <= 66; ++nu) {
      for (const std::size_t nv : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 16U, 17U, 18U, 33U}) {
        if (nv >= least) {
          compare(spaced<T>(nu, spacing), spaced<T>(nv, spacing), spacing == Spacing::uniform,
                  {(nu + nv) % 2 != 0, (nu + nv) % 4 < 2});
        }
      }
    }
  }
  /// Wider rows than a band of registers has room for (kernels/fast/row_bands.hpp), with a rest of
  /// each kind.
  void wide() {
    for (const std::size_t nu :
         {72U,  80U,  81U,  83U,  90U,  96U,  97U,  98U,  104U, 105U, 112U, 113U,
          127U, 128U, 129U, 136U, 140U, 145U, 193U, 196U, 256U, 288U, 289U, 300U}) {
      for (const std::size_t nv : {4U, 19U, 33U}) {
        compare(spaced<T>(nu, Spacing::uniform), spaced<T>(nv, Spacing::uniform), true,
                {false, nu % 3 != 0, nv == 19});
      }
      compare(spaced<T>(nu, Spacing::crowded), spaced<T>(47, Spacing::crowded), false,
              {false, nu % 2 != 0, nu % 4 < 2});
    }
  }
  /// Square grids, the size of some of which the kernels know.
  void squares() {
    for (std::size_t side = 2; side <= 66; ++side) {
      const std::vector<T> x = centred_parameters<T>(side);
      for (const Kind kind :
           {Kind{false, true}, Kind{true, true}, Kind{false, false}, Kind{false, true, true}}) {
        compare(x, x, true, kind);
      }
    }
  }
  /// Squares from edge to edge among the rows of other grids.
  void squares_among_rows() {
    for (const std::size_t side : {4U, 8U, 9U, 16U, 17U, 32U, 33U}) {
      const std::vector<T> up = centred_parameters<T>(side);
      const std::vector<T> down(up.rbegin(), up.rend());
      const std::vector<T> first(2, T(-1));
      const std::vector<T> last(1, T(1));
      for (const auto& [before, after] :
           {std::pair{first, last}, std::pair{up, up}, std::pair{down, down}}) {
        std::vector<T> y = before;
        y.insert(y.end(), up.begin(), up.end());
        y.insert(y.end(), after.begin(), after.end());
        compare(up, y, false, {false, true});
      }
      compare(up, down, false, {false, true});
    }
  }

private:
  void compare(const std::vector<T>& x, const std::vector<T>& y, bool uniform, Kind kind) {
    const std::size_t nu = x.size();
    const std::size_t nv = y.size();
    const auto& set = sets_[kind.poles ? 2 : kind.origins ? 1 : 0];
    Options options;
    options.threads = 1;
    options.watertight = kind.watertight;
    const auto samples = as_samples(kFew, x, y);
    const std::size_t count = kFew * nu * nv;
    constexpr unsigned kEverything = 127;
    GuardedPlanes<T> expected(count);
    std::vector<SampleStatus> expected_status(count);
    Outputs<T> all = expected.outputs(kEverything);
    all.status = expected_status.data();
    scattered(set, samples.view(Parameters::centred), all, options);
    Grid<T> of_grid{nu, nv, x.data(), y.data(), Parameters::centred};
    if (uniform) {
      of_grid = Grid<T>::uniform(nu, nv);
    }
    // position, with normal, with derivatives, these together, second derivatives: a kernel each.
    for (const unsigned groups : {1U, 9U, 7U, 15U, 112U}) {
      GuardedPlanes<T> found(count);
      std::vector<SampleStatus> status(count);
      Outputs<T> out = found.outputs(groups);
      out.status = status.data();
      grid(set, of_grid, out, options);
      EXPECT_EQ(found.wrong(expected, groups), 0U)
          << nu << "x" << nv << " groups " << groups << " origins " << kind.origins
          << " watertight " << kind.watertight << " poles " << kind.poles
          << (uniform ? " uniform" : " given");
      if ((groups & 8U) != 0) {
        EXPECT_EQ(status, expected_status) << nu << "x" << nv << " groups " << groups;
      }
    }
  }

  static constexpr std::size_t kFew = 2;
  PackOptions around_origins() {
    PackOptions options;
    options.local_origin = true;
    return options;
  }
  PatchSet<T> sets_[3] = {packed<T>(wavy_nets(kFew)), packed<T>(wavy_nets(kFew), around_origins()),
                          packed<T>(with_poles(wavy_nets(kFew)))};
};

using EveryWidthF32 = EveryWidth<float>;
using EveryWidthF64 = EveryWidth<double>;
INSTANTIATE_FOR_EVERY_ISA(EveryWidthF32);
INSTANTIATE_FOR_EVERY_ISA(EveryWidthF64);

TEST_P(EveryWidthF32, uniform) { widths(Spacing::uniform); }
TEST_P(EveryWidthF64, uniform) { widths(Spacing::uniform); }
TEST_P(EveryWidthF32, given) { widths(Spacing::given); }
TEST_P(EveryWidthF64, given) { widths(Spacing::given); }
TEST_P(EveryWidthF32, crowded) { widths(Spacing::crowded); }
TEST_P(EveryWidthF64, crowded) { widths(Spacing::crowded); }
TEST_P(EveryWidthF32, wide) { wide(); }
TEST_P(EveryWidthF64, wide) { wide(); }
TEST_P(EveryWidthF32, squares) { squares(); }
TEST_P(EveryWidthF64, squares) { squares(); }
TEST_P(EveryWidthF32, squares_among_rows) { squares_among_rows(); }
TEST_P(EveryWidthF64, squares_among_rows) { squares_among_rows(); }

} // namespace
} // namespace simdbezier::tests::grid_widths_test
