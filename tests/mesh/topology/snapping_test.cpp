// Sides that match only nearly: closed by a distance, and certified with what that moves.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/mesh_models.hpp"
#include "tests/mesh/support/mesh_oracle.hpp"
#include "tests/mesh/support/triangle_census.hpp"

namespace simdbezier::tests::snapping_test {
namespace {

/// Every control point moved by up to `most` in each direction, so that no side matches exactly.
MeshModel shaken(MeshModel model, double most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-most, most);
  for (PatchPoints& patch : model.patches) {
    for (auto& row : patch) {
      for (Point& point : row) {
        point = point + Point{uniform(random), uniform(random), uniform(random)};
      }
    }
  }
  return model;
}

Mesh<double> mesh_of(const MeshModel& model, double tolerance, double snap, double point_size) {
  const std::vector<double> values = model.values();
  MeshOptions options;
  options.rates.tolerance = tolerance;
  options.topology.snap = snap;
  options.topology.point_size = point_size;
  return tessellate<double>(ControlNets<double>::packed(std::span<const double>(values)), options);
}

TriangleCensus census_of(const Mesh<double>& mesh) {
  return count_triangles(
      std::span<const std::uint32_t>(mesh.triangles.front().data(), 3 * mesh.triangles.size()),
      mesh.positions.size());
}

struct Closed {
  const char* model;
  long euler;
};
constexpr Closed kClosed[] = {{"cube", 2},       {"torus 2 x 2", 0}, {"torus 4 x 3", 0},
                              {"ball 3 x 3", 2}, {"ball 4 x 2", 2},  {"pillow", 2}};

TEST(Snapping, closes_what_nearly_matches) {
  constexpr double kShake = 1e-4;
  constexpr double kSnap = 1e-3;
  for (const Closed& closed : kClosed) {
    for (const MeshModel& model : mesh_models()) {
      if (model.name != closed.model) {
        continue;
      }
      for (unsigned seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE(model.name + ", seed " + std::to_string(seed));
        const MeshModel near = shaken(seed == 0 ? model : shuffled(model, seed), kShake, seed);
        const Mesh<double> apart = mesh_of(near, 0.05, 0, kSnap);
        ASSERT_EQ(apart.report.status, Status::ok);
        EXPECT_GT(census_of(apart).open, 0U);
        const Mesh<double> mesh = mesh_of(near, 0.05, kSnap, kSnap);
        ASSERT_EQ(mesh.report.status, Status::ok);
        EXPECT_EQ(mesh.counts.open_edges, 0U);
        EXPECT_GT(mesh.counts.snapped_sides, 0U);
        const TriangleCensus census = census_of(mesh);
        EXPECT_EQ(census.open + census.crowded + census.degenerate, 0U);
        EXPECT_EQ(census.euler, closed.euler);
      }
    }
  }
}

/// The sides at a ball's poles are as close to each other as their own ends are, whichever way
/// round.
TEST(Snapping, makes_points_of_open_sides_that_are_as_short) {
  for (const MeshModel& model : mesh_models()) {
    if (model.name.starts_with("ball")) {
      for (unsigned seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE(model.name + ", seed " + std::to_string(seed));
        const Mesh<double> mesh = mesh_of(shaken(model, 1e-4, seed), 0.05, 1e-3, 0);
        ASSERT_EQ(mesh.report.status, Status::ok);
        EXPECT_EQ(mesh.counts.open_edges, 0U);
        EXPECT_TRUE(mesh.counts.orientable);
        const TriangleCensus census = census_of(mesh);
        EXPECT_EQ(census.open + census.crowded + census.degenerate, 0U);
        EXPECT_EQ(census.euler, 2);
      }
    }
  }
}

/// A ball with sides at its poles of which some are longer than the distance: the ends of the
/// meridians there are moved by 0.69 of it, in opposite directions, except for the first two.
MeshModel with_torn_poles(MeshModel model, double distance) {
  std::map<Point, std::vector<Point>> meridians; // at each pole, by their next control points
  for (PatchPoints& patch : model.patches) {
    for (const std::size_t j : {std::size_t{0}, std::size_t{3}}) {
      const Point pole = patch[j][1];
      if (patch[j][0] != pole || patch[j][3] != pole) {
        continue;
      }
      for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
        std::vector<Point>& known = meridians[pole];
        const Point next = patch[j == 0 ? 1 : 2][i];
        const auto at = std::find(known.begin(), known.end(), next) - known.begin();
        if (at == std::ssize(known)) {
          known.push_back(next);
        }
        patch[j][i][0] += at < 2 ? 0 : (at % 2 == 0 ? 0.69 : -0.69) * distance;
      }
    }
  }
  return model;
}

TEST(Snapping, makes_points_of_longer_sides_around_a_pole) {
  for (const MeshModel& model : mesh_models()) {
    if (model.name == "ball 4 x 2") {
      for (unsigned seed = 0; seed < 4; ++seed) {
        const MeshModel torn = with_torn_poles(model, 1e-3);
        const Mesh<double> mesh = mesh_of(seed == 0 ? torn : shuffled(torn, seed), 0.05, 1e-3, 0);
        ASSERT_EQ(mesh.report.status, Status::ok);
        EXPECT_EQ(mesh.counts.collapsed_sides, 8U);
        EXPECT_EQ(mesh.counts.open_edges, 0U);
        const TriangleCensus census = census_of(mesh);
        EXPECT_EQ(census.open + census.crowded + census.degenerate, 0U);
        EXPECT_EQ(census.euler, 2);
      }
    }
  }
}

/// Two patches whose common side is shorter than the distance.
TEST(Snapping, makes_points_of_short_sides_that_are_shared) {
  MeshModel model{"bow tie", {}, 0, 0};
  for (int k = 0; k < 2; ++k) {
    PatchPoints& patch = model.patches.emplace_back();
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double x = static_cast<double>(3 * k) + static_cast<double>(i) - 3;
        patch[j][i] = {x, static_cast<double>(j) * (std::fabs(x) + 1e-4), 0};
      }
    }
  }
  for (const bool snaps : {false, true}) {
    const Mesh<double> mesh = mesh_of(model, 0.05, snaps ? 1e-3 : 0, snaps ? 0 : 1e-3);
    ASSERT_EQ(mesh.report.status, Status::ok);
    EXPECT_EQ(mesh.counts.collapsed_sides, 2U);
    EXPECT_EQ(mesh.counts.edges, 6U);
    EXPECT_EQ(census_of(mesh).degenerate, 0U);
    const auto is_near = [](const Point& x) { return length(x) < 1e-3; };
    EXPECT_EQ(std::count_if(mesh.positions.begin(), mesh.positions.end(), is_near), 2)
        << "one for each patch, since patches that touch in a point stay apart";
  }
}

/// Two planes side by side whose common side is off by up to a distance: what a vertex is moved by
/// is part of the certificate.
TEST(Snapping, is_part_of_the_certificate) {
  for (const double gap : {0.0, 0.01, 0.03}) {
    MeshModel model{"planes", {}, 1, 1};
    for (int k = 0; k < 2; ++k) {
      PatchPoints& patch = model.patches.emplace_back();
      for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) {
          const bool moved = k == 1 && i == 0;
          patch[j][i] = {3.0 * k + static_cast<double>(i), static_cast<double>(j),
                         moved ? gap : 0.0};
        }
      }
    }
    const Mesh<double> mesh = mesh_of(model, 0.2, 0.05, 0);
    ASSERT_EQ(mesh.report.status, Status::ok);
    EXPECT_EQ(mesh.counts.snapped_sides, gap > 0 ? 2U : 0U);
    EXPECT_EQ(mesh.counts.open_edges, 6U);
    EXPECT_LT(mesh.deviations[0], 1e-12) << "the first patch's points are taken";
    EXPECT_GE(mesh.deviations[1], gap);
    EXPECT_LE(mesh.deviations[1], 0.2);
    const Mesh<double> refused = mesh_of(model, 0.029, 0.05, 0);
    EXPECT_EQ(refused.report.status, gap > 0.029 ? Status::snap_too_large : Status::ok);
    EXPECT_EQ(refused.report.item, gap > 0.029 ? 1U : 0U);
  }
}

/// Homogeneous points whose quotients are equal in float alone make a point of a side, as snapping
/// would: how far apart they are is part of the certificate.
TEST(Snapping, of_quotients_is_part_of_the_certificate) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.5, 1);
  std::size_t judged = 0;
  while (judged < 20) {
    const double apex[3] = {uniform(random), uniform(random), uniform(random)};
    const float weights[3] = {1, static_cast<float>(uniform(random)), 1};
    std::vector<float> values;
    double apart = 0;
    bool equal = true;
    for (const bool base : {false, true}) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
          const double x = apex[c] + (base ? 1e-5 * static_cast<double>(i * c + 1) : 0);
          values.push_back(static_cast<float>(x) * weights[i]);
          const float first = values[base ? values.size() - 1 : c];
          equal = equal && (base || values.back() / weights[i] == first);
          apart = std::max(apart, base ? 0
                                       : std::fabs(static_cast<double>(values.back()) /
                                                       static_cast<double>(weights[i]) -
                                                   static_cast<double>(first)));
        }
        values.push_back(weights[i]);
      }
    }
    if (!equal || apart < 1e-8) {
      continue;
    }
    const auto nets = ControlNets<float>::packed(values.data(), 1, 2, 1, 3, Weights::homogeneous);
    MeshOptions options;
    options.nu = options.nv = 256;
    const MeshPlan<double> plan = plan_mesh<double>(nets, options);
    ASSERT_EQ(plan.report.status, Status::ok);
    EXPECT_EQ(plan.counts.collapsed_sides, 1U);
    EXPECT_GE(plan.deviation, apart);
    ++judged;
  }
}

// The tolerance is not to blame where sides are moved by more than it allows.
TEST(Snapping, is_blamed_where_it_leaves_too_little_of_the_tolerance) {
  const std::vector<MeshModel> models = mesh_models();
  const MeshModel near = shaken(
      *std::ranges::find(models, "torus 4 x 3", [](const MeshModel& one) { return one.name; }),
      0.01, 5);
  EXPECT_EQ(to_string(mesh_of(near, 2e-3, 0.2, 0).report.status),
            to_string(Status::snap_too_large));
  EXPECT_EQ(to_string(mesh_of(near, 2e-3, 0, 0).report.status), "ok");
  EXPECT_EQ(to_string(mesh_of(near, 0.2, 0.2, 0).report.status), "ok");
  EXPECT_EQ(to_string(mesh_of(near, 1e-17, 0, 0).report.status), to_string(Status::bad_tolerance));
  EXPECT_EQ(to_string(mesh_of(near, -1, 0.2, 0).report.status), to_string(Status::bad_tolerance));
}

TEST(Snapping, leaves_what_is_farther_apart) {
  for (const MeshModel& model : mesh_models()) {
    if (model.name == "torus 4 x 3" || model.name == "cube") {
      const Mesh<double> mesh = mesh_of(shaken(model, 0.01, 3), 0.05, 1e-4, 0);
      ASSERT_EQ(mesh.report.status, Status::ok);
      EXPECT_EQ(mesh.counts.snapped_sides, 0U);
      EXPECT_EQ(mesh.counts.open_edges, 4 * model.patches.size());
    }
  }
}

// Distances of the size of a rounding of the coordinates: cells of that size have no place for a
// middle between two ends, which is rounded.
TEST(Snapping, joins_sides_that_are_a_rounding_apart) {
  const double u = std::ldexp(1, -33); // one rounding of the numbers from 2^19 to 2^20
  for (const double sign : {1.0, -1.0}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (int place = 0; place < 40; ++place) {
        SCOPED_TRACE(place);
        const double x = 600000 + place * u;
        const double from[] = {x - 5, x, x - 5, x + u, x + u, x + 5, x + 2 * u, x + 5};
        std::vector<double> values(24);
        for (std::size_t k = 0; k < 8; ++k) {
          values[3 * k + axis] = sign * from[k];
          values[3 * k + (axis + 1) % 3] = k / 2 % 2 == 0 ? 0 : 1;
        }
        Topology topology;
        TopologyOptions options;
        options.snap = u;
        ASSERT_EQ(
            find_topology(ControlNets<double>::packed(values.data(), 2, 1, 1), topology, options),
            Status::ok);
        EXPECT_EQ(topology.counts().snapped_sides, 2U);
        options.snap = u / 2;
        ASSERT_EQ(
            find_topology(ControlNets<double>::packed(values.data(), 2, 1, 1), topology, options),
            Status::ok);
        EXPECT_EQ(topology.counts().snapped_sides, 0U);
      }
    }
  }
}

TEST(Snapping, takes_the_closest_pairs) {
  // Three planes with one side each near the same line: the two that are closest are joined.
  MeshModel model{"three", {}, 0, 0};
  for (int k = 0; k < 3; ++k) {
    PatchPoints& patch = model.patches.emplace_back();
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double r = static_cast<double>(i);
        const double offset = k == 1 ? 0.01 : 0;
        patch[j][i] = {r * std::cos(2.0 * k) + offset, r * std::sin(2.0 * k) + (k == 2 ? 0.001 : 0),
                       static_cast<double>(j)};
      }
    }
  }
  const Mesh<double> mesh = mesh_of(model, 0.5, 0.02, 0);
  ASSERT_EQ(mesh.report.status, Status::ok);
  EXPECT_EQ(mesh.counts.snapped_sides, 2U);
  EXPECT_LT(mesh.deviations[1], 1e-12);
  EXPECT_NEAR(mesh.deviations[2], 0.001, 1e-9);
}

TEST(Snapping, bad_input_is_a_status) {
  for (const double snap : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    Topology topology;
    TopologyOptions options;
    options.snap = snap;
    EXPECT_EQ(find_topology(ControlNets<double>{}, topology, options), Status::bad_tolerance);
  }
}

} // namespace
} // namespace simdbezier::tests::snapping_test
