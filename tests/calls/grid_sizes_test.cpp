// Grids of every choice of outputs, with any number of threads, of mixed rows, and large ones.
// Accuracy is measured elsewhere, at scattered samples too; here a grid must give the scattered
// call's bits.
#include <cstddef>
#include <iterator>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/calls/grid_cases.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::grid_sizes_test {
namespace {

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
  /// The number of values that differ from those of `all`, in the groups that both hold.
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

} // namespace
} // namespace simdbezier::tests::grid_sizes_test
