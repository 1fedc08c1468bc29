// Bézier patches of random B-spline surfaces against Open CASCADE's own conversion: the same spans,
// and control points and weights that differ by roundings.
#include <GeomConvert_BSplineSurfaceToBezierSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/splines/spline_models.hpp"

namespace simdbezier::tests {
namespace {

/// Different knots with their numbers.
struct CountedKnots {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger times;

  explicit CountedKnots(const std::vector<double>& knots)
      : values(1, different(knots)), times(1, different(knots)) {
    int at = 0;
    for (std::size_t k = 0; k < knots.size(); ++k) {
      const bool is_new = k == 0 || knots[k] != knots[k - 1];
      at += is_new ? 1 : 0;
      values(at) = knots[k];
      times(at) = is_new ? 1 : times(at) + 1;
    }
  }
  static int different(const std::vector<double>& knots) {
    std::vector<double> copy = knots;
    return static_cast<int>(std::unique(copy.begin(), copy.end()) - copy.begin());
  }
};

Handle(Geom_BSplineSurface) surface_of(const SurfaceModel<double>& model) {
  const int columns = static_cast<int>(model.u.points);
  const int rows = static_cast<int>(model.v.points);
  TColgp_Array2OfPnt poles(1, columns, 1, rows);
  TColStd_Array2OfReal weights(1, columns, 1, rows);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto at = [&](std::size_t c) {
        return model.at(static_cast<std::size_t>(j), static_cast<std::size_t>(i), c);
      };
      poles(i + 1, j + 1) = gp_Pnt(at(0), at(1), at(2));
      weights(i + 1, j + 1) = model.weights == Weights::none ? 1 : at(3);
    }
  }
  const CountedKnots u(model.u.knots);
  const CountedKnots v(model.v.knots);
  return new Geom_BSplineSurface(poles, weights, u.values, v.values, u.times, v.times,
                                 model.u.degree, model.v.degree);
}

/// The largest distance of control points, and of weights up to a common factor.
double distance(const CutSurface<double>& ours, std::size_t patch,
                const Handle(Geom_BezierSurface) & theirs) {
  const bool rational = ours.nets.weights != Weights::none;
  double farthest = 0;
  for (int j = 0; j <= ours.nets.degree_v; ++j) {
    for (int i = 0; i <= ours.nets.degree_u; ++i) {
      const auto at = [&](std::size_t c) {
        return ours.at(patch, static_cast<std::size_t>(j), static_cast<std::size_t>(i), c);
      };
      const double weight = rational ? at(3) : 1;
      const gp_Pnt point(at(0) / weight, at(1) / weight, at(2) / weight);
      farthest = std::max(farthest, point.Distance(theirs->Pole(i + 1, j + 1)));
      const double scale = (rational ? ours.at(patch, 0, 0, 3) : 1) / theirs->Weight(1, 1);
      farthest = std::max(farthest, std::abs(weight - scale * theirs->Weight(i + 1, j + 1)));
    }
  }
  return farthest;
}

TEST(SpansOfOpenCascade, AreTheSame) {
  Random random(71);
  for (int k = 0; k < 200; ++k) {
    SCOPED_TRACE(k);
    const KnotKind kinds[] = {KnotKind::clamped, KnotKind::open, KnotKind::multiple};
    const AxisModel u = random_axis(random, kinds[k % 3], random.integer(1, 7), false);
    const AxisModel v = random_axis(random, kinds[k / 3 % 3], random.integer(1, 5), false);
    SurfaceModel<double> model =
        random_surface<double>(random, u, v, 3, k % 2 == 0 ? Weights::none : Weights::cartesian);
    double size = 0; // points of a model of size 1
    for (std::size_t at = 0; at < model.values.size(); ++at) {
      const bool is_weight = model.channels() == 4 && at % 4 == 3;
      size = is_weight ? size : std::max(size, std::abs(model.values[at]));
    }
    for (std::size_t at = 0; at < model.values.size(); ++at) {
      const bool is_weight = model.channels() == 4 && at % 4 == 3;
      model.values[at] /= is_weight ? 1 : size;
    }
    const CutSurface<double> ours(model.view());
    ASSERT_TRUE(ours.report);
    GeomConvert_BSplineSurfaceToBezierSurface theirs(surface_of(model));
    ASSERT_EQ(static_cast<std::size_t>(theirs.NbUPatches()), ours.spans.u);
    ASSERT_EQ(static_cast<std::size_t>(theirs.NbVPatches()), ours.spans.v);
    for (std::size_t patch = 0; patch < ours.spans.patches(); ++patch) {
      const auto at_u = static_cast<int>(patch % ours.spans.u) + 1;
      const auto at_v = static_cast<int>(patch / ours.spans.u) + 1;
      EXPECT_LE(distance(ours, patch, theirs.Patch(at_u, at_v)), 1e-13) << "patch " << patch;
    }
  }
}

} // namespace
} // namespace simdbezier::tests
