// Every grid width around the register widths and every choice of outputs. Accuracy is measured
// elsewhere, at scattered samples too; here a grid must give the scattered call's bits, whatever
// its size, and write nothing outside of its outputs.
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests {
namespace {

std::vector<Net> wavy_nets(std::size_t count) {
  std::vector<Net> nets(count);
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t k = 0; k < 16; ++k) {
      const double bump = std::sin(1.7 * static_cast<double>(k + 3 * n));
      nets[n].points[k] = {static_cast<double>(k % 4) + 0.2 * bump,
                           static_cast<double>(k / 4) - 0.1 * bump, bump};
    }
  }
  return nets;
}

/// (2i-N)/N, as the library documents uniform grids; one sample: off the middle.
template <typename T>
std::vector<T> centred_parameters(std::size_t count) {
  std::vector<T> x(count, static_cast<T>(0.25));
  const auto intervals = static_cast<T>(count - 1);
  for (std::size_t i = 0; count > 1 && i < count; ++i) {
    x[i] = (static_cast<T>(2 * i) - intervals) / intervals;
  }
  return x;
}

/// Planes in heap blocks of exactly their size, so that sanitizers see one element too many.
template <typename T>
class ExactPlanes {
public:
  ExactPlanes(std::size_t count, unsigned groups) : count_(count) {
    for (std::size_t plane = 0; plane < 12; ++plane) {
      if ((groups >> (plane / 3) & 1U) != 0) {
        planes_[plane] = std::make_unique<T[]>(count);
      }
    }
  }
  Outputs<T> outputs() {
    Outputs<T> out;
    Vectors<T>* const group[4] = {&out.position, &out.du, &out.dv, &out.normal};
    for (std::size_t g = 0; g < 4; ++g) {
      *group[g] = Vectors<T>::planes(planes_[3 * g].get(), planes_[3 * g + 1].get(),
                                     planes_[3 * g + 2].get());
    }
    return out;
  }
  /// Values that differ from those of `all`, of the groups that both hold.
  std::size_t different_from(const Planes<T>& all) const {
    std::size_t different = 0;
    for (std::size_t plane = 0; plane < 12; ++plane) {
      for (std::size_t k = 0; planes_[plane] != nullptr && k < count_; ++k) {
        different += same_bits(planes_[plane][k], all.at(plane / 3, plane % 3, k)) ? 0 : 1;
      }
    }
    return different;
  }

private:
  std::size_t count_;
  std::unique_ptr<T[]> planes_[12];
};

template <typename T>
SampleArrays<T> as_samples(std::size_t patches, const std::vector<T>& x, const std::vector<T>& y) {
  SampleArrays<T> samples;
  for (std::size_t p = 0; p < patches; ++p) {
    for (const T b : y) {
      for (const T a : x) {
        samples.add(p, a, b);
      }
    }
  }
  return samples;
}

constexpr std::size_t kPatches = 3;

template <typename T>
class Sizes : public IsaTest {
protected:
  void check(std::size_t nu, std::size_t nv, unsigned groups, int threads, bool uniform) {
    compare(centred_parameters<T>(nu), centred_parameters<T>(nv), groups, threads, uniform);
  }

  void compare(const std::vector<T>& x, const std::vector<T>& y, unsigned groups, int threads,
               bool uniform) {
    const std::size_t nu = x.size();
    const std::size_t nv = y.size();
    const auto samples = as_samples(kPatches, x, y);
    Planes<T> expected(kPatches * nu * nv);
    scattered(set_, samples.view(Parameters::centred), expected.outputs());
    ExactPlanes<T> found(kPatches * nu * nv, groups);
    Grid<T> samples_of_grid{nu, nv, x.data(), y.data(), Parameters::centred};
    if (uniform) {
      samples_of_grid = Grid<T>::uniform(nu, nv);
    }
    Options options;
    options.threads = threads;
    grid(set_, samples_of_grid, found.outputs(), options);
    EXPECT_EQ(found.different_from(expected), 0U)
        << nu << "x" << nv << " groups " << groups << " threads " << threads
        << (uniform ? " uniform" : " given");
  }

private:
  PatchSet<T> set_ = packed<T>(wavy_nets(kPatches));
};

constexpr unsigned kAllGroups = 15;

template <typename T>
class EverySize : public Sizes<T> {
protected:
  void groups() {
    for (unsigned groups = 1; groups <= kAllGroups; ++groups) {
      for (const std::size_t nu : {4U, 9U, 16U, 19U}) {
        this->check(nu, 6, groups, 1, true);
      }
    }
  }
  void threads() {
    for (const int threads : {0, 1, 2, 3, 7, 64}) {
      for (const unsigned groups : {1U, 9U, 7U, kAllGroups}) {
        this->check(21, 13, groups, threads, true);
      }
    }
  }
  /// Rows that change their kind all the time: edge, interior, outside, edge, …
  void mixed_rows() {
    for (const std::size_t nv : {7U, 127U, 128U, 129U, 600U, 3000U}) {
      std::vector<T> y(nv);
      constexpr T kKinds[] = {T(-1), T(0.5), T(1), T(1.25), T(-1), T(-1), T(0)};
      for (std::size_t j = 0; j < nv; ++j) {
        y[j] = kKinds[j % std::size(kKinds)];
      }
      for (const int threads : {1, 3}) {
        this->compare(centred_parameters<T>(3), y, kAllGroups, threads, false);
        this->compare(centred_parameters<T>(3), y, 1, threads, false);
      }
    }
  }
  /// Larger than what a plan keeps inline, and than one strip.
  void large() {
    this->check(300, 280, kAllGroups, 2, true);
    this->check(2, 700, 1, 2, true);
    this->check(1500, 3, 9, 1, true);
  }
};

using EverySizeF32 = EverySize<float>;
using EverySizeF64 = EverySize<double>;
INSTANTIATE_FOR_EVERY_ISA(EverySizeF32);
INSTANTIATE_FOR_EVERY_ISA(EverySizeF64);

TEST_P(EverySizeF32, every_choice_of_groups) { groups(); }
TEST_P(EverySizeF64, every_choice_of_groups) { groups(); }
TEST_P(EverySizeF32, any_number_of_threads) { threads(); }
TEST_P(EverySizeF64, any_number_of_threads) { threads(); }
TEST_P(EverySizeF32, rows_of_mixed_kinds) { mixed_rows(); }
TEST_P(EverySizeF64, rows_of_mixed_kinds) { mixed_rows(); }
TEST_P(EverySizeF32, large_grids) { large(); }
TEST_P(EverySizeF64, large_grids) { large(); }

// Every width, with guards --------------------------------------------------------------------

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
  /// Values that are not those of `expected` in the groups asked for, or not poison elsewhere.
  std::size_t wrong(GuardedPlanes& expected, unsigned groups) {
    std::size_t wrong = 0;
    for (std::size_t p = 0; p < 3 * kGroups; ++p) {
      const bool asked = (groups >> (p / 3) & 1U) != 0;
      for (std::size_t k = 0; k < count_; ++k) {
        wrong += same_bits(plane(p)[k], asked ? expected.plane(p)[k] : kPoison) ? 0 : 1;
      }
      for (std::size_t k = 0; k < kGuard; ++k) {
        wrong += same_bits(plane(p)[count_ + k], kPoison) ? 0 : 1;
        wrong += same_bits(values_[k], kPoison) ? 0 : 1;
      }
    }
    return wrong;
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

template <typename T>
class EveryWidth : public IsaTest {
protected:
  void widths(Spacing spacing) {
    const std::size_t least = spacing == Spacing::uniform ? 2 : 1;
    for (std::size_t nu = least; nu <= 66; ++nu) {
      for (const std::size_t nv : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 16U, 17U, 18U, 33U}) {
        if (nv >= least) {
          compare(nu, nv, spacing);
        }
      }
    }
  }

private:
  void compare(std::size_t nu, std::size_t nv, Spacing spacing) {
    const std::vector<T> x = spaced<T>(nu, spacing);
    const std::vector<T> y = spaced<T>(nv, spacing);
    const auto& set = sets_[(nu + nv) % 2];
    Options options;
    options.threads = 1;
    options.watertight = (nu + nv) % 4 < 2;
    const auto samples = as_samples(kFew, x, y);
    const std::size_t count = kFew * nu * nv;
    constexpr unsigned kEverything = 127;
    GuardedPlanes<T> expected(count);
    std::vector<SampleStatus> expected_status(count);
    Outputs<T> all = expected.outputs(kEverything);
    all.status = expected_status.data();
    scattered(set, samples.view(Parameters::centred), all, options);
    Grid<T> of_grid{nu, nv, x.data(), y.data(), Parameters::centred};
    if (spacing == Spacing::uniform) {
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
          << nu << "x" << nv << " groups " << groups << " spacing " << static_cast<int>(spacing);
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
  PatchSet<T> sets_[2] = {packed<T>(wavy_nets(kFew)), packed<T>(wavy_nets(kFew), around_origins())};
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

} // namespace
} // namespace simdbezier::tests
