// Rows of a grid are evaluated in groups, in pairs, cell by cell, and as many at a time as a kernel
// has room for. None of it shows: every row is what a grid of that row alone gives, and nothing is
// written behind the last one.
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/component_nets.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::row_groups_test {
namespace {

constexpr Degrees kDegrees[] = {{1, 3}, {2, 4}, {5, 5}, {3, 3}, {3, 7}, {7, 3}, {6, 6}, {9, 15}};
constexpr std::size_t kRows[] = {1, 2, 3, 7, 8, 9, 14, 255, 257, 530};
constexpr std::size_t kColumns[] = {1, 5, 9, 12, 16, 17, 32};
constexpr std::size_t kBehind = 16; ///< values of each plane that no row has: a register
constexpr Wanted kWanted[] = {{true, false, false, false}, // position, du and dv, normal, second
                              {true, true, false, false},
                              {true, false, true, false},
                              {true, true, true, false, true, true}};

/// Pairs around the middle, as far as they go, then rows in no order: edges, the middle, some
/// twice.
template <typename T>
[[nodiscard]] std::vector<T> rows_of(std::size_t count, bool mirrored, Random& random) {
  std::vector<T> v(count);
  for (std::size_t k = 0; k < count; ++k) {
    v[k] = static_cast<T>(random.symmetric());
    if (mirrored && k >= (count + 1) / 2) {
      v[k] = -v[count - 1 - k];
    } else if (!mirrored && k % 5 == 1) {
      v[k] = static_cast<T>(static_cast<int>(k % 3) - 1);
    } else if (k % 7 == 3) {
      v[k] = 0;
    }
  }
  return v;
}

class RowGroupsTest : public IsaTest {
protected:
  template <typename T>
  void expect_rows_alone(const PatchSet<T>& set, std::size_t nu, const std::vector<T>& v,
                         const Wanted& wanted, bool watertight) {
    std::vector<T> u(nu);
    for (std::size_t i = 0; i < nu; ++i) {
      u[i] = nu == 1 ? T(0.25) : uniform_centred<T>(static_cast<int>(i), static_cast<int>(nu) - 1);
    }
    CallOptions options;
    options.watertight = watertight;
    Planes<T> whole(nu * v.size() + kBehind, wanted);
    grid(set, Grid<T>{nu, v.size(), u.data(), v.data(), Parameters::centred}, whole.outputs(),
         options);
    for (std::size_t end = whole.count(); end <= whole.values().size(); end += whole.count()) {
      for (std::size_t k = end - kBehind; k < end; ++k) {
        EXPECT_EQ(whole.values()[k], T(-777)) << "columns " << nu << ", rows " << v.size();
      }
    }
    for (std::size_t j = 0; j < v.size(); j += 1 + j / 20) {
      Planes<T> alone(nu, wanted);
      grid(set, Grid<T>{nu, 1, u.data(), v.data() + j, Parameters::centred}, alone.outputs(),
           options);
      const std::size_t planes = alone.values().size() / nu;
      for (std::size_t p = 0; p < planes; ++p) {
        EXPECT_EQ(std::memcmp(whole.values().data() + p * whole.count() + j * nu,
                              alone.values().data() + p * nu, nu * sizeof(T)),
                  0)
            << "plane " << p << ", row " << j << " of " << v.size() << ", columns " << nu;
      }
    }
  }

  template <typename T>
  void expect_rows_alone() {
    Random random(29);
    std::size_t turn = 0;
    for (const Degrees degrees : kDegrees) {
      for (const bool rational : {false, true}) {
        const PatchSet<T> set = ComponentNets(degrees, 3, rational, 1, random).template packed<T>();
        for (const std::size_t rows : kRows) {
          const std::vector<T> v = rows_of<T>(rows, turn % 3 == 0, random);
          for (const std::size_t nu : kColumns) {
            expect_rows_alone(set, nu, v, kWanted[turn % std::size(kWanted)], turn % 5 != 0);
            ++turn;
          }
        }
      }
    }
  }
};

TEST_P(RowGroupsTest, AreTheRowsAloneFloat) { expect_rows_alone<float>(); }
TEST_P(RowGroupsTest, AreTheRowsAloneDouble) { expect_rows_alone<double>(); }
INSTANTIATE_FOR_EVERY_ISA(RowGroupsTest);

} // namespace
} // namespace simdbezier::tests::row_groups_test
