// Other bases: the same surfaces by their own formulas in exact rationals, there and back again,
// and whole B-spline meshes.
#include <gtest/gtest.h>

#include "tests/nets/net_batches.hpp"

namespace simdbezier::tests::bases_test {
namespace {

/// The basis functions' values, from their definitions.
std::vector<Rational> basis_functions(Basis basis, int degree, const Rational& t) {
  const Rational t2 = t * t;
  const Rational t3 = t2 * t;
  std::vector<Rational> values;
  switch (basis) {
  case Basis::power:
  case Basis::centred_power: {
    const Rational x = basis == Basis::power ? t : Rational(2 * t - 1);
    Rational power = 1;
    for (int k = 0; k <= degree; ++k, power *= x) {
      values.push_back(power);
    }
    return values;
  }
  case Basis::hermite:
    return {2 * t3 - 3 * t2 + 1, 3 * t2 - 2 * t3, t3 - 2 * t2 + t, t3 - t2};
  case Basis::catmull_rom:
    values = {-t3 + 2 * t2 - t, 3 * t3 - 5 * t2 + 2, -3 * t3 + 4 * t2 + t, t3 - t2};
    for (Rational& value : values) {
      value /= 2;
    }
    return values;
  case Basis::b_spline:
    values = {1 - 3 * t + 3 * t2 - t3, 3 * t3 - 6 * t2 + 4, 1 + 3 * t + 3 * t2 - 3 * t3, t3};
    for (Rational& value : values) {
      value /= 6;
    }
    return values;
  }
  return values;
}

template <typename T>
Rational surface(Basis basis, const Batch<T>& batch, std::size_t patch, std::size_t c,
                 const Rational& u, const Rational& v) {
  const auto fu = basis_functions(basis, batch.shape.degree_u, u);
  const auto fv = basis_functions(basis, batch.shape.degree_v, v);
  Rational sum = 0;
  for (int j = 0; j <= batch.shape.degree_v; ++j) {
    for (int i = 0; i <= batch.shape.degree_u; ++i) {
      sum += fu[static_cast<std::size_t>(i)] * fv[static_cast<std::size_t>(j)] *
             rational_of(batch.at(patch, j, i, c));
    }
  }
  return sum;
}

template <typename T>
Rational bezier(const Batch<T>& batch, std::size_t patch, std::size_t c, const Rational& u,
                const Rational& v) {
  const auto bu = exact_bernstein(batch.shape.degree_u, u);
  const auto bv = exact_bernstein(batch.shape.degree_v, v);
  Rational sum = 0;
  for (int j = 0; j <= batch.shape.degree_v; ++j) {
    for (int i = 0; i <= batch.shape.degree_u; ++i) {
      sum += bu[static_cast<std::size_t>(i)] * bv[static_cast<std::size_t>(j)] *
             rational_of(batch.at(patch, j, i, c));
    }
  }
  return sum;
}

struct BasisCase {
  const char* name;
  Basis basis;
  Shape shape;
};
const BasisCase kCases[] = {
    {"Power", Basis::power, {3, 3, 3, Weights::none}},
    {"PowerOfOtherDegrees", Basis::power, {1, 7, 2, Weights::none}},
    {"PowerHomogeneous", Basis::power, {2, 4, 1, Weights::homogeneous}},
    {"Centred", Basis::centred_power, {3, 3, 3, Weights::none}},
    {"CentredOfOtherDegrees", Basis::centred_power, {8, 2, 1, Weights::none}},
    {"CentredHomogeneous", Basis::centred_power, {5, 2, 1, Weights::homogeneous}},
    {"Hermite", Basis::hermite, {3, 3, 3, Weights::none}},
    {"CatmullRom", Basis::catmull_rom, {3, 3, 3, Weights::none}},
    {"BSpline", Basis::b_spline, {3, 3, 3, Weights::none}},
};
void PrintTo(const BasisCase& item, std::ostream* out) { *out << item.name; }

class BasesTest : public ::testing::TestWithParam<BasisCase> {};

/// Multiples of every denominator that occurs, so that all divisions come out even.
template <typename T>
Batch<T> divisible_batch(Shape shape, std::uint64_t seed) {
  Batch<T> batch = integer_batch<T>(shape, 5, seed);
  for (T& value : batch.values) {
    value = static_cast<T>(36 * static_cast<int>(value / 16));
  }
  return batch;
}

template <typename T>
void expect_same_surface(const BasisCase& item, const Batch<T>& other, const Batch<T>& net,
                         double tolerance) {
  const Rational parameters[] = {Rational(0), Rational(2, 7), Rational(3, 4), Rational(1)};
  for (std::size_t p = 0; p < net.count; ++p) {
    for (std::size_t c = 0; c < net.channels(); ++c) {
      for (const Rational& u : parameters) {
        for (const Rational& v : parameters) {
          const Rational error = surface(item.basis, other, p, c, u, v) - bezier(net, p, c, u, v);
          ASSERT_LE(std::abs(error.get_d()), tolerance);
        }
      }
    }
  }
}

TEST_P(BasesTest, IntegersConvertExactly) {
  const BasisCase& item = GetParam();
  const Batch<double> net = integer_batch<double>(item.shape, 5, 31);
  Batch<double> other(item.shape, 5);
  ASSERT_TRUE(from_bezier(item.basis, net.nets(), other.out()));
  expect_same_surface(item, other, net, 0);
  Batch<double> back(item.shape, 5);
  ASSERT_TRUE(to_bezier(item.basis, other.nets(), back.out()));
  EXPECT_EQ(differing(back.values, net.values), 0U) << "there and back again";
}

TEST_P(BasesTest, DivisibleIntegersConvertExactly) {
  const BasisCase& item = GetParam();
  if (item.basis == Basis::power || item.basis == Basis::centred_power) {
    return; // denominators grow with the degree; the way back above covers them
  }
  const Batch<float> other = divisible_batch<float>(item.shape, 32);
  Batch<float> net(item.shape, 5);
  ASSERT_TRUE(to_bezier(item.basis, other.nets(), net.out()));
  expect_same_surface(item, other, net, 0);
  Batch<float> back(item.shape, 5);
  ASSERT_TRUE(from_bezier(item.basis, net.nets(), back.out()));
  EXPECT_EQ(differing(back.values, other.values), 0U);
}

TEST_P(BasesTest, RandomValuesConvertWithinRoundings) {
  const BasisCase& item = GetParam();
  const Batch<float> other = random_batch<float>(item.shape, 5, 33);
  Batch<float> net(item.shape, 5);
  ASSERT_TRUE(to_bezier(item.basis, other.nets(), net.out()));
  // Rounded once: half a unit of the largest control point, of which all samples are means.
  double largest = 0;
  for (const float value : net.values) {
    largest = std::max(largest, static_cast<double>(std::abs(value)));
  }
  expect_same_surface(item, other, net, 1.01 * kUnitRoundoff<float> * largest);
}

INSTANTIATE_TEST_SUITE_P(All, BasesTest, ::testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

// The highest degree, where entries are the largest: exact on the way to powers, and back within a
// few roundings of what the conversion magnifies.
TEST(Bases, DegreeFifteen) {
  const Shape shape{15, 15, 1, Weights::none};
  for (const Basis basis : {Basis::power, Basis::centred_power}) {
    Batch<double> net = integer_batch<double>(shape, 1, 34);
    Batch<double> other(shape, 1);
    ASSERT_TRUE(from_bezier(basis, net.nets(), other.out()));
    const BasisCase item{"", basis, shape};
    expect_same_surface(item, other, net, 0);
  }
}

struct MeshCase {
  const char* name;
  std::size_t rows, columns;
  bool periodic_u, periodic_v;
  Weights weights;
};
const MeshCase kMeshes[] = {
    {"OnePatch", 4, 4, false, false, Weights::none},
    {"Open", 6, 23, false, false, Weights::none},
    {"Tube", 5, 7, true, false, Weights::none},
    {"SmallestTorus", 3, 3, true, true, Weights::none},
    {"Torus", 9, 21, true, true, Weights::none},
    {"RationalOpen", 5, 6, false, false, Weights::cartesian},
    {"RationalRing", 4, 5, false, true, Weights::homogeneous},
};
void PrintTo(const MeshCase& item, std::ostream* out) { *out << item.name; }

template <typename T>
struct Mesh {
  std::vector<T> points;
  SplineSurface<T> view;
};

template <typename T>
Mesh<T> make_mesh(const MeshCase& item) {
  const Batch<T> values =
      random_batch<T>({1, 1, 3, item.weights}, (item.rows * item.columns + 3) / 4, 35);
  Mesh<T> mesh{values.values, {}};
  const auto channels = static_cast<std::ptrdiff_t>(values.channels());
  mesh.view.points = mesh.points.data();
  mesh.view.rows = item.rows;
  mesh.view.columns = item.columns;
  mesh.view.row_stride = channels * static_cast<std::ptrdiff_t>(item.columns);
  mesh.view.point_stride = channels;
  mesh.view.weights = item.weights;
  mesh.view.periodic_u = item.periodic_u;
  mesh.view.periodic_v = item.periodic_v;
  return mesh;
}

/// Uniform bicubic splines have the bits that their pieces have one by one.
class MeshTest : public ::testing::TestWithParam<MeshCase> {};

TEST_P(MeshTest, PatchesAreTheSplineAndMeetBitForBit) {
  const MeshCase& item = GetParam();
  const Mesh<float> mesh = make_mesh<float>(item);
  const auto [nu, nv] = span_count(mesh.view);
  const Shape shape{3, 3, 3, item.weights};
  Batch<float> patches(shape, nu * nv);
  const Report report = to_bezier(mesh.view, patches.out(), {}, {.threads = 2});
  ASSERT_EQ(to_string(report.status), to_string(Status::ok));

  for (std::size_t p = 0; p < patches.count; ++p) {
    Batch<float> points(shape, 1); // the 16 points, gathered one by one
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const std::size_t row = (p / nu + static_cast<std::size_t>(j)) % item.rows;
        const std::size_t column = (p % nu + static_cast<std::size_t>(i)) % item.columns;
        for (std::size_t c = 0; c < points.channels(); ++c) {
          points.at(0, j, i, c) =
              mesh.points[(row * item.columns + column) * points.channels() + c];
        }
      }
    }
    Batch<float> alone(shape, 1);
    ASSERT_TRUE(to_bezier(Basis::b_spline, points.nets(), alone.out()));
    const std::size_t row = patches.net_values();
    const std::vector<float> there(patches.values.begin() + static_cast<std::ptrdiff_t>(p * row),
                                   patches.values.begin() +
                                       static_cast<std::ptrdiff_t>((p + 1) * row));
    ASSERT_EQ(differing(there, alone.values), 0U) << "patch " << p;
    if (item.weights != Weights::cartesian) {
      expect_same_surface({"", Basis::b_spline, shape}, points, alone, 1e-6);
    }
  }

  std::vector<EdgeLink> edges(4 * patches.count);
  ASSERT_EQ(find_adjacency(patches.nets(), edges.data()), Status::ok);
  for (std::size_t p = 0; p < patches.count && patches.count > 9; ++p) {
    const bool at_right = !item.periodic_u && p % nu + 1 == nu;
    const EdgeLink right = edges[4 * p + static_cast<std::size_t>(PatchEdge::u1)];
    const EdgeLink left{EdgeKind::shared, PatchEdge::u0, false, p / nu * nu + (p % nu + 1) % nu};
    EXPECT_EQ(right, at_right ? EdgeLink{} : left) << "patch " << p;
    const bool at_top = !item.periodic_v && p / nu + 1 == nv;
    const EdgeLink top = edges[4 * p + static_cast<std::size_t>(PatchEdge::v1)];
    const EdgeLink bottom{EdgeKind::shared, PatchEdge::v0, false, (p / nu + 1) % nv * nu + p % nu};
    EXPECT_EQ(top, at_top ? EdgeLink{} : bottom) << "patch " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(All, MeshTest, ::testing::ValuesIn(kMeshes),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace simdbezier::tests::bases_test
