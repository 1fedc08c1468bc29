// Spans of control points, memory of net operations that is too small, and results in std::vectors.
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/evaluation.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::results_test {
namespace {

constexpr std::size_t kPatches = 3;
const std::uint32_t kSides[kPatches] = {4, 2, 5};

[[nodiscard]] const PatchSet<float>& patches() {
  static const PatchSet<float> set = packed<float>(mixed_nets(kPatches));
  return set;
}

TEST(ControlPoints, in_spans_are_counted) {
  std::vector<std::array<float, 3>> points(32);
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k] = {static_cast<float>(k % 4), static_cast<float>(k / 4), static_cast<float>(k % 3)};
  }
  PatchSet<float> set;
  EXPECT_TRUE(pack(ControlNets<float>::packed(points), set));
  EXPECT_EQ(set.size(), 2U);
  EXPECT_TRUE(pack(ControlNets<float>::packed(points, 1, 1), set));
  EXPECT_EQ(set.size(), 8U);
  points.pop_back();
  EXPECT_EQ(pack(ControlNets<float>::packed(points), set).status, Status::input_too_small);
  EXPECT_EQ(set.size(), 8U);
  EXPECT_TRUE(pack(ControlNets<float>::packed(std::span<const float>()), set));
  EXPECT_EQ(set.size(), 0U);
  EXPECT_EQ(pack(ControlNets<float>::packed(points, -1, 0), set).status, Status::bad_degree);

  const std::vector<float> values(24, 1.0F);
  CurveSet<float> curve_set;
  EXPECT_TRUE(pack(ControlCurves<float>::packed(values), curve_set));
  EXPECT_EQ(curve_set.size(), 2U);
  EXPECT_EQ(pack(ControlCurves<float>::packed(std::span(values).first(23)), curve_set).status,
            Status::input_too_small);
}

TEST(ControlPoints, must_lie_in_the_memory_that_is_known) {
  const std::vector<float> values(96, 0.5F);
  const auto nets = ControlNets<float>::packed(std::span(values).first(48));
  PatchSet<float> set;
  for (const auto change :
       {+[](ControlNets<float>& n) { n.count = 2; }, +[](ControlNets<float>& n) { n.points += 1; },
        +[](ControlNets<float>& n) { n.row_stride = 13; },
        +[](ControlNets<float>& n) { n.point_stride = -3; },
        +[](ControlNets<float>& n) { n.components = 4; }}) {
    ControlNets<float> wrong = nets;
    change(wrong);
    EXPECT_EQ(pack(wrong, set).status, Status::input_too_small);
  }
  EXPECT_TRUE(pack(reversed_u(reversed_v(transposed(nets))), set));
  EXPECT_EQ(pack(boundary_curves(nets, PatchEdge::u1), *std::make_unique<CurveSet<float>>()).status,
            Status::ok);
}

TEST(NetResults, that_do_not_fit) {
  const std::vector<float> values(96, 0.5F);
  const auto nets = ControlNets<float>::packed(values);
  std::vector<float> out(500, -777.0F);
  const auto room = [&](std::size_t count) { return std::span(out).first(count); };
  const auto elevated = [&](std::size_t count) {
    return elevate(nets, MutableNets<float>::packed(room(count), 2, 4, 3)).status;
  };
  std::vector<double> points(23);
  std::vector<EdgeLink> links(7);
  EXPECT_EQ(elevated(119), Status::output_too_small);
  EXPECT_EQ(flatness(nets, room(1)).status, Status::output_too_small);
  EXPECT_EQ(control_boxes(nets, {room(5), room(6)}).status, Status::output_too_small);
  EXPECT_EQ(tight_boxes(nets, 1, {room(6), room(5)}).status, Status::output_too_small);
  EXPECT_EQ(iso_u(nets, 0.5, points).status, Status::output_too_small);
  EXPECT_EQ(find_adjacency(nets, links), Status::output_too_small);
  EXPECT_EQ(out, std::vector<float>(out.size(), -777.0F));
  points.resize(24);
  links.resize(8);
  EXPECT_EQ(elevated(120), Status::ok);
  EXPECT_EQ(flatness(nets, room(2)).status, Status::ok);
  EXPECT_EQ(control_boxes(nets, {room(6), std::span(out).subspan(6, 6)}).status, Status::ok);
  EXPECT_EQ(iso_u(nets, 0.5, points).status, Status::ok);
  EXPECT_EQ(find_adjacency(nets, links), Status::ok);
}

TEST(Results, are_those_of_the_calls_with_memory) {
  const auto grid = Grid<float>::uniform(5, 4, {1, 2});
  Planes<float> expected(40, {.second = true, .curvature = true});
  ASSERT_EQ(evaluate(patches(), grid, expected.outputs()), Status::ok);
  OutputSelection all;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(Output::status); ++k) {
    all.add(static_cast<Output>(k));
  }
  const SurfaceSamples<float> samples = evaluate(patches(), grid, all);
  ASSERT_TRUE(samples);
  for (std::size_t k = 0; k < 40; ++k) {
    EXPECT_EQ(samples.position[k], expected.vector(0, k));
    EXPECT_EQ(samples.dv[k], expected.vector(2, k));
    EXPECT_EQ(samples.normal[k], expected.vector(3, k));
    EXPECT_EQ(samples.duv[k], expected.vector(5, k));
    EXPECT_TRUE(same_bits(samples.maximum[k], expected.curvature(3, k)));
  }
  EXPECT_EQ(samples.sample_status, expected.status());
}

TEST(Results, hold_what_was_asked_for_or_nothing) {
  const auto some = evaluate(patches(), PatchGrids{kSides, kSides}, {Output::dv});
  EXPECT_TRUE(some);
  EXPECT_EQ(some.dv.size(), 45U);
  EXPECT_TRUE(some.position.empty() && some.sample_status.empty() && some.mean.empty());
  const auto none = evaluate(patches(), Grid<float>::uniform(1, 5), {Output::position});
  EXPECT_EQ(none.status, Status::bad_grid);
  EXPECT_TRUE(none.position.empty());
  EXPECT_EQ(evaluate(patches(), Grid<float>::uniform(std::numeric_limits<std::size_t>::max(), 5),
                     {Output::position})
                .status,
            Status::size_overflow);
  EXPECT_EQ(evaluate(patches(), Grid<float>::uniform(3, 3), OutputSelection{}).status,
            Status::null_output);
}

} // namespace
} // namespace simdbezier::tests::results_test
