// Control points of iso-parametric curves, from nets and from what sets keep of them.
#include <cmath>
#include <span>

#include "tests/curves/curve_results.hpp"
#include "tests/curves/iso_batch.hpp"

namespace simdbezier::tests::iso_points_test {
namespace {

/// Both orders: a point of the iso-curve's control polygon is one of the net's rows.
TEST(IsoPoints, AreThePointsOfRowsAndColumns) {
  for (const double ratio : {0.0, 9.0}) {
    const NetBatch<float> nets(4, 5, 2, ratio, 6);
    const std::size_t channels = ratio > 0 ? 4 : 3;
    for (const double t : {0.0, 0.3, 0.5, 1.0, 1.25}) {
      std::vector<double> u_points(4 * 3 * channels);
      std::vector<double> v_points(4 * 6 * channels);
      ASSERT_EQ(iso_u(nets.view(), t, u_points, {.threads = 2}).status, Status::ok);
      ASSERT_EQ(iso_v(nets.view(), t, v_points, {.threads = 1}).status, Status::ok);
      CurveBatch<float> rows{4 * 3, 5, 3, nets.weights, nets.points};
      for (std::size_t k = 0; k < 4 * 3; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          const double exact = oracle_curve(rows, k, c, t - 0.5).d[0].to_double();
          ASSERT_NEAR(u_points[k * channels + c], exact, 1e-13);
        }
      }
      for (std::size_t patch = 0; patch < 4; ++patch) {
        for (std::size_t i = 0; i < 6; ++i) {
          CurveBatch<float> column{1, 2, 3, nets.weights, {}};
          for (std::size_t j = 0; j < 3; ++j) {
            const float* const point = &nets.points[((patch * 3 + j) * 6 + i) * channels];
            column.points.insert(column.points.end(), point, point + channels);
          }
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_NEAR(v_points[(patch * 6 + i) * channels + c],
                        oracle_curve(column, 0, c, t - 0.5).d[0].to_double(), 1e-13);
          }
        }
      }
    }
  }
}

TEST(IsoPoints, EndsAreBoundariesAndReversalIsExact) {
  const NetBatch<double> nets(3, 4, 3, 7, 6);
  std::vector<double> points(3 * 4 * 4);
  for (const double t : {0.0, 1.0}) {
    ASSERT_EQ(iso_u(nets.view(), t, points.data()).status, Status::ok);
    const auto boundary = boundary_curves(nets.view(), t == 0 ? PatchEdge::u0 : PatchEdge::u1);
    for (std::ptrdiff_t k = 0; k < 3 * 4; ++k) {
      for (std::ptrdiff_t c = 0; c < 4; ++c) {
        EXPECT_EQ(points[static_cast<std::size_t>(4 * k + c)],
                  boundary.points[k / 4 * boundary.curve_stride + k % 4 * boundary.point_stride +
                                  c * boundary.component_stride]);
      }
    }
  }
  auto reversed = nets.view();
  reversed.points += 4 * reversed.point_stride;
  reversed.point_stride = -reversed.point_stride;
  std::vector<double> mirrored(points.size());
  ASSERT_EQ(iso_u(nets.view(), 0.3125, points.data()).status, Status::ok);
  ASSERT_EQ(iso_u(reversed, 1 - 0.3125, mirrored.data()).status, Status::ok);
  EXPECT_EQ(points, mirrored);
}

// Products with weights of any size stay within range.
TEST(IsoPoints, ScalesOfWeightsDoNotMatter) {
  NetBatch<double> nets(3, 4, 3, 7, 6);
  std::vector<double> expected(3 * 4 * 4);
  ASSERT_EQ(iso_u(nets.view(), 0.3125, expected).status, Status::ok);
  const std::vector<double> points = nets.points;
  for (const double scale : {0x1p-600, 0x1p600}) {
    for (const double weight : {0x1p-1020, 0x1p-600, 0x1p600, 0x1p1015}) {
      for (std::size_t k = 0; k < points.size(); ++k) {
        nets.points[k] = points[k] * (k % 4 == 3 ? weight : scale);
      }
      std::vector<double> found(expected.size());
      ASSERT_EQ(iso_u(nets.view(), 0.3125, found).status, Status::ok);
      for (std::size_t k = 0; k < found.size(); ++k) {
        ASSERT_EQ(found[k], expected[k] * (k % 4 == 3 ? weight : scale)) << scale << ", " << weight;
      }
    }
  }
}

TEST(IsoPoints, RefuseBadInput) {
  NetBatch<float> nets(3, 4, 3, 7, 6);
  std::vector<double> points(3 * 5 * 4, -777);
  const auto refused = [&](Status expected, const ControlNets<float>& view, double t, double* to) {
    EXPECT_EQ(to_string(iso_u(view, t, to).status), to_string(expected));
    EXPECT_EQ(to_string(iso_v(view, t, to).status), to_string(expected));
    for (const double value : points) {
      ASSERT_EQ(value, -777);
    }
  };
  auto view = nets.view();
  refused(Status::non_finite_input, view, NAN, points.data());
  refused(Status::null_output, view, 0.5, nullptr);
  view.degree_u = 16;
  refused(Status::bad_degree, view, 0.5, points.data());
  view = nets.view();
  view.components = 0;
  refused(Status::bad_components, view, 0.5, points.data());
  view = nets.view();
  view.row_stride = 0;
  refused(Status::bad_stride, view, 0.5, points.data());
  view = nets.view();
  view.points = nullptr;
  refused(Status::null_input, view, 0.5, points.data());
  view = nets.view();
  view.points = reinterpret_cast<const float*>(points.data());
  refused(Status::overlapping_outputs, view, 0.5, points.data() + 8);
  nets.points[nets.points.size() - 1] = 0;
  refused(Status::bad_weight, nets.view(), 0.5, points.data());
  nets.points[5] = NAN;
  refused(Status::non_finite_input, nets.view(), 0.5, points.data());
  CurveSet<float> set;
  const Report report = iso_u(nets.view(), 0.5, set);
  EXPECT_EQ(to_string(report.status), to_string(Status::non_finite_input));
  EXPECT_EQ(report.point, 1);
  EXPECT_EQ(report.component, 1);
  const Report parameter = iso_u(nets.view(), NAN, set);
  EXPECT_EQ(to_string(parameter.status), to_string(Status::non_finite_input));
  EXPECT_EQ(parameter.point, -1);
}

/// Iso-curves of a set come from the points that it keeps, which are the nets' own.
template <typename T>
void expect_iso_of_set(const NetBatch<T>& nets, bool along_v, double t) {
  PatchSet<T> patches;
  ASSERT_TRUE(static_cast<bool>(pack(nets.view(), patches)));
  CurveSet<T> of_set;
  CurveSet<T> of_nets;
  ASSERT_TRUE(static_cast<bool>(along_v ? iso_u(patches, t, of_set) : iso_v(patches, t, of_set)));
  ASSERT_TRUE(
      static_cast<bool>(along_v ? iso_u(nets.view(), t, of_nets) : iso_v(nets.view(), t, of_nets)));
  ASSERT_EQ(of_set.size(), nets.count);
  ASSERT_EQ(of_set.degree(), along_v ? nets.degree_v : nets.degree_u);
  ASSERT_EQ(of_set.rational(), nets.weights != Weights::none);
  CurveResults<T> expected(nets.count * 9, 3);
  CurveResults<T> results(nets.count * 9, 3);
  ASSERT_EQ(evaluate(of_nets, CurveGrid<T>::uniform(9), expected.outputs()), Status::ok);
  ASSERT_EQ(evaluate(of_set, CurveGrid<T>::uniform(9), results.outputs()), Status::ok);
  EXPECT_EQ(results.hash(), expected.hash()) << "t " << t << " along v " << along_v;
}

TEST(IsoOfSets, EqualsIsoOfNets) {
  const int degrees[][2] = {{3, 3}, {1, 4}, {7, 2}};
  for (const auto& [m, n] : degrees) {
    for (const double ratio : {0.0, 6.0}) {
      for (const double t : {0.0, 0.3, 1.0}) {
        expect_iso_of_set(NetBatch<float>(21, m, n, ratio, 8), true, t);
        expect_iso_of_set(NetBatch<double>(21, m, n, ratio, 8), false, t);
      }
    }
  }
}

/// What was subtracted when the patches were packed is not subtracted again.
TEST(IsoOfSets, AreRelativeToWhatTheSetIs) {
  NetBatch<double> nets(2, 2, 2, 0, 8);
  PackOptions moved;
  moved.relative_to[1] = 64;
  PatchSet<double> patches;
  ASSERT_TRUE(static_cast<bool>(pack(nets.view(), patches, moved)));
  CurveSet<double> curves;
  ASSERT_TRUE(static_cast<bool>(iso_v(patches, 0, curves, moved)));
  CurveResults<double> results(2 * 5, 3);
  ASSERT_EQ(evaluate(curves, CurveGrid<double>::uniform(5), results.outputs()), Status::ok);
  EXPECT_EQ(results.at(0, 0, 0), nets.points[0]);
  EXPECT_EQ(results.at(0, 1, 0), nets.points[1] - 64);
}

TEST(IsoOfSets, RefuseBadInput) {
  const NetBatch<float> nets(2, 3, 3, 0, 8);
  const NetBatch<float> others(2, 3, 2, 0, 8);
  PatchSet<float> patches;
  PatchSet<float> mixed;
  CurveSet<float> curves;
  ASSERT_TRUE(static_cast<bool>(pack(nets.view(), patches)));
  const ControlNets<float> both[] = {nets.view(), others.view()};
  ASSERT_TRUE(static_cast<bool>(pack(std::span<const ControlNets<float>>(both), mixed)));
  EXPECT_EQ(iso_u(mixed, 0.5, curves).status, Status::bad_degree);
  EXPECT_EQ(iso_v(patches, NAN, curves).status, Status::non_finite_input);
  EXPECT_TRUE(curves.empty());
  EXPECT_EQ(iso_u(PatchSet<float>(), 0.5, curves).status, Status::ok);
  EXPECT_TRUE(curves.empty());
}

} // namespace
} // namespace simdbezier::tests::iso_points_test
