// Topologies of other frames: which control nets they fit, and who asks.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/rates.hpp>
#include <simdbezier/topology.hpp>

#include "tests/mesh/support/mesh_models.hpp"

namespace simdbezier::tests::fit_test {
namespace {

/// A model's control points in T, and the topology of these.
template <typename T>
struct Frame {
  std::vector<T> values;
  std::size_t patches;
  Topology topology;

  explicit Frame(const MeshModel& model, const TopologyOptions& options = {})
      : patches(model.patches.size()) {
    for (const double value : model.values()) {
      values.push_back(static_cast<T>(value));
    }
    EXPECT_EQ(find_topology(nets(), topology, options), Status::ok);
  }
  [[nodiscard]] ControlNets<T> nets() const {
    return ControlNets<T>::packed(values.data(), patches, 3, 3);
  }
  /// What choose_rates() says of the nets as they are.
  [[nodiscard]] Report report() const {
    std::vector<std::uint32_t> nu(patches);
    std::vector<std::uint32_t> nv(patches);
    std::vector<std::uint16_t> diagonals(patches);
    const CertifiedRates rates{nu, nv, diagonals, {}};
    RateOptions options;
    options.tolerance = 0.1;
    const Report chosen = choose_rates(nets(), topology, options, rates);
    EXPECT_EQ(chosen.status == Status::bad_topology,
              certify_rates(nets(), topology, {}, rates).status == Status::bad_topology);
    return chosen;
  }
};

/// A map that is no linear one, and takes equal points to equal points.
template <typename T>
void deform(std::vector<T>& values) {
  for (std::size_t k = 0; k < values.size(); k += 3) {
    const T x = values[k];
    values[k] = x + std::sin(values[k + 1]) / 4;
    values[k + 2] -= x * x / 8;
  }
}

/// The sides that control point i, j of a bicubic patch is on.
std::vector<PatchEdge> sides_with(std::size_t i, std::size_t j) {
  std::vector<PatchEdge> sides;
  for (const auto& [on, side] :
       {std::pair(j == 0, PatchEdge::v0), std::pair(j == 3, PatchEdge::v1),
        std::pair(i == 0, PatchEdge::u0), std::pair(i == 3, PatchEdge::u1)}) {
    if (on) {
      sides.push_back(side);
    }
  }
  return sides;
}

template <typename T>
class Fits : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Fits, Scalars);

TYPED_TEST(Fits, every_frame_of_a_model_that_moves) {
  for (const MeshModel& original : mesh_models()) {
    for (unsigned seed = 0; seed < 4; ++seed) {
      Frame<TypeParam> frame(seed == 0 ? original : shuffled(original, seed));
      SCOPED_TRACE(original.name + ", seed " + std::to_string(seed));
      for (int moved = 0; moved < 3; ++moved) {
        EXPECT_TRUE(fits(frame.topology, frame.nets()));
        EXPECT_NE(frame.report().status, Status::bad_topology);
        deform(frame.values);
      }
    }
  }
}

// The oracle is find_adjacency(): a point counts where a side that it is on has another one, or is
// a point.
TYPED_TEST(Fits, no_nets_in_which_a_joined_side_has_come_apart) {
  for (const MeshModel& original : mesh_models()) {
    const MeshModel model = shuffled(original, 3);
    Frame<TypeParam> frame(model);
    std::vector<EdgeLink> links(4 * frame.patches);
    ASSERT_TRUE(find_adjacency(frame.nets(), Values<EdgeLink>(links)));
    for (std::size_t point = 0; point < 16 * frame.patches; ++point) {
      SCOPED_TRACE(model.name + ", point " + std::to_string(point));
      bool joined = false;
      for (const PatchEdge side : sides_with(point % 4, point / 4 % 4)) {
        const EdgeLink& link = links[4 * (point / 16) + static_cast<std::size_t>(side)];
        joined = joined || link.kind != EdgeKind::boundary;
      }
      TypeParam& value = frame.values[3 * point + point % 3];
      const TypeParam before = value;
      value = std::nextafter(value, std::numeric_limits<TypeParam>::max());
      EXPECT_EQ(fits(frame.topology, frame.nets()), !joined);
      const Report report = frame.report();
      EXPECT_EQ(report.status == Status::bad_topology, joined);
      if (joined) {
        EXPECT_LT(report.item, frame.patches);
      }
      value = before;
    }
  }
}

/// Two flat patches, 0 <= x <= 1 and 1 + gap <= x <= 2 + gap.
MeshModel two_sheets(double gap) {
  MeshModel model;
  for (std::size_t p = 0; p < 2; ++p) {
    PatchPoints& points = model.patches.emplace_back();
    for (std::size_t k = 0; k < 16; ++k) {
      points[k / 4][k % 4] = {static_cast<double>(p) * (1 + gap) + static_cast<double>(k % 4) / 3,
                              static_cast<double>(k / 4) / 3, 0};
    }
  }
  return model;
}

TYPED_TEST(Fits, snapped_sides_as_long_as_they_are_near) {
  TopologyOptions options;
  options.snap = 0.01;
  const Frame<TypeParam> snapped(two_sheets(0.005), options);
  ASSERT_EQ(snapped.topology.counts().snapped_sides, 2U);
  struct Row {
    double gap;
    bool fits;
  };
  for (const Row& row : {Row{0, true}, {0.001, true}, {0.009, true}, {0.02, false}, {1, false}}) {
    Frame<TypeParam> frame(two_sheets(row.gap));
    frame.topology = snapped.topology;
    SCOPED_TRACE(row.gap);
    EXPECT_EQ(fits(frame.topology, frame.nets()), row.fits);
    EXPECT_EQ(frame.report().status, row.fits ? Status::ok : Status::bad_topology);
  }
}

// The certificate counts the gap of the nets at hand, and not that of the frame that was snapped.
TYPED_TEST(Fits, snapped_sides_with_their_gap_of_now) {
  TopologyOptions options;
  options.snap = 0.01;
  for (const double gap : {0.001, 0.009}) {
    Frame<TypeParam> frame(two_sheets(gap));
    frame.topology = Frame<TypeParam>(two_sheets(0.005), options).topology;
    std::vector<std::uint32_t> nu = {1, 1};
    std::vector<std::uint32_t> nv = {1, 1};
    std::vector<std::uint16_t> diagonals(2);
    std::vector<double> deviation(2);
    ASSERT_TRUE(certify_rates(frame.nets(), frame.topology, {}, {nu, nv, diagonals, deviation}));
    EXPECT_NEAR(deviation[1], gap, 1e-5);
  }
}

// How short a side has to be to count as a point says nothing of sides that are none.
TYPED_TEST(Fits, sides_that_are_no_points_by_snap_alone) {
  struct Row {
    double snap;
    double gap;
    bool fits;
  };
  const Row rows[] = {{0, 0, true},        {0, 1e-3, false},    {0, 0.2, false},
                      {0.01, 0.009, true}, {0.01, 0.02, false}, {0.01, 0.2, false}};
  for (const Row& row : rows) {
    SCOPED_TRACE(testing::Message() << "snap " << row.snap << ", gap " << row.gap);
    TopologyOptions options;
    options.snap = row.snap;
    options.point_size = 0.25;
    Frame<TypeParam> frame(two_sheets(row.gap));
    frame.topology = Frame<TypeParam>(two_sheets(row.snap / 2), options).topology;
    ASSERT_EQ(frame.topology.counts().edges, 7U);
    EXPECT_EQ(fits(frame.topology, frame.nets()), row.fits);
    EXPECT_EQ(frame.report().status == Status::bad_topology, !row.fits);
  }
}

/// Flat triangles side by side whose tips are at y = 1: sides that are `size` long.
MeshModel tips(std::size_t patches, double size) {
  MeshModel model;
  for (std::size_t p = 0; p < patches; ++p) {
    PatchPoints& points = model.patches.emplace_back();
    for (std::size_t k = 0; k < 16; ++k) {
      const double x = static_cast<double>(p) + static_cast<double>(k % 4) / 3;
      const double y = static_cast<double>(k / 4) / 3;
      points[k / 4][k % 4] = {x * ((1 - y) + size * y), y, 0};
    }
  }
  return model;
}

TYPED_TEST(Fits, short_sides_as_long_as_they_are_short) {
  TopologyOptions of_points;
  of_points.point_size = 0.01;
  TopologyOptions of_snap;
  of_snap.snap = 0.01;
  for (const std::size_t patches : {1U, 2U, 7U}) { // whose tips reach farther than one may be long
    for (const TopologyOptions& options : {of_points, of_snap}) {
      for (const double found : {0.001, 0.009}) {
        const Frame<TypeParam> first(tips(patches, found), options);
        ASSERT_EQ(first.topology.counts().collapsed_sides, patches);
        for (const double size : {0.0, 0.001, 0.009, 0.08, 0.2}) {
          SCOPED_TRACE(testing::Message() << patches << " patches, snap " << options.snap
                                          << ", found at " << found << ", now " << size);
          Frame<TypeParam> frame(tips(patches, size));
          frame.topology = first.topology;
          EXPECT_EQ(fits(frame.topology, frame.nets()), size < 0.01);
        }
      }
    }
  }
}

// Such a side may be longer than `snap`: all of its points are as near to the one that it matched.
TYPED_TEST(Fits, open_sides_that_matched_a_point) {
  const auto model = [](double size) {
    MeshModel both = tips(2, 0);
    // The second one is upside down, with its tip above that of the first.
    for (std::size_t k = 0; k < 16; ++k) {
      const double x = static_cast<double>(k % 4) / 3 - 0.5;
      const double y = static_cast<double>(k / 4) / 3;
      both.patches[1][k / 4][k % 4] = {x * (y + size * (1 - y)), 1 + y, 0};
    }
    return both;
  };
  TopologyOptions options;
  options.snap = 0.01;
  const Frame<TypeParam> first(model(0.018), options);
  ASSERT_EQ(first.topology.counts().collapsed_sides, 2U);
  for (const double size : {0.0, 0.005, 0.018, 0.03, 0.5}) {
    SCOPED_TRACE(size);
    Frame<TypeParam> frame(model(size));
    frame.topology = first.topology;
    EXPECT_EQ(fits(frame.topology, frame.nets()), size < 0.02);
  }
}

TYPED_TEST(Fits, no_nets_of_another_shape) {
  const Frame<TypeParam> frame(two_sheets(0));
  const std::vector<TypeParam> points(3 * 9 * 2);
  EXPECT_FALSE(fits(frame.topology, ControlNets<TypeParam>::packed(points.data(), 1, 2, 2)));
  EXPECT_FALSE(fits(Topology(), frame.nets()));
  EXPECT_FALSE(fits(frame.topology, std::span<const ControlNets<TypeParam>>()));
  EXPECT_TRUE(fits(Topology(), std::span<const ControlNets<TypeParam>>()));
}

} // namespace
} // namespace simdbezier::tests::fit_test
