// Meshes in other bases against their own functions, and transformations against long double.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include <tools/formats/rib/bases.hpp>
#include <tools/formats/surfaces/affine_map.hpp>
#include <tools/formats/surfaces/basis_mesh.hpp>

#include "tests/program/formats/format_files.hpp"

namespace simdbezier::tests::basis_mesh_test {
namespace {

using tools::AffineMap;
using tools::BasisFunctions;
using tools::BasisMatrix;

// Numbers that long double can take further than the code judged; elsewhere it is no wider.
constexpr bool kLongDoubleIsWider = sizeof(long double) > sizeof(double);

/// Values of a mesh, the weight of each being the last one.
struct Mesh {
  std::vector<double> points;
  std::vector<std::uint32_t> lines;
};

template <typename Value>
Mesh make_mesh(std::size_t count, std::size_t each, const Value& value) {
  Mesh mesh;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t c = 0; c < each; ++c) {
      mesh.points.push_back(value());
    }
    mesh.lines.push_back(static_cast<std::uint32_t>(k + 1));
  }
  return mesh;
}

long double function_value(const BasisFunctions& functions, std::size_t j, long double t) {
  const auto order = static_cast<std::size_t>(functions.degree) + 1;
  long double value = 0;
  for (std::size_t k = order; k-- > 0;) {
    value = value * t + functions.coefficients[k * order + j];
  }
  return value / functions.denominator;
}

long double bernstein(int degree, int k, long double t) {
  long double value = std::pow(t, k) * std::pow(1 - t, degree - k);
  for (int i = 1; i <= k; ++i) {
    value *= static_cast<long double>(degree - k + i) / i;
  }
  return value;
}

/// A direction of the mesh under test.
struct Direction {
  BasisFunctions functions;
  tools::MeshDirection mesh;
};

using Position = std::array<long double, 3>;

Position divided(const std::array<long double, 4>& sum, std::size_t each) {
  const long double weight = each == 4 ? sum[3] : 1;
  return {sum[0] / weight, sum[1] / weight, sum[2] / weight};
}

/// The surface by its own functions.
Position by_functions(const Mesh& mesh, const Direction& u, const Direction& v, std::size_t each,
                      std::size_t patch, long double tu, long double tv) {
  std::array<long double, 4> sum = {};
  for (std::size_t j = 0; j <= static_cast<std::size_t>(v.functions.degree); ++j) {
    for (std::size_t i = 0; i <= static_cast<std::size_t>(u.functions.degree); ++i) {
      const std::size_t index = v.mesh.point(patch / u.mesh.patches, j) * u.mesh.points +
                                u.mesh.point(patch % u.mesh.patches, i);
      const long double factor =
          function_value(u.functions, i, tu) * function_value(v.functions, j, tv);
      for (std::size_t c = 0; c < each; ++c) {
        sum[c] += factor * mesh.points[index * each + c];
      }
    }
  }
  return divided(sum, each);
}

Position by_bezier(const tools::PatchFile& file, std::size_t patch, long double tu,
                   long double tv) {
  const tools::PatchRun& run = file.run_of(patch);
  std::array<long double, 4> sum = {};
  for (int j = 0; j <= run.degree_v; ++j) {
    for (int i = 0; i <= run.degree_u; ++i) {
      const auto value = file.point(patch, static_cast<std::size_t>(j * (run.degree_u + 1) + i));
      for (std::size_t c = 0; c < value.size(); ++c) {
        sum[c] += bernstein(run.degree_u, i, tu) * bernstein(run.degree_v, j, tv) * value[c];
      }
    }
  }
  return divided(sum, run.values_per_point());
}

void expect_surface(const Direction& u, const Direction& v, const Mesh& mesh, Weights weights) {
  const std::size_t each = weights == Weights::none ? 3 : 4;
  tools::PatchFile file;
  const BasisMatrix matrix_u(u.functions);
  const BasisMatrix matrix_v(v.functions);
  const double error = tools::add_basis_mesh(
      file, {matrix_u, matrix_v, u.mesh, v.mesh, weights, mesh.points, mesh.lines});
  ASSERT_EQ(file.count, u.mesh.patches * v.mesh.patches);
  EXPECT_LT(error, 1e-10);
  for (std::size_t patch = 0; patch < file.count; ++patch) {
    for (const long double tu : {0.0L, 0.3L, 1.0L}) {
      for (const long double tv : {0.0L, 0.6L, 1.0L}) {
        const Position expected = by_functions(mesh, u, v, each, patch, tu, tv);
        const Position found = by_bezier(file, patch, tu, tv);
        const auto distance = static_cast<double>(
            std::hypot(expected[0] - found[0], expected[1] - found[1], expected[2] - found[2]));
        EXPECT_LE(distance, error * (kLongDoubleIsWider ? 1.01 : 3) + 1e-16)
            << "patch " << patch << " at " << tu << ", " << tv;
      }
    }
  }
}

BasisFunctions some_functions(int degree, std::mt19937_64& random, bool integers) {
  std::uniform_real_distribution<double> number(-3, 3);
  BasisFunctions functions{degree, {}, integers ? 7.0 : 0.7};
  for (int k = 0; k < (degree + 1) * (degree + 1); ++k) {
    const double value = number(random);
    functions.coefficients.push_back(integers ? std::nearbyint(value) : value);
  }
  return functions;
}

TEST(BasisMesh, IsTheSurfaceOfItsFunctionsUpToItsBound) {
  std::mt19937_64 random(58);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int degree = 1; degree <= kMostDegree; ++degree) {
    for (const bool integers : {true, false}) {
      const int other = 1 + degree * 7 % kMostDegree;
      const std::size_t order = static_cast<std::size_t>(degree) + 1;
      const std::size_t other_order = static_cast<std::size_t>(other) + 1;
      const Direction u{some_functions(degree, random, integers), {order + 2, 2, 2}};
      const Direction v{some_functions(other, random, !integers),
                        {2 * other_order, other_order, 2}}; // periodic
      SCOPED_TRACE("degrees " + std::to_string(degree) + ", " + std::to_string(other));
      expect_surface(u, v,
                     make_mesh(u.mesh.points * v.mesh.points, 3, [&] { return number(random); }),
                     Weights::none);
    }
  }
}

TEST(BasisMesh, TakesHomogeneousWeights) {
  std::mt19937_64 random(59);
  std::uniform_real_distribution<double> number(0.5, 1);
  const BasisFunctions spline{3, {1, 4, 1, 0, -3, 0, 3, 0, 3, -6, 3, 0, -1, 3, -3, 1}, 6};
  const Direction u{spline, {6, 1, 6}}; // periodic
  const Direction v{spline, {5, 1, 2}};
  expect_surface(u, v, make_mesh(30, 4, [&] { return number(random); }), Weights::homogeneous);
}

// (p0 + 4 p1 + p2) / 6 and its like, in whole numbers.
TEST(BasisMesh, IsExactForWholeNumbers) {
  struct Case {
    const char* basis;
    std::array<double, 4> values;
    std::array<double, 4> points;
  };
  const Case cases[] = {{"b-spline", {6, 0, 0, 0}, {1, 0, 0, 0}},
                        {"b-spline", {0, 6, 0, 0}, {4, 4, 2, 1}},
                        {"b-spline", {0, 0, 6, 0}, {1, 2, 4, 4}},
                        {"b-spline", {1, 1, 1, 2}, {1, 1, 1, 7 / 6.0}},
                        {"catmull-rom", {6, 0, 0, 0}, {0, -1, 0, 0}},
                        {"catmull-rom", {0, 6, 12, 0}, {6, 8, 13, 12}},
                        {"catmull-rom", {0, 0, 1, 1}, {0, 1 / 6.0, 5 / 6.0, 1}},
                        {"hermite", {1, 3, 5, 6}, {1, 2, 3, 5}},
                        {"hermite", {0, 1, 0, 0}, {0, 1 / 3.0, 0, 0}},
                        {"power", {1, 0, 0, 0}, {0, 0, 0, 1}},
                        {"power", {2, 3, 6, 5}, {5, 7, 10, 16}}};
  const BasisMatrix bezier = *tools::rib_basis_matrix(tools::kRibNamedBases[0].matrix, 1);
  for (const auto& [name, values, expected] : cases) {
    SCOPED_TRACE(name);
    const tools::RibBasis basis = tools::rib_basis(name, 1);
    Mesh mesh;
    for (int k = 0; k < 16; ++k) { // constant across the other direction
      const double x = values[static_cast<std::size_t>(k % 4)];
      const double y = values[static_cast<std::size_t>(k / 4)];
      mesh.points.insert(mesh.points.end(), {x, y, x});
      mesh.lines.push_back(1);
    }
    tools::PatchFile in_u;
    tools::PatchFile in_v;
    static_cast<void>(tools::add_basis_mesh(
        in_u,
        {*basis.matrix, bezier, {4, 1, 1}, {4, 1, 1}, Weights::none, mesh.points, mesh.lines}));
    static_cast<void>(tools::add_basis_mesh(
        in_v,
        {bezier, *basis.matrix, {4, 1, 1}, {4, 1, 1}, Weights::none, mesh.points, mesh.lines}));
    for (std::size_t k = 0; k < 16; ++k) {
      EXPECT_EQ(in_u.point(0, k)[0], expected[k % 4]) << k;
      EXPECT_EQ(in_v.point(0, k)[1], expected[k / 4]) << k;
    }
  }
}

// What neighbours have in common has equal bits, also across a seam.
TEST(BasisMesh, HasNoGaps) {
  std::mt19937_64 random(60);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const char* const name : {"b-spline", "catmull-rom"}) {
    const tools::RibBasis basis = tools::rib_basis(name, 1);
    const Mesh mesh = make_mesh(5 * 7, 3, [&] { return number(random); });
    tools::PatchFile file;
    static_cast<void>(tools::add_basis_mesh(file, {*basis.matrix,
                                                   *basis.matrix,
                                                   {5, 1, 5},
                                                   {7, 1, 4},
                                                   Weights::none,
                                                   mesh.points,
                                                   mesh.lines}));
    ASSERT_EQ(file.count, 20U);
    for (std::size_t p = 0; p < 20; ++p) {
      const std::size_t right = p / 5 * 5 + (p + 1) % 5;
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_EQ(file.point(p, 4 * k + 3)[c], file.point(right, 4 * k)[c]);
          if (p + 5 < 20) {
            EXPECT_EQ(file.point(p, 12 + k)[c], file.point(p + 5, k)[c]);
          }
        }
      }
    }
  }
}

/// A point under transformations, in long double, and the map that is to do the same.
struct MovedPoint {
  std::array<long double, 3> point;
  AffineMap map;
};

void move(MovedPoint& moved, const std::array<std::array<long double, 3>, 3>& rows,
          const AffineMap& map) {
  const std::array<long double, 3> p = moved.point;
  for (std::size_t c = 0; c < 3; ++c) {
    moved.point[c] = p[0] * rows[0][c] + p[1] * rows[1][c] + p[2] * rows[2][c];
  }
  moved.map = moved.map * map;
}

TEST(AffineMap, IsOffByItsBoundAtMost) {
  if (!kLongDoubleIsWider) {
    GTEST_SKIP() << "long double is double";
  }
  std::mt19937_64 random(61);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int k = 0; k < 2000; ++k) {
    const std::array<double, 3> start = {number(random), number(random), number(random)};
    const double third = 1 / 3.0;
    MovedPoint moved{{start[0] + static_cast<long double>(third), start[1], start[2]},
                     AffineMap::translation({third, 0, 0})};
    for (int step = 0; step < k % 7; ++step) {
      const double degrees = 400 * number(random);
      const long double angle = std::fmod(static_cast<long double>(degrees), 360.0L) *
                                3.14159265358979323846264338327950288L / 180;
      const long double c = std::cos(angle);
      const long double s = std::sin(angle);
      const double x = number(random);
      const double tilt = 20 * number(random);
      const long double skew =
          std::tan(static_cast<long double>(tilt) * 3.14159265358979323846264338327950288L / 180);
      move(moved, {{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}}, *AffineMap::rotation(degrees, {0, 0, 2}));
      move(moved, {{{x, 0, 0}, {0, 3, 0}, {0, 0, -1}}}, AffineMap::scaling({x, 3, -1}));
      move(moved, {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}, *AffineMap::rotation(120, {1, 1, 1}));
      move(moved, {{{1, 0, 0}, {0, 1, skew}, {0, 0, 1}}},
           *AffineMap::skew(tilt, {0, 3, 0}, {0, 0, 1}));
      const AffineMap shift = AffineMap::translation({x, third, -x});
      moved.map = moved.map * shift;
      moved.point = {moved.point[0] + x, moved.point[1] + third, moved.point[2] - x};
    }
    std::array<double, 3> point = start;
    const double bound = moved.map.move(point.data(), 1);
    const auto distance = static_cast<double>(std::hypot(
        moved.point[0] - point[0], moved.point[1] - point[1], moved.point[2] - point[2]));
    ASSERT_LE(distance, bound);
    ASSERT_LE(bound, 1e-8);
  }
}

} // namespace
} // namespace simdbezier::tests::basis_mesh_test
