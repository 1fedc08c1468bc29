// Open CASCADE, Geom_BezierSurface::D2 and GeomLProp_SLProps: double.
#include <algorithm>

#include <GeomLProp_SLProps.hxx>
#include <Geom_BezierSurface.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "tests/properties/accuracy/suite/adapters/adapters.hpp"

namespace simdbezier::tests {
namespace {

class OpenCascadeEvaluator : public Evaluator<double> {
public:
  [[nodiscard]] std::string name() const override { return "opencascade"; }

  [[nodiscard]] Capabilities capabilities(const Net& /*net*/) const override {
    return {.second_derivatives = true, .curvature = true};
  }

  void evaluate(const Net& net, std::span<const Parameters2<double>> at, int /*grid*/,
                std::span<Result<double>> results) override {
    const Handle(Geom_BezierSurface) surface = make_surface(net);
    for (std::size_t k = 0; k < at.size(); ++k) {
      gp_Pnt position;
      gp_Vec first[2];
      gp_Vec second[3];
      surface->D2(at[k].u, at[k].v, position, first[0], first[1], second[0], second[2], second[1]);
      for (int c = 0; c < 3; ++c) {
        results[k].position[c] = position.Coord(c + 1);
        results[k].du[c] = first[0].Coord(c + 1);
        results[k].dv[c] = first[1].Coord(c + 1);
        results[k].duu[c] = second[0].Coord(c + 1);
        results[k].duv[c] = second[1].Coord(c + 1);
        results[k].dvv[c] = second[2].Coord(c + 1);
      }
      set_normal_from_tangents(results[k]);
      set_curvature(surface, at[k], results[k]);
    }
  }

private:
  [[nodiscard]] static Handle(Geom_BezierSurface) make_surface(const Net& net) {
    const Net polygon = control_polygon(net);
    TColgp_Array2OfPnt poles(1, net.degree_u + 1, 1, net.degree_v + 1);
    TColStd_Array2OfReal weights(1, net.degree_u + 1, 1, net.degree_v + 1);
    for (int j = 0; j <= net.degree_v; ++j) {
      for (int i = 0; i <= net.degree_u; ++i) {
        const Vector3& point = polygon.at(j, i);
        poles.SetValue(i + 1, j + 1, gp_Pnt(point[0], point[1], point[2]));
        weights.SetValue(i + 1, j + 1, net.weight(j, i));
      }
    }
    return net.is_rational() ? new Geom_BezierSurface(poles, weights)
                             : new Geom_BezierSurface(poles);
  }

  /// Zero where it finds no normal, which curvatures need; for some samples it says so by throwing.
  static void set_curvature(const Handle(Geom_BezierSurface) & surface,
                            const Parameters2<double>& at, Result<double>& result) {
    constexpr double kResolution = 1e-300; // no tangent counts as zero
    std::fill_n(result.curvature, 4, 0.0);
    try {
      GeomLProp_SLProps properties(surface, at.u, at.v, 2, kResolution);
      if (properties.IsCurvatureDefined()) {
        result.curvature[0] = properties.GaussianCurvature();
        result.curvature[1] = properties.MeanCurvature();
        result.curvature[2] = properties.MinCurvature();
        result.curvature[3] = properties.MaxCurvature();
      }
    } catch (const Standard_Failure&) {
    }
  }
};

} // namespace

void add_opencascade(Evaluators<double>& list) {
  list.push_back(std::make_unique<OpenCascadeEvaluator>());
}

} // namespace simdbezier::tests
