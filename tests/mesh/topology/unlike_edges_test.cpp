// Edges that are one curve although their control points differ: weights of 1 beside none, other
// scales of weights and other degrees, and poles of quotients that differ by roundings.
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <span>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>
#include <simdbezier/nets.hpp>

#include "tests/mesh/support/general_nets.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::unlike_edges_test {
namespace {

constexpr double kScales[] = {1, 3, 7, 0.1, 1e6};

/// In what the patches of a gluing differ.
struct Unlike {
  const char* name;
  bool forms;   ///< some have weights of 1, others have none
  bool weights; ///< of their own at all control points
  bool scales;  ///< of the weights
  bool degrees;
};
constexpr Unlike kUnlike[] = {{"forms", true, false, false, false},
                              {"scales", true, true, true, false},
                              {"degrees", false, false, false, true},
                              {"degrees of rational patches", false, true, false, true},
                              {"all", true, true, true, true}};

template <typename S>
std::vector<TestPatch> made_unlike(const RandomGluing& gluing, const Unlike& how, double size,
                                   unsigned seed) {
  std::mt19937 random(seed);
  std::vector<TestPatch> patches;
  for (GeneralNet net : nets_of(gluing, how.weights)) {
    net = placed(how.degrees ? raised_at_random(net, random) : net, size, {0, 0, 0});
    net = weighted(net, how.scales ? kScales[random() % std::size(kScales)] : 1);
    const bool plain = !how.weights && !how.scales && !(how.forms && random() % 2 == 0);
    patches.push_back(rounded_patch<S>(net, plain               ? Weights::none
                                            : random() % 2 == 0 ? Weights::cartesian
                                                                : Weights::homogeneous));
  }
  return patches;
}

template <typename S>
Topology topology_of_all(const std::vector<TestPatch>& patches, double snap) {
  const GeneralViews<S> views(patches);
  Topology topology;
  TopologyOptions how;
  how.snap = snap;
  EXPECT_EQ(find_topology<S>(views.nets, topology, how), Status::ok);
  return topology;
}

void expect_same(const TopologyCounts& found, const TopologyCounts& expected) {
  EXPECT_EQ(found.edges, expected.edges);
  EXPECT_EQ(found.open_edges, expected.open_edges);
  EXPECT_EQ(found.collapsed_sides, expected.collapsed_sides);
  EXPECT_EQ(found.corners, expected.corners);
  EXPECT_EQ(found.turned_edges, expected.turned_edges);
  EXPECT_EQ(found.orientable, expected.orientable);
}

template <typename S>
void expect_joined(const RandomGluing& gluing, const Unlike& how, double size, unsigned seed) {
  // What the gluing is, from bicubic patches whose edges have equal control points.
  std::vector<TestPatch> plain;
  for (const GeneralNet& net : nets_of(gluing, false)) {
    plain.push_back(rounded_patch<S>(net, Weights::none));
  }
  const TopologyCounts expected = topology_of_all<S>(plain, 0).counts();
  EXPECT_EQ(expected.open_edges, gluing.open_edges);
  const std::vector<TestPatch> patches = made_unlike<S>(gluing, how, size, seed);
  const bool exact = !how.scales && !how.degrees;
  const double snap = exact ? 0 : size * (sizeof(S) == 4 ? 3e-5 : 1e-12);
  const TopologyCounts counts = topology_of_all<S>(patches, snap).counts();
  expect_same(counts, expected);
  if (seed % 8 != 0) {
    return;
  }
  MeshOptions options;
  options.rates.tolerance = 0.1 * size;
  options.topology.snap = snap;
  options.normals = false;
  const GeneralViews<S> views(patches);
  const MeshPlan<S> plan = plan_mesh<S, S>(views.nets, options);
  ASSERT_EQ(plan.report.status, Status::ok);
  const Mesh<S> mesh = tessellate<S, S>(views.nets, options);
  ASSERT_EQ(mesh.report.status, Status::ok);
  EXPECT_LE(mesh.deviation, options.rates.tolerance);
  const TriangleCensus census = census_of(mesh);
  EXPECT_EQ(census.open > 0, gluing.open_edges > 0);
  EXPECT_EQ(gluing.folded ? 0 : census.crowded + census.degenerate, 0U);
  expect_certified(plan, mesh, patches);
}

template <typename S>
class UnlikeEdges : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(UnlikeEdges, Scalars);

TYPED_TEST(UnlikeEdges, are_joined) {
  const unsigned gluings = by_form<unsigned>(32, 400);
  for (const Unlike& how : kUnlike) {
    for (unsigned seed = 0; seed < gluings; ++seed) {
      const double size = kScales[seed / 8 % std::size(kScales)];
      SCOPED_TRACE(std::string(how.name) + ", seed " + std::to_string(seed));
      expect_joined<TypeParam>(RandomGluing(seed), how, size, seed);
    }
  }
}

/// Two patches whose edge at x = 0 has equal control points, and weights 1, w, 1 on either side.
template <typename S>
std::array<std::vector<S>, 2> beside(double w, double other) {
  std::array<std::vector<S>, 2> patches;
  for (const bool right : {false, true}) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 2; ++i) {
        const double x = 100 * (i - (right ? 0.0 : 1.0));
        const double weight = j == 1 ? (right ? other : w) : 1;
        patches[right].insert(patches[right].end(), {S(x), S(3 * j), S(j == 1 ? 3 : 0), S(weight)});
      }
    }
  }
  return patches;
}

// Middles of the edges are at (0, 3, 3 w / (1 + w)).
TYPED_TEST(UnlikeEdges, of_other_weights_are_other_curves) {
  for (const auto [w, other] : {std::array{1.0, 1.2}, {1.2, 1.0}, {1.0, 1.01}, {0.9, 1.1}}) {
    SCOPED_TRACE(std::to_string(w) + " beside " + std::to_string(other));
    const auto values = beside<TypeParam>(w, other);
    std::vector<ControlNets<TypeParam>> nets;
    for (const std::vector<TypeParam>& patch : values) {
      nets.push_back(ControlNets<TypeParam>::packed(patch.data(), 1, 1, 2, 3, Weights::cartesian));
    }
    const double apart = std::fabs(3 * w / (1 + w) - 3 * other / (1 + other));
    for (const double snap : {0.99 * apart, 2.0}) {
      MeshOptions options;
      options.rates.tolerance = 100;
      options.topology.snap = snap;
      const Mesh<TypeParam> mesh = tessellate<TypeParam, TypeParam>(nets, options);
      ASSERT_EQ(mesh.report.status, Status::ok);
      EXPECT_EQ(mesh.counts.open_edges, snap < apart ? 8U : 6U);
      EXPECT_TRUE(snap < apart || mesh.deviation >= apart);
    }
  }
}

// A degree cannot be raised without roundings, though here there are none.
TYPED_TEST(UnlikeEdges, of_other_degrees_are_no_closer_than_roundings) {
  const TypeParam line[] = {-1, 0, 0, 0, 0, 0, -1, 6, 0, 0, 6, 0};
  const TypeParam raised[] = {0, 0, 0, 1, 0, 0, 0, 3, 0, 1, 3, 0, 0, 6, 0, 1, 6, 0};
  const ControlNets<TypeParam> nets[] = {ControlNets<TypeParam>::packed(std::span(line), 1, 1),
                                         ControlNets<TypeParam>::packed(std::span(raised), 1, 2)};
  for (const double snap : {1e-18, 1e-12}) {
    Topology topology;
    TopologyOptions how;
    how.snap = snap;
    ASSERT_EQ(find_topology<TypeParam>(nets, topology, how), Status::ok);
    EXPECT_EQ(topology.counts().open_edges, snap < 1e-15 ? 8U : 6U);
  }
}

/// One row of control points is an arc of 90 degrees: weights 1, sqrt(1/2), 1.
constexpr double kHalf = 0.7071067811865476;
constexpr std::array<long double, 3> kArc[3] = {{1, 0, 1}, {kHalf, kHalf, kHalf}, {0, 1, 1}};

/// An octant of a sphere of radius 1 whose pole, (0, 0, 1) or (0, 0, -1), is the side v = 1.
GeneralNet octant(unsigned number) {
  GeneralNet net{2, 2, {}};
  for (const auto& meridian : kArc) {
    for (const auto& parallel : kArc) {
      const long double x = parallel[0] * meridian[0];
      const long double y = parallel[1] * meridian[0];
      const long double z = parallel[2] * meridian[1];
      const bool turned = number % 2 != 0; // by 90 degrees about the axis
      const long double half = number / 2 % 2 != 0 ? -1 : 1;
      net.points.push_back({half * (turned ? -y : x), half * (turned ? x : y), number < 4 ? z : -z,
                            parallel[2] * meridian[2]});
    }
  }
  return net;
}

template <typename S>
void expect_sphere(double radius, double offset, unsigned seed) {
  std::mt19937 random(seed);
  const Point centre = {offset, -offset / 3, offset / 7};
  std::vector<TestPatch> patches;
  for (unsigned k = 0; k < 8; ++k) {
    GeneralNet net = placed(octant(k), radius, centre);
    net = random() % 2 == 0 ? net : reversed(net);
    net = random() % 2 == 0 ? net : transposed(net);
    net = random() % 2 == 0 ? net : reversed(net);
    patches.push_back(rounded_patch<S>(net, Weights::homogeneous));
  }
  const GeneralViews<S> views(patches);
  MeshOptions options;
  options.rates.tolerance = 0.05 * radius;
  const Mesh<S> mesh = tessellate<S, S>(views.nets, options);
  ASSERT_EQ(mesh.report.status, Status::ok);
  EXPECT_EQ(mesh.counts.collapsed_sides, 8U);
  EXPECT_EQ(mesh.counts.corners, 6U);
  EXPECT_EQ(mesh.counts.open_edges, 0U);
  const TriangleCensus census = census_of(mesh);
  EXPECT_EQ(census.open + census.crowded + census.degenerate + census.repeated, 0U);
  EXPECT_EQ(census.euler, 2);
  const std::set<std::array<S, 3>> places(mesh.positions.begin(), mesh.positions.end());
  EXPECT_EQ(places.size(), mesh.positions.size()) << "two vertices in one place";
  const MeshPlan<S> plan = plan_mesh<S, S>(views.nets, options);
  expect_certified(plan, mesh, patches);
}

TYPED_TEST(UnlikeEdges, poles_of_spheres_are_points) {
  unsigned seed = 0;
  for (const double radius : {1.0, 3.0, 7.0, 10.0, 0.1, 1e6, 1.0 / 3}) {
    for (const double offset : {0.0, 1.0, 100.0}) {
      SCOPED_TRACE("radius " + std::to_string(radius) + ", offset " + std::to_string(offset));
      expect_sphere<TypeParam>(radius, offset * radius, seed++);
    }
  }
}

/// A patch one of whose sides is a point, with weights of its own, and a part of it.
template <typename S>
void expect_tip(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.1, 10);
  GeneralNet net{static_cast<int>(1 + random() % 6), static_cast<int>(1 + random() % 3), {}};
  const Point tip = {uniform(random), uniform(random), uniform(random)};
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= net.degree_u; ++i) {
      const long double weight = uniform(random);
      const double x[3] = {i + 0.1 * uniform(random), 3.0 * j, 0.1 * uniform(random)};
      auto& point = net.points.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        point[c] = weight * (tip[c] + (j == 0 ? 0 : x[c]));
      }
      point[3] = weight;
    }
  }
  net = placed(net, kScales[random() % std::size(kScales)], {0, 0, 0});
  net = random() % 2 == 0 ? net : reversed(net);
  const bool in_v = random() % 2 == 0;
  net = in_v ? transposed(net) : net;
  net = random() % 2 == 0 ? net : reversed(net);
  const TestPatch patch = rounded_patch<S>(net, Weights::homogeneous);
  const GeneralViews<S> views({patch});
  std::vector<S> part(views.values[0].size());
  const auto out =
      MutableNets<S>::packed(part.data(), 1, net.degree_u, net.degree_v, 3, Weights::homogeneous);
  ASSERT_TRUE(segment<S>(views.nets[0],
                         in_v ? SubPatch<S>{S(0), S(1), S(0.25), S(0.7)}
                              : SubPatch<S>{S(0.25), S(0.7), S(0), S(1)},
                         out));
  for (const ControlNets<S>& whole : {views.nets[0], ControlNets<S>(out)}) {
    MeshOptions options;
    options.nu = options.nv = 6;
    const Mesh<S> mesh = tessellate<S>(whole, options);
    ASSERT_EQ(mesh.report.status, Status::ok);
    EXPECT_EQ(mesh.counts.collapsed_sides, 1U);
    EXPECT_EQ(mesh.counts.corners, 3U);
    EXPECT_EQ(mesh.positions.size(), 31U);
    EXPECT_EQ(census_of(mesh).degenerate, 0U);
    const std::set<std::array<S, 3>> places(mesh.positions.begin(), mesh.positions.end());
    EXPECT_EQ(places.size(), mesh.positions.size()) << "two vertices in one place";
  }
}

TYPED_TEST(UnlikeEdges, tips_of_quotients_are_points) {
  std::mt19937 random(7);
  for (unsigned k = 0; k < by_form<unsigned>(300, 5000); ++k) {
    SCOPED_TRACE(k);
    expect_tip<TypeParam>(random);
  }
}

} // namespace
} // namespace simdbezier::tests::unlike_edges_test
