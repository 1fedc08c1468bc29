// Strides of pack calls: what leads beyond what memory can address is refused before anything is
// read, and what is never taken may be anything.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/nets/shape_nets.hpp"

namespace simdbezier::tests::pack_strides_test {
namespace {

constexpr std::ptrdiff_t kMax = std::numeric_limits<std::ptrdiff_t>::max();
constexpr std::ptrdiff_t kMin = std::numeric_limits<std::ptrdiff_t>::min();
/// Twice any of these strides cannot be addressed, in bytes.
constexpr std::ptrdiff_t kBad[] = {kMax,     kMin,     kMax - 1, kMin + 1, kMax / 2, kMin / 2,
                                   kMax / 3, kMax / 4, kMin / 4, kMax / 8, kMin / 8};

template <typename S>
struct NetStride {
  const char* name;
  std::ptrdiff_t ControlNets<S>::*member;
};
template <typename S>
constexpr NetStride<S> kNetStrides[] = {{"patch", &ControlNets<S>::patch_stride},
                                        {"row", &ControlNets<S>::row_stride},
                                        {"point", &ControlNets<S>::point_stride},
                                        {"component", &ControlNets<S>::component_stride}};

const ShapeCase kShapes[] = {
    {3, 3}, {2, 4, 2, Weights::cartesian}, {7, 3, 1, Weights::homogeneous}};

template <typename T, typename S>
void expect_refused(const ControlNets<S>& nets, const ControlNets<S>& good, const char* what) {
  PatchSet<T> set;
  ASSERT_TRUE(pack(good, set));
  EXPECT_EQ(to_string(pack(nets, set).status), to_string(Status::size_overflow)) << what;
  const ControlNets<S> entries[] = {good, nets};
  EXPECT_EQ(to_string(pack(std::span<const ControlNets<S>>(entries), set).status),
            to_string(Status::size_overflow))
      << what;
  EXPECT_EQ(set.size(), good.count) << what << ": the set was changed";
}

template <typename T, typename S>
void expect_net_strides() {
  for (const ShapeCase& c : kShapes) {
    const RandomNets<S> nets(c, 3, 1);
    for (const NetStride<S>& stride : kNetStrides<S>) {
      for (const std::ptrdiff_t bad : kBad) {
        SCOPED_TRACE(testing::Message() << c << ", " << stride.name << " stride " << bad);
        ControlNets<S> view = nets.view;
        view.*stride.member = bad;
        expect_refused<T>(view, nets.view, "alone");
      }
    }
    // Each of them alone would do.
    ControlNets<S> sum = nets.view;
    sum.patch_stride = sum.row_stride = kMax / static_cast<std::ptrdiff_t>(sizeof(S)) / 8;
    sum.point_stride = sum.row_stride;
    expect_refused<T>(sum, nets.view, "in sum");
  }
}

TEST(PackStrides, that_cannot_be_addressed_are_refused) {
  expect_net_strides<float, float>();
  expect_net_strides<float, double>();
  expect_net_strides<double, float>();
  expect_net_strides<double, double>();
}

/// The first of three patches alone: its patch stride leads nowhere.
template <typename T, typename S>
void expect_unused_stride() {
  for (const ShapeCase& c : kShapes) {
    const RandomNets<S> nets(c, 3, 1);
    ControlNets<S> one = nets.view;
    one.count = 1;
    PatchSet<T> expected;
    ASSERT_TRUE(pack(one, expected));
    for (const std::ptrdiff_t any : kBad) {
      one.patch_stride = any;
      PatchSet<T> set;
      ASSERT_TRUE(pack(one, set)) << c << ", " << any;
      expect_same_sets(expected, set, name_of(c));
    }
  }
}

TEST(PackStrides, that_are_not_taken_may_be_anything) {
  expect_unused_stride<float, float>();
  expect_unused_stride<float, double>();
  expect_unused_stride<double, float>();
  expect_unused_stride<double, double>();
}

/// Rows a million values apart, last row first.
TEST(PackStrides, that_are_large_are_taken) {
  constexpr std::ptrdiff_t kFar = std::ptrdiff_t{1} << 20;
  for (const ShapeCase& c : kShapes) {
    const RandomNets<float> nets(c, 1, 1);
    const auto row = static_cast<std::size_t>(nets.view.row_stride);
    const auto rows = static_cast<std::size_t>(c.degree_v) + 1;
    std::vector<float> memory(rows * std::size_t{kFar});
    for (std::size_t k = 0; k < nets.values.size(); ++k) {
      memory[(rows - 1 - k / row) * std::size_t{kFar} + k % row] = nets.values[k];
    }
    ControlNets<float> view = nets.view;
    view.points = memory.data() + (rows - 1) * std::size_t{kFar};
    view.row_stride = -kFar;
    PatchSet<float> expected;
    PatchSet<float> set;
    ASSERT_TRUE(pack(nets.view, expected));
    ASSERT_TRUE(pack(view, set)) << c;
    expect_same_sets(expected, set, name_of(c));
  }
}

template <typename S>
struct CurveStride {
  const char* name;
  std::ptrdiff_t ControlCurves<S>::*member;
};
template <typename S>
constexpr CurveStride<S> kCurveStrides[] = {{"curve", &ControlCurves<S>::curve_stride},
                                            {"point", &ControlCurves<S>::point_stride},
                                            {"component", &ControlCurves<S>::component_stride}};

template <typename T, typename S>
void expect_curve_strides() {
  const std::vector<S> values(3 * 4 * 3, S(1));
  const auto good = ControlCurves<S>::packed(values.data(), 3, 3, 3);
  CurveSet<T> set;
  ASSERT_TRUE(pack(good, set));
  for (const std::ptrdiff_t bad : kBad) {
    for (const CurveStride<S>& stride : kCurveStrides<S>) {
      ControlCurves<S> view = good;
      view.*stride.member = bad;
      EXPECT_EQ(to_string(pack(view, set).status), to_string(Status::size_overflow))
          << stride.name << " stride " << bad;
      EXPECT_EQ(set.size(), 3U) << "the set was changed";
    }
    ControlCurves<S> one = good;
    one.count = 1;
    one.curve_stride = bad;
    CurveSet<T> alone;
    EXPECT_TRUE(pack(one, alone)) << bad;
  }
}

/// All patches in one place: each net could be addressed, and the counts wrap around to 0 and 1.
TEST(PackStrides, counts_that_add_up_beyond_what_fits) {
  const std::vector<double> values(48, 1.0);
  for (const std::size_t more : {0U, 1U}) {
    ControlNets<double> first{values.data(), std::size_t{1} << 63};
    first.patch_stride = 0;
    ControlNets<double> second = first;
    second.count += more;
    const ControlNets<double> nets[] = {first, second};
    PatchSet<double> set;
    const Report report = pack(std::span<const ControlNets<double>>(nets), set);
    EXPECT_EQ(to_string(report.status), to_string(Status::size_overflow)) << more;
    EXPECT_EQ(set.size(), 0U);
  }
}

TEST(PackStrides, of_curves_likewise) {
  expect_curve_strides<float, float>();
  expect_curve_strides<float, double>();
  expect_curve_strides<double, float>();
  expect_curve_strides<double, double>();
}

} // namespace
} // namespace simdbezier::tests::pack_strides_test
