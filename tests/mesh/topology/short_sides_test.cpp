// Sides that count as points because the caller says so: the vertex there has the normal of a side
// that is a point, not that of its few remaining roundings.
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

namespace simdbezier::tests::short_sides_test {
namespace {

using Corner = std::array<double, 3>;

/// A flat triangle from (1,0,0) and (0,1,0) to the tip (0,0,3), a side that is `size` long in a
/// direction out of the plane. turn: which way round the patch is read.
std::vector<double> triangle(double size, int turn) {
  const Corner tip = {0, 0, 3};
  const Corner beside = {size, -size / 2, 3 + size};
  const Corner net[2][2] = {{{1, 0, 0}, {0, 1, 0}}, {tip, beside}};
  std::vector<double> values;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const int k = (turn & 1) != 0 ? i : j;
      const int l = (turn & 1) != 0 ? j : i;
      const Corner& corner = net[(turn & 2) != 0 ? 1 - k : k][(turn & 4) != 0 ? 1 - l : l];
      values.insert(values.end(), corner.begin(), corner.end());
    }
  }
  return values;
}

struct Short {
  double size;
  double point_size;
  double snap;
};
constexpr Short kShort[] = {{1e-15, 1e-9, 0}, {1e-6, 1e-5, 0}, {1e-4, 1e-3, 0},
                            {1e-15, 0, 1e-9}, {1e-6, 0, 1e-5}, {1e-4, 0, 1e-3}};

template <typename T>
void expect_tip(const Short& c, int turn, Weights form) {
  std::vector<double> values;
  const std::vector<double> points = triangle(c.size, turn);
  for (std::size_t k = 0; k < 4; ++k) {
    const double weight = form == Weights::none ? 1 : 1 + 0.1 * static_cast<double>(k);
    for (std::size_t i = 0; i < 3; ++i) {
      values.push_back(points[3 * k + i] * (form == Weights::homogeneous ? weight : 1));
    }
    if (form != Weights::none) {
      values.push_back(weight);
    }
  }
  MeshOptions options;
  options.nu = options.nv = 4;
  options.topology.point_size = c.point_size;
  options.topology.snap = c.snap;
  const Mesh<T> mesh = tessellate<T>(
      ControlNets<double>::packed(std::span<const double>(values), 1, 1, 3, form), options);
  ASSERT_EQ(mesh.report.status, Status::ok);
  EXPECT_EQ(mesh.counts.collapsed_sides, 1U);
  int tips = 0;
  // Turned once, the patch faces the other way.
  const int mirrors = (turn & 1) + (turn >> 1 & 1) + (turn >> 2 & 1);
  const double sign = mirrors % 2 == 0 ? 1 : -1;
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    if (mesh.positions[k][2] < T(2.9)) {
      continue;
    }
    ++tips;
    const double normal[3] = {3, 3, 1};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(static_cast<double>(mesh.normals[k][i]), sign * normal[i] / std::sqrt(19.0),
                  2 * c.size + 1e-6);
    }
  }
  EXPECT_EQ(tips, 1);
}

TEST(ShortSides, have_the_normals_of_points) {
  for (const Short& c : kShort) {
    for (int turn = 0; turn < 8; ++turn) {
      for (const Weights form : {Weights::none, Weights::cartesian, Weights::homogeneous}) {
        SCOPED_TRACE(testing::Message()
                     << "size " << c.size << ", point_size " << c.point_size << ", snap " << c.snap
                     << ", turn " << turn << ", form " << static_cast<int>(form));
        expect_tip<float>(c, turn, form);
        expect_tip<double>(c, turn, form);
      }
    }
  }
}

// Both ends of the side v = 0 are one point, and its middle is half as far away as its control
// point.
TEST(ShortSides, that_bulge_count_in_the_certificate) {
  constexpr double kBulge = 0.1;
  constexpr double kX[3] = {-1, 0, 1};
  std::vector<double> values;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 3; ++i) {
      values.insert(values.end(), {j * kX[i], j == 0 && i == 1 ? -kBulge : j, 0.0});
    }
  }
  MeshOptions options;
  options.nu = options.nv = 8;
  options.topology.point_size = 2 * kBulge;
  const auto nets =
      ControlNets<double>::packed(std::span<const double>(values), 2, 1, 3, Weights::none);
  const Mesh<double> mesh = tessellate<double>(nets, options);
  ASSERT_EQ(mesh.report.status, Status::ok);
  EXPECT_EQ(mesh.counts.collapsed_sides, 1U);
  EXPECT_GE(mesh.deviation, kBulge / 2);
}

} // namespace
} // namespace simdbezier::tests::short_sides_test
