// Rates that are raised so that meshes are surfaces, and rates that stay as they are.
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/rates.hpp>

#include "tests/mesh/support/mesh_models.hpp"
#include "tests/mesh/support/triangle_census.hpp"

namespace simdbezier::tests::separation_test {
namespace {

using Point = std::array<double, 3>;

/// The mesh of some nets, all patches of which ask for the same rates.
struct SeparatedMesh {
  Topology topology;
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  std::size_t raised = 0;
  MeshSize size;
  TriangleCensus census;

  SeparatedMesh(const ControlNets<double>& nets, std::uint32_t rate_u, std::uint32_t rate_v)
      : SeparatedMesh(nets, std::vector(nets.count, rate_u), std::vector(nets.count, rate_v)) {}
  SeparatedMesh(const ControlNets<double>& nets, std::vector<std::uint32_t> rates_u,
                std::vector<std::uint32_t> rates_v)
      : nu(std::move(rates_u)), nv(std::move(rates_v)) {
    EXPECT_EQ(find_topology(nets, topology), Status::ok);
    EXPECT_EQ(separate_vertices(topology, nu, nv, raised), Status::ok);
    MeshLayout layout;
    EXPECT_EQ(lay_out_mesh(topology, {nu, nv, {}}, layout), Status::ok);
    size = layout.size();
    std::vector<std::uint32_t> triangles(3 * size.triangles);
    EXPECT_EQ(write_triangles(layout, std::span(triangles), {.threads = 1}), Status::ok);
    census = count_triangles<std::uint32_t>(triangles, size.vertices);
  }
};

SeparatedMesh mesh_of(const MeshModel& model, std::uint32_t rate_u, std::uint32_t rate_v) {
  const std::vector<double> values = model.values();
  return {ControlNets<double>::packed(std::span<const double>(values)), rate_u, rate_v};
}

/// A second sheet on a surface that is one already: nothing is separated, and no cells are needed.
TEST(Separation, gives_repeated_patches_the_rates_of_the_first) {
  for (const MeshModel& model : mesh_models()) {
    if (model.repeated) {
      continue;
    }
    const std::size_t n = model.patches.size();
    for (const std::size_t copies : {2U, 3U}) {
      MeshModel several = model;
      for (std::size_t k = 1; k < copies; ++k) {
        const MeshModel others = shuffled(model, static_cast<unsigned>(k));
        several.patches.insert(several.patches.end(), others.patches.begin(), others.patches.end());
      }
      for (const std::uint32_t rate : {1U, 2U, 3U}) {
        SCOPED_TRACE(model.name + ", rate " + std::to_string(rate));
        const SeparatedMesh once = mesh_of(model, rate, rate);
        const SeparatedMesh mesh = mesh_of(several, rate, rate);
        EXPECT_EQ(mesh.topology.counts().repeated_patches, (copies - 1) * n);
        EXPECT_EQ(mesh.raised, copies * once.raised);
        EXPECT_EQ(mesh.size.triangles, copies * once.size.triangles);
        EXPECT_EQ(mesh.census.degenerate + mesh.census.unused, 0U);
        EXPECT_TRUE(std::equal(once.nu.begin(), once.nu.end(), mesh.nu.begin()));
        EXPECT_TRUE(std::equal(once.nv.begin(), once.nv.end(), mesh.nv.begin()));
      }
    }
  }
}

/// A patch on one edge of others, so that it has more than two sides.
PatchPoints fin_on(const PatchPoints& patch) {
  PatchPoints fin;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      fin[j][i] = patch[0][i];
      fin[j][i][2] += 0.7 * static_cast<double>(j);
      fin[j][i][1] -= static_cast<double>(j);
    }
  }
  return fin;
}

TEST(Separation, takes_patches_with_the_same_edges_apart_beside_a_third) {
  for (MeshModel model : mesh_models()) {
    if (model.name != "pillow") {
      continue;
    }
    model.patches.push_back(fin_on(model.patches[0]));
    for (const std::uint32_t rate : {1U, 2U, 3U}) {
      const SeparatedMesh mesh = mesh_of(model, rate, rate);
      EXPECT_LE(mesh.nu[0], std::max(rate, 2U));
      EXPECT_EQ(mesh.nu[2], rate);
      EXPECT_EQ(mesh.census.repeated + mesh.census.degenerate + mesh.census.unused, 0U);
      EXPECT_EQ(mesh.census.crowded, std::max(rate, 2U)) << "segments of the fin's edge alone";
    }
  }
}

/// Two neighbouring sides are one edge, which no number of cells takes apart.
TEST(Separation, leaves_rates_that_do_not_help) {
  PatchPoints cone;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      cone[j][i] = {1.0 * static_cast<double>(i + j),
                    i > 0 && j > 0 ? 1.0 * static_cast<double>(i) - static_cast<double>(j) : 0.0,
                    0.3 * static_cast<double>(i * j)};
    }
  }
  for (const bool with_fin : {false, true}) {
    MeshModel model{"cone", {cone}};
    if (with_fin) {
      model.patches.push_back(fin_on(cone));
    }
    for (const std::uint32_t rate : {1U, 2U, 4U}) {
      const SeparatedMesh mesh = mesh_of(model, rate, rate);
      EXPECT_EQ(mesh.topology.counts().edges, with_fin ? 6U : 3U);
      EXPECT_EQ(mesh.raised, 0U) << rate << ", " << with_fin;
      EXPECT_EQ(mesh.nu[0], rate);
    }
  }
}

/// Three sides are one point, and the fourth one ends where it begins.
TEST(Separation, leaves_the_rates_of_patches_with_three_sides_in_a_point) {
  for (std::size_t open = 0; open < 4; ++open) { // v0, v1, u0, u1
    PatchPoints petal{};
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const bool on[] = {j == 0, j == 3, i == 0, i == 3};
        const bool along = open < 2 ? i == 1 || i == 2 : j == 1 || j == 2;
        const bool inside = (i == 1 || i == 2) && (j == 1 || j == 2);
        if (inside || (on[open] && along)) {
          petal[j][i] = {1.0 + static_cast<double>(i), 1.0 + static_cast<double>(j * j),
                         inside ? 1.0 : 0.0};
        }
      }
    }
    for (const std::uint32_t nu : {1U, 2U, 3U, 4U, 5U}) {
      for (const std::uint32_t nv : {1U, 2U, 3U, 4U, 7U}) {
        SCOPED_TRACE(std::to_string(open) + ", " + std::to_string(nu) + " x " + std::to_string(nv));
        const SeparatedMesh mesh = mesh_of({"petal", {petal}}, nu, nv);
        EXPECT_EQ(mesh.topology.counts().collapsed_sides, 3U);
        // Between opposite sides that are points, two rows of vertices make a surface.
        EXPECT_EQ(mesh.raised, (open < 2 ? nu : nv) < 3 ? 1U : 0U);
        EXPECT_LE(mesh.nu[0], std::max(nu + 1, 3U));
        EXPECT_LE(mesh.nv[0], std::max(nv + 1, 3U));
        EXPECT_EQ(mesh.census.degenerate + mesh.census.unused + mesh.census.crowded, 0U);
        EXPECT_EQ(mesh.census.repeated, 0U);
        EXPECT_EQ(mesh.census.euler, 1);
      }
    }
  }
}

/// All four sides are one point: a bubble, and a patch that is nothing but that point.
TEST(Separation, gives_patches_between_points_triangles) {
  for (const double size : {1.0, 0.0}) {
    PatchPoints bubble{};
    for (std::size_t j = 1; j < 3; ++j) {
      for (std::size_t i = 1; i < 3; ++i) {
        bubble[j][i] = {size * (static_cast<double>(i) - 1.5),
                        size * (static_cast<double>(j) - 1.5), size * static_cast<double>(i + j)};
      }
    }
    for (const std::uint32_t nu : {1U, 2U, 3U, 5U}) {
      for (const std::uint32_t nv : {1U, 2U, 3U, 4U}) {
        const SeparatedMesh mesh = mesh_of({"bubble", {bubble}}, nu, nv);
        EXPECT_EQ(mesh.nu[0], std::max(nu, 3U));
        EXPECT_EQ(mesh.nv[0], std::max(nv, 3U));
        EXPECT_EQ(mesh.census.euler, 2);
        EXPECT_EQ(mesh.census.open + mesh.census.crowded + mesh.census.repeated +
                      mesh.census.degenerate + mesh.census.unused,
                  0U);
      }
    }
  }
}

/// A patch with some sides that are the origin (1: v0, 2: v1, 4: u0, 8: u1). Control points of the
/// other sides depend on them alone.
PatchPoints patch_with_points(unsigned points, double height) {
  PatchPoints patch;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const bool at_origin = ((points & 1) != 0 && j == 0) || ((points & 2) != 0 && j == 3) ||
                             ((points & 4) != 0 && i == 0) || ((points & 8) != 0 && i == 3);
      const bool inside = (i == 1 || i == 2) && (j == 1 || j == 2);
      const auto x = static_cast<double>(i);
      const auto y = static_cast<double>(j);
      patch[j][i] = at_origin ? Point{} : Point{2 + x * (y + 1), 3 - y * y, inside ? height : 0};
    }
  }
  return patch;
}

/// Two patches on one boundary, three or two of whose sides are one point, with all small rates of
/// either: what coincides does so in one pair of them and not in the next.
TEST(Separation, takes_two_patches_on_one_boundary_of_few_edges_apart) {
  for (const unsigned points : {7U, 11U, 13U, 14U, 5U, 6U, 9U, 10U}) {
    const MeshModel lens{"lens", {patch_with_points(points, 1), patch_with_points(points, -1)}};
    const std::vector<double> values = lens.values();
    const auto nets = ControlNets<double>::packed(std::span<const double>(values));
    constexpr std::uint32_t kMost = 4;
    for (std::uint32_t code = 0; code < kMost * kMost * kMost * kMost; ++code) {
      const std::vector<std::uint32_t> nu = {1 + code % kMost, 1 + code / kMost % kMost};
      const std::vector<std::uint32_t> nv = {1 + code / (kMost * kMost) % kMost,
                                             1 + code / (kMost * kMost * kMost)};
      SCOPED_TRACE(std::to_string(points) + ": " + std::to_string(nu[0]) + " x " +
                   std::to_string(nv[0]) + ", " + std::to_string(nu[1]) + " x " +
                   std::to_string(nv[1]));
      const SeparatedMesh mesh(nets, nu, nv);
      EXPECT_EQ(mesh.topology.counts().open_edges, 0U);
      EXPECT_EQ(mesh.census.euler, 2);
      EXPECT_EQ(mesh.census.open + mesh.census.crowded + mesh.census.repeated +
                    mesh.census.degenerate + mesh.census.unused,
                0U);
    }
  }
}

TEST(Separation, is_refused_beyond_the_most_segments) {
  for (const MeshModel& model : mesh_models()) {
    if (model.name != "torus 1 x 1") {
      continue;
    }
    const std::vector<double> values = model.values();
    const auto nets = ControlNets<double>::packed(std::span<const double>(values));
    Topology topology;
    ASSERT_EQ(find_topology(nets, topology), Status::ok);
    std::uint32_t nu = 0;
    std::uint32_t nv = 0;
    std::uint16_t diagonals = 0;
    for (const std::uint32_t most : {1U, 2U, 3U, 8U}) {
      RateOptions options;
      options.tolerance = 100;
      options.most_segments = most;
      const Report report =
          choose_rates(std::span(&nets, 1), topology, options,
                       {std::span(&nu, 1), std::span(&nv, 1), std::span(&diagonals, 1), {}});
      EXPECT_EQ(report.status, most < 3 ? Status::bad_tolerance : Status::ok) << most;
      EXPECT_TRUE(most < 3 || nu * nv == 9) << nu << " x " << nv;
    }
  }
}

/// Sheets that all pass through two poles, two by two behind each other, however many there are.
TEST(Separation, finds_what_coincides_between_corners_of_many_patches) {
  const Point north = {0, 0, 1};
  const Point south = {0, 0, -1};
  for (const int sheets : {3, 20, 32, 33, 100}) {
    const auto around = [&](double k, double r) {
      const double a = 6.283185307179586 * std::fmod(k, sheets) / sheets;
      return Point{r * std::cos(a), r * std::sin(a), 0};
    };
    std::vector<double> values;
    for (int k = 0; k < sheets; ++k) {
      const Point a = around(k, 1);
      const Point b = around(k + 0.4, 1);
      const Point next = around(k + 1, 1);
      const Point outer = around(k + 0.7, 1.1);
      for (const Point& p : {a, north, south, b, north, b, next, outer, south, next, b, outer}) {
        values.insert(values.end(), p.begin(), p.end());
      }
    }
    const auto nets = ControlNets<double>::packed(values.data(), values.size() / 12, 1, 1);
    const SeparatedMesh mesh(nets, 1, 1);
    EXPECT_EQ(mesh.topology.counts().open_edges, 0U) << sheets;
    EXPECT_GT(mesh.raised, 0U) << sheets;
    EXPECT_EQ(mesh.census.crowded + mesh.census.repeated + mesh.census.open, 0U) << sheets;
  }
}

} // namespace
} // namespace simdbezier::tests::separation_test
