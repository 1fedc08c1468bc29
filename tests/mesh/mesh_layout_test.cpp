// Meshes of models whose topology is known: closed where they are, with no vertex between two
// others on an edge, whatever the rates.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/topology.hpp>

#include "tests/mesh/support/mesh_models.hpp"
#include "tests/mesh/support/random_gluing.hpp"
#include "tests/mesh/support/triangle_census.hpp"

namespace simdbezier::tests::mesh_layout_test {
namespace {

struct Rates {
  std::vector<std::uint32_t> cells_u;
  std::vector<std::uint32_t> cells_v;
  std::vector<std::uint16_t> diagonals;
};

Rates random_rates(std::size_t patches, std::uint32_t most, unsigned seed) {
  std::mt19937 random(seed);
  Rates rates;
  for (std::size_t p = 0; p < patches; ++p) {
    rates.cells_u.push_back(1 + static_cast<std::uint32_t>(random() % most));
    rates.cells_v.push_back(1 + static_cast<std::uint32_t>(random() % most));
    rates.diagonals.push_back(static_cast<std::uint16_t>(random() % 512));
  }
  return rates;
}

Topology topology_of(const std::vector<double>& values, bool orient) {
  const auto nets = ControlNets<double>::packed(values.data(), values.size() / 48, 3, 3);
  Topology topology;
  TopologyOptions options;
  options.orient = orient;
  EXPECT_EQ(find_topology(nets, topology, options), Status::ok);
  return topology;
}

TriangleCensus census_of(const Topology& topology, const Rates& rates) {
  MeshLayout layout;
  EXPECT_EQ(lay_out_mesh(topology, {rates.cells_u, rates.cells_v, rates.diagonals}, layout),
            Status::ok);
  const MeshSize size = layout.size();
  constexpr std::uint32_t kUntouched = 0xabababab;
  std::vector<std::uint32_t> triangles(3 * size.triangles + 1, kUntouched);
  const auto written = std::span(triangles).first(3 * size.triangles);
  EXPECT_EQ(write_triangles(layout, written, {.threads = 1}), Status::ok);
  EXPECT_EQ(triangles.back(), kUntouched);
  return count_triangles<std::uint32_t>(written, size.vertices);
}

void expect_closed(const MeshModel& model, bool orient, std::uint32_t most, unsigned seed) {
  SCOPED_TRACE(model.name + ", rates to " + std::to_string(most) + ", seed " +
               std::to_string(seed));
  const std::vector<double> values = model.values();
  const Topology topology = topology_of(values, orient);
  Rates rates = random_rates(model.patches.size(), most, seed);
  std::size_t raised = 0;
  ASSERT_EQ(separate_vertices(topology, rates.cells_u, rates.cells_v, raised), Status::ok);
  const TriangleCensus census = census_of(topology, rates);
  EXPECT_EQ(census.out_of_range, 0);
  EXPECT_EQ(census.degenerate, 0);
  EXPECT_EQ(census.unused, 0);
  EXPECT_EQ(census.repeated, 0);
  EXPECT_EQ(census.euler, model.euler);
  EXPECT_EQ(census.crowded > 0, !model.manifold);
  if (model.manifold) {
    EXPECT_EQ(census.loops, model.loops);
    EXPECT_EQ(census.disagreeing == 0, model.agree || orient);
  }
}

TEST(MeshLayout, is_closed_where_the_model_is) {
  for (const MeshModel& model : mesh_models()) {
    if (model.repeated) {
      continue;
    }
    for (const std::uint32_t most : {1U, 2U, 3U, 7U, 20U}) {
      for (unsigned seed = 0; seed < 6; ++seed) {
        expect_closed(model, false, most, seed);
      }
    }
  }
}

TEST(MeshLayout, is_oriented_where_that_is_asked_for) {
  for (const MeshModel& model : mesh_models()) {
    if (!model.orientable || model.repeated) {
      continue;
    }
    for (const std::uint32_t most : {1U, 2U, 5U}) {
      for (unsigned seed = 0; seed < 8; ++seed) {
        expect_closed(shuffled(model, seed), true, most, seed);
      }
    }
  }
}

TEST(MeshLayout, is_a_surface_however_sides_are_joined) {
  std::size_t judged = 0;
  for (unsigned seed = 0; seed < 1500; ++seed) {
    const RandomGluing gluing(seed);
    const Topology topology = topology_of(gluing.values, false);
    ASSERT_EQ(topology.counts().open_edges, gluing.open_edges);
    for (const std::uint32_t most : {1U, 2U, 3U, 6U}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", rates to " + std::to_string(most));
      Rates rates = random_rates(gluing.patches, most, seed);
      std::size_t raised = 0;
      ASSERT_EQ(separate_vertices(topology, rates.cells_u, rates.cells_v, raised), Status::ok);
      const TriangleCensus census = census_of(topology, rates);
      EXPECT_EQ(census.out_of_range, 0U);
      EXPECT_EQ(census.degenerate, 0U);
      if (gluing.folded) { // which no rates take apart
        continue;
      }
      EXPECT_EQ(census.crowded, 0U);
      EXPECT_EQ(census.repeated, 0U);
      EXPECT_EQ(census.unused, 0U);
      EXPECT_EQ(census.open > 0, gluing.open_edges > 0);
      if (!gluing.has_points) {
        const TopologyCounts counts = topology.counts();
        EXPECT_EQ(census.euler, static_cast<long>(counts.corners) -
                                    static_cast<long>(counts.edges) +
                                    static_cast<long>(counts.patches));
      }
      ++judged;
    }
  }
  EXPECT_GT(judged, 1000U);
}

TEST(MeshLayout, rates_and_their_neighbours_are_counted_exactly) {
  // A sheet of two patches: rates 4 and 6 on the common edge are 8 segments.
  const std::vector<MeshModel> models = mesh_models();
  const MeshModel& torus = models[5];
  ASSERT_EQ(torus.name, "torus 1 x 2");
  const Topology topology = topology_of(torus.values(), false);
  const std::vector<std::uint32_t> cells_u = {4, 6};
  const std::vector<std::uint32_t> cells_v = {2, 2};
  MeshLayout layout;
  ASSERT_EQ(lay_out_mesh(topology, {cells_u, cells_v, {}}, layout), Status::ok);
  // 2 cells a triangle pair, and 4 + 2 further vertices on each of two edges, for two sides.
  EXPECT_EQ(layout.size().triangles, 2U * (4 * 2 + 6 * 2) + 2 * (8 - 4) + 2 * (8 - 6));
  EXPECT_EQ(layout.first_triangle(1), 2U * 8 + 2 * (8 - 4));
  EXPECT_EQ(layout.first_triangle(2), layout.size().triangles);
}

/// Triangles that go to all places within a cache line, in every way; what stands around them
/// stays.
template <typename Index>
void expect_numbers_anywhere(const MeshLayout& layout, const std::vector<std::uint32_t>& expected) {
  constexpr Index kGuard = 0xabcd;
  constexpr std::size_t kLine = 64 / sizeof(Index);
  for (const Destination destination : {Destination::cache, Destination::memory}) {
    for (const int threads : {1, 2, 5}) {
      for (std::size_t offset = 0; offset < kLine; offset += threads == 1 ? 1 : 7) {
        SCOPED_TRACE(std::to_string(offset) + ", threads " + std::to_string(threads));
        std::vector<Index> memory(2 * kLine + expected.size(), kGuard);
        const std::span all(memory);
        ASSERT_EQ(write_triangles(layout, all.subspan(offset, expected.size()),
                                  {.threads = threads, .destination = destination}),
                  Status::ok);
        const auto written = all.subspan(offset, expected.size());
        EXPECT_TRUE(std::equal(expected.begin(), expected.end(), written.begin()));
        for (const auto& beside : {all.first(offset), all.subspan(offset + expected.size())}) {
          EXPECT_EQ(std::count(beside.begin(), beside.end(), kGuard),
                    static_cast<std::ptrdiff_t>(beside.size()));
        }
      }
    }
  }
}

TEST(MeshLayout, numbers_are_the_same_wherever_they_go) {
  const MeshModel model = mesh_models()[7];
  const Topology topology = topology_of(model.values(), false);
  for (const unsigned most : {2U, 9U, 80U}) { // one line; some; patches of all kinds
    const Rates rates = random_rates(model.patches.size(), most, 3);
    MeshLayout layout;
    ASSERT_EQ(lay_out_mesh(topology, {rates.cells_u, rates.cells_v, rates.diagonals}, layout),
              Status::ok);
    ASSERT_LT(layout.size().vertices, 0xabcdU);
    std::vector<std::uint32_t> expected(3 * layout.size().triangles);
    ASSERT_EQ(write_triangles(layout, std::span(expected), {.threads = 1}), Status::ok);
    expect_numbers_anywhere<std::uint32_t>(layout, expected);
    expect_numbers_anywhere<std::uint16_t>(layout, expected);
  }
}

/// A patch whose sides v0, v1, u0, u1 are the origin where a bit is set, and beside it one that
/// shares its side u1, where that is not a point.
std::vector<double> patch_of_points(unsigned sides) {
  std::vector<double> values;
  const auto put = [&](double i, double j, double k, bool origin) {
    values.insert(values.end(), {origin ? 0.0 : i + 1, origin ? 0.0 : j + 1, k});
  };
  const auto at_origin = [&](std::size_t i, std::size_t j) {
    return ((sides & 1) != 0 && j == 0) || ((sides & 2) != 0 && j == 3) ||
           ((sides & 4) != 0 && i == 0) || ((sides & 8) != 0 && i == 3);
  };
  for (const std::size_t patch : {0U, 1U}) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const bool origin = patch == 0 ? at_origin(i, j) : i == 0 && at_origin(3, j);
        put(static_cast<double>(patch == 0 ? i : 3 + i), static_cast<double>(j),
            patch == 0 || i == 0 ? 0 : 1, origin);
      }
    }
  }
  return values;
}

/// Rates as they are, without separate_vertices(): whatever the sides, no number is written behind
/// the triangles that were counted.
TEST(MeshLayout, sides_that_are_points_leave_no_triangle_uncounted) {
  constexpr std::uint32_t kGuard = 0xabababab;
  constexpr std::uint32_t kMost = 4;
  for (unsigned sides = 0; sides < 16; ++sides) {
    const Topology topology = topology_of(patch_of_points(sides), false);
    for (std::uint32_t code = 0; code < kMost * kMost * kMost * 2; ++code) {
      const std::vector<std::uint32_t> cells_u = {1 + code % kMost, 2};
      const std::vector<std::uint32_t> cells_v = {1 + code / kMost % kMost,
                                                  1 + code / kMost / kMost % kMost};
      const std::uint16_t diagonals = code / kMost / kMost / kMost != 0 ? 511 : 0;
      SCOPED_TRACE("sides " + std::to_string(sides) + ", rates " + std::to_string(cells_u[0]) +
                   " x " + std::to_string(cells_v[0]) + " beside " + std::to_string(cells_v[1]));
      MeshLayout layout;
      ASSERT_EQ(lay_out_mesh(topology,
                             {cells_u, cells_v, std::vector<std::uint16_t>{diagonals, diagonals}},
                             layout),
                Status::ok);
      const std::size_t counted = layout.size().triangles;
      ASSERT_LE(counted, 100U);
      ASSERT_LE(layout.first_triangle(1), counted);
      std::vector<std::uint32_t> triangles(3 * counted + 60, kGuard);
      ASSERT_EQ(write_triangles(layout, std::span(triangles), {.threads = 1}), Status::ok);
      EXPECT_EQ(std::count(triangles.begin(), triangles.end(), kGuard), 60);
      const TriangleCensus census = count_triangles<std::uint32_t>(
          std::span(triangles).first(3 * counted), layout.size().vertices);
      EXPECT_EQ(census.out_of_range, 0U);
      // Where an edge of one segment ends where it begins, the neighbour's cell has one triangle.
      EXPECT_EQ(census.degenerate, 0U);
    }
  }
}

TEST(MeshLayout, bad_input_is_a_status) {
  const MeshModel model = mesh_models()[1];
  const Topology topology = topology_of(model.values(), false);
  const std::vector<std::uint32_t> good(model.patches.size(), 3);
  std::vector<std::uint32_t> bad = good;
  MeshLayout layout;
  for (const std::uint32_t wrong : {0U, kMostSegments + 1, ~0U}) {
    bad[2] = wrong;
    EXPECT_EQ(lay_out_mesh(topology, {bad, good, {}}, layout), Status::bad_rates);
    EXPECT_EQ(lay_out_mesh(topology, {good, bad, {}}, layout), Status::bad_rates);
    std::size_t raised = 7;
    std::vector<std::uint32_t> copy = good;
    EXPECT_EQ(separate_vertices(topology, bad, copy, raised), Status::bad_rates);
    EXPECT_EQ(raised, 7U);
  }
  const std::span<const std::uint32_t> fewer = std::span(good).first(good.size() - 1);
  EXPECT_EQ(lay_out_mesh(topology, {fewer, good, {}}, layout), Status::bad_rates);
  const std::vector<std::uint16_t> one(1);
  EXPECT_EQ(lay_out_mesh(topology, {good, good, one}, layout), Status::bad_rates);
  EXPECT_EQ(layout.size().vertices, 0U);

  ASSERT_EQ(lay_out_mesh(topology, {good, good, {}}, layout), Status::ok);
  std::vector<std::uint32_t> triangles(3 * layout.size().triangles - 1, 99);
  EXPECT_EQ(write_triangles(layout, std::span(triangles)), Status::output_too_small);
  EXPECT_EQ(std::count(triangles.begin(), triangles.end(), 99U),
            static_cast<std::ptrdiff_t>(triangles.size()));
  EXPECT_EQ(write_triangles(layout, std::span<std::uint32_t>()), Status::null_output);
  triangles.resize(3 * layout.size().triangles);
  for (const Isa wanted :
       {Isa::scalar, Isa::sse2, Isa::avx2, Isa::avx512, Isa::neon64, Isa::simd128}) {
    const bool runs = std::ranges::count(available_isas(), wanted) > 0;
    EXPECT_EQ(write_triangles(layout, std::span(triangles), {.isa = wanted}),
              runs ? Status::ok : Status::unsupported_isa);
    EXPECT_EQ(take_executed_isa(), runs ? wanted : Isa::automatic);
  }
  const std::vector<std::uint32_t> many(model.patches.size(), 300);
  ASSERT_EQ(lay_out_mesh(topology, {many, many, {}}, layout), Status::ok);
  std::vector<std::uint16_t> narrow(3 * layout.size().triangles);
  EXPECT_EQ(write_triangles(layout, std::span(narrow)), Status::size_overflow);
}

TEST(MeshLayout, empty_models_have_empty_meshes) {
  MeshLayout layout;
  EXPECT_EQ(lay_out_mesh(Topology(), {}, layout), Status::ok);
  EXPECT_EQ(layout.size().triangles, 0U);
  EXPECT_EQ(write_triangles(layout, std::span<std::uint32_t>()), Status::ok);
  EXPECT_EQ(layout.first_triangle(3), 0U);
}

} // namespace
} // namespace simdbezier::tests::mesh_layout_test
