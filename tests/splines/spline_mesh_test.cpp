// Meshes of splines: what is certified is the distance from the spline, not from its patches.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/splines/spline_oracle.hpp"

namespace simdbezier::tests::spline_mesh_test {
namespace {

/// The point of one patch at fractions of it, nets being [channel][patch][j][i].
std::vector<Rational> point_at(const std::vector<std::vector<Rational>>& nets, std::size_t patch,
                               std::size_t order_u, std::size_t order_v, const Rational& u,
                               const Rational& v) {
  std::vector<Rational> sums;
  for (const std::vector<Rational>& channel : nets) {
    std::vector<std::vector<Rational>> rows;
    for (std::size_t j = 0; j < order_v; ++j) {
      const auto row =
          channel.begin() + static_cast<std::ptrdiff_t>((patch * order_v + j) * order_u);
      rows.emplace_back(row, row + static_cast<std::ptrdiff_t>(order_u));
    }
    const auto reduce = [](std::vector<Rational> line, const Rational& t) {
      for (; line.size() > 1; line.pop_back()) {
        for (std::size_t k = 0; k + 1 < line.size(); ++k) {
          line[k] = (1 - t) * line[k] + t * line[k + 1];
        }
      }
      return line.front();
    };
    std::vector<Rational> column;
    for (const auto& row : rows) {
      column.push_back(reduce(row, u));
    }
    sums.push_back(reduce(column, v));
  }
  return sums;
}

/// What is to be below 1: the largest distance at equal parameters, in extraction_error().
template <typename T>
double share_of_bound(const SurfaceModel<T>& model) {
  const CutSurface<T> cut(model.view());
  EXPECT_TRUE(cut.report);
  const std::size_t channels = model.channels();
  std::vector<std::vector<Rational>> exact;
  std::vector<std::vector<Rational>> found(channels);
  for (std::size_t c = 0; c < channels; ++c) {
    exact.push_back(exact_nets(model, c));
    for (std::size_t k = c; k < cut.values.size(); k += channels) {
      found[c].emplace_back(static_cast<double>(cut.values[k]));
    }
  }
  double worst = 0;
  const Rational places[] = {Rational(1, 3), 1};
  for (std::size_t patch = 0; patch < cut.spans.patches(); ++patch) {
    for (const Rational& u : places) {
      const Rational& v = places[patch % 2];
      const auto a = point_at(exact, patch, model.u.order(), model.v.order(), u, v);
      const auto b = point_at(found, patch, model.u.order(), model.v.order(), u, v);
      Rational square = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const Rational apart =
            channels == 3 ? Rational(a[c] - b[c]) : Rational(a[c] / a[3] - b[c] / b[3]);
        square += apart * apart;
      }
      worst = std::max(worst, std::sqrt(square.get_d()));
    }
  }
  return worst / extraction_error(model.view());
}

template <typename T>
class SplineMeshes : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SplineMeshes, Scalars);

TYPED_TEST(SplineMeshes, ExtractionIsAsCloseAsItsBound) {
  Random random(77);
  double worst = 0;
  for (const Weights weights : {Weights::none, Weights::cartesian, Weights::homogeneous}) {
    for (const KnotKind kind : kKnotKinds) {
      for (const double spread : {0.0, 8.0}) { // of weights, in powers of two
        const AxisModel u = random_axis(random, kind, random.integer(1, 5), false);
        const AxisModel v = random_axis(random, kKnotKinds[random.below(8)], random.integer(1, 3),
                                        random.below(2) == 0);
        auto model = random_surface<TypeParam>(random, u, v, 3, weights);
        for (std::size_t k = 0; k < u.points * v.points && weights != Weights::none; ++k) {
          const auto factor =
              static_cast<TypeParam>(std::exp2(std::floor(spread * random.symmetric())));
          for (std::size_t c = weights == Weights::cartesian ? 3 : 0; c < 4; ++c) {
            model.values[4 * k + c] *= factor;
          }
        }
        const double share = share_of_bound(model);
        EXPECT_LE(share, 1) << name_of(kind) << ", weights " << static_cast<int>(weights);
        worst = std::max(worst, share);
      }
    }
  }
  EXPECT_GT(worst, 0.01); // a bound of that order
}

/// Two surfaces of different degrees, one with weights.
template <typename T>
std::vector<SurfaceModel<T>> two_models() {
  Random random(78);
  const auto axis = [&](int degree) {
    return random_axis(random, KnotKind::clamped, degree, false);
  };
  return {random_surface<T>(random, axis(3), axis(2), 3, Weights::none),
          random_surface<T>(random, axis(2), axis(2), 3, Weights::cartesian)};
}

TYPED_TEST(SplineMeshes, AreMeshesOfNetsThatKnowWhatCuttingRounded) {
  using T = TypeParam;
  const std::vector<SurfaceModel<T>> models = two_models<T>();
  const std::vector<SplineSurface<T>> surfaces = {models[0].view(), models[1].view()};
  const CutSurface<T> cut[] = {CutSurface<T>(surfaces[0]), CutSurface<T>(surfaces[1])};
  const std::vector<ControlNets<T>> nets = {cut[0].nets, cut[1].nets};
  for (const bool left_out : {false, true}) { // numbers of patches change on the way
    MeshOptions options;
    options.nu = options.nv = 3;
    options.drop_repeated = left_out;
    options.split_edges = left_out;
    Report report{Status::bad_range};
    const auto mesh = tessellate<T>(std::span<const SplineSurface<T>>(surfaces), options, &report);
    const auto of_nets = tessellate<T>(std::span<const ControlNets<T>>(nets), options);
    const auto plan = plan_mesh<T>(std::span<const SplineSurface<T>>(surfaces), options);
    ASSERT_TRUE(mesh);
    ASSERT_TRUE(report);
    ASSERT_TRUE(of_nets);
    EXPECT_EQ(plan.deviation, mesh.deviation);
    EXPECT_EQ(mesh.positions, of_nets.positions);
    EXPECT_EQ(mesh.triangles, of_nets.triangles);
    ASSERT_EQ(mesh.deviations.size(), cut[0].spans.patches() + cut[1].spans.patches());
    for (std::size_t patch = 0; patch < mesh.deviations.size(); ++patch) {
      const double error = extraction_error(surfaces[patch < cut[0].spans.patches() ? 0 : 1]);
      const double more = mesh.deviations[patch] - of_nets.deviations[patch];
      const double rounding = 0x1p-50 * mesh.deviations[patch];
      EXPECT_GE(more, error - rounding) << patch;
      EXPECT_LE(more, 1.01 * error + rounding) << patch;
    }
  }
}

TYPED_TEST(SplineMeshes, KeepNoToleranceThatCuttingExceeds) {
  using T = TypeParam;
  const std::vector<SurfaceModel<T>> models = two_models<T>();
  const SplineSurface<T> surface = models[1].view();
  const CutSurface<T> cut(surface);
  const ControlNets<T> nets = cut.nets;
  // Results in double are so close to the nets that it is cutting alone that leaves no room.
  MeshOptions options;
  options.rates.tolerance = 0.9 * extraction_error(surface);
  EXPECT_EQ(tessellate<double>(surface, options).report.status, Status::bad_tolerance);
  options.rates.tolerance = 1e-3 * plan_mesh<double>(nets, {.nu = 2, .nv = 2}).diagonal;
  const auto mesh = tessellate<double>(surface, options);
  ASSERT_TRUE(mesh);
  EXPECT_LE(mesh.deviation, options.rates.tolerance);
}

// Points of a pole that are one but not equal: patches have one of them, and the bound says so.
template <typename S>
void expect_pole_within(double unit) {
  constexpr std::size_t kColumns = 8;
  std::vector<S> points;
  for (std::size_t k = 0; k < 2 * kColumns; ++k) {
    const std::size_t column = k % kColumns;
    const double x = k < kColumns ? 1 + 16 * unit * static_cast<double>(column % 2) : 0.5;
    const double y = k < kColumns ? 0 : (static_cast<double>(column) - 3.5) / 16;
    points.insert(points.end(), {static_cast<S>(x), static_cast<S>(y), 0, 1});
  }
  const double knots[] = {0, 0, 1, 1};
  SplineSurface<S> surface;
  surface.points = points.data();
  surface.rows = 2;
  surface.columns = kColumns;
  surface.row_stride = 4 * kColumns;
  surface.point_stride = 4;
  surface.weights = Weights::homogeneous;
  surface.degree_v = 1;
  surface.knots_v = knots;
  EXPECT_GE(extraction_error(surface), 11 * unit); // of means by 1/3 and 2/3
  EXPECT_LE(extraction_error(surface), 200 * unit);
}
// Where a periodic spline closes, its last and its first points may be one with other weights.
TEST(SplinePoles, StayOneAcrossTheSeam) {
  Random random(23);
  std::size_t odd = 0; // means that are another point
  for (int round = 0; round < 100; ++round) {
    const double apex = random.unit() + 1;
    const double weight[2] = {random.unit() + 0.5, random.unit() + 0.5};
    std::vector<double> points; // x, w: two rows of four columns
    for (int row = 0; row < 2; ++row) {
      for (const double w : {weight[0], 1.0, 2.0, weight[1]}) {
        const bool is_apex = w == weight[0] || w == weight[1];
        points.insert(points.end(), {is_apex ? apex + row : random.unit(), w});
      }
    }
    SplineSurface<double> surface;
    surface.points = points.data();
    surface.rows = 2;
    surface.columns = 4;
    surface.row_stride = 8;
    surface.point_stride = 2;
    surface.components = 1;
    surface.weights = Weights::cartesian;
    surface.periodic_u = true;
    surface.degree_u = 2;
    surface.degree_v = 1;
    std::vector<double> nets(4 * 12);
    ASSERT_TRUE(to_bezier(
        surface, MutableNets<double>::packed(nets.data(), 4, 2, 1, 1, Weights::homogeneous)));
    const double* const end = nets.data() + 2 * 12 + 4; // of the piece of points 2, 3, 0
    EXPECT_EQ(end[0], apex * end[1]);
    odd += (weight[0] * apex + weight[1] * apex) / 2 != apex * ((weight[0] + weight[1]) / 2);
  }
  EXPECT_GT(odd, 10U);
}

TEST(SplineMeshBounds, CountWhatPolesLose) {
  expect_pole_within<float>(0x1p-24);
  expect_pole_within<double>(0x1p-53);
}

TEST(SplineMeshReports, NameTheSurface) {
  std::vector<SurfaceModel<double>> models = two_models<double>();
  const auto report_of = [&](auto spoil) {
    std::vector<SplineSurface<double>> surfaces = {models[0].view(), models[1].view(),
                                                   models[1].view()};
    spoil(surfaces);
    Report report;
    const auto mesh = tessellate<double>(std::span<const SplineSurface<double>>(surfaces),
                                         {.nu = 2, .nv = 2}, &report);
    EXPECT_EQ(mesh.report.status, report.status);
    EXPECT_TRUE(mesh.positions.empty());
    return report;
  };
  const Report components = report_of([](auto& all) { all[2].components = 2; });
  EXPECT_EQ(components.status, Status::bad_components);
  EXPECT_EQ(components.item, 2U);
  const Report knots = report_of([](auto& all) { all[2].knots_v = all[2].knots_v.first(4); });
  EXPECT_EQ(knots.status, Status::bad_knots);
  EXPECT_EQ(knots.item, 2U);
  EXPECT_EQ(knots.component, 1);
  models[0].at(1, 2, 1) = std::numeric_limits<double>::infinity();
  const Report point = report_of([](auto&) {});
  EXPECT_EQ(point.status, Status::non_finite_input);
  EXPECT_EQ(point.point, models[0].u.points + 2);
}

} // namespace
} // namespace simdbezier::tests::spline_mesh_test
