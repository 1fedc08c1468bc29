// Grids whose rows lie a multiple of 512 bytes apart, which are evaluated in strips: each row has
// the bits that it has in a call of its own.
#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "tests/calls/grid_cases.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/shape_nets.hpp"

namespace simdbezier::tests::row_strips_test {
namespace {

constexpr Wanted kWanted[] = {
    {.tangents = false, .normal = false, .status = false},
    {.tangents = false},
    {.normal = false, .status = false},
    {},
    {.position = false, .tangents = false, .normal = false, .status = false, .second = true},
    {.second = true},
    {.second = true, .curvature = true}};

constexpr ShapeCase kShapes[] = {{3, 3}, {3, 3, 3, Weights::cartesian}, {5, 5}, {1, 1}, {4, 2},
                                 {7, 3}};

/// Rows of each kind, several of them in one run and in one strip.
template <typename T>
std::vector<T> rows() {
  std::vector<T> y = centred_parameters<T>(41);
  y[3] = T(1.25);
  y[7] = y[8] = y[20] = T(-1);
  y[16] = y[17] = T(1);
  y[31] = y[32] = T(-1.5);
  return y;
}

class RowStripsTest : public IsaTest {
protected:
  template <typename T>
  void all_widths() {
    for (const std::size_t bytes : {512U, 1024U, 2048U, 4096U, 1536U}) {
      for (const ShapeCase& shape : kShapes) {
        for (const Wanted& wanted : kWanted) {
          const bool few = !wanted.second && wanted.tangents == wanted.normal;
          if (bytes <= 1024 || (few && shape.degree_u < 5 && shape.weights == Weights::none)) {
            compare<T>(bytes / sizeof(T), shape, wanted);
          }
        }
      }
    }
  }

private:
  static constexpr std::size_t kPatches = 2;

  /// The edge u = 0 of the first patch becomes a point, so that its samples have statuses.
  template <typename T>
  static void collapse_first_edge(std::vector<T>& values, const ShapeCase& shape) {
    const std::size_t row = static_cast<std::size_t>(shape.degree_u + 1) * shape.channels();
    for (std::size_t k = row; k < shape.values(); k += row) {
      std::copy_n(values.begin(), shape.channels(),
                  values.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }

  template <typename T>
  void compare(std::size_t nu, const ShapeCase& shape, const Wanted& wanted) {
    RandomNets<T> nets(shape, kPatches, nu);
    collapse_first_edge(nets.values, shape);
    PatchSet<T> set;
    expect_packed(pack(nets.view, set));
    const std::vector<T> x = centred_parameters<T>(nu);
    const std::vector<T> y = rows<T>();
    Planes<T> whole(kPatches * nu * y.size(), wanted);
    const CallOptions options{.threads = 1, .watertight = shape.degree_u != 5};
    CallOptions threads = options;
    threads.threads = 2;
    grid(set, {nu, y.size(), x.data(), y.data(), Parameters::centred}, whole.outputs(), threads);
    std::size_t different = 0;
    for (std::size_t j = 0; j < y.size(); ++j) {
      Planes<T> row(kPatches * nu, wanted);
      grid(set, {nu, 1, x.data(), &y[j], Parameters::centred}, row.outputs(), options);
      const std::size_t planes = row.values().size() / row.count();
      for (std::size_t patch = 0; patch < kPatches; ++patch) {
        const std::size_t at = (patch * y.size() + j) * nu;
        for (std::size_t k = 0; k < planes; ++k) {
          different += differing_bits(whole.values().data() + k * whole.count() + at,
                                      row.values().data() + k * row.count() + patch * nu, nu);
        }
        different += std::equal(whole.status().begin() + static_cast<std::ptrdiff_t>(at),
                                whole.status().begin() + static_cast<std::ptrdiff_t>(at + nu),
                                row.status().begin() + static_cast<std::ptrdiff_t>(patch * nu))
                         ? 0
                         : 1;
      }
    }
    EXPECT_EQ(different, 0U) << nu << " columns, " << shape << ", outputs "
                             << &wanted - std::begin(kWanted);
  }
};

TEST_P(RowStripsTest, RowsByThemselvesF32) { all_widths<float>(); }
TEST_P(RowStripsTest, RowsByThemselvesF64) { all_widths<double>(); }
INSTANTIATE_FOR_EVERY_ISA(RowStripsTest);

} // namespace
} // namespace simdbezier::tests::row_strips_test
