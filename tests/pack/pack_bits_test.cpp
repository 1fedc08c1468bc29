// Packing patches of any shape: every instruction set, thread count, layout and batch gets the same
// bits, and so do both kernels where both can pack.
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/nets/shape_nets.hpp"

namespace simdbezier::tests::pack_bits_test {
namespace {

std::vector<ShapeCase> some_shapes() {
  return {{1, 1},
          {3, 3, 4},
          {5, 2},
          {2, 2, 3, Weights::cartesian},
          {3, 7, 2, Weights::homogeneous},
          {6, 4, 1},
          {9, 8, 3, Weights::cartesian},
          {15, 1, 16}};
}

template <typename T, typename S>
void expect_equal_everywhere() {
  for (const ShapeCase& c : some_shapes()) {
    constexpr std::size_t kCount = 19;
    const RandomNets<S> nets(c, kCount, 3, 100);
    PackOptions options;
    options.local_origin = c.degree_u % 2 == 0;
    options.relative_to[1] = c.degree_v % 2 == 0 ? 0.1 : 0;
    options.isa = available_isas().front();
    PatchSet<T> expected;
    ASSERT_TRUE(pack(nets.view, expected, options)) << c;
    // [channel][i][j][patch], last patch first
    std::vector<S> planes(nets.values.size());
    ControlNets<S> other = nets.view;
    other.patch_stride = -1;
    other.row_stride = kCount;
    other.point_stride = static_cast<std::ptrdiff_t>(kCount) * (c.degree_v + 1);
    other.component_stride = other.point_stride * (c.degree_u + 1);
    other.points = planes.data() + kCount - 1;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const auto patch = static_cast<std::ptrdiff_t>(k / c.values());
      const auto point = static_cast<std::ptrdiff_t>(k % c.values() / c.channels());
      const auto channel = static_cast<std::ptrdiff_t>(k % c.channels());
      const std::ptrdiff_t at =
          patch * other.patch_stride + point / (c.degree_u + 1) * other.row_stride +
          point % (c.degree_u + 1) * other.point_stride + channel * other.component_stride;
      planes[static_cast<std::size_t>(at + static_cast<std::ptrdiff_t>(kCount) - 1)] =
          nets.values[k];
    }
    for (const Isa isa : available_isas()) {
      options.isa = isa;
      options.threads = isa == available_isas().front() ? 1 : 3;
      PatchSet<T> set;
      ASSERT_TRUE(pack(nets.view, set, options)) << c;
      expect_same_sets(expected, set, name_of(c) + " " + std::string(to_string(isa)));
      ASSERT_TRUE(pack(other, set, options)) << c;
      expect_same_sets(expected, set, name_of(c) + " planes " + std::string(to_string(isa)));
    }
    for (std::size_t patch = 0; patch < kCount; ++patch) { // alone
      ControlNets<S> one = nets.view;
      one.points += patch * c.values();
      one.count = 1;
      PatchSet<T> set;
      ASSERT_TRUE(pack(one, set, options)) << c;
      expect_same_patch(expected.storage()->buckets[0], patch, set.storage()->buckets[0], 0,
                        name_of(c) + " alone");
    }
  }
}

TEST(PackBits, bits_do_not_depend_on_instruction_set_threads_layout_or_batch) {
  expect_equal_everywhere<float, float>();
  expect_equal_everywhere<double, double>();
  expect_equal_everywhere<float, double>();
  expect_equal_everywhere<double, float>();
}

/// Bicubic patches in space have a kernel of their own.
template <typename T, typename S>
void expect_both_kernels_to_agree(bool origins) {
  const RandomNets<S> four({3, 3, 4}, 9, 51);
  ControlNets<S> three = four.view;
  three.components = 3;
  PackOptions options;
  options.local_origin = origins;
  PatchSet<T> a;
  PatchSet<T> b;
  ASSERT_TRUE(pack(three, a, options));
  ASSERT_TRUE(pack(four.view, b, options));
  const detail::PatchStorage<T>& x = a.storage()->buckets[0];
  const detail::PatchStorage<T>& y = b.storage()->buckets[0];
  for (std::size_t patch = 0; patch < 9; ++patch) {
    for (std::size_t k = 0; k < 48; ++k) {
      EXPECT_EQ(x.coefficients[patch * 48 + k], y.coefficients[patch * 64 + k]);
      EXPECT_EQ(x.edges[patch * 64 + k], y.edges[patch * y.shape.edges() + k]);
    }
    for (std::size_t k = 0; k < 12; ++k) {
      EXPECT_EQ(x.edges[patch * 64 + 48 + k], y.edges[patch * y.shape.edges() + 64 + k]);
    }
    for (std::size_t k = 0; origins && k < 24; ++k) {
      EXPECT_EQ(x.origins[patch * 24 + k], y.origins[patch * 32 + k]);
    }
  }
}

TEST(PackBits, bicubic_patches_get_the_same_bits_from_both_kernels) {
  for (const bool origins : {false, true}) {
    expect_both_kernels_to_agree<float, float>(origins);
    expect_both_kernels_to_agree<double, double>(origins);
    expect_both_kernels_to_agree<float, double>(origins);
    expect_both_kernels_to_agree<double, float>(origins);
  }
}

} // namespace
} // namespace simdbezier::tests::pack_bits_test
