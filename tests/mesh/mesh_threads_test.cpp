// Topologies and layouts are the same for any number of threads, in every member.
#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/topology.hpp>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "tests/mesh/support/mesh_models.hpp"
#include "tests/mesh/support/random_gluing.hpp"

namespace simdbezier::tests::mesh_threads_test {
namespace {

constexpr int kThreads[] = {2, 3, 7};

using Patches = std::vector<PatchPoints>;

void append(const std::vector<double>& values, Patches& patches) {
  for (std::size_t k = 0; k < values.size(); k += 48) {
    PatchPoints patch;
    std::copy_n(values.data() + k, 48, &patch[0][0][0]);
    patches.push_back(patch);
  }
}

/// Leaves of a book with so many: one edge has all of them, and both of its ends have.
void append_book(std::size_t leaves, Patches& patches) {
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    PatchPoints patch;
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double x = static_cast<double>(i);
        patch[j][i] = {x, static_cast<double>(j), x * static_cast<double>(leaf)};
      }
    }
    patches.push_back(patch);
  }
}

/// Patches with everything that is rare: sides that are points, that are the same from both ends,
/// or of many patches; repetitions; points that are no numbers.
Patches odd_patches() {
  Patches patches;
  append_book(200, patches);
  const PatchPoints leaf = patches.front();
  PatchPoints palindrome = leaf;
  palindrome[0][3] = palindrome[0][0];
  palindrome[0][2] = palindrome[0][1];
  PatchPoints no_numbers;
  for (auto& row : no_numbers) {
    for (auto& point : row) {
      point.fill(std::numeric_limits<double>::quiet_NaN());
    }
  }
  PatchPoints point;
  for (auto& row : point) {
    row.fill({5, 6, 7});
  }
  for (const PatchPoints& patch : {leaf, palindrome, no_numbers, point}) {
    patches.insert(patches.end(), 5, patch);
  }
  return patches;
}

/// All models, random gluings and odd patches in random order, so that neighbours are far apart; in
/// the order in which they are made, neighbours are near.
Patches mixed_patches(bool in_order) {
  Patches patches = odd_patches();
  for (const MeshModel& model : mesh_models()) {
    for (unsigned seed = 0; seed < 3; ++seed) {
      append(shuffled(model, seed).values(), patches);
    }
  }
  for (unsigned seed = 0; seed < 80; ++seed) {
    append(RandomGluing(seed).values, patches);
  }
  if (!in_order) {
    std::shuffle(patches.begin(), patches.end(), std::mt19937(3));
  }
  return patches;
}

template <typename S>
std::vector<S> values_of(const Patches& patches) {
  std::vector<S> values;
  for (const PatchPoints& patch : patches) {
    const double* const first = &patch[0][0][0];
    std::transform(first, first + 48, std::back_inserter(values),
                   [](double value) { return static_cast<S>(value); });
  }
  return values;
}

void expect_same(const TopologyCounts& a, const TopologyCounts& b) {
  EXPECT_EQ(a.patches, b.patches);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.open_edges, b.open_edges);
  EXPECT_EQ(a.non_manifold_edges, b.non_manifold_edges);
  EXPECT_EQ(a.collapsed_sides, b.collapsed_sides);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.repeated_patches, b.repeated_patches);
  EXPECT_EQ(a.turned_edges, b.turned_edges);
  EXPECT_EQ(a.snapped_sides, b.snapped_sides);
  EXPECT_EQ(a.orientable, b.orientable);
}

void expect_same(const detail::TopologyData& a, const detail::TopologyData& b) {
  EXPECT_TRUE(a.sides == b.sides);
  EXPECT_TRUE(a.first == b.first);
  EXPECT_TRUE(a.members == b.members);
  EXPECT_TRUE(a.corners == b.corners);
  EXPECT_TRUE(a.next_corner == b.next_corner);
  EXPECT_TRUE(a.flags == b.flags);
  EXPECT_TRUE(a.originals == b.originals);
  EXPECT_TRUE(a.loops == b.loops);
  EXPECT_TRUE(a.apart == b.apart);
  EXPECT_TRUE(a.displacement == b.displacement);
  expect_same(a.counts, b.counts);
}

void expect_same(const detail::MeshData& a, const detail::MeshData& b) {
  EXPECT_TRUE(a.corners == b.corners);
  EXPECT_TRUE(a.edge_first == b.edge_first);
  EXPECT_TRUE(a.segments == b.segments);
  EXPECT_TRUE(a.inner == b.inner);
  EXPECT_TRUE(a.triangles == b.triangles);
  EXPECT_EQ(a.most_segments, b.most_segments);
  EXPECT_EQ(a.has_unions, b.has_unions);
  EXPECT_TRUE(std::equal(a.crowded_edges.begin(), a.crowded_edges.end(), b.crowded_edges.begin(),
                         b.crowded_edges.end(), [](const auto& x, const auto& y) {
                           return x.edge == y.edge && x.rates == y.rates;
                         }));
  EXPECT_EQ(a.most_boundary_vertices, b.most_boundary_vertices);
  EXPECT_EQ(a.most_boundary_samples, b.most_boundary_samples);
  EXPECT_EQ(a.most_sides, b.most_sides);
  EXPECT_EQ(a.vertices, b.vertices);
}

template <typename S>
Topology topology_of(const std::vector<S>& values, const TopologyOptions& options, int threads) {
  Topology topology;
  EXPECT_EQ(find_topology(ControlNets<S>::packed(values.data(), values.size() / 48, 3, 3), topology,
                          options, {.threads = threads}),
            Status::ok);
  return topology;
}

template <typename S>
void expect_same_topologies(const Patches& patches) {
  const std::vector<S> values = values_of<S>(patches);
  TopologyOptions snapping;
  snapping.snap = 1e-3;
  TopologyOptions small_points;
  small_points.point_size = 0.5;
  small_points.flip = true;
  for (const TopologyOptions& options : {TopologyOptions{}, snapping, small_points}) {
    const Topology expected = topology_of(values, options, 1);
    ASSERT_GT(expected.counts().non_manifold_edges, 0U);
    ASSERT_GT(expected.counts().repeated_patches, 0U);
    ASSERT_GT(expected.counts().turned_edges, 0U);
    for (const int threads : kThreads) {
      SCOPED_TRACE(threads);
      expect_same(*expected.data(), *topology_of(values, options, threads).data());
    }
  }
}

TEST(MeshThreads, topologies_are_the_same) {
  for (const bool in_order : {false, true}) {
    SCOPED_TRACE(in_order);
    expect_same_topologies<float>(mixed_patches(in_order));
    expect_same_topologies<double>(mixed_patches(in_order));
  }
}

TEST(MeshThreads, topologies_of_few_patches_are_the_same) {
  for (const MeshModel& model : mesh_models()) {
    SCOPED_TRACE(model.name);
    const std::vector<double> values = model.values();
    const Topology expected = topology_of(values, {}, 1);
    for (const int threads : kThreads) {
      expect_same(*expected.data(), *topology_of(values, {}, threads).data());
    }
  }
}

TEST(MeshThreads, layouts_are_the_same) {
  for (const bool in_order : {false, true}) {
    const Topology topology = topology_of(values_of<double>(mixed_patches(in_order)), {}, 1);
    for (const std::uint32_t most : {1U, 3U, 40U}) {
      SCOPED_TRACE(most);
      std::mt19937 random(most);
      std::vector<std::uint32_t> rates[2];
      for (auto& in_one : rates) {
        std::generate_n(std::back_inserter(in_one), topology.counts().patches,
                        [&] { return 1 + static_cast<std::uint32_t>(random() % most); });
      }
      const PatchRates of{rates[0], rates[1], {}};
      MeshLayout expected;
      ASSERT_EQ(lay_out_mesh(topology, of, expected), Status::ok);
      for (const int threads : kThreads) {
        SCOPED_TRACE(threads);
        MeshLayout layout;
        ASSERT_EQ(lay_out_mesh(topology, of, layout, {.threads = threads}), Status::ok);
        expect_same(*expected.data(), *layout.data());
      }
    }
  }
}

TEST(MeshThreads, too_many_vertices_are_refused) {
  const Topology topology = topology_of(values_of<float>(Patches(300, odd_patches()[0])), {}, 1);
  const std::vector<std::uint32_t> rates(300, kMostSegments);
  for (const int threads : {1, 2, 7}) {
    MeshLayout layout;
    EXPECT_EQ(lay_out_mesh(topology, {rates, rates, {}}, layout, {.threads = threads}),
              Status::size_overflow);
    EXPECT_EQ(layout.size().vertices, 0U);
  }
}

} // namespace
} // namespace simdbezier::tests::mesh_threads_test
