// Which edges and corners of known models are one.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <simdbezier/topology.hpp>

#include "src/mesh/topology/net_corners.hpp"
#include "tests/mesh/support/mesh_models.hpp"

namespace simdbezier::tests::topology_test {
namespace {

struct Expected {
  const char* model;
  std::size_t edges;
  std::size_t open;
  std::size_t non_manifold;
  std::size_t collapsed;
  std::size_t corners;
  std::size_t repeated;
};

constexpr Expected kExpected[] = {
    {"patch", 4, 4, 0, 0, 4, 0},          {"sheet", 17, 10, 0, 0, 12, 0},
    {"cube", 12, 0, 0, 0, 8, 0},          {"torus 1 x 1", 2, 0, 0, 0, 1, 0},
    {"torus 2 x 1", 4, 0, 0, 0, 2, 0},    {"torus 4 x 3", 24, 0, 0, 0, 12, 0},
    {"ball 1 x 1", 1, 0, 0, 2, 2, 0},     {"ball 4 x 2", 12, 0, 0, 8, 6, 0},
    {"pillow", 4, 0, 0, 0, 4, 0},         {"ring turned by half", 9, 6, 0, 0, 6, 0},
    {"book of 3", 10, 9, 1, 0, 8, 0},     {"touching in a corner", 8, 8, 0, 0, 8, 0},
    {"one patch twice", 4, 0, 0, 0, 4, 1}};

MeshModel named(const std::string& name) {
  for (MeshModel& model : mesh_models()) {
    if (model.name == name) {
      return model;
    }
  }
  ADD_FAILURE() << "no model " << name;
  return {};
}

Status topology_of(const MeshModel& model, Topology& topology,
                   const TopologyOptions& options = {}) {
  const std::vector<double> values = model.values();
  return find_topology(ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3),
                       topology, options);
}

TEST(TopologyTest, counts_are_the_models) {
  for (const Expected& expected : kExpected) {
    const MeshModel original = named(expected.model);
    for (unsigned seed = 0; seed < 5; ++seed) {
      const MeshModel model = seed == 0 ? original : shuffled(original, seed);
      SCOPED_TRACE(model.name + ", seed " + std::to_string(seed));
      Topology topology;
      ASSERT_EQ(topology_of(model, topology), Status::ok);
      const TopologyCounts counts = topology.counts();
      EXPECT_EQ(counts.patches, model.patches.size());
      EXPECT_EQ(counts.edges, expected.edges);
      EXPECT_EQ(counts.open_edges, expected.open);
      EXPECT_EQ(counts.non_manifold_edges, expected.non_manifold);
      EXPECT_EQ(counts.collapsed_sides, expected.collapsed);
      EXPECT_EQ(counts.corners, expected.corners);
      EXPECT_EQ(counts.repeated_patches, expected.repeated);
      EXPECT_EQ(counts.orientable, model.orientable);
      if (model.agree) {
        EXPECT_EQ(counts.turned_edges, 0U);
      }
    }
  }
}

TEST(TopologyTest, a_model_of_one_side_cannot_be_oriented) {
  TopologyOptions options;
  options.orient = true;
  Topology topology;
  EXPECT_EQ(topology_of(named("ring turned by half"), topology, options), Status::not_orientable);
  EXPECT_EQ(topology.counts().patches, 0U);
}

TEST(TopologyTest, only_patches_that_disagree_are_turned) {
  MeshModel model = named("cube");
  for (auto& row : model.patches[3]) {
    std::reverse(row.begin(), row.end());
  }
  TopologyOptions options;
  options.orient = true;
  Topology topology;
  ASSERT_EQ(topology_of(model, topology, options), Status::ok);
  EXPECT_EQ(topology.counts().turned_edges, 4U);
  for (std::size_t patch = 0; patch < 6; ++patch) {
    EXPECT_EQ(topology.is_turned(patch), patch == 3);
  }
  EXPECT_FALSE(topology.is_turned(6));
}

TEST(TopologyTest, short_sides_are_points_where_that_is_asked_for) {
  MeshModel model = named("patch");
  for (std::size_t i = 0; i < 4; ++i) { // the side v = 0 within 1e-6 of a point
    model.patches[0][0][i] = {1 + 1e-6 * static_cast<double>(i) / 4, 0, 0};
  }
  TopologyOptions options;
  Topology topology;
  ASSERT_EQ(topology_of(model, topology, options), Status::ok);
  EXPECT_EQ(topology.counts().collapsed_sides, 0U);
  options.point_size = 1e-6;
  ASSERT_EQ(topology_of(model, topology, options), Status::ok);
  EXPECT_EQ(topology.counts().collapsed_sides, 1U);
  EXPECT_EQ(topology.counts().corners, 3U);
}

/// Two patches with a side in common, which runs the other way in the second one. One of its
/// control points is no number in space. The others have distances from its ends that are below 1
/// and above it: a maximum that forgot them would depend on the direction.
std::vector<double> with_odd_point(std::size_t odd, bool homogeneous) {
  constexpr double kSide[4] = {0, 100, 50, 0.1};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values;
  for (std::size_t k = 0; k < 32; ++k) {
    double x = static_cast<double>(10 * (k % 4));
    double y = static_cast<double>(10 * (k / 4));
    double weight = 1;
    if (k % 16 < 4) {
      const std::size_t on_side = k < 16 ? k : 3 - k % 16;
      x = kSide[on_side];
      y = 0;
      if (on_side == odd) {
        x = homogeneous ? 0 : nan;
        weight = 0; // 0 / 0
      }
    }
    values.insert(values.end(), {x, y, 0});
    if (homogeneous) {
      values.push_back(weight);
    }
  }
  return values;
}

TEST(TopologyTest, sides_with_points_that_are_no_numbers_are_no_points) {
  for (const bool homogeneous : {false, true}) {
    for (std::size_t odd = 0; odd < 4; ++odd) {
      const std::vector<double> values = with_odd_point(odd, homogeneous);
      const auto weights = homogeneous ? Weights::homogeneous : Weights::none;
      for (const double snap : {0.0, 1.0}) {
        TopologyOptions options;
        options.point_size = 1;
        options.snap = snap;
        Topology topology;
        ASSERT_EQ(find_topology(ControlNets<double>::packed(values.data(), 2, 3, 3, 3, weights),
                                topology, options),
                  Status::ok);
        EXPECT_EQ(topology.counts().collapsed_sides, 0U) << odd << homogeneous << snap;
        EXPECT_EQ(topology.counts().edges, 7U) << odd << homogeneous << snap;
      }
    }
  }
}

/// Weights of 1 are none, so that patches may repeat others that have no weights.
TEST(TopologyTest, patches_with_weights_of_one_repeat_those_without) {
  const MeshModel model = named("patch");
  const std::vector<double> plain = model.values();
  for (const Weights form : {Weights::cartesian, Weights::homogeneous}) {
    for (const double inner : {1.0, 2.0}) {
      std::vector<double> values;
      for (std::size_t k = 0; k < 16; ++k) {
        const double weight = k == 5 ? inner : 1; // an inner control point
        for (std::size_t c = 0; c < 3; ++c) {
          values.push_back(plain[3 * k + c] * (form == Weights::homogeneous ? weight : 1));
        }
        values.push_back(weight);
      }
      const ControlNets<double> nets[] = {
          ControlNets<double>::packed(plain.data(), 1, 3, 3),
          ControlNets<double>::packed(values.data(), 1, 3, 3, 3, form)};
      Topology topology;
      ASSERT_EQ(find_topology(std::span<const ControlNets<double>>(nets), topology), Status::ok);
      EXPECT_EQ(topology.counts().edges, 4U);
      EXPECT_EQ(topology.counts().repeated_patches, inner == 1 ? 1U : 0U);
    }
  }
}

/// The patch as homogeneous values with weights whose products are rounded.
template <typename S>
std::vector<S> weighted(const PatchPoints& net) {
  std::vector<S> values;
  for (std::size_t k = 0; k < 16; ++k) {
    const S weight = S(0.1) * static_cast<S>(1 + k * 7 % 11);
    for (const double x : net[k / 4][k % 4]) {
      values.push_back(static_cast<S>(x * double{weight}));
    }
    values.push_back(weight);
  }
  return values;
}

template <typename S>
unsigned doubts(const PatchPoints& net) {
  const std::vector<S> values = weighted<S>(net);
  const auto view = ControlNets<S>::packed(values.data(), 1, 3, 3, 3, Weights::homogeneous);
  return detail::QuickLook<S, true>(view).doubts(values.data());
}

/// A quick look at homogeneous points may leave nothing out, and has to be of use near the origin.
template <typename S>
void expect_doubts() {
  for (const double angle : {0.0, 1e-12, 0.2, 3.1}) {
    for (const double away : {0.0, 10.0, 1e9, 1e15}) {
      for (std::size_t corner = 0; corner < 4; ++corner) {
        SCOPED_TRACE(testing::Message() << angle << " at " << away << ", corner " << corner);
        PatchPoints net = named("patch").patches[0];
        const std::size_t i = corner % 2 * 3;
        const std::size_t j = corner / 2 * 3;
        const auto at = net[j][i];
        net[j][i == 0 ? 1 : 2] = {at[0] + 1, at[1], at[2]};
        net[j == 0 ? 1 : 2][i] = {at[0] + std::cos(angle), at[1] + std::sin(angle), at[2]};
        for (std::size_t k = 0; k < 16; ++k) {
          net[k / 4][k % 4][0] += away;
        }
        const double lost = away * std::numeric_limits<S>::epsilon(); // of steps of 1
        const bool doubted = (doubts<S>(net) & unsigned{detail::kMayLeaveTogether} << corner) != 0;
        if (angle < 0.1 || lost > 0.1) {
          EXPECT_TRUE(doubted);
        } else if (lost < 1e-5) {
          EXPECT_FALSE(doubted);
        }
      }
    }
  }
  for (std::size_t side = 0; side < kPatchEdges; ++side) {
    PatchPoints net = named("patch").patches[0];
    const auto corner = [&](std::size_t end) -> auto& {
      const std::size_t k = detail::kSideCorners[side][end];
      return net[k / 2 * 3][k % 2 * 3];
    };
    EXPECT_EQ(doubts<S>(net) / detail::kEndsMayMeet, 0U);
    corner(0) = corner(1) = {3, 0.7, 0.3};
    EXPECT_EQ(doubts<S>(net) / detail::kEndsMayMeet, 1U << side);
  }
}

TEST(TopologyTest, quick_looks_at_quotients_leave_out_nothing) {
  expect_doubts<float>();
  expect_doubts<double>();
}

TEST(TopologyTest, bad_input_is_a_status) {
  Topology topology;
  TopologyOptions options;
  for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    options.point_size = wrong;
    EXPECT_EQ(topology_of(named("patch"), topology, options), Status::bad_tolerance);
  }
  const std::vector<double> values(64);
  auto nets = ControlNets<double>::packed(values.data(), 1, 3, 3, 2);
  EXPECT_EQ(find_topology(nets, topology), Status::bad_components);
  nets = ControlNets<double>::packed(nullptr, 1, 3, 3);
  EXPECT_EQ(find_topology(nets, topology), Status::null_input);
  nets = ControlNets<double>::packed(values.data(), 1, 3, 3);
  nets.degree_u = 16;
  EXPECT_EQ(find_topology(nets, topology), Status::bad_degree);
  nets = ControlNets<double>::packed(values.data(), std::size_t{1} << 29, 3, 3);
  nets.patch_stride = 0;
  EXPECT_EQ(find_topology(nets, topology), Status::size_overflow);
}

} // namespace
} // namespace simdbezier::tests::topology_test
