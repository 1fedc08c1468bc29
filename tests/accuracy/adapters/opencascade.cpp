// Open CASCADE, Geom_BezierSurface::D1: double.
#include <Geom_BezierSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "tests/accuracy/adapters/adapters.hpp"

namespace simdbezier::tests {
namespace {

class OpenCascadeEvaluator : public Evaluator<double> {
public:
  [[nodiscard]] std::string name() const override { return "opencascade"; }

  void evaluate(const Net& net, std::span<const Parameters2<double>> at, int /*grid*/,
                std::span<Result<double>> results) override {
    TColgp_Array2OfPnt poles(1, net.degree_u + 1, 1, net.degree_v + 1);
    for (int j = 0; j <= net.degree_v; ++j) {
      for (int i = 0; i <= net.degree_u; ++i) {
        const Vector3& point = net.at(j, i);
        poles.SetValue(i + 1, j + 1, gp_Pnt(point[0], point[1], point[2]));
      }
    }
    const Geom_BezierSurface surface(poles);
    for (std::size_t k = 0; k < at.size(); ++k) {
      gp_Pnt position;
      gp_Vec du;
      gp_Vec dv;
      surface.D1(at[k].u, at[k].v, position, du, dv);
      for (int c = 0; c < 3; ++c) {
        results[k].position[c] = position.Coord(c + 1);
        results[k].du[c] = du.Coord(c + 1);
        results[k].dv[c] = dv.Coord(c + 1);
      }
      set_normal_from_tangents(results[k]);
    }
  }
};

} // namespace

void add_opencascade(Evaluators<double>& list) {
  list.push_back(std::make_unique<OpenCascadeEvaluator>());
}

} // namespace simdbezier::tests
